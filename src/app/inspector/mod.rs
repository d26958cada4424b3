//! The cloud that is looked at: its analysis, and the view of one of its candidate planes.

pub(super) mod command_line;
pub(super) mod details;
pub(super) mod image;
pub mod look;
pub(super) mod navigate;
pub mod planes;
pub(super) mod stages;
mod update;
pub mod why;
