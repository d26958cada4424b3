//! A plane, and reflections in it.

use glam::DVec3;

/// A plane through a point, with a normal of unit length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point in the plane.
    pub point: DVec3,
    /// Its normal, of unit length.
    pub normal: DVec3,
}

impl Plane {
    /// The signed distance from the plane, positive on the normal's side (d_x of Eq. 12).
    pub fn signed_distance(&self, p: DVec3) -> f64 {
        (p - self.point).dot(self.normal)
    }

    /// The mirror image of a point (Eq. 12).
    pub fn reflect_point(&self, p: DVec3) -> DVec3 {
        p - 2.0 * self.signed_distance(p) * self.normal
    }

    /// The mirror image of a direction, such as a normal (Eq. 13).
    pub fn reflect_direction(&self, v: DVec3) -> DVec3 {
        v - 2.0 * v.dot(self.normal) * self.normal
    }
}
