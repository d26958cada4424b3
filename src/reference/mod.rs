//! Axes to compare the method's axis with.

mod error;
mod peduncle;

pub use error::axis_error_rad;
pub use peduncle::{HueRange, Peduncle, PeduncleError, PeduncleSource, hue_deg};
