//! Many queries, answered a block at a time.

use glam::DVec3;
use pulp::Simd;

use super::Neighbors;
pub(crate) use super::block::BLOCK;
use super::block::{Block, Double};
use super::tree::{LEAF, Walk};

/// How many queries of a block the next one starts from.
const SEEDS: usize = 3;

/// What is nearest to each query of a block.
#[derive(Debug)]
pub(crate) struct Nearest {
    /// The places' positions in the tree's order.
    pub(crate) position: [u32; BLOCK],
    /// Their squared distances, in the square of the points' unit.
    pub(crate) distance_squared: [f64; BLOCK],
}

impl Nearest {
    /// Of no query.
    pub(crate) const NONE: Self = Self {
        position: [0; BLOCK],
        distance_squared: [0.0; BLOCK],
    };
}

/// Answers blocks of queries, each from where the block before it found its.
///
/// To be used where code is built for the vector instructions `S`: all that it calls in its loops is
/// inlined. What depends on how they round is only which leaves are looked into, never an answer.
pub(crate) struct Together<'a, S> {
    simd: S,
    index: &'a Neighbors,
    /// Leaves in which queries of the last block found their nearest.
    start: [usize; SEEDS],
    block: Block,
    walk: Walk,
}

impl<'a, S: Simd> Together<'a, S> {
    #[inline(always)]
    pub(crate) fn new(index: &'a Neighbors, simd: S) -> Self {
        Self {
            simd,
            index,
            start: [usize::MAX; SEEDS],
            block: Block::empty(),
            walk: Walk::new(),
        }
    }

    /// The nearest places of the first `size` of `queries`, coordinate by coordinate; those left over
    /// are to be copies of one of them.
    #[inline(always)]
    pub(crate) fn answer(&mut self, queries: &[Double; 3], size: usize, nearest: &mut Nearest) {
        let (index, tree) = (self.index, &self.index.tree);
        let (start, block, walk) = (&mut self.start, &mut self.block, &mut self.walk);
        let query = |i: usize| DVec3::new(queries[0][i], queries[1][i], queries[2][i]);
        if start[0] == usize::MAX {
            *start = [tree.descend(query(0)); SEEDS];
        }
        if !block.begin(tree, queries, start[0]) {
            for i in 0..size {
                let (distance, position) = index.nearest_from::<S>(tree.descend(query(i)), query(i));
                (nearest.position[i], nearest.distance_squared[i]) = (position as u32, distance);
            }
            return;
        }
        // Where the queries before these found theirs, so that hardly anything else is in reach.
        for (i, &leaf) in start.iter().enumerate() {
            if !start[..i].contains(&leaf) {
                block.look_into::<S>(tree, leaf);
            }
        }
        block.update_center_reach();
        walk.begin(tree, block.center());
        while let Some(leaf) = walk.next::<S>(tree, block.center_reach_squared()) {
            if !start.contains(&leaf) && block.may_find_in::<S>(tree, leaf) && block.look_into::<S>(tree, leaf)
            {
                block.update_reach();
            }
        }
        for i in 0..size {
            let (leaf, surely) = block.found(i);
            let place = if surely {
                block.place(self.simd, i, tree)
            } else {
                None
            };
            let (distance, position) = match place {
                Some(place) => (tree.distance_squared(leaf, place, query(i)), leaf * LEAF + place),
                None => index.nearest_from::<S>(leaf, query(i)),
            };
            (nearest.position[i], nearest.distance_squared[i]) = (position as u32, distance);
        }
        for s in 0..SEEDS {
            start[s] = block.found(s * (BLOCK - 1) / (SEEDS - 1)).0;
        }
    }
}
