//! The interface. Each panel reads the [`State`](crate::app::State) and returns
//! [`Command`](crate::app::Command)s; it changes nothing itself.

mod action;
pub mod inspector;
pub mod many;
mod pane;
pub mod panels;
mod peduncle;
pub mod true_axes;
mod widgets;
mod window;

pub use action::{Act, Action, Group, WindowAct};
pub use pane::Pane;
pub use window::actions::actions;
pub use window::layout::{first_layout, layout_from};
pub use window::open::{OpenError, open_window, session_path};
pub use window::theme::set_up;
pub use window::{Start, Window};
