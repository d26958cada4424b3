//! The peduncle's points, and the two reference axes that follow from them.

mod grow;
mod hue;
mod peduncle;

pub use grow::{grown, median_spacing, shrunk};
pub use hue::{HueRange, hue_deg};
pub use peduncle::{Peduncle, PeduncleError, PeduncleSource};
