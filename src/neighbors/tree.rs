//! A tree of boxes over leaves of points, laid out by number alone: a group holds the boxes of sixteen
//! leaves that follow one another, or of sixteen groups of the level below.

use std::ops::Range;

use glam::DVec3;
use pulp::Scalar;

use super::boxes::{BoxGroup, OrientedBox, WIDTH};
use super::leaf::{LEAF, Leaf};
use crate::parallel::map_pieces;

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
}

impl Tree {
    /// Builds the tree on `points`, of which there must be some, in the order in which it holds them.
    pub(super) fn new(points: &[DVec3]) -> Self {
        let (mut size, mut levels) = (LEAF, Vec::new());
        let mut leaves: Vec<Leaf> = Vec::new();
        let leaf = |(points, bounds): (&[DVec3], &OrientedBox)| Leaf::new(points, bounds);
        loop {
            // The boxes of small nodes by sixteens, of large ones one by one.
            let nodes = if points.len() > 256 * size { WIDTH } else { 1 };
            let work = |range: Range<usize>| -> Vec<OrientedBox> {
                points[range].chunks(size).map(OrientedBox::around).collect()
            };
            let boxes = map_pieces(points.len(), nodes * size, &(), work).unwrap_or_default();
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
            let mut exact = [[f64::INFINITY; LEAF]; 3];
            for (i, point) in points.iter().enumerate() {
                for e in 0..3 {
                    exact[e][i] = point[e];
                }
            }
            exact
        });
        Self {
            leaves,
            exact: exact.collect(),
            levels,
            len: points.len(),
        }
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

    /// The squared distance from `q` to the nearest point of a leaf, and the first position that has it.
    #[inline(always)]
    pub(super) fn nearest_in(&self, leaf: usize, q: DVec3) -> (f64, usize) {
        // The first position stands in where all distances overflow.
        let mut best = (f64::INFINITY, leaf * LEAF);
        for (position, squared) in (leaf * LEAF..).zip(self.distances_squared(leaf, q)) {
            if squared < best.0 {
                best = (squared, position);
            }
        }
        best
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
