//! Axes to compare the method's axis with.

mod error;
mod grow;
mod hue;
mod peduncle;

pub use error::axis_error_rad;
pub use grow::{grown, median_spacing, shrunk};
pub use hue::{HueRange, hue_deg};
pub use peduncle::{Peduncle, PeduncleError, PeduncleSource};
