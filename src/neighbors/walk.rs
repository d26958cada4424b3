//! Standpoint box to box, down to the leaves within reach.

use pulp::Simd;

use super::boxes::{Boxes, SLACK, WIDTH, times_plus};
use super::tree::Tree;

/// Queries that walk together, in the boxes' frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Standpoint {
    /// The point that they lie around, and at least how far each of them lies from it.
    pub(super) center: [f64; 3],
    pub(super) radius: f32,
    /// A point near what they have found, c, and |c|², c seen from the center: what squared distances
    /// are compared with.
    pub(super) toward: [f64; 3],
    pub(super) reference: f64,
}

/// What is this many times as far from other queries as they lie from their middles is somewhere else.
const JUMP: f32 = 8.0;

impl Standpoint {
    /// Whether what these queries look for is likely to be near what the others have found.
    #[inline(always)]
    pub(super) fn is_near(&self, other: &Self) -> bool {
        let mut squared = 0.0;
        for e in 0..3 {
            let d = (self.center[e] - other.center[e]) as f32;
            squared += d * d;
        }
        let much = JUMP * (self.radius + other.radius);
        squared < much * much
    }
}

/// How far to walk: a box is out of reach once either bound says so.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    /// What squared distances from the center may exceed the reference by, and at least the root of
    /// the largest.
    pub(super) excess: f32,
    pub(super) root: f32,
    /// What |q - p|² of any query q may exceed |q - c|² by. With p and c seen from the center that is
    /// what |p|² exceeds |c|² by, but for 2 q·(p - c), which is little where p is close to c.
    pub(super) excess_toward: f32,
}

/// A walk from box to box, down to the leaves. No iterator and without closures, since only what is
/// inlined is built for each kind of vector instructions.
pub(super) struct Walk {
    from: Standpoint,
    /// Excesses over the reference, levels and numbers of the groups to go into.
    stack: [(f32, u32, u32); 12 * WIDTH],
    height: usize,
    /// Which leaves of `group` are still to be visited, a bit each, and how far all of them are.
    near: u32,
    group: usize,
    distances: [f32; WIDTH],
}

impl Walk {
    /// A walk that has ended.
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self {
            from: Standpoint {
                center: [0.0; 3],
                radius: 0.0,
                toward: [0.0; 3],
                reference: 0.0,
            },
            stack: [(0.0, 0, 0); 12 * WIDTH],
            height: 0,
            near: 0,
            group: 0,
            distances: [0.0; WIDTH],
        }
    }

    /// Begins again: over all leaves that may hold a point within reach, and perhaps some more.
    #[inline(always)]
    pub(super) fn begin(&mut self, tree: &Tree, from: Standpoint) {
        self.from = from;
        self.stack[0] = (f32::NEG_INFINITY, tree.top(), 0);
        (self.height, self.near) = (1, 0);
    }

    /// The next leaf within a reach, and what the squared distance of its box exceeds the reference by.
    /// The reach must not grow from call to call. Where boxes may be small beside their distance,
    /// `FAR_OFF` tells them apart.
    #[inline(always)]
    pub(super) fn next<S: Simd, const FAR_OFF: bool>(
        &mut self,
        tree: &Tree,
        reach: Reach,
    ) -> Option<(usize, f32)> {
        loop {
            while self.near != 0 {
                let i = self.near.trailing_zeros() as usize;
                self.near &= self.near - 1;
                let leaf = self.group * WIDTH + i;
                // Where rounding left no number, better look.
                if !(self.distances[i] > reach.excess) && leaf < tree.leaves() {
                    return Some((leaf, self.distances[i]));
                }
            }
            if self.height == 0 {
                return None;
            }
            self.height -= 1;
            let (distance, level, group) = self.stack[self.height];
            if distance > reach.excess {
                continue;
            }
            let (level, group) = (level as usize, group as usize);
            let boxes = &tree.boxes(level)[group];
            let (distances, limits);
            if FAR_OFF && boxes.is_far_off(self.from.center) {
                (distances, limits) = self.far_off::<S>(boxes, reach);
            } else {
                let Standpoint {
                    center, reference, ..
                } = self.from;
                distances = boxes.excesses_close_by::<S>(center, reference, reach.root);
                limits = [reach.excess; WIDTH];
            }
            // Bit after bit and then all at once, as vectors can.
            let mut bits = [0u32; WIDTH];
            for i in 0..WIDTH {
                bits[i] = if distances[i] > limits[i] { 0 } else { 1 << i };
            }
            let mut near = bits.iter().fold(0, |all, bit| all | bit);
            if level == 0 {
                (self.near, self.group, self.distances) = (near, group, distances);
                continue;
            }
            while near != 0 {
                let i = near.trailing_zeros() as usize;
                near &= near - 1;
                let below = group * WIDTH + i;
                if below < tree.boxes(level - 1).len() {
                    self.stack[self.height] = (distances[i], level as u32 - 1, below as u32);
                    self.height += 1;
                }
            }
        }
    }

    /// How far boxes are, most of them small beside their distance, and how far they may be.
    #[inline(always)]
    fn far_off<S: Simd>(&self, boxes: &Boxes, reach: Reach) -> ([f32; WIDTH], [f32; WIDTH]) {
        let from = &self.from;
        let distances = boxes.excesses_far_off::<S>(from.center, from.reference, reach.root);
        let mut limits = boxes.spans::<S>(from.toward);
        let sideways = 2.0 * from.radius * (1.0 + SLACK);
        for i in 0..WIDTH {
            let limit = times_plus::<S>(sideways, limits[i], reach.excess_toward);
            limits[i] = if limit < reach.excess { limit } else { reach.excess };
        }
        (distances, limits)
    }
}
