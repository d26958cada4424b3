//! The peduncle's points, and the two reference axes that follow from them.

mod grow;
mod hue;
mod reference;

pub use grow::{grown, median_spacing, shrunk};
pub use hue::{HueRange, hue_deg};
pub use reference::{Peduncle, PeduncleError, PeduncleSource};
