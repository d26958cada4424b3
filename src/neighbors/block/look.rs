//! Looking into a leaf, with a bound on what rounding may have changed.

use pulp::{Simd, WithSimd};

use super::super::boxes::{DOUBLE_ROUNDING, SLACK, UNDERFLOW};
use super::super::lanes::{BLOCK, Lanes, seldom};
use super::super::leaf::LEAF;
use super::super::tree::Tree;
use super::{Block, Column, Looked};

/// What rounding may add to or take off the squared distance from a point of a leaf, in units of
/// r (w + r), r being the leaf's radius and w at least as far as any query is from its center: some
/// 20 roundings of 2^-24.
const LEAF_ROUNDING: f32 = 1.0 / (1 << 19) as f32;
/// The same for where the leaf is, seen from the queries' middle, in units of its distance times the
/// farthest query's: some 20 roundings as well.
pub(super) const PLACE_ROUNDING: f32 = 1.0 / (1 << 19) as f32;
/// The same for sums of what was rounded before, in units of their size.
pub(super) const SUM_ROUNDING: f32 = 1.0 / (1 << 22) as f32;

impl Block {
    /// Looks for nearer points in a leaf, in which it must not have looked before. `queries` are those
    /// that the block has begun with. What `KEEP` says is kept for [`Block::candidates`].
    #[inline(always)]
    pub(in super::super) fn look_into<S: Simd, const KEEP: bool>(
        &mut self,
        simd: S,
        tree: &Tree,
        queries: &[Column; 3],
        leaf: usize,
    ) {
        if tree.is_coarse(leaf) {
            let block = self;
            let look = LookExactly::<KEEP> {
                block,
                tree,
                queries,
                leaf,
            };
            seldom(simd, look);
        } else {
            self.look_closely::<S, KEEP, true>(simd, tree, leaf);
        }
    }

    /// Looks into all leaves once more, so that the candidates are known.
    #[inline(always)]
    pub(in super::super) fn look_again<S: Simd>(&mut self, simd: S, tree: &Tree, queries: &[Column; 3]) {
        let mut leaves = std::mem::take(&mut self.leaves);
        leaves.clear();
        leaves.extend(self.looked.iter().map(|looked| looked.leaf));
        self.find_nothing();
        for &leaf in &leaves {
            self.look_into::<S, true>(simd, tree, queries, leaf as usize);
        }
        self.leaves = leaves;
    }

    /// Looks into a leaf that is so large that single precision would blur all distances.
    #[inline(always)]
    fn look_exactly<S: Simd, const KEEP: bool>(
        &mut self,
        simd: S,
        tree: &Tree,
        queries: &[Column; 3],
        leaf: usize,
    ) {
        let [x, y, z] = queries;
        let mut nearest = [f64::INFINITY; BLOCK];
        for place in 0..tree.positions(leaf).len() {
            let p = tree.place(leaf, place);
            for i in 0..BLOCK {
                let d = [x[i] - p.x, y[i] - p.y, z[i] - p.z];
                let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                nearest[i] = if squared < nearest[i] { squared } else { nearest[i] };
            }
        }
        let scale_squared = tree.scale() * tree.scale();
        let size = (self.reference as f32).sqrt() + self.radius;
        let (mut uppers, mut lowers) = (Lanes::ZERO, Lanes::ZERO);
        for i in 0..BLOCK {
            let mut own = self.reference;
            for e in 0..3 {
                let local = f64::from(self.local[e].0[i]);
                own += local * local;
            }
            let squared = nearest[i] * scale_squared;
            let (more, squared) = ((squared - own) as f32, squared as f32);
            let distance = squared.sqrt() + size;
            let rounding = SLACK * more.abs()
                + DOUBLE_ROUNDING * distance * (distance + 2.0)
                + PLACE_ROUNDING * self.radius * distance * 0.25
                + UNDERFLOW;
            uppers.0[i] = more + rounding;
            lowers.0[i] = more - rounding;
        }
        for part in 0..uppers.parts::<S>().len() {
            self.take::<S, KEEP>(simd, part, uppers.parts::<S>()[part], lowers.parts::<S>()[part]);
        }
        if KEEP {
            self.lowers.push(self.latest);
        }
        self.looked.push(Looked {
            leaf: leaf as u32,
            center: [0.0; 3],
            // Which of its points it is, is asked again.
            ties: f32::INFINITY,
            blurred: false,
        });
    }

    /// Looks into a leaf in single precision. Returns whether it may hold something nearer to any query;
    /// that is all where `TAKE` does not say that what was found is to be taken.
    #[inline(always)]
    fn look_closely<S: Simd, const KEEP: bool, const TAKE: bool>(
        &mut self,
        simd: S,
        tree: &Tree,
        leaf: usize,
    ) -> bool {
        let center = tree.leaf_center(leaf);
        let near = tree.leaf_near(leaf);
        // No closures: they would not be built for these instructions.
        let mut exact = [0.0; 3];
        for e in 0..3 {
            exact[e] = center[e] - self.center[e];
        }
        let squared = exact[0] * exact[0] + exact[1] * exact[1] + exact[2] * exact[2];
        let farther = (squared - self.reference) as f32;
        let c = [exact[0] as f32, exact[1] as f32, exact[2] as f32];
        // For all queries at once, so as for the farthest of them.
        let distance = (squared as f32).sqrt() * (1.0 + SLACK);
        let (place, r) = (self.radius * distance, near.radius);
        let size = distance + self.radius;
        let within = LEAF_ROUNDING * r * (size + r);
        let double = DOUBLE_ROUNDING * (size + r) * (size + 2.0);
        let beside = within
            + PLACE_ROUNDING * place
            + SUM_ROUNDING * (2.0 * place + r * (2.0 * size + r))
            + double
            + UNDERFLOW;
        let blur = SUM_ROUNDING * farther.abs();
        let rounding = simd.splat_f32s(beside + blur);
        let (x, y, z) = (&near.minus_twice[0], &near.minus_twice[1], &near.minus_twice[2]);
        // One where something may be nearer.
        let mut nearer = simd.splat_f32s(0.0);
        for from in (0..self.upper.parts::<S>().len()).step_by(2) {
            // Two vectors of queries at a time, since each comparison waits for the one before it.
            let mut w = [[simd.splat_f32s(0.0); 3]; 2];
            let mut base = [simd.splat_f32s(farther); 2];
            let mut least = [simd.splat_f32s(f32::INFINITY); 2];
            for k in 0..2 {
                for e in 0..3 {
                    let q = self.local[e].parts::<S>()[from + k];
                    base[k] = simd.mul_add_e_f32s(q, simd.splat_f32s(-2.0 * c[e]), base[k]);
                    w[k][e] = simd.sub_f32s(q, simd.splat_f32s(c[e]));
                }
            }
            for j in 0..LEAF {
                let p = [
                    simd.splat_f32s(x[j]),
                    simd.splat_f32s(y[j]),
                    simd.splat_f32s(z[j]),
                ];
                let squared = simd.splat_f32s(near.squared[j]);
                for k in 0..2 {
                    let more = simd.mul_add_e_f32s(w[k][0], p[0], squared);
                    let more = simd.mul_add_e_f32s(w[k][1], p[1], more);
                    let more = simd.mul_add_e_f32s(w[k][2], p[2], more);
                    least[k] = simd.min_f32s(more, least[k]);
                }
            }
            for k in 0..2 {
                let squared = simd.add_f32s(base[k], least[k]);
                let (upper, lower) = (simd.add_f32s(squared, rounding), simd.sub_f32s(squared, rounding));
                if TAKE {
                    self.take::<S, KEEP>(simd, from + k, upper, lower);
                } else {
                    // Where rounding left no number, better look.
                    let beyond = simd.greater_than_f32s(lower, self.upper.parts::<S>()[from + k]);
                    nearer = simd.select_f32s(beyond, nearer, simd.splat_f32s(1.0));
                }
            }
        }
        if !TAKE {
            return simd.reduce_max_f32s(nearer) > 0.0;
        }
        if KEEP {
            self.lowers.push(self.latest);
        }
        self.looked.push(Looked {
            leaf: leaf as u32,
            center: c,
            ties: 2.0 * (within + double + UNDERFLOW),
            blurred: blur > beside,
        });
        true
    }

    /// Keeps the squared distances of the leaf that is looked into, as bounds, where they are least.
    #[inline(always)]
    fn take<S: Simd, const KEEP: bool>(&mut self, simd: S, part: usize, upper: S::f32s, lower: S::f32s) {
        let look = simd.splat_u32s(self.looked.len() as u32);
        let looks = &mut S::as_mut_simd_u32s(&mut self.look.0).0[part];
        let uppers = &mut self.upper.parts_mut::<S>()[part];
        let lowers = &mut self.lower.parts_mut::<S>()[part];
        let seconds = &mut self.second.parts_mut::<S>()[part];
        if KEEP {
            self.latest.parts_mut::<S>()[part] = lower;
        }
        let nearer = simd.less_than_f32s(upper, *uppers);
        let other = simd.select_f32s(nearer, *lowers, lower);
        *looks = simd.select_u32s(nearer, look, *looks);
        *uppers = simd.min_f32s(upper, *uppers);
        *lowers = simd.select_f32s(nearer, lower, *lowers);
        *seconds = simd.min_f32s(other, *seconds);
    }
}

/// [`Block::look_exactly`], where the leaf may hold something nearer to any query.
struct LookExactly<'a, const KEEP: bool> {
    block: &'a mut Block,
    tree: &'a Tree,
    queries: &'a [Column; 3],
    leaf: usize,
}

impl<const KEEP: bool> WithSimd for LookExactly<'_, KEEP> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            block, tree, leaf, ..
        } = self;
        // Mostly that is enough to tell that it holds nothing for them.
        if block.look_closely::<S, false, false>(simd, tree, leaf) {
            block.look_exactly::<S, KEEP>(simd, tree, self.queries, leaf);
        }
    }
}
