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
mod places;
mod tree;

use glam::DVec3;
use pulp::{Scalar, Simd};

use block::{BLOCK, Block, Double};
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
        let (distance_squared, position) = self.nearest_from::<Scalar>(self.tree.descend(query), query);
        self.neighbor(position, distance_squared)
    }

    /// The squared distance and the position of the nearest place, from a leaf that holds places nearby.
    #[inline(always)]
    fn nearest_from<S: Simd>(&self, start: usize, query: DVec3) -> (f64, usize) {
        // The first place there stands in where every distance overflows.
        let mut best = (f64::INFINITY, start * LEAF);
        self.look_into(start, query, &mut best);
        let in_frame = self.tree.in_frame(query).as_vec3();
        let mut reach = self.tree.reach_squared(in_frame, best.0);
        let mut walk = self.tree.walk(in_frame);
        while let Some(leaf) = walk.next::<S>(&self.tree, reach) {
            if leaf != start {
                self.look_into(leaf, query, &mut best);
                reach = self.tree.reach_squared(in_frame, best.0);
            }
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
        let position = leaf * LEAF + equal.trailing_zeros() as usize;
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
        let column = |e: usize| queries.iter().map(|q| q[e]).collect::<Vec<f64>>();
        let columns = [column(0), column(1), column(2)];
        let found = self.nearest_of_columns(columns.each_ref().map(Vec::as_slice));
        let each = found.position.iter().zip(&found.distance_squared);
        each.map(|(&position, &d)| self.neighbor(position as usize, d))
            .collect()
    }

    /// [`Neighbors::nearest_of_each`] of queries that are given coordinate by coordinate, all as many.
    pub(crate) fn nearest_of_columns(&self, queries: [&[f64]; 3]) -> NearestPlaces {
        // The widest vector instructions that this machine has. What depends on how they round is only
        // which leaves are looked into, never an answer.
        pulp::Arch::new().dispatch(Nearest { index: self, queries })
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

/// How many queries of a block the next one starts from.
const SEEDS: usize = 3;

/// What is nearest to each of many queries.
#[derive(Debug, Default)]
pub(crate) struct NearestPlaces {
    /// The place's position in the tree's order.
    pub(crate) position: Vec<u32>,
    /// Its squared distance, in the square of the points' unit.
    pub(crate) distance_squared: Vec<f64>,
}

/// [`Neighbors::nearest_of_columns`] as what can be built once for each kind of vector instructions:
/// all that it calls in its loops is inlined into it.
struct NearestOfEach<'a, S> {
    simd: S,
    index: &'a Neighbors,
    queries: [&'a [f64]; 3],
}

/// The same, before it is known which instructions there are.
struct Nearest<'a> {
    index: &'a Neighbors,
    queries: [&'a [f64]; 3],
}

impl pulp::WithSimd for Nearest<'_> {
    type Output = NearestPlaces;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { index, queries } = self;
        simd.vectorize(NearestOfEach { simd, index, queries })
    }
}

impl<S: Simd> pulp::NullaryFnOnce for NearestOfEach<'_, S> {
    type Output = NearestPlaces;

    #[inline(always)]
    fn call(self) -> NearestPlaces {
        let (index, tree) = (self.index, &self.index.tree);
        let count = self.queries[0].len();
        let mut found = NearestPlaces {
            position: vec![0; count],
            distance_squared: vec![0.0; count],
        };
        let mut start = [usize::MAX; SEEDS];
        let mut block = Block::empty();
        for from in (0..count).step_by(BLOCK) {
            let size = BLOCK.min(count - from);
            let queries = self.block(from, size);
            let query = |i: usize| DVec3::new(queries[0][i], queries[1][i], queries[2][i]);
            let positions = &mut found.position[from..from + size];
            let distances = &mut found.distance_squared[from..from + size];
            if start[0] == usize::MAX {
                start = [tree.descend(query(0)); SEEDS];
            }
            if !block.begin(tree, &queries, start[0]) {
                for i in 0..size {
                    let (distance, position) = index.nearest_from::<S>(tree.descend(query(i)), query(i));
                    (positions[i], distances[i]) = (position as u32, distance);
                }
                continue;
            }
            // Where the queries before these found theirs, so that hardly anything else is in reach.
            for (i, &leaf) in start.iter().enumerate() {
                if !start[..i].contains(&leaf) {
                    block.look_into::<S>(tree, leaf);
                }
            }
            block.update_reach();
            let mut walk = tree.walk(block.center());
            while let Some(leaf) = walk.next::<S>(tree, block.center_reach_squared()) {
                if !start.contains(&leaf)
                    && block.may_find_in::<S>(tree, leaf)
                    && block.look_into::<S>(tree, leaf)
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
                (positions[i], distances[i]) = (position as u32, distance);
            }
            for s in 0..SEEDS {
                start[s] = block.found(s * (BLOCK - 1) / (SEEDS - 1)).0;
            }
        }
        found
    }
}

impl<S> NearestOfEach<'_, S> {
    /// The queries of a block; a short one is filled up with its last.
    #[inline(always)]
    fn block(&self, from: usize, size: usize) -> [Double; 3] {
        let mut block = [[0.0; BLOCK]; 3];
        for e in 0..3 {
            let column = &self.queries[e][from..from + size];
            if let Ok(whole) = <&Double>::try_from(column) {
                block[e] = *whole;
            } else {
                block[e] = [column[size - 1]; BLOCK];
                block[e][..size].copy_from_slice(column);
            }
        }
        block
    }
}
