//! What is drawn. A panel reads the [`State`](crate::app::State) and says
//! [`Command`](crate::app::Command)s; it changes nothing itself.

pub mod inspector;
pub mod many;
pub mod panels;
mod peduncle;
pub mod true_axes;
mod widgets;
pub mod window;

pub use window::layout::{Pane, first_layout, layout_from};
pub use window::open::{OpenError, open_window, session_path};
pub use window::theme::set_up;
pub use window::{Start, Window};
