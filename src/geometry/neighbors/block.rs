//! Queries that walk through the tree together.
//!
//! Single precision sorts out the leaves, with a bound on its rounding; the leaf that won is then
//! compared in double precision. Where the bound leaves two leaves in the running, as with points
//! that are equally far, the query is asked again by itself.

use glam::{DVec3, Vec3};
use pulp::Simd;

use super::boxes::{SLACK, times_plus};
use super::tree::{LEAF, Tree};

/// Queries in a block: twice what the widest vectors hold of single precision.
pub(crate) const BLOCK: usize = 32;

/// What one number is for each query.
type Lanes = [f32; BLOCK];
/// The same in double precision.
pub(super) type Double = [f64; BLOCK];

/// What rounding may add to or take off the squared distance from a point of a leaf, in units of
/// r (w + r), r being the leaf's radius and w at least as far as any query is from its center: some
/// 20 roundings of 2^-24.
const LEAF_ROUNDING: f32 = 1.0 / (1 << 19) as f32;
/// The same for where the leaf is, seen from the queries' middle, in units of its distance times the
/// farthest query's: some 20 roundings as well.
const PLACE_ROUNDING: f32 = 1.0 / (1 << 19) as f32;
/// The same for sums of what was rounded before, in units of their size.
const SUM_ROUNDING: f32 = 1.0 / (1 << 22) as f32;
/// The same for what was computed in double precision, in units of (w + 2)².
const DOUBLE_ROUNDING: f32 = 1.0 / (1u64 << 48) as f32;
const WIDER: f32 = 1e-4;
/// More than is lost where products fall below single precision's range.
const UNDERFLOW: f32 = 1e-37;
/// Farther away than this many half extents of the points, squares are not trusted.
const FAR: f32 = 1e12;

/// The places of a leaf, so that no sum of two of them is one.
const CODES: [f32; LEAF] = {
    let mut codes = [0.0; LEAF];
    let mut place = 0;
    while place < LEAF {
        codes[place] = (LEAF + place) as f32;
        place += 1;
    }
    codes
};

/// A leaf that was looked into.
struct Looked {
    leaf: u32,
    /// Its center as seen from the queries' middle.
    center: [f32; 3],
    /// What squared distances from two of its points must differ by to be told apart.
    ties: f32,
}

/// A block of queries, in the tree's frame, and what they have found so far.
///
/// With m the queries' middle, q a query and c a leaf's center, both seen from there, and p a point
/// seen from the center, the squared distance is |q|² + |c|² - 2 q·c + |p|² - 2 (q - c)·p. The first
/// is the same for all points, and the others are small or well known, so that single precision
/// holds the differences.
pub(super) struct Block {
    in_frame: [Lanes; 3],
    /// A point that the queries lie around, how far each of them lies from it, and how far the
    /// farthest does.
    center: [f64; 3],
    from_center: Lanes,
    radius: f32,
    /// The queries as seen from there.
    local: [Lanes; 3],
    /// What rounding may add to a distance from a box.
    slack_squared: Lanes,
    /// Squared distances are kept as what they exceed |q|² and the reference by; `own` is both.
    reference: f64,
    own: Lanes,
    /// The squared distance of the nearest point, and of the nearest in any other leaf than its.
    least: Lanes,
    second: Lanes,
    /// What rounding may have changed in any of them.
    rounding: f32,
    /// Which of `looked` has the nearest point.
    look: [u32; BLOCK],
    /// The leaves it has looked into.
    looked: Vec<Looked>,
    /// How far a box may be and hold something nearer, squared.
    reach_squared: Lanes,
    /// How far it may be from the center and hold something nearer to any query, squared.
    center_reach_squared: f32,
}

impl Block {
    /// A block without queries.
    #[inline(always)]
    pub(super) fn empty() -> Self {
        Self {
            in_frame: [[0.0; BLOCK]; 3],
            center: [0.0; 3],
            from_center: [0.0; BLOCK],
            radius: 0.0,
            local: [[0.0; BLOCK]; 3],
            slack_squared: [0.0; BLOCK],
            reference: 0.0,
            own: [0.0; BLOCK],
            least: [f32::INFINITY; BLOCK],
            second: [f32::INFINITY; BLOCK],
            rounding: 0.0,
            look: [0; BLOCK],
            looked: Vec::with_capacity(64),
            reach_squared: [f32::INFINITY; BLOCK],
            center_reach_squared: f32::INFINITY,
        }
    }

    /// Begins with other queries, which have found nothing. The distance of `leaf`'s center is what
    /// others are compared with. `false` where the queries are so far away that squares of distances
    /// mean little.
    #[inline(always)]
    pub(super) fn begin(&mut self, tree: &Tree, queries: &[Double; 3], leaf: usize) -> bool {
        let block = self;
        block.least = [f32::INFINITY; BLOCK];
        block.second = [f32::INFINITY; BLOCK];
        block.rounding = 0.0;
        block.look = [0; BLOCK];
        block.looked.clear();
        block.reference = 0.0;
        for e in 0..3 {
            let mut all = [0.0; BLOCK];
            for i in 0..BLOCK {
                all[i] = tree.in_frame_along(e, queries[e][i]);
                block.in_frame[e][i] = all[i] as f32;
            }
            block.center[e] = f64::from(fold(block.in_frame[e], |a, b| a + b) / BLOCK as f32);
            for i in 0..BLOCK {
                block.local[e][i] = (all[i] - block.center[e]) as f32;
            }
            let c = tree.leaf_center(leaf)[e] - block.center[e];
            block.reference += c * c;
        }
        let rounded_reference = block.reference as f32;
        let mut near = true;
        for i in 0..BLOCK {
            let q = [block.in_frame[0][i], block.in_frame[1][i], block.in_frame[2][i]];
            let size = 1.0 + q[0].abs() + q[1].abs() + q[2].abs();
            let d = [block.local[0][i], block.local[1][i], block.local[2][i]];
            let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            block.slack_squared[i] = (1.0 + 2.0 / WIDER) * (SLACK * size) * (SLACK * size);
            block.own[i] = squared + rounded_reference;
            block.from_center[i] = squared.sqrt();
            near &= size < FAR;
        }
        block.radius = fold(block.from_center, |a, b| if a > b { a } else { b }) * (1.0 + SLACK);
        near
    }

    /// Looks for nearer points in a leaf, in which it must not have looked before. Says whether there
    /// were any.
    #[inline(always)]
    pub(super) fn look_into<S: Simd>(&mut self, tree: &Tree, leaf: usize) -> bool {
        let center = tree.leaf_center(leaf);
        let near = tree.leaf_near(leaf);
        let exact: [f64; 3] = std::array::from_fn(|e| center[e] - self.center[e]);
        let squared = exact[0] * exact[0] + exact[1] * exact[1] + exact[2] * exact[2];
        let farther = (squared - self.reference) as f32;
        let c = exact.map(|c| c as f32);
        let look = self.looked.len() as u32;
        let minus_twice = c.map(|c| -2.0 * c);
        let mut w = [[0.0; BLOCK]; 3];
        let mut base = [0.0; BLOCK];
        for i in 0..BLOCK {
            let q = [self.local[0][i], self.local[1][i], self.local[2][i]];
            let b = times_plus::<S>(q[0], minus_twice[0], farther);
            let b = times_plus::<S>(q[1], minus_twice[1], b);
            base[i] = times_plus::<S>(q[2], minus_twice[2], b);
            w[0][i] = q[0] - c[0];
            w[1][i] = q[1] - c[1];
            w[2][i] = q[2] - c[2];
        }
        let mut least = [f32::INFINITY; BLOCK];
        for j in (0..LEAF).step_by(2) {
            // Two points at a time, since each comparison with the least waits for the one before it.
            let ([x, y, z], squared) = (&near.minus_twice, &near.squared);
            for i in 0..BLOCK {
                let more = times_plus::<S>(w[0][i], x[j], squared[j]);
                let more = times_plus::<S>(w[1][i], y[j], more);
                let more = times_plus::<S>(w[2][i], z[j], more);
                let k = j + 1;
                let other = times_plus::<S>(w[0][i], x[k], squared[k]);
                let other = times_plus::<S>(w[1][i], y[k], other);
                let other = times_plus::<S>(w[2][i], z[k], other);
                let more = if other < more { other } else { more };
                least[i] = if more < least[i] { more } else { least[i] };
            }
        }
        let mut nearer = false;
        for i in 0..BLOCK {
            let squared = base[i] + least[i];
            let before = self.least[i];
            let (low, high) = if squared < before {
                (squared, before)
            } else {
                (before, squared)
            };
            self.look[i] = if squared < before { look } else { self.look[i] };
            nearer |= squared < before;
            self.least[i] = low;
            self.second[i] = if high < self.second[i] {
                high
            } else {
                self.second[i]
            };
        }
        // For all queries at once, so as for the farthest of them.
        let distance = (squared as f32).sqrt() * (1.0 + SLACK);
        let (place, r) = (self.radius * distance, near.radius);
        let size = distance + self.radius;
        let within = LEAF_ROUNDING * r * (size + r);
        let rounding = within
            + PLACE_ROUNDING * place
            + SUM_ROUNDING * (farther.abs() + 2.0 * place + r * (2.0 * size + r))
            + DOUBLE_ROUNDING * (size + 2.0) * (size + 2.0)
            + UNDERFLOW;
        if !(rounding <= self.rounding) {
            self.rounding = rounding;
        }
        self.looked.push(Looked {
            leaf: leaf as u32,
            center: c,
            ties: 2.0 * (within + UNDERFLOW),
        });
        nearer
    }

    /// Draws the reach in to what was found.
    #[inline(always)]
    pub(super) fn update_reach(&mut self) {
        for i in 0..BLOCK {
            let squared = self.own[i] + (self.least[i] + self.rounding);
            let squared = if squared > 0.0 { squared } else { 0.0 };
            // (a + b)² is at most (1 + e) a² + (1 + 1/e) b², whatever e: no root is taken.
            self.reach_squared[i] = squared * (1.0 + WIDER) + self.slack_squared[i];
        }
    }

    /// As [`Block::update_reach`], and the reach from the center.
    #[inline(always)]
    pub(super) fn update_center_reach(&mut self) {
        self.update_reach();
        let mut from_center = [0.0; BLOCK];
        for i in 0..BLOCK {
            from_center[i] = (self.reach_squared[i].sqrt() + self.from_center[i]) * (1.0 + SLACK);
        }
        let farthest = fold(from_center, |a, b| if a > b { a } else { b });
        self.center_reach_squared = farthest * farthest;
    }

    /// A point that the queries lie around, in the tree's frame.
    #[inline(always)]
    pub(super) fn center(&self) -> Vec3 {
        // It was computed in single precision.
        DVec3::from_array(self.center).as_vec3()
    }

    /// How far from the center a box may be and hold something nearer to any query, squared.
    #[inline(always)]
    pub(super) fn center_reach_squared(&self) -> f32 {
        self.center_reach_squared
    }

    /// Whether a box may hold something nearer to any query.
    #[inline(always)]
    pub(super) fn may_find_in<S: Simd>(&self, tree: &Tree, leaf: usize) -> bool {
        tree.any_within::<S, BLOCK>(leaf, &self.in_frame, &self.reach_squared)
    }

    /// Which point of the leaf found is the query's nearest, where single precision tells them apart.
    #[inline(always)]
    pub(super) fn place<S: Simd>(&self, simd: S, i: usize, tree: &Tree) -> Option<usize> {
        let looked = &self.looked[self.look[i] as usize];
        let near = tree.leaf_near(looked.leaf as usize);
        let mut w = [0.0; 3];
        for e in 0..3 {
            w[e] = self.local[e][i] - looked.center[e];
        }
        // No closures: they would not be built for these instructions.
        let (x, _) = S::as_simd_f32s(&near.minus_twice[0]);
        let (y, _) = S::as_simd_f32s(&near.minus_twice[1]);
        let (z, _) = S::as_simd_f32s(&near.minus_twice[2]);
        let (squared, _) = S::as_simd_f32s(&near.squared);
        let mut all = [simd.splat_f32s(f32::INFINITY); LEAF];
        let mut least = all[0];
        for part in 0..squared.len() {
            let more = simd.mul_add_e_f32s(simd.splat_f32s(w[0]), x[part], squared[part]);
            let more = simd.mul_add_e_f32s(simd.splat_f32s(w[1]), y[part], more);
            all[part] = simd.mul_add_e_f32s(simd.splat_f32s(w[2]), z[part], more);
            least = simd.min_f32s(least, all[part]);
        }
        let limit = simd.reduce_min_f32s(least) + looked.ties;
        // The sum tells the place of a single one.
        let (codes, _) = S::as_simd_f32s(&CODES);
        let mut sum = simd.splat_f32s(0.0);
        for part in 0..squared.len() {
            let within = simd.less_than_or_equal_f32s(all[part], simd.splat_f32s(limit));
            sum = simd.add_f32s(sum, simd.select_f32s(within, codes[part], simd.splat_f32s(0.0)));
        }
        let place = (simd.reduce_sum_f32s(sum) as usize).wrapping_sub(LEAF);
        (place < LEAF).then_some(place)
    }

    /// The leaf in which the query's nearest point seems to be, and whether it surely is.
    #[inline(always)]
    pub(super) fn found(&self, i: usize) -> (usize, bool) {
        let surely = self.second[i] - self.least[i] > 2.0 * self.rounding;
        (self.looked[self.look[i] as usize].leaf as usize, surely)
    }
}

/// Halves lanes again and again, as vectors can.
#[inline(always)]
fn fold(mut lanes: Lanes, op: fn(f32, f32) -> f32) -> f32 {
    let mut half = BLOCK / 2;
    while half > 0 {
        for i in 0..half {
            lanes[i] = op(lanes[i], lanes[i + half]);
        }
        half /= 2;
    }
    lanes[0]
}
