//! From box to box, down to the leaves within reach.

use pulp::Simd;

use super::boxes::WIDTH;
use super::tree::Tree;

/// A walk from box to box, down to the leaves. No iterator and without closures, since only what is
/// inlined is built for each kind of vector instructions.
pub(super) struct Walk {
    from: [f64; 3],
    /// Distances, levels and numbers of the groups to go into.
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
            from: [0.0; 3],
            stack: [(0.0, 0, 0); 12 * WIDTH],
            height: 0,
            near: 0,
            group: 0,
            distances: [0.0; WIDTH],
        }
    }

    /// Begins again, as [`Tree::walk`].
    #[inline(always)]
    pub(super) fn begin(&mut self, tree: &Tree, from: [f64; 3]) {
        self.from = from;
        self.stack[0] = (0.0, tree.top(), 0);
        (self.height, self.near) = (1, 0);
    }

    /// The next leaf within a reach, and the squared distance of its box. The reach is given squared and
    /// as a bound on its root; it must not grow from call to call.
    #[inline(always)]
    pub(super) fn next<S: Simd>(
        &mut self,
        tree: &Tree,
        (reach_squared, reach): (f32, f32),
    ) -> Option<(usize, f32)> {
        loop {
            while self.near != 0 {
                let i = self.near.trailing_zeros() as usize;
                self.near &= self.near - 1;
                let leaf = self.group * WIDTH + i;
                // Where rounding left no number, better look.
                if !(self.distances[i] > reach_squared) && leaf < tree.leaves() {
                    return Some((leaf, self.distances[i]));
                }
            }
            if self.height == 0 {
                return None;
            }
            self.height -= 1;
            let (distance, level, group) = self.stack[self.height];
            if distance > reach_squared {
                continue;
            }
            let (level, group) = (level as usize, group as usize);
            let distances = tree.boxes(level)[group].distances_squared::<S>(self.from, reach);
            // Bit after bit and then all at once, as vectors can.
            let mut bits = [0u32; WIDTH];
            for i in 0..WIDTH {
                bits[i] = if distances[i] > reach_squared { 0 } else { 1 << i };
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
}
