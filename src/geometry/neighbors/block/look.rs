//! Looking into a leaf, with a bound on what rounding may have changed.

use pulp::Simd;

use super::super::boxes::SLACK;
use super::super::lanes::{BLOCK, Lanes};
use super::super::tree::{LEAF, Tree};
use super::{Block, Column, Looked};

/// What rounding may add to or take off the squared distance from a point of a leaf, in units of
/// r (w + r), r being the leaf's radius and w at least as far as any query is from its center: some
/// 20 roundings of 2^-24.
const LEAF_ROUNDING: f32 = 1.0 / (1 << 19) as f32;
/// The same for where the leaf is, seen from the queries' middle, in units of its distance times the
/// farthest query's: some 20 roundings as well.
const PLACE_ROUNDING: f32 = 1.0 / (1 << 19) as f32;
/// The same for sums of what was rounded before, in units of their size.
pub(super) const SUM_ROUNDING: f32 = 1.0 / (1 << 22) as f32;
/// The same for what was computed in double precision, in units of (w + r) (w + 2).
const DOUBLE_ROUNDING: f32 = 1.0 / (1u64 << 48) as f32;
/// More than is lost where products fall below single precision's range.
const UNDERFLOW: f32 = 1e-37;
impl Block {
    /// Looks for nearer points in a leaf, in which it must not have looked before. `queries` are those
    /// that the block has begun with.
    #[inline(always)]
    pub(in super::super) fn look_into<S: Simd>(
        &mut self,
        simd: S,
        tree: &Tree,
        queries: &[Column; 3],
        leaf: usize,
    ) {
        if tree.is_coarse(leaf) {
            self.look_exactly(simd, tree, queries, leaf);
        } else {
            self.look_closely(simd, tree, leaf);
        }
    }

    /// Looks into a leaf that is so large that single precision would blur all distances.
    #[inline(always)]
    fn look_exactly<S: Simd>(&mut self, simd: S, tree: &Tree, queries: &[Column; 3], leaf: usize) {
        let [x, y, z] = queries;
        let mut nearest = [f64::INFINITY; BLOCK];
        for place in tree.positions(leaf) {
            let p = tree.place(leaf, place % LEAF);
            for i in 0..BLOCK {
                let d = [x[i] - p.x, y[i] - p.y, z[i] - p.z];
                let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                nearest[i] = if squared < nearest[i] { squared } else { nearest[i] };
            }
        }
        let scale_squared = tree.scale() * tree.scale();
        let look = self.looked.len() as u32;
        let mut largest = Lanes::ZERO;
        for i in 0..BLOCK {
            let mut own = self.reference;
            for e in 0..3 {
                let local = f64::from(self.local[e].0[i]);
                own += local * local;
            }
            let squared = nearest[i] * scale_squared;
            let (more, squared) = ((squared - own) as f32, squared as f32);
            let before = self.least.0[i];
            let nearer = more < before;
            // What is farther by far must not blur what is near; it only must not seem farther than it is.
            let second = if nearer {
                before
            } else {
                more - SUM_ROUNDING * squared
            };
            largest.0[i] = if nearer { squared } else { 0.0 };
            self.least.0[i] = if nearer { more } else { before };
            self.look.0[i] = if nearer { look } else { self.look.0[i] };
            self.second.0[i] = if second < self.second.0[i] {
                second
            } else {
                self.second.0[i]
            };
        }
        let own = self.radius * self.radius + self.reference as f32;
        let rounding = SUM_ROUNDING * (largest.greatest(simd) + own) + UNDERFLOW;
        if !(rounding <= self.rounding) {
            self.rounding = rounding;
        }
        self.looked.push(Looked {
            leaf: leaf as u32,
            center: [0.0; 3],
            // Which of its points it is, is asked again.
            ties: f32::INFINITY,
        });
    }

    #[inline(always)]
    fn look_closely<S: Simd>(&mut self, simd: S, tree: &Tree, leaf: usize) {
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
        let look = simd.splat_u32s(self.looked.len() as u32);
        let (x, y, z) = (&near.minus_twice[0], &near.minus_twice[1], &near.minus_twice[2]);
        let local = [
            self.local[0].parts::<S>(),
            self.local[1].parts::<S>(),
            self.local[2].parts::<S>(),
        ];
        let looks = S::as_mut_simd_u32s(&mut self.look.0).0;
        let (leasts, seconds) = (self.least.parts_mut::<S>(), self.second.parts_mut::<S>());
        for from in (0..leasts.len()).step_by(2) {
            // Two vectors of queries at a time, since each comparison waits for the one before it.
            let mut w = [[simd.splat_f32s(0.0); 3]; 2];
            let mut base = [simd.splat_f32s(farther); 2];
            let mut least = [simd.splat_f32s(f32::INFINITY); 2];
            for k in 0..2 {
                for e in 0..3 {
                    let q = local[e][from + k];
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
                let (squared, before) = (simd.add_f32s(base[k], least[k]), leasts[from + k]);
                let nearer = simd.less_than_f32s(squared, before);
                looks[from + k] = simd.select_u32s(nearer, look, looks[from + k]);
                leasts[from + k] = simd.min_f32s(squared, before);
                let farther = simd.max_f32s(squared, before);
                seconds[from + k] = simd.min_f32s(farther, seconds[from + k]);
            }
        }
        // For all queries at once, so as for the farthest of them.
        let distance = (squared as f32).sqrt() * (1.0 + SLACK);
        let (place, r) = (self.radius * distance, near.radius);
        let size = distance + self.radius;
        let within = LEAF_ROUNDING * r * (size + r);
        let double = DOUBLE_ROUNDING * (size + r) * (size + 2.0);
        let rounding = within
            + PLACE_ROUNDING * place
            + SUM_ROUNDING * (farther.abs() + 2.0 * place + r * (2.0 * size + r))
            + double
            + UNDERFLOW;
        if !(rounding <= self.rounding) {
            self.rounding = rounding;
        }
        self.looked.push(Looked {
            leaf: leaf as u32,
            center: c,
            ties: 2.0 * (within + double + UNDERFLOW),
        });
    }
}
