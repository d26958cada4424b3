//! Queries that walk through the tree together.
//!
//! Single precision sorts out the leaves, with a bound on its rounding; the leaf that won is then
//! compared in double precision. Where the bound leaves two leaves in the running, as with points
//! that are equally far, the query is asked again by itself.

use glam::{DVec3, Vec3};

use super::boxes::SLACK;
use super::tree::{LEAF, Tree};

/// Queries in a block: twice what the widest vectors hold of single precision.
pub(super) const BLOCK: usize = 32;

/// What one number is for each query.
type Lanes = [f32; BLOCK];

/// What rounding may add to or take off the squared distance from a point of a leaf, in units of
/// r (|w| + r), w being the query seen from the leaf's center and r the leaf's radius: some 16
/// roundings of 2^-24.
const LEAF_ROUNDING: f32 = 1.0 / (1 << 20) as f32;
/// The same for the squared distance from the leaf's center, which is rounded to single precision
/// after what all leaves have in common is taken off it.
const CENTER_ROUNDING: f32 = 1.0 / (1 << 22) as f32;
/// The same for what was computed in double precision, in units of (|w| + 2)².
const DOUBLE_ROUNDING: f32 = 1.0 / (1u64 << 48) as f32;
/// More than is lost where products fall below single precision's range.
const UNDERFLOW: f32 = 1e-37;
/// Farther away than this many half extents of the points, squares are not trusted.
const FAR: f32 = 1e12;

/// A block of queries, in the tree's frame, and what they have found so far.
pub(super) struct Block {
    queries: [[f64; BLOCK]; 3],
    in_frame: [Lanes; 3],
    /// A point that the queries lie around, and how far each of them lies from it.
    center: Vec3,
    from_center: Lanes,
    /// What rounding may add to a distance from a box.
    slack: Lanes,
    /// Squared distances are kept as what they exceed this by: a small number, which single
    /// precision holds well.
    reference: [f64; BLOCK],
    rounded_reference: Lanes,
    /// The squared distance of the nearest point, and of the nearest in any other leaf than its.
    least: Lanes,
    second: Lanes,
    /// What rounding may have changed in any of them.
    rounding: Lanes,
    /// The leaf of the nearest point.
    leaf: [u32; BLOCK],
    /// How far a box may be and hold something nearer, squared.
    reach_squared: Lanes,
    /// How far it may be from the center and hold something nearer to any query, squared.
    center_reach_squared: f32,
}

impl Block {
    /// Up to [`BLOCK`] queries, at least one; a short block is filled up with its last. The
    /// distances of `leaf`'s center are what others are compared with. `None` where the queries are
    /// so far away that squares of distances mean little.
    #[inline(always)]
    pub(super) fn new(tree: &Tree, queries: &[DVec3], leaf: usize) -> Option<Self> {
        let mut block = Self {
            queries: [[0.0; BLOCK]; 3],
            in_frame: [[0.0; BLOCK]; 3],
            center: Vec3::ZERO,
            from_center: [0.0; BLOCK],
            slack: [0.0; BLOCK],
            reference: [0.0; BLOCK],
            rounded_reference: [0.0; BLOCK],
            least: [f32::INFINITY; BLOCK],
            second: [f32::INFINITY; BLOCK],
            rounding: [0.0; BLOCK],
            leaf: [leaf as u32; BLOCK],
            reach_squared: [f32::INFINITY; BLOCK],
            center_reach_squared: f32::INFINITY,
        };
        for i in 0..BLOCK {
            let query = tree.in_frame(queries[i.min(queries.len() - 1)]);
            for e in 0..3 {
                block.queries[e][i] = query[e];
            }
        }
        let center = tree.leaf_center(leaf);
        let mut mean = [0.0; 3];
        for e in 0..3 {
            for i in 0..BLOCK {
                block.in_frame[e][i] = block.queries[e][i] as f32;
                let w = block.queries[e][i] - center[e];
                block.reference[i] += w * w;
            }
            mean[e] = fold(block.in_frame[e], |a, b| a + b) / BLOCK as f32;
        }
        let mut near = true;
        for i in 0..BLOCK {
            let q = [block.in_frame[0][i], block.in_frame[1][i], block.in_frame[2][i]];
            let size = 1.0 + q[0].abs() + q[1].abs() + q[2].abs();
            let d = [q[0] - mean[0], q[1] - mean[1], q[2] - mean[2]];
            block.slack[i] = SLACK * size;
            block.rounded_reference[i] = block.reference[i] as f32;
            block.from_center[i] = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
            near &= size < FAR;
        }
        block.center = Vec3::from_array(mean);
        near.then_some(block)
    }

    /// Looks for nearer points in a leaf, in which it must not have looked before. Says whether there
    /// were any.
    #[inline(always)]
    pub(super) fn look_into(&mut self, tree: &Tree, leaf: usize) -> bool {
        let center = tree.leaf_center(leaf);
        let near = tree.leaf_near(leaf);
        let mut w = [[0.0; BLOCK]; 3];
        let mut base = [0.0; BLOCK];
        for i in 0..BLOCK {
            let from_center: [f64; 3] = [
                self.queries[0][i] - center[0],
                self.queries[1][i] - center[1],
                self.queries[2][i] - center[2],
            ];
            let squared = from_center[0] * from_center[0]
                + from_center[1] * from_center[1]
                + from_center[2] * from_center[2];
            base[i] = (squared - self.reference[i]) as f32;
            w[0][i] = from_center[0] as f32;
            w[1][i] = from_center[1] as f32;
            w[2][i] = from_center[2] as f32;
        }
        let mut least = [f32::INFINITY; BLOCK];
        for j in (0..LEAF).step_by(2) {
            // |w - p|² = |w|² - 2 w·p + |p|², whose last two terms are small. Two points at a time,
            // since each comparison with the least waits for the one before it.
            let ([x, y, z], squared) = (&near.minus_twice, &near.squared);
            for i in 0..BLOCK {
                let more = squared[j] + w[0][i] * x[j] + w[1][i] * y[j] + w[2][i] * z[j];
                let k = j + 1;
                let other = squared[k] + w[0][i] * x[k] + w[1][i] * y[k] + w[2][i] * z[k];
                let more = if other < more { other } else { more };
                least[i] = if more < least[i] { more } else { least[i] };
            }
        }
        let mut nearer = false;
        for i in 0..BLOCK {
            let size = w[0][i].abs() + w[1][i].abs() + w[2][i].abs();
            let squared = base[i] + least[i];
            let rounding = LEAF_ROUNDING * near.radius * (size + near.radius)
                + CENTER_ROUNDING * (base[i].abs() + squared.abs())
                + DOUBLE_ROUNDING * (size + 2.0) * (size + 2.0)
                + UNDERFLOW;
            let before = self.least[i];
            let (low, high) = if squared < before {
                (squared, before)
            } else {
                (before, squared)
            };
            self.leaf[i] = if squared < before {
                leaf as u32
            } else {
                self.leaf[i]
            };
            nearer |= squared < before;
            self.least[i] = low;
            self.second[i] = if high < self.second[i] {
                high
            } else {
                self.second[i]
            };
            self.rounding[i] = if rounding > self.rounding[i] {
                rounding
            } else {
                self.rounding[i]
            };
        }
        nearer
    }

    /// Draws the reach in to what was found.
    #[inline(always)]
    pub(super) fn update_reach(&mut self) {
        let mut from_center = [0.0; BLOCK];
        for i in 0..BLOCK {
            let squared = self.rounded_reference[i] + self.least[i] + self.rounding[i];
            let squared = if squared > 0.0 { squared } else { 0.0 };
            let reach = squared.sqrt() * (1.0 + SLACK) + self.slack[i];
            self.reach_squared[i] = reach * reach;
            from_center[i] = (reach + self.from_center[i]) * (1.0 + SLACK);
        }
        let farthest = fold(from_center, |a, b| if a > b { a } else { b });
        self.center_reach_squared = farthest * farthest;
    }

    /// A point that the queries lie around, in the tree's frame.
    #[inline(always)]
    pub(super) fn center(&self) -> Vec3 {
        self.center
    }

    /// How far from the center a box may be and hold something nearer to any query, squared.
    #[inline(always)]
    pub(super) fn center_reach_squared(&self) -> f32 {
        self.center_reach_squared
    }

    /// Whether a box may hold something nearer to any query.
    #[inline(always)]
    pub(super) fn may_find_in(&self, tree: &Tree, leaf: usize) -> bool {
        tree.any_within(leaf, &self.in_frame, &self.reach_squared)
    }

    /// The leaf in which the query's nearest point seems to be, and whether it surely is.
    #[inline(always)]
    pub(super) fn found(&self, i: usize) -> (usize, bool) {
        let surely = self.second[i] - self.least[i] > 2.0 * self.rounding[i];
        (self.leaf[i] as usize, surely)
    }
}

/// Halves lanes again and again, as vectors can.
#[inline(always)]
fn fold(mut lanes: Lanes, op: fn(f32, f32) -> f32) -> f32 {
    for half in [BLOCK / 2, BLOCK / 4, BLOCK / 8, BLOCK / 16] {
        for i in 0..half {
            lanes[i] = op(lanes[i], lanes[i + half]);
        }
    }
    op(lanes[0], lanes[1])
}
