//! How far the queries of a block still look, and which boxes that leaves out.

use pulp::Simd;

use super::super::boxes::{FAR_OFF_SQUARED, SLACK};
use super::super::lanes::BLOCK;
use super::super::tree::Tree;
use super::super::walk::{Reach, Standpoint};
use super::Block;

/// Leaves whose boxes are not much farther from the queries' middle than the queries are from what
/// they have found are looked into first: most of them hold what is nearest to some query. So much
/// farther, in units of how far the queries lie from their middle.
const FIRST: f32 = 0.05;

impl Block {
    /// The reach from what was found in the first leaf.
    #[inline(always)]
    pub(in super::super) fn begin_reach<S: Simd, const FAR_OFF: bool>(&mut self, simd: S) {
        let reference = self.reference as f32;
        for i in 0..BLOCK {
            let f = self.from_center.0[i] * (1.0 + SLACK);
            // (r + f)² is at most (1 + k) r² + (1 + 1/k) f², whatever k, and just that for k = f / r.
            // What is zero, or nearly, must not divide.
            let squared = self.squares.0[i] + self.upper.0[i] + reference;
            let squared = if squared > 0.0 { squared } else { 0.0 };
            let reach = squared.sqrt().max(f * 0.0625).max(1e-18);
            self.slope.0[i] = (reach + f) / reach;
            self.more.0[i] = (reach + f) * f;
        }
        self.reach.root = 0.0;
        self.update_reach::<S, FAR_OFF>(simd);
        let mean = (self.upper.sum(simd) + self.squares.sum(simd)) * (1.0 / BLOCK as f32);
        self.first_excess = mean + FIRST * self.reach.root * self.radius;
    }

    /// Draws the reach in to what was found.
    #[inline(always)]
    pub(in super::super) fn update_reach<S: Simd, const FAR_OFF: bool>(&mut self, simd: S) {
        let (squares, upper) = (self.squares.parts::<S>(), self.upper.parts::<S>());
        let (slope, more) = (self.slope.parts::<S>(), self.more.parts::<S>());
        let zero = simd.splat_f32s(0.0);
        let reference = self.reference as f32;
        let mut farthest = zero;
        for part in 0..squares.len() {
            let excess = simd.add_f32s(squares[part], upper[part]);
            let squared = simd.max_f32s(simd.add_f32s(excess, simd.splat_f32s(reference)), zero);
            farthest = simd.max_f32s(farthest, simd.mul_add_e_f32s(squared, slope[part], more[part]));
        }
        let farthest = simd.reduce_max_f32s(farthest) * (1.0 + SLACK);
        // The reach hardly ever grows: then because more was rounded.
        if farthest > self.reach.root * self.reach.root {
            self.reach.root = farthest.sqrt() * (1.0 + SLACK);
        }
        self.reach.excess = farthest - reference + SLACK * (farthest + reference);
        if FAR_OFF {
            let twice_toward = self.twice_toward.parts::<S>();
            let mut toward = simd.splat_f32s(f32::NEG_INFINITY);
            for part in 0..upper.len() {
                toward = simd.max_f32s(toward, simd.add_f32s(upper[part], twice_toward[part]));
            }
            let toward = simd.reduce_max_f32s(toward);
            self.reach.excess_toward = toward + SLACK * toward.abs() + self.twice_toward_rounding;
        }
    }

    /// Where the queries begin to walk.
    #[inline(always)]
    pub(in super::super) fn standpoint(&self) -> Standpoint {
        Standpoint {
            center: self.center,
            radius: self.radius,
            toward: self.toward,
            reference: self.reference,
        }
    }

    /// How far to walk to find something nearer to any query.
    #[inline(always)]
    pub(in super::super) fn reach(&self) -> Reach {
        self.reach
    }

    /// What a box may be farther from the center than the reference and be looked into before others,
    /// squared.
    #[inline(always)]
    pub(in super::super) fn first_excess(&self) -> f32 {
        self.first_excess
    }

    /// Whether a box may hold something nearer to any query.
    #[inline(always)]
    pub(in super::super) fn may_find_in<S: Simd, const FAR_OFF: bool>(
        &self,
        tree: &Tree,
        leaf: usize,
    ) -> bool {
        let center = tree.leaf_center(leaf);
        let radius = tree.leaf_near(leaf).radius;
        let (mut at, mut squared, mut size) = ([0.0; 3], 0.0, self.radius + radius);
        for e in 0..3 {
            let d = center[e] - self.center[e];
            squared += d * d;
            at[e] = d as f32;
            size += at[e].abs();
        }
        let (group, lane) = tree.leaf_box(leaf);
        if FAR_OFF && !(squared < FAR_OFF_SQUARED * f64::from(radius) * f64::from(radius)) {
            let reach = (&self.upper, squared - self.reference, radius + self.radius);
            return !group.beyond_far_off::<S>((lane, at, size), &self.local, reach);
        }
        let reach = (&self.upper, &self.squares, self.reference as f32, self.reach.root);
        !group.beyond_close_by::<S>((lane, at, size), &self.local, reach)
    }
}
