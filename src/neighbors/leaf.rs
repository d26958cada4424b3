//! The points of a leaf, coordinate by coordinate, in double and in single precision.

use glam::DVec3;

/// Points in a leaf.
pub(super) const LEAF: usize = 32;

/// Points of a leaf, coordinate by coordinate; what is left over lies at infinity.
pub(super) type Leaf = [[f64; LEAF]; 3];

/// The same points in single precision, seen from the leaf's center, in the tree's frame.
#[derive(Debug, Clone, Copy)]
// No vector straddles two lines of the cache.
#[repr(C, align(64))]
pub(super) struct Near {
    /// -2 times their coordinates.
    pub(super) minus_twice: [[f32; LEAF]; 3],
    /// Their squared distances from the center; what is left over lies at infinity.
    pub(super) squared: [f32; LEAF],
    /// The largest distance from the center, or a little more.
    pub(super) radius: f32,
    /// In the tree's frame.
    pub(super) center: [f64; 3],
}

impl Near {
    pub(super) const NONE: Self = Self {
        minus_twice: [[0.0; LEAF]; 3],
        squared: [f32::INFINITY; LEAF],
        radius: 0.0,
        center: [0.0; 3],
    };

    /// Of points in the tree's frame.
    pub(super) fn new(points: &[DVec3]) -> Self {
        let mut near = Self::NONE;
        let (low, high) = extent(points);
        let center = 0.5 * (low + high);
        near.center = center.to_array();
        for (i, &point) in points.iter().enumerate() {
            let p = (point - center).as_vec3();
            for e in 0..3 {
                near.minus_twice[e][i] = -2.0 * p[e];
            }
            near.squared[i] = p.as_dvec3().length_squared() as f32;
            near.radius = near.radius.max(p.length());
        }
        near.radius *= 1.0 + 1e-6;
        near
    }
}

/// The lowest and the highest of each coordinate; there must be points.
pub(super) fn extent(points: &[DVec3]) -> (DVec3, DVec3) {
    let first = points[0];
    points
        .iter()
        .fold((first, first), |(low, high), &p| (low.min(p), high.max(p)))
}
