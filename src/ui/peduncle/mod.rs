//! The peduncle: its picking in the view, its hues, its references, and the questions about its file.

mod bar;
mod hues;
pub(in crate::ui) mod keys;
mod question;
mod references;
mod tools;

pub(in crate::ui) use bar::show as bar;
pub(in crate::ui) use hues::show as hue_bar;
pub(in crate::ui) use question::show as question;
pub(in crate::ui) use references::{beside, show as references};
pub(in crate::ui) use tools::{drag, paint, picking_tools};
