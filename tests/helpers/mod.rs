//! What several tests need.
#![allow(dead_code, reason = "each target uses some of it")]

pub mod bodies;
pub mod campaign;
pub mod command_line;
pub mod disk;
#[cfg(feature = "window")]
pub mod driving;
#[cfg(feature = "snapshots")]
pub mod in_window;
pub mod peppers;
pub mod ply_text;
pub mod store;
