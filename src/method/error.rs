//! The error of an axis against another (§ 3).

use crate::geometry::angle_between_lines_rad;
use crate::method::AxisEstimate;

/// The angle between two undirected axes in radians, 0 to π/2.
pub fn axis_error_rad(axis: &AxisEstimate, reference: &AxisEstimate) -> f64 {
    angle_between_lines_rad(axis.direction, reference.direction)
}
