//! Queries that walk through the tree together.
//!
//! Single precision sorts out the leaves, with a bound on its rounding; the leaf that won is then
//! compared in double precision. Where the bound leaves several leaves in the running, as with points
//! that are equally far, these are all compared.

mod look;
mod reach;

use pulp::Simd;

use look::{PLACE_ROUNDING, SUM_ROUNDING};

use super::boxes::SLACK;
use super::lanes::{BLOCK, Lanes, Looks};
use super::leaf::LEAF;
use super::tree::Tree;
use super::walk::Reach;

/// A coordinate of each query.
pub(crate) type Column = [f64; BLOCK];

/// Farther away than this many half extents of the points, squares are not trusted.
const FAR: f32 = 1e12;

/// How close together a group lies, in units of how far the queries lie from their middle.
const CLOSE: f32 = 0.125;

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
    /// Whether its distances are blurred for being so much farther or nearer than the reference.
    blurred: bool,
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
    /// A point near what they find, and its squared distance from their middle. Squared distances are
    /// kept as what they exceed |q|² and this reference by; `squares` is |q|², or a little more.
    toward: [f64; 3],
    reference: f64,
    squares: Lanes,
    /// 2 q·c, with c where that point is seen from the middle, and what rounding may change in it.
    twice_toward: Lanes,
    twice_toward_rounding: f32,
    /// The squared distance of the nearest point is at most `upper` and at least `lower`; in any other
    /// leaf than its own it is at least `second`.
    upper: Lanes,
    lower: Lanes,
    second: Lanes,
    /// Which of `looked` has the nearest point.
    look: Looks,
    /// The leaves it has looked into.
    looked: Vec<Looked>,
    /// At least how far their nearest points are, as `lower`, or nothing; the latest's before it is among
    /// them.
    lowers: Vec<Lanes>,
    latest: Lanes,
    /// The leaves to look into again.
    leaves: Vec<u32>,
    /// A bound on how far it may be from the center and hold something nearer to a query, squared:
    /// `slope` times the query's squared reach and `more`, touching what it bounds where the query's
    /// reach was when the block began to walk.
    slope: Lanes,
    more: Lanes,
    /// How far to walk.
    reach: Reach,
    /// What it may be farther from the center than the reference and be looked into first, squared.
    first_excess: f32,
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
            toward: [0.0; 3],
            reference: 0.0,
            squares: Lanes::ZERO,
            twice_toward: Lanes::ZERO,
            twice_toward_rounding: 0.0,
            upper: Lanes::INFINITY,
            lower: Lanes::INFINITY,
            second: Lanes::INFINITY,
            look: Looks::FIRST,
            looked: Vec::with_capacity(64),
            lowers: Vec::new(),
            latest: Lanes::ZERO,
            leaves: Vec::new(),
            slope: Lanes::ZERO,
            more: Lanes::ZERO,
            reach: Reach {
                excess: f32::INFINITY,
                root: 0.0,
                excess_toward: f32::INFINITY,
            },
            first_excess: 0.0,
        }
    }

    /// Begins with other queries. `false` where they are so far away that squares of distances mean
    /// little.
    #[inline(always)]
    pub(super) fn begin<S: Simd>(&mut self, simd: S, tree: &Tree, queries: &[Column; 3]) -> bool {
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
            (self.local[e], self.center[e]) = (local, center);
        }
        let mut from_center = Lanes::ZERO;
        for i in 0..BLOCK {
            let d = [self.local[0].0[i], self.local[1].0[i], self.local[2].0[i]];
            let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            self.squares.0[i] = squared * (1.0 + 2.0 * SUM_ROUNDING);
            from_center.0[i] = squared.sqrt();
        }
        self.radius = from_center.greatest(simd) * (1.0 + SLACK);
        self.from_center = from_center;
        let [x, y, z] = self.center;
        ((x.abs() + y.abs() + z.abs()) as f32 + self.radius) < FAR
    }

    /// The first `size` queries in one group or two, a bit each: where most of them lie much closer together
    /// than the others do, these are apart. A single group where all lie about as close together as the
    /// points of leaves do.
    #[inline(always)]
    pub(super) fn groups(&self, tree: &Tree, size: usize) -> ([u32; 2], usize) {
        let all = u32::MAX >> (BLOCK - size);
        if self.radius < tree.apart() {
            return ([all, 0], 1);
        }
        // Most of them, one after the other, are the middle one's. What is less is looked for sooner
        // together with all others than apart.
        let group = self.close_to(size / 2) & all;
        if 3 * group.count_ones() as usize >= 2 * size && group != all {
            ([group, all & !group], 2)
        } else {
            ([all, 0], 1)
        }
    }

    /// The queries close to one of them, a bit each.
    #[cold]
    #[inline(never)]
    fn close_to(&self, query: usize) -> u32 {
        let close = CLOSE * self.radius;
        let mut group = 0;
        for i in 0..BLOCK {
            let mut squared = 0.0;
            for e in 0..3 {
                let d = self.local[e].0[i] - self.local[e].0[query];
                squared += d * d;
            }
            // It is close to itself, even where there is no radius.
            group |= u32::from(squared <= close * close) << i;
        }
        group
    }

    /// Nothing is found yet. The distance of `leaf`'s center, or of a point of it, is what others are
    /// compared with. Returns whether to walk with care: boxes may be small beside that, or queries before
    /// were left in doubt, as `doubtful` says.
    #[inline(always)]
    pub(super) fn refer_to(&mut self, tree: &Tree, leaf: usize, doubtful: bool) -> bool {
        self.find_nothing();
        self.toward = if tree.is_coarse(leaf) {
            tree.nearest_in_leaf(leaf, self.center)
        } else {
            tree.leaf_center(leaf)
        };
        self.reference = 0.0;
        let mut twice = [0.0; 3];
        for e in 0..3 {
            let c = self.toward[e] - self.center[e];
            self.reference += c * c;
            twice[e] = 2.0 * c as f32;
        }
        if !doubtful && !tree.is_far_off(self.reference) {
            return false;
        }
        for i in 0..BLOCK {
            let q = [self.local[0].0[i], self.local[1].0[i], self.local[2].0[i]];
            self.twice_toward.0[i] = q[0] * twice[0] + q[1] * twice[1] + q[2] * twice[2];
        }
        let size = (self.reference as f32).sqrt() + self.radius;
        self.twice_toward_rounding = PLACE_ROUNDING * self.radius * size;
        true
    }

    /// Nothing is found yet.
    #[inline(always)]
    fn find_nothing(&mut self) {
        self.upper = Lanes::INFINITY;
        self.lower = Lanes::INFINITY;
        self.second = Lanes::INFINITY;
        self.look = Looks::FIRST;
        self.looked.clear();
        self.lowers.clear();
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
        let surely = self.second.0[i] > self.upper.0[i];
        (self.looked[self.look.0[i] as usize].leaf as usize, surely)
    }

    /// The leaves that may hold what is nearest to a query, no other does: after [`Block::look_again`].
    #[inline(always)]
    pub(super) fn candidates(&self, i: usize) -> impl Iterator<Item = usize> {
        let leaves = self.looked.iter().zip(&self.lowers);
        leaves
            .filter(move |(_, lower)| !(lower.0[i] > self.upper.0[i]))
            .map(|(looked, _)| looked.leaf as usize)
    }

    /// Whether the candidates are known.
    #[inline(always)]
    pub(super) fn knows_candidates(&self) -> bool {
        !self.lowers.is_empty()
    }

    /// How many leaves were looked into.
    #[inline(always)]
    pub(super) fn looked(&self) -> usize {
        self.looked.len()
    }

    /// Whether another reference would tell more queries' nearest from others.
    #[inline(always)]
    pub(super) fn is_blurred(&self, i: usize) -> bool {
        self.looked[self.look.0[i] as usize].blurred
    }
}
