//! Picking the peduncle in the view, and what is asked and told about it.

mod bar;
mod hues;
pub(super) mod keys;
mod question;
mod references;
mod tools;

pub(super) use bar::show as bar;
pub(super) use hues::show as hue_bar;
pub(super) use question::show as question;
pub(super) use references::{beside, show as references};
pub(super) use tools::{drag, paint};
