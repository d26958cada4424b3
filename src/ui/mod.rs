//! What is drawn: one file a panel. A panel reads the [`State`](crate::app::State) and says
//! [`Command`](crate::app::Command)s; it changes nothing itself.

mod about;
pub mod actions;
pub mod annotating;
mod color_scale;
pub mod contributions;
mod controls;
mod dialogs;
pub mod files;
pub mod folder;
mod help;
pub mod hemisphere;
mod layout;
mod marks;
mod menu;
mod notice;
mod open;
mod paint;
mod palette;
mod panes;
pub mod parameters;
mod peduncle;
mod plane_tip;
mod planes;
pub mod point;
pub mod ranking;
mod rows;
mod save_image;
pub mod score_map;
pub mod scrub;
mod status;
mod theme;
mod view3d;
mod view_bar;
pub mod warnings;
mod window;

pub use layout::{Pane, first_layout, layout_from};
pub use open::{OpenError, open_window, session_path};
pub use theme::set_up;
pub use window::{Start, Window};
