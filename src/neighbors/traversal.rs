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
    /// The nodes to visit: their excesses over the reference, levels (0 for leaves) and numbers.
    stack: [(f32, u32, u32); STACK],
    height: usize,
}

impl Traversal {
    /// A traversal of all leaves that may hold a point within reach of `from`.
    #[inline(always)]
    pub(super) fn new(tree: &Tree, from: [f64; 3], reference: f64) -> Self {
        let mut stack = [(0.0, 0, 0); STACK];
        stack[0] = (f32::NEG_INFINITY, tree.levels.len() as u32, 0);
        Self {
            from,
            reference,
            stack,
            height: 1,
        }
    }

    /// The next leaf whose squared distance may exceed the reference by no more than `reach`, and at least
    /// that excess.
    #[inline(always)]
    pub(super) fn next<S: Simd>(&mut self, tree: &Tree, reach: f32) -> Option<(usize, f32)> {
        while self.height > 0 {
            self.height -= 1;
            let (excess, level, node) = self.stack[self.height];
            let (level, node) = (level as usize, node as usize);
            // Compared so that NaN is within reach.
            if excess > reach {
                continue;
            }
            if level == 0 {
                return Some((node, excess));
            }
            let excesses = tree.levels[level - 1][node].excesses::<S>(&self.from, self.reference);
            // Bit after bit and then all at once, as vectors can.
            let mut bits = [0u32; WIDTH];
            for i in 0..WIDTH {
                bits[i] = if excesses[i] > reach { 0 } else { 1 << i };
            }
            let mut near = bits.iter().fold(0, |all, bit| all | bit);
            let below = if level > 1 {
                tree.levels[level - 2].len()
            } else {
                tree.leaves.len()
            };
            while near != 0 {
                // The last first, so that the first is visited first.
                let i = 31 - near.leading_zeros() as usize;
                near ^= 1 << i;
                if node * WIDTH + i < below {
                    self.stack[self.height] = (excesses[i], level as u32 - 1, (node * WIDTH + i) as u32);
                    self.height += 1;
                }
            }
        }
        None
    }
}
