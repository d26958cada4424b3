//! A block of queries that search the tree together, in single precision.

use glam::DVec3;
use pulp::Simd;

use super::lanes::{BLOCK, Lanes, ROUNDING, SUM_ROUNDING, rounding_of_squared, times_plus};
use super::tree::{LEAF, Leaf, Tree};

/// A coordinate of each query.
pub(crate) type Column = [f64; BLOCK];

/// The width of the shell of leaves that are looked into first, in units of the queries' radius: most of
/// these leaves hold the nearest point of some query.
const FIRST: f32 = 0.05;

/// A block whose center moved by so many times the radii of both blocks is somewhere else.
const JUMP: f64 = 8.0;

/// Distances of a leaf's points differ by up to its size. They are told apart if so many times the rounding is less.
const BLIND: f32 = 16.0;

/// A leaf that was looked into.
pub(super) struct Looked {
    pub(super) leaf: usize,
    sight: Sight,
    /// The lower bounds of each query's squared distance from its points.
    pub(super) lower: Lanes,
}

/// A block of queries and bounds on the squared distances of their nearest points.
///
/// With q a query and c a leaf's center, both seen from the queries' center, and p a point of the leaf, seen
/// from c, the squared distance is |q|² + |c|² - 2 q·c + |p|² - 2 (q - c)·p. The first term is the same for
/// all points and left out, and the second, which is computed in double precision, is replaced by what it
/// exceeds a reference by. The rest is small or well known: single precision holds the differences.
#[derive(Default)]
pub(super) struct Block {
    /// The mean of the queries, and the largest distance of a query from it.
    pub(super) center: [f64; 3],
    radius: f32,
    /// The queries, their distances, and their squared distances, as seen from the center.
    local: [Lanes; 3],
    away: Lanes,
    squares: Lanes,
    /// The squared distance of the point that the search begins with.
    pub(super) reference: f64,
    /// The squared distance of a query's nearest point exceeds |q|² and the reference by at most so much.
    pub(super) upper: Lanes,
    /// The leaves that were looked into.
    pub(super) looked: Vec<Looked>,
    /// The largest squared distance from the center at which a point may be the nearest one of a query, less
    /// the reference.
    pub(super) reach: f32,
}

/// A leaf as seen from the center of a block.
pub(super) struct Sight {
    center: [f32; 3],
    /// The excess of the leaf's squared distance over the reference.
    farther: f32,
    /// The bound on what rounding may change in the squared distance from a query to a point of the leaf, and
    /// in what two points of the leaf differ by.
    rounding: f32,
    ties: f32,
}

impl Block {
    /// Begins with other queries. Returns whether they are close to those before, so that their nearest points
    /// are likely to be so as well.
    #[inline(always)]
    pub(super) fn begin<S: Simd>(&mut self, simd: S, queries: &[Column; 3]) -> bool {
        let (mut moved, before) = (0.0, self.radius);
        let mut squares = [0.0; BLOCK];
        for e in 0..3 {
            let (first, mut local) = (queries[e][0], Lanes::default());
            for i in 0..BLOCK {
                local.0[i] = (queries[e][i] - first) as f32;
            }
            let center = first + f64::from(local.sum(simd) / BLOCK as f32);
            for i in 0..BLOCK {
                local.0[i] = (queries[e][i] - center) as f32;
                squares[i] += local.0[i] * local.0[i];
            }
            self.local[e] = local;
            moved += (center - self.center[e]) * (center - self.center[e]);
            self.center[e] = center;
        }
        for i in 0..BLOCK {
            self.squares.0[i] = squares[i] * (1.0 + 2.0 * SUM_ROUNDING);
            self.away.0[i] = squares[i].sqrt() * (1.0 + 2.0 * SUM_ROUNDING);
        }
        self.radius = self.away.greatest(simd);
        let much = JUMP * f64::from(before + self.radius);
        moved < much * much
    }

    /// Begins the search with a point that is likely to be near. It bounds the distances even where its leaf is
    /// so large that single precision tells little about it.
    #[inline(always)]
    pub(super) fn begin_with<S: Simd>(&mut self, point: &DVec3) {
        self.looked.clear();
        let (mut minus_twice, mut squared) = ([0.0; 3], 0.0);
        for e in 0..3 {
            let c = point[e] - self.center[e];
            squared += c * c;
            minus_twice[e] = -2.0 * c as f32;
        }
        self.reference = squared;
        let size = (squared as f32).sqrt() + self.radius;
        let rounding = ROUNDING * self.radius * size + rounding_of_squared(size);
        for i in 0..BLOCK {
            let more = times_plus::<S>(minus_twice[0], self.local[0].0[i], rounding);
            let more = times_plus::<S>(minus_twice[1], self.local[1].0[i], more);
            let more = times_plus::<S>(minus_twice[2], self.local[2].0[i], more);
            // Infinite as well where rounding left no number.
            self.upper.0[i] = if more < f32::INFINITY { more } else { f32::INFINITY };
        }
    }

    /// Whether the points are so far that rounding hides which of a leaf's points are nearer.
    #[inline(always)]
    pub(super) fn is_blind(&self, tree: &Tree) -> bool {
        let size = (self.reference as f32).sqrt() + self.radius;
        !(BLIND * rounding_of_squared(size) < tree.typical_radius * size)
    }

    /// The excess over the reference up to which leaves are looked into first.
    #[inline(always)]
    pub(super) fn first_excess<S: Simd>(&self, simd: S) -> f32 {
        let mean = (self.upper.sum(simd) + self.squares.sum(simd)) / BLOCK as f32;
        let root = (self.reference as f32 + self.reach).max(0.0).sqrt();
        mean + FIRST * root * self.radius
    }

    #[inline(always)]
    pub(super) fn sight(&self, leaf: &Leaf) -> Sight {
        let (mut center, mut squared, mut distance) = ([0.0; 3], 0.0, 0.0);
        for e in 0..3 {
            let c = leaf.center[e] - self.center[e];
            squared += c * c;
            center[e] = c as f32;
            // At least the distance in the end, without a root.
            distance += center[e].abs();
        }
        let farther = (squared - self.reference) as f32;
        let size = distance + self.radius + leaf.radius;
        let within = ROUNDING * leaf.radius * size + rounding_of_squared(size);
        Sight {
            center,
            farther,
            rounding: within + ROUNDING * self.radius * distance + SUM_ROUNDING * farther.abs(),
            ties: 2.0 * within,
        }
    }

    /// Whether the box of a leaf may hold a point nearer to any query than those found.
    #[inline(always)]
    pub(super) fn may_find_in<S: Simd>(&self, leaf: &Leaf, sight: &Sight) -> bool {
        let c = sight.center;
        let [x, y, z] = &self.local;
        let mut excess = [sight.farther - sight.rounding; BLOCK];
        for i in 0..BLOCK {
            let more = times_plus::<S>(-2.0 * c[0], x.0[i], excess[i]);
            let more = times_plus::<S>(-2.0 * c[1], y.0[i], more);
            excess[i] = times_plus::<S>(-2.0 * c[2], z.0[i], more);
        }
        for e in 0..3 {
            let ([ax, ay, az], half) = (leaf.axes[e], leaf.half[e]);
            let offset = -(ax * c[0] + ay * c[1] + az * c[2]);
            for i in 0..BLOCK {
                let along = times_plus::<S>(ax, x.0[i], offset);
                let along = times_plus::<S>(ay, y.0[i], along);
                let along = times_plus::<S>(az, z.0[i], along).abs();
                let inside = if along < half { along } else { half };
                let less = times_plus::<S>(-2.0, along, inside);
                excess[i] = times_plus::<S>(inside, less, excess[i]);
            }
        }
        let mut beyond = true;
        for i in 0..BLOCK {
            beyond &= excess[i] > self.upper.0[i];
        }
        !beyond
    }

    /// Looks for nearer points in a leaf, in which it must not have looked before.
    #[inline(always)]
    pub(super) fn look_into<S: Simd>(&mut self, simd: S, tree: &Tree, leaf: usize, sight: Sight) {
        #[cfg(test)]
        super::work_tests::count(BLOCK);
        let near = &tree.leaves[leaf];
        let rounding = simd.splat_f32s(sight.rounding);
        let [x, y, z] = &near.minus_twice;
        let mut lower = Lanes::default();
        for from in (0..lower.vectors::<S>().len()).step_by(2) {
            // Two vectors of queries at a time, since each comparison waits for the one before it.
            let mut w = [[simd.splat_f32s(0.0); 3]; 2];
            let mut base = [simd.splat_f32s(sight.farther); 2];
            let mut least = [simd.splat_f32s(f32::INFINITY); 2];
            for k in 0..2 {
                for e in 0..3 {
                    let (q, c) = (self.local[e].vectors::<S>()[from + k], sight.center[e]);
                    base[k] = simd.mul_add_e_f32s(q, simd.splat_f32s(-2.0 * c), base[k]);
                    w[k][e] = simd.sub_f32s(q, simd.splat_f32s(c));
                }
            }
            for j in 0..LEAF {
                let (x, y, z) = (
                    simd.splat_f32s(x[j]),
                    simd.splat_f32s(y[j]),
                    simd.splat_f32s(z[j]),
                );
                let squared = simd.splat_f32s(near.squared[j]);
                for k in 0..2 {
                    let more = simd.mul_add_e_f32s(w[k][0], x, squared);
                    let more = simd.mul_add_e_f32s(w[k][1], y, more);
                    let more = simd.mul_add_e_f32s(w[k][2], z, more);
                    least[k] = simd.min_f32s(more, least[k]);
                }
            }
            for k in 0..2 {
                let excess = simd.add_f32s(base[k], least[k]);
                lower.vectors_mut::<S>()[from + k] = simd.sub_f32s(excess, rounding);
                let upper = &mut self.upper.vectors_mut::<S>()[from + k];
                *upper = simd.min_f32s(simd.add_f32s(excess, rounding), *upper);
            }
        }
        self.looked.push(Looked { leaf, sight, lower });
    }

    /// Draws the reach in to what was found.
    #[inline(always)]
    pub(super) fn update_reach<S: Simd>(&mut self, simd: S) {
        // A point nearer to q than √D is nearer to the center than √D + |q|; the square of that exceeds the
        // reference by what D exceeds it and |q|² by, and 2 |q| (√D + |q|).
        let reference = self.reference as f32 * (1.0 + ROUNDING);
        let mut reach = Lanes::default();
        for i in 0..BLOCK {
            let (upper, away) = (self.upper.0[i], self.away.0[i]);
            let squared = upper + self.squares.0[i] + reference;
            let found = if squared > 0.0 { squared } else { 0.0 }.sqrt();
            let more = 2.0 * away * (found + away);
            let excess = upper + more + ROUNDING * (upper.abs() + more);
            // Infinite as well where rounding left no number.
            reach.0[i] = excess.min(f32::INFINITY);
        }
        self.reach = reach.greatest(simd);
    }

    /// The number of leaves that may hold the nearest point of each query, and the last of these among those
    /// that were looked into.
    #[inline(always)]
    pub(super) fn candidates(&self) -> ([u32; BLOCK], [u32; BLOCK]) {
        let (mut count, mut last) = ([0; BLOCK], [0; BLOCK]);
        for (number, looked) in self.looked.iter().enumerate() {
            for i in 0..BLOCK {
                let beyond = looked.lower.0[i] > self.upper.0[i];
                count[i] += u32::from(!beyond);
                last[i] = if beyond { last[i] } else { number as u32 };
            }
        }
        (count, last)
    }

    /// The position of the point of a leaf that is nearest to a query, if single precision tells it.
    #[inline(always)]
    pub(super) fn nearest_in<S: Simd>(
        &self,
        simd: S,
        tree: &Tree,
        looked: &Looked,
        query: usize,
    ) -> Option<usize> {
        let near = &tree.leaves[looked.leaf];
        let mut w = [0.0; 3];
        for e in 0..3 {
            w[e] = self.local[e].0[query] - looked.sight.center[e];
        }
        let [x, y, z] = &near.minus_twice;
        let mut excess = Lanes::default();
        for j in 0..LEAF {
            let more = times_plus::<S>(w[0], x[j], near.squared[j]);
            let more = times_plus::<S>(w[1], y[j], more);
            excess.0[j] = times_plus::<S>(w[2], z[j], more);
        }
        let limit = excess.least(simd) + looked.sight.ties;
        // Each place within the limit adds its code. The sum of several is no code.
        let mut codes = Lanes::default();
        for j in 0..LEAF {
            let code = (LEAF + j) as f32;
            codes.0[j] = if excess.0[j] <= limit { code } else { 0.0 };
        }
        let place = (codes.sum(simd) as usize).wrapping_sub(LEAF);
        (place < LEAF).then_some(looked.leaf * LEAF + place)
    }
}
