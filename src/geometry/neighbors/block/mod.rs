//! Queries that walk through the tree together.
//!
//! Single precision sorts out the leaves, with a bound on its rounding; the leaf that won is then
//! compared in double precision. Where the bound leaves two leaves in the running, as with points
//! that are equally far, the query is asked again by itself.

mod look;

use pulp::Simd;

use look::SUM_ROUNDING;

use super::boxes::SLACK;
use super::lanes::{BLOCK, Lanes, Looks};
use super::tree::{LEAF, Tree};

/// A coordinate of each query.
pub(crate) type Column = [f64; BLOCK];

/// Leaves whose boxes are not much farther from the queries' middle than the queries are from what
/// they have found are looked into first: most of them hold what is nearest to some query. So much
/// farther, in units of how far the queries lie from their middle.
const FIRST: f32 = 0.25;
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
    /// A point that the queries lie around, how far each of them lies from it, and how far the
    /// farthest does.
    center: [f64; 3],
    from_center: Lanes,
    radius: f32,
    /// The queries as seen from there.
    local: [Lanes; 3],
    /// Squared distances are kept as what they exceed |q|² and the reference by; `own` is both, or a
    /// little more.
    reference: f64,
    own: Lanes,
    /// The squared distance of the nearest point, and of the nearest in any other leaf than its.
    least: Lanes,
    second: Lanes,
    /// What rounding may have changed in any of them.
    rounding: f32,
    /// Which of `looked` has the nearest point.
    look: Looks,
    /// The leaves it has looked into.
    looked: Vec<Looked>,
    /// How far a box may be and hold something nearer, squared.
    reach_squared: Lanes,
    /// A bound on how far it may be from the center and hold something nearer to a query, squared:
    /// `slope` times the query's squared reach and `more`, touching what it bounds where the query's
    /// reach was when the block began to walk.
    slope: Lanes,
    more: Lanes,
    /// The greatest of these, and a bound on its root.
    center_reach_squared: f32,
    center_reach: f32,
    /// How far it may be from the center and be looked into first, squared.
    first_squared: f32,
}

impl Block {
    /// A block without queries.
    #[inline(always)]
    pub(super) fn empty() -> Self {
        Self {
            center: [0.0; 3],
            from_center: Lanes::ZERO,
            radius: 0.0,
            local: [Lanes::ZERO; 3],
            reference: 0.0,
            own: Lanes::ZERO,
            least: Lanes::INFINITY,
            second: Lanes::INFINITY,
            rounding: 0.0,
            look: Looks::FIRST,
            looked: Vec::with_capacity(64),
            reach_squared: Lanes::INFINITY,
            slope: Lanes::ZERO,
            more: Lanes::ZERO,
            center_reach_squared: f32::INFINITY,
            center_reach: 0.0,
            first_squared: 0.0,
        }
    }

    /// Begins with other queries, which have found nothing. The distance of `leaf`'s center is what
    /// others are compared with. `false` where the queries are so far away that squares of distances
    /// mean little.
    #[inline(always)]
    pub(super) fn begin<S: Simd>(
        &mut self,
        simd: S,
        tree: &Tree,
        queries: &[Column; 3],
        leaf: usize,
    ) -> bool {
        self.least = Lanes::INFINITY;
        self.second = Lanes::INFINITY;
        self.rounding = 0.0;
        self.look = Looks::FIRST;
        self.looked.clear();
        self.reference = 0.0;
        for e in 0..3 {
            let (mut all, mut local) = ([0.0; BLOCK], Lanes::ZERO);
            for i in 0..BLOCK {
                all[i] = tree.in_frame_along(e, queries[e][i]);
            }
            let first = all[0];
            for i in 0..BLOCK {
                local.0[i] = (all[i] - first) as f32;
            }
            let center = first + f64::from(local.sum(simd) / BLOCK as f32);
            for i in 0..BLOCK {
                local.0[i] = (all[i] - center) as f32;
            }
            let c = tree.leaf_center(leaf)[e] - center;
            self.reference += c * c;
            (self.local[e], self.center[e]) = (local, center);
        }
        let reference = self.reference as f32;
        let mut from_center = Lanes::ZERO;
        for i in 0..BLOCK {
            let d = [self.local[0].0[i], self.local[1].0[i], self.local[2].0[i]];
            let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            self.own.0[i] = (squared + reference) * (1.0 + 2.0 * SUM_ROUNDING);
            from_center.0[i] = squared.sqrt();
        }
        self.radius = from_center.greatest(simd) * (1.0 + SLACK);
        self.from_center = from_center;
        let [x, y, z] = self.center;
        ((x.abs() + y.abs() + z.abs()) as f32 + self.radius) < FAR
    }

    /// The reach from what was found in the first leaf.
    #[inline(always)]
    pub(super) fn begin_reach<S: Simd>(&mut self, simd: S) {
        self.update_reach(simd);
        for i in 0..BLOCK {
            let f = self.from_center.0[i] * (1.0 + SLACK);
            // (r + f)² is at most (1 + k) r² + (1 + 1/k) f², whatever k, and just that for k = f / r.
            // What is zero, or nearly, must not divide.
            let reach = self.reach_squared.0[i].sqrt().max(f * 0.0625).max(1e-18);
            self.slope.0[i] = (reach + f) / reach;
            self.more.0[i] = (reach + f) * f;
        }
        self.center_reach = 0.0;
        self.update_reach(simd);
    }

    /// Draws the reach in to what was found.
    #[inline(always)]
    pub(super) fn update_reach<S: Simd>(&mut self, simd: S) {
        let (own, least) = (self.own.parts::<S>(), self.least.parts::<S>());
        let (slope, more) = (self.slope.parts::<S>(), self.more.parts::<S>());
        let reach_squared = self.reach_squared.parts_mut::<S>();
        let rounding = simd.splat_f32s(self.rounding);
        let zero = simd.splat_f32s(0.0);
        let (mut farthest, mut sum) = (zero, zero);
        for part in 0..own.len() {
            let squared = simd.add_f32s(own[part], simd.add_f32s(least[part], rounding));
            let reach = simd.max_f32s(squared, zero);
            reach_squared[part] = reach;
            farthest = simd.max_f32s(farthest, simd.mul_add_e_f32s(reach, slope[part], more[part]));
            sum = simd.add_f32s(sum, reach);
        }
        self.center_reach_squared = simd.reduce_max_f32s(farthest) * (1.0 + SLACK);
        // The reach hardly ever grows: then because more was rounded.
        if self.center_reach_squared > self.center_reach * self.center_reach {
            self.center_reach = self.center_reach_squared.sqrt() * (1.0 + SLACK);
        }
        let mean = simd.reduce_sum_f32s(sum) * (1.0 / BLOCK as f32);
        self.first_squared = mean + FIRST * self.center_reach * self.radius;
    }

    /// A point that the queries lie around, in the tree's frame.
    #[inline(always)]
    pub(super) fn center(&self) -> [f64; 3] {
        self.center
    }

    /// How far from the center a box may be and hold something nearer to any query, squared, and a
    /// bound on its root.
    #[inline(always)]
    pub(super) fn center_reach(&self) -> (f32, f32) {
        (self.center_reach_squared, self.center_reach)
    }

    /// How far from the center a box may be and be looked into before others, squared.
    #[inline(always)]
    pub(super) fn first_squared(&self) -> f32 {
        self.first_squared
    }

    /// Whether a box may hold something nearer to any query.
    #[inline(always)]
    pub(super) fn may_find_in<S: Simd>(&self, tree: &Tree, leaf: usize) -> bool {
        let (boxes, lane) = tree.leaf_box(leaf);
        let center = tree.leaf_center(leaf);
        let (mut own, mut size) = ([0.0; 3], self.radius + tree.leaf_near(leaf).radius);
        for e in 0..3 {
            own[e] = (center[e] - self.center[e]) as f32;
            size += own[e].abs();
        }
        let reach = (&self.reach_squared, self.center_reach);
        boxes.any_within::<S>((lane, own, size), &self.local, reach)
    }

    /// Which point of the leaf found is the query's nearest, where single precision tells them apart.
    #[inline(always)]
    pub(super) fn place<S: Simd>(&self, simd: S, i: usize, tree: &Tree) -> Option<usize> {
        let looked = &self.looked[self.look.0[i] as usize];
        let near = tree.leaf_near(looked.leaf as usize);
        let mut w = [0.0; 3];
        for e in 0..3 {
            w[e] = self.local[e].0[i] - looked.center[e];
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
        let surely = self.second.0[i] - self.least.0[i] > 2.0 * self.rounding;
        (self.looked[self.look.0[i] as usize].leaf as usize, surely)
    }
}
