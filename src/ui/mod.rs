//! What is drawn: one file a panel. A panel reads the [`State`](crate::app::State) and says
//! [`Command`](crate::app::Command)s; it changes nothing itself.

mod controls;
pub mod parameters;
