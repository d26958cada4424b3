//! Many queries, answered a block at a time.

use glam::DVec3;
use pulp::Simd;

use super::Neighbors;
use super::block::{Block, Column};
use super::lanes::BLOCK;
use super::tree::LEAF;
use super::walk::Walk;

/// What is nearest to each query of a block.
#[derive(Debug)]
pub(crate) struct Nearest {
    /// The places' positions in the tree's order.
    pub(crate) position: [u32; BLOCK],
    /// Their squared distances, in the square of the points' unit.
    pub(crate) distance_squared: Column,
}

impl Nearest {
    /// Of no query.
    pub(crate) const NONE: Self = Self {
        position: [0; BLOCK],
        distance_squared: [0.0; BLOCK],
    };
}

/// Leaves that can wait while others are looked into. Even surfaces leave some 20 waiting.
const WAITING: usize = 64;

/// Answers blocks of queries, each from where the block before it found its.
///
/// To be used where code is built for the vector instructions `S`: all that it calls in its loops is
/// inlined. What depends on how they round is only which leaves are looked into, never an answer.
pub(crate) struct Together<'a, S> {
    simd: S,
    index: &'a Neighbors,
    /// The leaf in which the last query found its nearest.
    start: Option<usize>,
    block: Block,
    walk: Walk,
    /// Leaves that may be out of reach by the time all others have been looked into, and how far they
    /// are from the queries' middle, squared.
    waiting: [(f32, u32); WAITING],
}

impl<'a, S: Simd> Together<'a, S> {
    #[inline(always)]
    pub(crate) fn new(index: &'a Neighbors, simd: S) -> Self {
        Self {
            simd,
            index,
            start: None,
            block: Block::empty(),
            walk: Walk::new(),
            waiting: [(0.0, 0); WAITING],
        }
    }

    /// The nearest places of the first `size` of `queries`, coordinate by coordinate; those left over
    /// are to be copies of one of them.
    #[inline(always)]
    pub(crate) fn answer(&mut self, queries: &[Column; 3], size: usize, nearest: &mut Nearest) {
        let (simd, index, tree) = (self.simd, self.index, &self.index.tree);
        let (block, walk, waiting) = (&mut self.block, &mut self.walk, &mut self.waiting);
        let query = |i: usize| DVec3::new(queries[0][i], queries[1][i], queries[2][i]);
        let start = match self.start {
            Some(leaf) => leaf,
            None => tree.descend(query(0)),
        };
        if !block.begin(simd, tree, queries, start) {
            for i in 0..size {
                let (distance, position) = index.nearest_from::<S>(tree.descend(query(i)), query(i));
                (nearest.position[i], nearest.distance_squared[i]) = (position as u32, distance);
            }
            return;
        }
        // Where the query before these found its, so that not much else is in reach.
        block.look_into(simd, tree, queries, start);
        block.begin_reach(simd);
        walk.begin(tree, block.center());
        let mut count = 0;
        while let Some((leaf, distance)) = walk.next::<S>(tree, block.center_reach()) {
            if leaf == start {
                continue;
            }
            let first = distance <= block.first_squared();
            if !first && count < WAITING {
                waiting[count] = (distance, leaf as u32);
                count += 1;
            } else if first || block.may_find_in::<S>(tree, leaf) {
                block.look_into(simd, tree, queries, leaf);
                block.update_reach(simd);
            }
        }
        for &(distance, leaf) in &waiting[..count] {
            let leaf = leaf as usize;
            if !(distance > block.center_reach().0) && block.may_find_in::<S>(tree, leaf) {
                block.look_into(simd, tree, queries, leaf);
                block.update_reach(simd);
            }
        }
        for i in 0..size {
            let (leaf, surely) = block.found(i);
            let place = if surely { block.place(simd, i, tree) } else { None };
            let (distance, position) = match place {
                Some(place) => (tree.distance_squared(leaf, place, query(i)), leaf * LEAF + place),
                None => index.nearest_from::<S>(leaf, query(i)),
            };
            (nearest.position[i], nearest.distance_squared[i]) = (position as u32, distance);
        }
        self.start = Some(block.found(BLOCK - 1).0);
    }
}
