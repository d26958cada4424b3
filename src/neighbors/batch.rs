//! The search for the nearest points of many queries, a block at a time.

use glam::DVec3;
use pulp::Simd;

use super::Neighbors;
use super::block::{Block, Column};
use super::exact::ExactBoxes;
use super::lanes::BLOCK;
use super::traversal::Traversal;
use super::tree::LEAF;

/// The nearest place of each query of a block.
#[derive(Debug, Default)]
pub(crate) struct BlockResult {
    /// The places' positions in the tree's order.
    pub(crate) position: [u32; BLOCK],
    /// Their squared distances, in the square of the points' unit.
    pub(crate) distance_squared: Column,
}

/// While leaves are looked into first, the reach is drawn in after so many of them.
const ROUND: usize = 8;
/// The number of waiting leaves below which drawing the reach in is not worth its time.
const MANY: usize = 24;

/// A search for the nearest places of blocks of queries, each of which starts where the one before it ended.
///
/// To be used where code is built for the vector instructions `S`: all that it calls in its loops is
/// inlined. Only the choice of leaves that are looked into depends on how they round, never an answer.
pub(crate) struct BatchSearch<'a, S> {
    simd: S,
    index: &'a Neighbors,
    /// The position of the nearest place of the last query.
    last: usize,
    block: Block,
    /// Leaves that may be out of reach by the time all others have been looked into, and their excesses over
    /// the reference.
    waiting: Vec<(f32, usize)>,
}

impl<'a, S: Simd> BatchSearch<'a, S> {
    #[inline(always)]
    pub(crate) fn new(index: &'a Neighbors, simd: S) -> Self {
        let mut block = Block::default();
        block.looked.reserve(64);
        Self {
            simd,
            index,
            last: 0,
            block,
            waiting: Vec::with_capacity(64),
        }
    }

    /// Finds the nearest places of the first `size` of `queries`, coordinate by coordinate; the others must be
    /// copies of one of these.
    #[inline(always)]
    pub(crate) fn find(&mut self, queries: &[Column; 3], size: usize, result: &mut BlockResult) {
        let (simd, tree) = (self.simd, &self.index.tree);
        if !self.block.begin(simd, queries) {
            let center = self.block.center;
            let leaf = tree.descend(&center);
            let nowhere = (f64::INFINITY, u32::MAX, leaf * LEAF);
            self.last = self.index.nearer_in(leaf, DVec3::from_array(center), nowhere).2;
        }
        self.search();
        let (count, last) = self.block.candidates();
        let mut found = [[0.0; BLOCK]; 3];
        for i in 0..size {
            let mut position = None;
            if count[i] == 1 {
                let looked = &self.block.looked[last[i] as usize];
                position = self.block.nearest_in(simd, tree, looked, i);
            }
            let position = match position {
                Some(position) => position,
                None => self.exact(i, DVec3::new(queries[0][i], queries[1][i], queries[2][i])),
            };
            result.position[i] = position as u32;
            self.last = position;
            let point = tree.point(position);
            for e in 0..3 {
                found[e][i] = point[e];
            }
        }
        for i in 0..BLOCK {
            let (x, y) = (queries[0][i] - found[0][i], queries[1][i] - found[1][i]);
            let z = queries[2][i] - found[2][i];
            result.distance_squared[i] = x * x + y * y + z * z;
        }
    }

    /// Looks into all leaves that may hold the nearest point of any query, first of all into that of the last
    /// one; into none where single precision tells nothing.
    #[inline(always)]
    fn search(&mut self) {
        let (simd, tree, block) = (self.simd, &self.index.tree, &mut self.block);
        let start = self.last / LEAF;
        block.begin_with::<S>(&tree.point(self.last));
        if block.is_blind(tree) {
            return;
        }
        block.look_into(simd, tree, start, block.sight(&tree.leaves[start]));
        block.update_reach(simd);
        let mut first_excess = block.first_excess(simd);
        self.waiting.clear();
        let mut traversal = Traversal::new(tree, block.center, block.reference);
        while let Some((leaf, excess)) = traversal.next::<S>(tree, block.reach) {
            if leaf == start {
                continue;
            }
            if excess > first_excess {
                self.waiting.push((excess, leaf));
            } else {
                block.look_into(simd, tree, leaf, block.sight(&tree.leaves[leaf]));
                if block.looked.len() % ROUND == 0 {
                    block.update_reach(simd);
                    first_excess = block.first_excess(simd);
                }
            }
        }
        block.update_reach(simd);
        for (i, &(excess, leaf)) in self.waiting.iter().enumerate() {
            if excess > block.reach {
                continue;
            }
            let sight = block.sight(&tree.leaves[leaf]);
            if block.may_find_in::<S>(&tree.leaves[leaf], &sight) {
                block.look_into(simd, tree, leaf, sight);
                if self.waiting.len() - i > MANY {
                    block.update_reach(simd);
                }
            }
        }
    }

    /// The position of the place nearest to query `i` among all that single precision could not tell apart.
    #[cold]
    #[inline(never)]
    fn exact(&self, i: usize, query: DVec3) -> usize {
        let (index, last, block) = (self.index, self.last, &self.block);
        let mut best = (
            index.tree.point(last).distance_squared(query),
            index.first[last],
            last,
        );
        if block.looked.is_empty() {
            let exact_boxes = index.exact_boxes.get_or_init(|| ExactBoxes::new(index));
            return exact_boxes.nearest(index, query, best).2;
        }
        // What is not inlined is built for this machine's vector instructions only in here.
        self.simd.vectorize(|| {
            for looked in &block.looked {
                if !(looked.lower.0[i] > block.upper.0[i]) {
                    best = index.nearer_in(looked.leaf, query, best);
                }
            }
        });
        best.2
    }
}
