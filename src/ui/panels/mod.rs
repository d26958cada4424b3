//! The panels beside the view: a file or folder each.

pub mod contributions;
pub mod files;
pub mod hemisphere;
pub mod parameters;
pub mod point;
pub mod ranking;
pub mod score_map;
pub mod scrub;
pub mod warnings;
