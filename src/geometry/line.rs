//! Angles between directions and between lines.

use glam::DVec3;

/// The angle between two directions in radians, 0 to π; neither needs to be of unit length.
///
/// By the tangent rather than the arc cosine, which loses half of its digits near 0 and π.
pub fn angle_between_directions_rad(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// The angle between two undirected lines in radians, 0 to π/2 (§ 3: the error of an axis).
pub fn angle_between_lines_rad(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b).abs())
}
