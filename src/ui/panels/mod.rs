//! The panes beside the view: a file or folder each, named as the pane.

pub mod clouds;
pub mod contributions;
pub mod estimators;
pub mod hemisphere;
pub mod parameters;
pub mod ranking;
pub mod score_map;
pub mod simulate;
pub mod why_this_score;
