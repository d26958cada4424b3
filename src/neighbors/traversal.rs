//! A traversal of the tree from box to box, down to the leaves within reach.

use pulp::Simd;

use super::boxes::WIDTH;
use super::tree::Tree;

/// Nine levels of sixteen boxes are more than 2^32 points have.
const STACK: usize = 9 * WIDTH;

/// A traversal of the tree. No iterator and without closures, since only what is inlined is built for
/// each kind of vector instructions.
pub(super) struct Traversal {
    /// The point that distances are measured from.
    from: [f64; 3],
    /// A squared distance that others are compared with.
    reference: f64,
    /// The groups to visit: their excesses over the reference, levels and numbers.
    stack: [(f32, u32, u32); STACK],
    height: usize,
    /// The leaves of `group` that are still to be visited, a bit each, and the excesses of all of them.
    near: u32,
    group: usize,
    excesses: [f32; WIDTH],
}

impl Traversal {
    /// A traversal of all leaves that may hold a point within reach of `from`.
    #[inline(always)]
    pub(super) fn new(tree: &Tree, from: [f64; 3], reference: f64) -> Self {
        let mut stack = [(0.0, 0, 0); STACK];
        stack[0] = (f32::NEG_INFINITY, tree.levels.len() as u32 - 1, 0);
        Self {
            from,
            reference,
            stack,
            height: 1,
            near: 0,
            group: 0,
            excesses: [0.0; WIDTH],
        }
    }

    /// The next leaf whose squared distance may exceed the reference by no more than `reach`, and at least
    /// that excess.
    #[inline(always)]
    pub(super) fn next<S: Simd>(&mut self, tree: &Tree, reach: f32) -> Option<(usize, f32)> {
        loop {
            while self.near != 0 {
                let i = self.near.trailing_zeros() as usize;
                self.near &= self.near - 1;
                let leaf = self.group * WIDTH + i;
                // NaN is within reach.
                if !(self.excesses[i] > reach) && leaf < tree.leaves.len() {
                    return Some((leaf, self.excesses[i]));
                }
            }
            if self.height == 0 {
                return None;
            }
            self.height -= 1;
            let (excess, level, group) = self.stack[self.height];
            if excess > reach {
                continue;
            }
            let (level, group) = (level as usize, group as usize);
            let excesses = tree.levels[level][group].excesses::<S>(&self.from, self.reference);
            // Bit after bit and then all at once, as vectors can.
            let mut bits = [0u32; WIDTH];
            for i in 0..WIDTH {
                bits[i] = if excesses[i] > reach { 0 } else { 1 << i };
            }
            let mut near = bits.iter().fold(0, |all, bit| all | bit);
            if level == 0 {
                (self.near, self.group, self.excesses) = (near, group, excesses);
                continue;
            }
            while near != 0 {
                let i = near.trailing_zeros() as usize;
                near &= near - 1;
                let below = group * WIDTH + i;
                if below < tree.levels[level - 1].len() {
                    self.stack[self.height] = (excesses[i], level as u32 - 1, below as u32);
                    self.height += 1;
                }
            }
        }
    }
}
