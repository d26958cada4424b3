//! A tree of boxes over leaves of points, laid out by number alone: a group holds the boxes of sixteen
//! leaves that follow one another, or of sixteen groups of the level below.

use std::ops::Range;

use glam::DVec3;
use pulp::Scalar;

use super::boxes::{BoxGroup, OrientedBox, WIDTH};
use crate::parallel::{Cancelled, Watch, map_pieces};

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

#[derive(Debug)]
pub(super) struct Tree {
    /// The points of each leaf in single precision.
    pub(super) leaves: Vec<Leaf>,
    /// The points of each leaf in double precision, coordinate by coordinate. Missing points of the last
    /// leaf lie at infinity.
    exact: Vec<[[f64; LEAF]; 3]>,
    /// The boxes of the leaves, then those of sixteen leaves each, up to a single group.
    pub(super) levels: Vec<Vec<BoxGroup>>,
    /// The number of points.
    pub(super) len: usize,
    /// The median of the leaves' radii.
    pub(super) typical_radius: f32,
}

impl Tree {
    /// Builds the tree on `points`, of which there must be some, in the order in which it holds them.
    pub(super) fn new(points: &[DVec3], watch: &dyn Watch) -> Result<Self, Cancelled> {
        let (mut size, mut levels) = (LEAF, Vec::new());
        let mut leaves: Vec<Leaf> = Vec::new();
        let leaf = |(points, bounds): (&[DVec3], &OrientedBox)| Leaf::new(points, bounds);
        loop {
            // The boxes of small nodes by sixteens, of large ones one by one.
            let nodes = if points.len() > 256 * size { WIDTH } else { 1 };
            let work = |range: Range<usize>| -> Vec<OrientedBox> {
                points[range].chunks(size).map(OrientedBox::around).collect()
            };
            let boxes = map_pieces(points.len(), nodes * size, watch, work)?;
            let boxes = boxes.concat();
            if size == LEAF {
                leaves = points.chunks(LEAF).zip(&boxes).map(leaf).collect();
            }
            levels.push(boxes.chunks(WIDTH).map(BoxGroup::new).collect());
            if boxes.len() <= WIDTH {
                break;
            }
            size *= WIDTH;
        }
        let exact = points.chunks(LEAF).map(|points| {
            let at = |i, e| points.get(i).map_or(f64::INFINITY, |p: &DVec3| p[e]);
            [0, 1, 2].map(|e| std::array::from_fn(|i| at(i, e)))
        });
        let mut radii: Vec<f32> = leaves.iter().map(|leaf| leaf.radius).collect();
        let middle = radii.len() / 2;
        watch.go_on()?;
        Ok(Self {
            typical_radius: *radii.select_nth_unstable_by(middle, f32::total_cmp).1,
            leaves,
            exact: exact.collect(),
            levels,
            len: points.len(),
        })
    }

    /// The positions of a leaf's points in the tree's order.
    #[inline(always)]
    pub(super) fn positions(&self, leaf: usize) -> Range<usize> {
        leaf * LEAF..((leaf + 1) * LEAF).min(self.len)
    }

    /// The point at a position of the tree's order.
    #[inline(always)]
    pub(super) fn point(&self, position: usize) -> DVec3 {
        let [x, y, z] = &self.exact[position / LEAF];
        DVec3::new(x[position % LEAF], y[position % LEAF], z[position % LEAF])
    }

    /// The squared distances from `q` to the points of a leaf.
    #[inline(always)]
    pub(super) fn distances_squared(&self, leaf: usize, q: DVec3) -> [f64; LEAF] {
        let [x, y, z] = &self.exact[leaf];
        let mut sum = [0.0; LEAF];
        for i in 0..LEAF {
            let d = [q.x - x[i], q.y - y[i], q.z - z[i]];
            sum[i] = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        }
        sum
    }

    /// A leaf near `from`: down the most promising boxes.
    pub(super) fn descend(&self, from: &[f64; 3]) -> usize {
        let node = self.levels.iter().rev().fold(0, |node: usize, groups| {
            let group = node.min(groups.len() - 1);
            group * WIDTH + groups[group].most_promising::<Scalar>(from)
        });
        node.min(self.leaves.len() - 1)
    }
}
