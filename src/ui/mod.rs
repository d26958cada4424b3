//! What is drawn: one file a panel. A panel reads the [`State`](crate::app::State) and says
//! [`Command`](crate::app::Command)s; it changes nothing itself.

pub mod contributions;
mod controls;
pub mod files;
pub mod parameters;
pub mod point;
pub mod warnings;
