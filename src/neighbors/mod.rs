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

mod around;
mod block;
mod boxes;
mod eigen;
mod gaps;
mod lanes;
mod leaf;
mod order;
mod places;
mod together;
mod tree;
mod walk;

use glam::DVec3;
use pulp::{Scalar, Simd};

pub(crate) use eigen::symmetric_eigen;
pub(crate) use lanes::BLOCK;
use leaf::LEAF;
use places::distinct_places;
pub(crate) use together::{Nearest, Together};
use tree::Tree;
use walk::Walk;

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
        let (mut first, place_of) = distinct_places(points);
        if first.len() == points.len() {
            let (tree, order) = Tree::new(points);
            let start = (0..=points.len() as u32).collect();
            return Some(Self {
                tree,
                first: order.clone(),
                start,
                order,
            });
        }
        let places: Vec<DVec3> = first.iter().map(|&i| points[i as usize]).collect();
        let (tree, places_in_order) = Tree::new(&places);
        let mut position = vec![0; places.len()];
        for (i, &place) in places_in_order.iter().enumerate() {
            position[place as usize] = i as u32;
        }
        let mut start = vec![0; places.len() + 1];
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
        first = places_in_order
            .iter()
            .map(|&place| first[place as usize])
            .collect();
        Some(Self {
            tree,
            first,
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
        let start = self.tree.descend(self.tree.in_frame(query).to_array());
        let (distance_squared, position) = self.nearest_from::<Scalar>(start, query);
        self.neighbor(position, distance_squared)
    }

    /// The squared distance and the position of the nearest place, from a leaf that holds places nearby.
    #[inline(always)]
    fn nearest_from<S: Simd>(&self, start: usize, query: DVec3) -> (f64, usize) {
        // The first place there stands in where every distance overflows.
        let mut best = (f64::INFINITY, self.tree.positions(start).start);
        self.look_into(start, query, &mut best);
        let (from, mut reach) = self.tree.single(self.tree.in_frame(query).to_array(), best.0);
        let mut walk = Walk::new();
        walk.begin(&self.tree, from);
        while let Some((leaf, _)) = walk.next::<S, true>(&self.tree, reach) {
            if leaf != start {
                self.look_into(leaf, query, &mut best);
                reach = self.tree.reach(from.reference, best.0);
            }
        }
        best
    }

    /// The same where it is known to be in one of `leaves`.
    #[inline(always)]
    fn nearest_in(&self, leaves: impl Iterator<Item = usize>, query: DVec3) -> (f64, usize) {
        let mut best = (f64::INFINITY, 0);
        for leaf in leaves {
            if best.0 == f64::INFINITY {
                best.1 = self.tree.positions(leaf).start;
            }
            self.look_into(leaf, query, &mut best);
        }
        best
    }

    #[inline(always)]
    fn look_into(&self, leaf: usize, query: DVec3, best: &mut (f64, usize)) {
        let distances = self.tree.leaf_distances_squared(leaf, query);
        // Halved again and again, as vectors can.
        let mut least = distances;
        let mut half = LEAF / 2;
        while half > 0 {
            for i in 0..half {
                let (a, b) = (least[i], least[i + half]);
                least[i] = if b < a { b } else { a };
            }
            half /= 2;
        }
        let least = least[0];
        let mut equal = 0u32;
        for i in 0..LEAF {
            equal |= u32::from(distances[i] == least) << i;
        }
        // The first of equals is the lowest. Where all overflow none may be equal, or one that is
        // left over.
        let position = self.tree.positions(leaf).start + equal.trailing_zeros() as usize;
        if least < best.0
            || (least == best.0 && least < f64::INFINITY && self.first[position] < self.first[best.1])
        {
            *best = (least, position);
        }
    }

    /// [`Neighbors::nearest`] of each query, in their order. Queries that lie close to those before
    /// them, as points in [`Neighbors::order`] do, are answered several times sooner than one by one:
    /// they walk through the tree together.
    pub fn nearest_of_each(&self, queries: &[DVec3]) -> Vec<Neighbor> {
        pulp::Arch::new().dispatch(NearestOfEach { index: self, queries })
    }

    /// The lowest index of the points at each position of the tree's order.
    pub(crate) fn first(&self) -> &[u32] {
        &self.first
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
        let mut together = Together::new(self.index, simd);
        let mut nearest = Nearest::NONE;
        for queries in self.queries.chunks(BLOCK) {
            let mut columns = [[0.0; BLOCK]; 3];
            for i in 0..BLOCK {
                let query = queries[i.min(queries.len() - 1)];
                for e in 0..3 {
                    columns[e][i] = query[e];
                }
            }
            together.answer(&columns, queries.len(), &mut nearest);
            for i in 0..queries.len() {
                let (position, distance) = (nearest.position[i] as usize, nearest.distance_squared[i]);
                all.push(self.index.neighbor(position, distance));
            }
        }
        all
    }
}
