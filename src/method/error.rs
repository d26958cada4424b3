//! The error of an axis against a reference (§ 3).

use crate::geometry::angle_between_lines_rad;
use crate::method::AxisEstimate;

/// Computes the angle between two undirected axes in radians, 0 to π/2.
pub fn axis_error_rad(axis: &AxisEstimate, reference: &AxisEstimate) -> f64 {
    angle_between_lines_rad(axis.direction, reference.direction)
}
