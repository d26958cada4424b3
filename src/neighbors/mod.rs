//! Exact nearest neighbors of many queries that lie close together but far from the points.
//!
//! A k-d tree goes down to the cell of a query and back up, into every cell that is nearer than the best point
//! so far. Among the points that is quick: few cells are nearer. But the queries here are the points of a
//! surface mirrored in a plane, and most planes carry them well off the surface. From there a large part of the
//! surface is nearly as far as its nearest point, and cells whose sides follow the coordinate axes stick out of a
//! slanted surface by about their own size: hundreds of them are nearer than the nearest point. And each query goes
//! that way alone, though the one before it has just gone nearly the same. Three things are done instead.
//!
//! **Oriented boxes** (`boxes`). Points are sorted into leaves of 32 by halving along the longest side, as for a
//! k-d tree. But leaves, and nodes of 16 leaves, of 256 leaves and so on, have boxes along the principal axes of their
//! points. Such a box is as thin as the surface is within it, and from afar it is nearly as far as its points.
//! The boxes of 16 children are tested at a time, one in each lane of a vector.
//!
//! **Blocks of coherent queries** (`batch`). A block of 32 queries traverses the tree once, from its center, with
//! a reach that covers what every query has found. It starts with the nearest point of the query before it, so
//! that most of the tree is out of reach from the first. Leaves that are hardly farther than what was found are
//! looked into at once. The others wait, and are then tested against each of the 32 queries.
//!
//! **Single precision with a bound, then double** (`block`). The squared distances of 32 queries from 32 points
//! take a few hundred vector instructions in single precision, which keeps too few digits to tell neighbors
//! apart far away. So what is large and common to all candidates is left out, and a bound on all rounding makes
//! each distance an interval. Only leaves whose interval reaches below the least upper end may hold the nearest
//! point: mostly a single leaf, and in it a single point. Otherwise, as with points that are equally far, the few
//! candidates are compared in double precision. Every answer is thus the one that double precision gives for
//! all points, whatever the vector instructions of the machine, and of points that are equally far it is the one with
//! the lowest index.
//!
//! The bound grows with the size of boxes and leaves, hardly with their distance. Where rounding leaves no number,
//! a comparison counts as within reach. Clumps, strays and huge coordinates thus make a search slower, never wrong.
//! Queries so far away that the bound hides all differences are answered in double precision alone (`exact`).
//! Exact duplicates are removed first: no box can tell them apart.

#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    clippy::neg_cmp_op_on_partial_ord,
    reason = "only what is inlined is built for each kind of vector instructions; loops over lanes, of several \
              arrays at a time; NaN, where rounding left no number, counts as within reach"
)]

mod batch;
mod block;
mod boxes;
mod exact;
mod lanes;
mod nearest_places;
mod order;
mod traversal;
mod tree;
#[cfg(test)]
mod work_tests;

use std::sync::OnceLock;

use exact::{Candidate, ExactBoxes};
use glam::DVec3;
use pulp::Simd;

use crate::parallel::{Cancelled, PartOf, Watch};
pub(crate) use batch::{BatchSearch, BlockResult};
pub(crate) use lanes::BLOCK;
use order::spatial_order;
use tree::{LEAF, Tree};

/// Points between two questions to the watch while the index is built: some milliseconds.
const PIECE: u32 = 1 << 16;

/// One place in space and the points that lie exactly there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbor {
    /// The lowest index of the points at this place.
    pub index: usize,
    /// The squared distance from the query, in the square of the points' unit.
    pub distance_squared: f64,
    /// The number of points that lie exactly here.
    pub multiplicity: usize,
}

/// An index of points for exact nearest-neighbor queries.
///
/// Exact duplicates are stored once with their number, since no box can tell them apart, and depth
/// cameras make many. The answers count each of them.
#[derive(Debug)]
pub struct Neighbors {
    tree: Tree,
    /// The lowest point index of each place, in the tree's order.
    first: Vec<u32>,
    /// The start of each place's points in `order`, and the number of points at the end.
    start: Vec<u32>,
    /// All points, place by place.
    order: Vec<u32>,
    /// Made when a query needs them.
    exact_boxes: OnceLock<ExactBoxes>,
}

impl Neighbors {
    /// Indexes `points`, which must be finite. `None` if there are none, or more than [`u32::MAX`].
    pub fn new(points: &[DVec3]) -> Option<Self> {
        // Without a watch nothing is called off.
        Self::new_watched(points, &()).unwrap_or_default()
    }

    /// [`Neighbors::new`], called off by a watch.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if the watch cancels the work.
    pub fn new_watched(points: &[DVec3], watch: &dyn Watch) -> Result<Option<Self>, Cancelled> {
        if points.is_empty() || u32::try_from(points.len()).is_err() {
            return Ok(None);
        }
        // Its share of longer work is not told.
        let watch = &PartOf {
            watch,
            pieces: 0..0,
            total: 1,
        };
        let (lowest, place_of) = distinct_places(points, watch)?;
        let places: Vec<DVec3> = lowest.iter().map(|&i| points[i as usize]).collect();
        let place_order = spatial_order(&places, watch)?;
        let in_order: Vec<DVec3> = place_order.iter().map(|&place| places[place as usize]).collect();
        let first: Vec<u32> = place_order.iter().map(|&place| lowest[place as usize]).collect();
        let (mut start, mut order): (Vec<u32>, Vec<u32>) =
            ((0..=first.len() as u32).collect(), first.clone());
        if places.len() < points.len() {
            let mut position = vec![0; places.len()];
            for (i, &place) in (0..).zip(&place_order) {
                position[place as usize] = i;
            }
            let position = |&i: &u32| position[place_of[i as usize] as usize];
            order = (0..points.len() as u32).collect();
            watch.go_on()?;
            order.sort_by_key(position);
            watch.go_on()?;
            for at in &mut start {
                *at = order.partition_point(|i| position(i) < *at) as u32;
            }
        }
        Ok(Some(Self {
            tree: Tree::new(&in_order, watch)?,
            first,
            start,
            order,
            exact_boxes: OnceLock::new(),
        }))
    }

    /// The number of distinct places that the points occupy.
    pub fn distinct(&self) -> usize {
        self.first.len()
    }

    /// The indices of all points, in an order in which each lies close to the one before it.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The place nearest to `query`, which must be finite; of several as near the one of the lowest index.
    pub fn nearest(&self, query: DVec3) -> Neighbor {
        self.nearest_of_each(&[query])[0]
    }

    /// The nearest place of each query, as [`Neighbors::nearest`] has it, in the order of the queries.
    ///
    /// Queries that lie close to those before them, as points in [`Neighbors::order`] do, are answered
    /// many times sooner than one by one: they search the tree together.
    pub fn nearest_of_each(&self, queries: &[DVec3]) -> Vec<Neighbor> {
        pulp::Arch::new().dispatch(NearestOfEach { index: self, queries })
    }

    /// The lowest index of the points at each position of the tree's order.
    pub(crate) fn first(&self) -> &[u32] {
        &self.first
    }

    /// The nearest place in a leaf, or `best` if none there is nearer.
    #[inline(always)]
    fn nearer_in(&self, leaf: usize, query: DVec3, best: Candidate) -> Candidate {
        #[cfg(test)]
        work_tests::count(1);
        let distances = self.tree.distances_squared(leaf, query);
        // In eight lanes, as vectors can.
        let lesser =
            |a: [f64; 8], b: &[f64; 8]| std::array::from_fn(|i| if b[i] < a[i] { b[i] } else { a[i] });
        let lanes = distances.as_chunks().0.iter().fold([f64::INFINITY; 8], lesser);
        let least = lanes.into_iter().fold(f64::INFINITY, f64::min);
        if least > best.0 {
            return best;
        }
        // The points of a leaf are sorted by number: the first of equals is the lowest.
        let position = leaf * LEAF + distances.iter().position(|&d| d == least).unwrap_or(0);
        let found = (least, self.first[position], position);
        if found < best { found } else { best }
    }

    #[inline(always)]
    fn neighbor(&self, position: usize, distance_squared: f64) -> Neighbor {
        Neighbor {
            index: self.first[position] as usize,
            distance_squared,
            multiplicity: self.points_at(position).len(),
        }
    }
}

/// The lowest point index of each distinct place, ascending, and the place of each point.
fn distinct_places(points: &[DVec3], watch: &dyn Watch) -> Result<(Vec<u32>, Vec<u32>), Cancelled> {
    let mask = (2 * points.len()).next_power_of_two() - 1;
    // A hash table: each place is in the first slot from its hash on that was free.
    let mut table = vec![u32::MAX; mask + 1];
    let (mut lowest, mut place_of) = (Vec::<u32>::new(), Vec::with_capacity(points.len()));
    for (i, &p) in (0..).zip(points) {
        if i % PIECE == 0 {
            watch.go_on()?;
        }
        // Adding zero turns -0.0 into 0.0, so that equal coordinates have equal bits.
        let mut slot = (p + 0.0).to_array().iter().fold(0, |hash, x| {
            let mixed = (hash ^ x.to_bits()).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            mixed ^ (mixed >> 32)
        }) as usize;
        while (lowest.get(table[slot & mask] as usize)).is_some_and(|&i| points[i as usize] != p) {
            slot = slot.wrapping_add(1);
        }
        let place = &mut table[slot & mask];
        if *place == u32::MAX {
            *place = lowest.len() as u32;
            lowest.push(i);
        }
        place_of.push(*place);
    }
    Ok((lowest, place_of))
}

/// [`Neighbors::nearest_of_each`] by the widest vector instructions that this machine has.
struct NearestOfEach<'a> {
    index: &'a Neighbors,
    queries: &'a [DVec3],
}

impl pulp::WithSimd for NearestOfEach<'_> {
    type Output = Vec<Neighbor>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Neighbor> {
        let mut all = Vec::with_capacity(self.queries.len());
        let mut search = BatchSearch::new(self.index, simd);
        let mut result = BlockResult::default();
        for queries in self.queries.chunks(BLOCK) {
            let column = |e: usize| std::array::from_fn(|i| queries[i.min(queries.len() - 1)][e]);
            let columns = [column(0), column(1), column(2)];
            search.find(&columns, queries.len(), &mut result);
            let found = result.position.iter().zip(&result.distance_squared);
            let neighbor = |(&position, &squared)| self.index.neighbor(position as usize, squared);
            all.extend(found.take(queries.len()).map(neighbor));
        }
        all
    }
}
