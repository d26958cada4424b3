//! The points that are the peduncle, and the two references that they give.

mod grow;
mod hue;
mod peduncle;

pub use grow::{grown, median_spacing, shrunk};
pub use hue::{HueRange, hue_deg};
pub use peduncle::{Peduncle, PeduncleError, PeduncleSource};
