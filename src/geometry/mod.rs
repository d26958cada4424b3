//! Points, planes and lines, and what can be computed from them without knowing the method.
//!
//! Positions are `f64` in the file's own unit and frame, so that nothing has to be moved back
//! before it is shown; whoever wants `f32` (the GPU, a search) subtracts a nearby origin first.

mod cloud;
mod line;
pub(crate) mod parallel;
mod plane;
mod unit;
mod watch;

pub use cloud::{Cloud, LengthMismatch};
pub use line::{angle_between_directions_rad, angle_between_lines_rad};
pub use plane::Plane;
pub use unit::Unit;
pub use watch::{Cancelled, Watch};
