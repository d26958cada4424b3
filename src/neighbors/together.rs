//! Many queries, answered a block at a time.

use glam::DVec3;
use pulp::{Scalar, Simd, WithSimd};

use super::Neighbors;
use super::block::{Block, Column};
use super::lanes::{BLOCK, seldom};
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

/// While leaves are looked into first, the reach is drawn in after so many of them.
const ROUND: usize = 8;
/// Where fewer leaves wait, drawing the reach in is not worth its time.
const MANY: usize = 24;

/// Where a block looked into more leaves, a query asked again by itself walks: that leads to fewer.
const MANY_LOOKED: usize = 64;

/// Where single precision left so many queries of a block in doubt, the next one keeps what it finds in
/// each leaf, so that it need not look again.
const MANY_UNSURE: usize = 2;

/// Answers blocks of queries, each from where the block before it found its.
///
/// To be used where code is built for the vector instructions `S`: all that it calls in its loops is
/// inlined. What depends on how they round is only which leaves are looked into, never an answer.
pub(crate) struct Together<'a, S> {
    simd: S,
    index: &'a Neighbors,
    /// The leaf in which the last query found its nearest.
    start: Option<usize>,
    /// Whether single precision left several queries in doubt before.
    doubtful: bool,
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
            doubtful: false,
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
        let query = |i: usize| DVec3::new(queries[0][i], queries[1][i], queries[2][i]);
        let mut before = self.block.standpoint();
        if !self.block.begin(simd, tree, queries) {
            for i in 0..size {
                let start = tree.descend(tree.in_frame(query(i)).to_array());
                let (distance, position) = index.nearest_from::<Scalar>(start, query(i));
                (nearest.position[i], nearest.distance_squared[i]) = (position as u32, distance);
            }
            return;
        }
        let (groups, count) = self.block.groups(tree, size);
        let mut apart;
        let mut part = queries;
        for &group in &groups[..count] {
            if count > 1 {
                apart = gather(queries, group);
                part = &apart;
                self.block.begin(simd, tree, part);
            }
            let here = self.block.standpoint();
            let mut start = match self.start {
                Some(leaf) if here.is_near(&before) => leaf,
                _ => tree.descend(here.center),
            };
            before = here;
            for again in [true, false] {
                if self.block.refer_to(tree, start, self.doubtful) {
                    let together = &mut *self;
                    seldom(
                        simd,
                        WalkFarOff {
                            together,
                            start,
                            queries: part,
                        },
                    );
                } else {
                    self.walk_from::<false>(start, part);
                }
                let (leaf, surely) = self.block.found(0);
                if surely || !self.block.is_blurred(0) || !again {
                    break;
                }
                start = leaf;
            }
            let mut left = group;
            let mut unsure = 0;
            for i in 0..group.count_ones() as usize {
                let to = left.trailing_zeros() as usize;
                left &= left - 1;
                let (leaf, surely) = self.block.found(i);
                let place = if surely {
                    self.block.place(simd, i, tree)
                } else {
                    None
                };
                let (distance, position) = if let Some(place) = place {
                    (
                        tree.distance_squared(leaf, place, query(to)),
                        tree.positions(leaf).start + place,
                    )
                } else {
                    unsure += usize::from(!surely);
                    let (block, query) = (&mut self.block, query(to));
                    let again = Again {
                        index,
                        block,
                        queries: part,
                        i,
                        query,
                        leaf: surely.then_some(leaf),
                    };
                    seldom(simd, again)
                };
                (nearest.position[to], nearest.distance_squared[to]) = (position as u32, distance);
            }
            self.doubtful = unsure >= MANY_UNSURE;
            self.start = Some(self.block.found(BLOCK - 1).0);
        }
    }

    /// Looks for what is nearest to the queries that the block has begun with, in all leaves that may
    /// hold it, first of all in `start`.
    #[inline(always)]
    fn walk_from<const FAR_OFF: bool>(&mut self, start: usize, queries: &[Column; 3]) {
        let (simd, tree) = (self.simd, &self.index.tree);
        let (block, walk, waiting) = (&mut self.block, &mut self.walk, &mut self.waiting);
        // Where the query before these found its, so that not much else is in reach.
        block.look_into::<S, FAR_OFF>(simd, tree, queries, start);
        block.begin_reach::<S, FAR_OFF>(simd);
        walk.begin(tree, block.standpoint());
        let mut count = 0;
        while let Some((leaf, distance)) = walk.next::<S, FAR_OFF>(tree, block.reach()) {
            if leaf == start {
                continue;
            }
            let first = distance <= block.first_excess();
            if !first && count < WAITING {
                waiting[count] = (distance, leaf as u32);
                count += 1;
            } else if first || block.may_find_in::<S, FAR_OFF>(tree, leaf) {
                block.look_into::<S, FAR_OFF>(simd, tree, queries, leaf);
                if !first || block.looked() % ROUND == 0 {
                    block.begin_reach::<S, FAR_OFF>(simd);
                }
            }
        }
        block.update_reach::<S, FAR_OFF>(simd);
        for (i, &(distance, leaf)) in waiting[..count].iter().enumerate() {
            let leaf = leaf as usize;
            if !(distance > block.reach().excess) && block.may_find_in::<S, FAR_OFF>(tree, leaf) {
                block.look_into::<S, FAR_OFF>(simd, tree, queries, leaf);
                if count - i > MANY {
                    block.update_reach::<S, FAR_OFF>(simd);
                }
            }
        }
    }
}

/// [`Together::walk_from`] where boxes may be small beside their distance or queries are left in doubt.
struct WalkFarOff<'a, 'b, S> {
    together: &'a mut Together<'b, S>,
    start: usize,
    queries: &'a [Column; 3],
}

impl<S: Simd> WithSimd for WalkFarOff<'_, '_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<T: Simd>(self, _: T) {
        self.together.walk_from::<true>(self.start, self.queries);
    }
}

/// Asks for query `i` by itself. Its nearest is in `leaf` or in what the block has looked into.
struct Again<'a> {
    index: &'a Neighbors,
    block: &'a mut Block,
    queries: &'a [Column; 3],
    i: usize,
    query: DVec3,
    leaf: Option<usize>,
}

impl WithSimd for Again<'_> {
    type Output = (f64, usize);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (f64, usize) {
        let (index, block) = (self.index, self.block);
        if self.leaf.is_some() {
            return index.nearest_in(self.leaf.into_iter(), self.query);
        }
        if block.looked() > MANY_LOOKED {
            let (leaf, _) = block.found(self.i);
            return index.nearest_from::<S>(leaf, self.query);
        }
        if !block.knows_candidates() {
            block.look_again(simd, &index.tree, self.queries);
        }
        index.nearest_in(block.candidates(self.i), self.query)
    }
}

/// The queries of a group, and copies of the first for those that are not in it.
#[cold]
#[inline(never)]
fn gather(queries: &[Column; 3], group: u32) -> [Column; 3] {
    let mut gathered = [[0.0; BLOCK]; 3];
    for e in 0..3 {
        gathered[e] = [queries[e][group.trailing_zeros() as usize]; BLOCK];
        let mut left = group;
        for i in 0..group.count_ones() as usize {
            gathered[e][i] = queries[e][left.trailing_zeros() as usize];
            left &= left - 1;
        }
    }
    gathered
}
