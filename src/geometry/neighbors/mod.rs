//! Nearest neighbors, exact.
//!
//! The tree is our own, since what the method asks is unusual: points mirrored away from a surface
//! are far from it and nearly as far from much of it, and each asks for almost what the one before
//! it asked for. See `boxes.rs` for the first, [`Neighbors::nearest_of_each`] for the second.

#![allow(
    clippy::inline_always,
    reason = "only what is inlined is built for each kind of vector instructions"
)]
#![allow(
    clippy::needless_range_loop,
    reason = "loops over lanes, of several arrays at a time"
)]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "where rounding left no number, a box must be looked into"
)]

mod boxes;
mod places;
mod tree;

use std::num::NonZeroUsize;

use glam::{DVec3, Vec3};

use places::distinct_places;
use tree::{Item, LEAF, Tree};

/// One place in space and the points that lie exactly there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbor {
    /// The lowest index of the points at this place.
    pub index: usize,
    /// The squared distance from the query, in the square of the points' unit.
    pub distance_squared: f64,
    /// How many points lie exactly here.
    pub multiplicity: usize,
}

/// Queries that walk through the tree together.
const BLOCK: usize = 16;

/// An index of points for exact nearest-neighbor queries.
///
/// Exact duplicates are stored once with their number, since no box can tell them apart, and depth
/// cameras make many. The answers count each of them.
pub struct Neighbors {
    tree: Tree,
    /// For each place, in the tree's order, its lowest point index.
    first: Vec<u32>,
    /// For each place, where its points start in `order`; then the number of points.
    start: Vec<u32>,
    /// All points, place by place.
    order: Vec<u32>,
}

impl std::fmt::Debug for Neighbors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Neighbors")
            .field("places", &self.first.len())
            .finish_non_exhaustive()
    }
}

impl Neighbors {
    /// Indexes `points`, which must be finite. `None` where there are none, or more than
    /// [`u32::MAX`] of them.
    pub fn new(points: &[DVec3]) -> Option<Self> {
        if points.is_empty() || u32::try_from(points.len()).is_err() {
            return None;
        }
        let (firsts, place_of) = distinct_places(points);
        let mut items: Vec<Item> = firsts
            .iter()
            .enumerate()
            .map(|(place, &first)| Item {
                at: points[first as usize],
                id: place as u32,
            })
            .collect();
        let tree = Tree::new(&mut items);
        let mut position = vec![0; items.len()];
        for (i, item) in items.iter().enumerate() {
            position[item.id as usize] = i as u32;
        }
        let mut start = vec![0; items.len() + 1];
        for &place in &place_of {
            start[position[place as usize] as usize + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut next = start.clone();
        let mut order = vec![0; points.len()];
        for (i, &place) in place_of.iter().enumerate() {
            let slot = &mut next[position[place as usize] as usize];
            order[*slot as usize] = i as u32;
            *slot += 1;
        }
        Some(Self {
            tree,
            first: items.iter().map(|item| firsts[item.id as usize]).collect(),
            start,
            order,
        })
    }

    /// How many distinct places the points occupy.
    pub fn distinct(&self) -> usize {
        self.first.len()
    }

    /// The indices of all points in an order in which each lies close to the one before it.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The place nearest to `query`, which must be finite; of several as near the one of the lowest
    /// index.
    pub fn nearest(&self, query: DVec3) -> Neighbor {
        let start = self.tree.descend(query);
        // The first place there stands in where every distance overflows.
        let mut best = (f64::INFINITY, start * LEAF);
        self.look_into(start, query, &mut best);
        self.tree.walk(query, best.0, |leaf, _| {
            if leaf != start {
                self.look_into(leaf, query, &mut best);
            }
            best.0
        });
        self.neighbor(best.1, best.0)
    }

    #[inline(always)]
    fn look_into(&self, leaf: usize, query: DVec3, best: &mut (f64, usize)) {
        let distances = self.tree.leaf_distances_squared(leaf, query);
        for position in self.tree.positions(leaf) {
            let d = distances[position % LEAF];
            if d < best.0 || (d == best.0 && self.first[position] < self.first[best.1]) {
                *best = (d, position);
            }
        }
    }

    /// [`Neighbors::nearest`] of each query, in their order. Queries that lie close to those before
    /// them, as points in [`Neighbors::order`] do, are answered several times sooner than one by one:
    /// they walk through the tree together.
    pub fn nearest_of_each(&self, queries: &[DVec3]) -> Vec<Neighbor> {
        // The widest vector instructions that this machine has. They round like all others, and
        // nothing is contracted, so that the answers are the same everywhere.
        pulp::Arch::new().dispatch(NearestOfEach { index: self, queries })
    }

    /// The places nearest to `query` that together hold at least `count` points (all of them where
    /// there are fewer), nearest first, of those as near the one of the lowest index first. The last
    /// place may hold more points than are still wanted.
    pub fn nearest_places(&self, query: DVec3, count: NonZeroUsize) -> Vec<Neighbor> {
        let start = self.tree.descend(query);
        let mut found = Vec::new();
        self.gather(query, count, start, &mut found);
        found
            .iter()
            .map(|&(d, position)| self.neighbor(position as usize, d))
            .collect()
    }

    /// The distances and positions in the tree's order of the nearest places, into `found`.
    /// `start` is a leaf nearby.
    #[inline(always)]
    fn gather(&self, query: DVec3, count: NonZeroUsize, start: usize, found: &mut Vec<(f64, u32)>) {
        let mut wanted = count.get();
        let count = wanted.min(self.tree.len());
        // Some places nearby, whose count-th bounds the search.
        found.clear();
        // One leaf more than they fill, since the last may be short.
        let window = count.div_ceil(LEAF) + 1;
        let leaves = self.tree.len().div_ceil(LEAF);
        let from = start
            .saturating_sub(window / 2)
            .min(leaves.saturating_sub(window));
        for leaf in from..(from + window).min(leaves) {
            self.collect(leaf, query, f64::INFINITY, found);
        }
        let (_, &mut (limit, _), _) = found.select_nth_unstable_by(count - 1, |a, b| a.0.total_cmp(&b.0));
        found.clear();
        self.tree.walk(query, limit, |leaf, _| {
            self.collect(leaf, query, limit, found);
            limit
        });
        let by_distance = |a: &(f64, u32), b: &(f64, u32)| {
            (a.0.total_cmp(&b.0)).then_with(|| self.first[a.1 as usize].cmp(&self.first[b.1 as usize]))
        };
        if found.len() > count {
            found.select_nth_unstable_by(count - 1, by_distance);
            found.truncate(count);
        }
        found.sort_unstable_by(by_distance);
        let enough = found.iter().position(|&(_, position)| {
            let here = self.multiplicity(position as usize);
            let last = here >= wanted;
            wanted = wanted.saturating_sub(here);
            last
        });
        found.truncate(enough.map_or(found.len(), |last| last + 1));
    }

    #[inline(always)]
    fn collect(&self, leaf: usize, query: DVec3, limit: f64, found: &mut Vec<(f64, u32)>) {
        let distances = self.tree.leaf_distances_squared(leaf, query);
        for position in self.tree.positions(leaf) {
            let d = distances[position % LEAF];
            if d <= limit {
                found.push((d, position as u32));
            }
        }
    }

    fn multiplicity(&self, position: usize) -> usize {
        (self.start[position + 1] - self.start[position]) as usize
    }

    #[inline(always)]
    fn neighbor(&self, position: usize, distance_squared: f64) -> Neighbor {
        Neighbor {
            index: self.first[position] as usize,
            distance_squared,
            multiplicity: self.multiplicity(position),
        }
    }
}

/// [`Neighbors::nearest_of_each`] as what can be built once for each kind of vector instructions:
/// all that it calls in its loops is inlined into it.
struct NearestOfEach<'a> {
    index: &'a Neighbors,
    queries: &'a [DVec3],
}

impl pulp::NullaryFnOnce for NearestOfEach<'_> {
    type Output = Vec<Neighbor>;

    #[inline(always)]
    fn call(self) -> Vec<Neighbor> {
        let (index, tree) = (self.index, &self.index.tree);
        let mut found = Vec::with_capacity(self.queries.len());
        let mut near = Vec::new();
        let mut start = None;
        for queries in self.queries.chunks(BLOCK) {
            let center = queries.iter().sum::<DVec3>() / queries.len() as f64;
            let first = start.unwrap_or_else(|| tree.descend(center));
            let mut block = Block::new(index, queries, first);
            block.look_into(index, first);
            let limit_squared = block.limit_squared(queries, center);
            near.clear();
            tree.walk(center, limit_squared, |leaf, distance| {
                near.push((distance, leaf));
                limit_squared
            });
            // The nearest first, so that most of the others need not be looked into.
            near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for &(_, leaf) in &near {
                if leaf != first && tree.any_within(leaf, &block.in_frame, &block.reach_squared) {
                    block.look_into(index, leaf);
                }
            }
            start = Some(block.position[0] / LEAF);
            for i in 0..queries.len() {
                found.push(index.neighbor(block.position[i], block.best[i]));
            }
        }
        found
    }
}

/// Queries that walk through the tree together, and what they have found so far.
struct Block {
    queries: [[f64; BLOCK]; 3],
    /// The queries in the boxes' frame.
    in_frame: [[f32; BLOCK]; 3],
    /// How far, in that frame, a box may be from a query and hold something nearer.
    reach_squared: [f32; BLOCK],
    /// The squared distances of what is nearest so far.
    best: [f64; BLOCK],
    /// Where that stands in the tree's order.
    position: [usize; BLOCK],
}

impl Block {
    /// A short block is filled up with its last query. The first place of leaf `first` stands in
    /// where every distance overflows.
    #[inline(always)]
    fn new(index: &Neighbors, queries: &[DVec3], first: usize) -> Self {
        let mut block = Self {
            queries: [[0.0; BLOCK]; 3],
            in_frame: [[0.0; BLOCK]; 3],
            reach_squared: [f32::INFINITY; BLOCK],
            best: [f64::INFINITY; BLOCK],
            position: [first * LEAF; BLOCK],
        };
        for i in 0..BLOCK {
            let query = queries[i.min(queries.len() - 1)];
            let in_frame = index.tree.in_frame(query);
            for e in 0..3 {
                block.queries[e][i] = query[e];
                block.in_frame[e][i] = in_frame[e];
            }
        }
        block
    }

    #[inline(always)]
    fn look_into(&mut self, index: &Neighbors, leaf: usize) {
        let (least, which) = index.tree.nearest_in_leaf(leaf, &self.queries);
        for i in 0..BLOCK {
            if least[i] > self.best[i] || least[i] == f64::INFINITY {
                continue;
            }
            let there = leaf * LEAF + which[i] as usize;
            if least[i] < self.best[i] || index.first[there] < index.first[self.position[i]] {
                (self.best[i], self.position[i]) = (least[i], there);
                let in_frame = Vec3::from_array(self.in_frame.map(|c| c[i]));
                self.reach_squared[i] = index.tree.reach_squared(in_frame, least[i]);
            }
        }
    }

    /// How far from `center` something nearer to any of the queries may be, squared.
    #[inline(always)]
    fn limit_squared(&self, queries: &[DVec3], center: DVec3) -> f64 {
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        let radius_squared = queries
            .iter()
            .fold(0.0, |a, q| larger(a, center.distance_squared(*q)));
        let best = self.best.iter().fold(0.0, |a, &b| larger(a, b));
        // A hair more than it is, against rounding.
        let limit = (best.sqrt() + radius_squared.sqrt()) * (1.0 + 1e-12);
        limit * limit
    }
}
