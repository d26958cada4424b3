//! What is drawn: one file a panel. A panel reads the [`State`](crate::app::State) and says
//! [`Command`](crate::app::Command)s; it changes nothing itself.

mod color_scale;
pub mod hemisphere;
mod marks;
mod notice;
mod plane_tip;
mod planes;
pub mod ranking;
pub mod score_map;
pub mod scrub;
