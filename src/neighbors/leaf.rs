//! The points of a leaf in single precision, and their bounding box.

use glam::DVec3;

use super::boxes::OrientedBox;

/// Points in a leaf.
pub(super) const LEAF: usize = 32;

/// The points of a leaf, coordinate by coordinate, seen from the center of their bounding box.
#[derive(Debug, Clone, Copy)]
// No vector straddles two lines of the cache.
#[repr(C, align(64))]
pub(super) struct Leaf {
    /// -2 times the coordinates.
    pub(super) minus_twice: [[f32; LEAF]; 3],
    /// The squared distances from the center. Missing points of the last leaf lie at infinity.
    pub(super) squared: [f32; LEAF],
    /// The axes and the half extents of the bounding box.
    pub(super) axes: [[f32; 3]; 3],
    pub(super) half: [f32; 3],
    /// At least the largest distance from the center of any point, and of any corner of the box.
    pub(super) radius: f32,
    pub(super) center: [f64; 3],
}

impl Leaf {
    /// A leaf of `points`, at most [`LEAF`], within their bounding box.
    pub(super) fn new(points: &[DVec3], bounds: &OrientedBox) -> Self {
        let mut leaf = Self {
            minus_twice: [[0.0; LEAF]; 3],
            squared: [f32::INFINITY; LEAF],
            axes: bounds.axes.map(|axis| axis.to_array()),
            half: bounds.half.as_vec3().to_array(),
            radius: bounds.half.length() as f32 * (1.0 + 1e-6),
            center: bounds.center.to_array(),
        };
        for (i, &point) in points.iter().enumerate() {
            let p = (point - bounds.center).as_vec3();
            for e in 0..3 {
                leaf.minus_twice[e][i] = -2.0 * p[e];
            }
            leaf.squared[i] = p.as_dvec3().length_squared() as f32;
        }
        leaf
    }
}
