//! Nearest neighbors, exact.
//!
//! The tree is our own, since what the method asks is unusual: points mirrored away from a surface
//! are far from it and nearly as far from much of it, and each asks for almost what the one before
//! it asked for. See `boxes.rs` for the first, [`Hint`] for the second.

mod boxes;
mod places;
mod tree;

use std::num::NonZeroUsize;

use glam::DVec3;

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

/// Where the last query was answered. A query near it starts there and is answered sooner, and the
/// same.
#[derive(Debug, Clone, Copy, Default)]
pub struct Hint {
    leaf: Option<usize>,
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
        self.nearest_from(query, &mut Hint::default())
    }

    /// [`Neighbors::nearest`], starting at the answer to an earlier query to the same index, and
    /// leaving this one's answer for the next.
    #[inline(always)]
    pub fn nearest_from(&self, query: DVec3, hint: &mut Hint) -> Neighbor {
        let start = hint.leaf.unwrap_or_else(|| self.tree.descend(query));
        // The first place of all stands in where every distance overflows.
        let mut best = (f64::INFINITY, start * LEAF);
        self.look_into(start, query, &mut best);
        self.tree.walk(query, best.0, |leaf| {
            if leaf != start {
                self.look_into(leaf, query, &mut best);
            }
            best.0
        });
        hint.leaf = Some(best.1 / LEAF);
        self.neighbor(best.1, best.0)
    }

    #[inline(always)]
    fn look_into(&self, leaf: usize, query: DVec3, best: &mut (f64, usize)) {
        let distances = self.tree.leaf_distances_squared(leaf, query);
        // Pairwise rather than in a row, so that the lanes need not wait for each other.
        let mut least = distances;
        for width in [8, 4, 2, 1] {
            for i in 0..width {
                least[i] = if least[i + width] < least[i] { least[i + width] } else { least[i] };
            }
        }
        if least[0] > best.0 {
            return;
        }
        for position in self.tree.positions(leaf) {
            let d = distances[position % LEAF];
            if d == least[0] && (d < best.0 || self.first[position] < self.first[best.1]) {
                *best = (d, position);
            }
        }
    }

    /// The places nearest to `query` that together hold at least `count` points (all of them where
    /// there are fewer), nearest first, of those as near the one of the lowest index first. The last
    /// place may hold more points than are still wanted.
    pub fn nearest_places(&self, query: DVec3, count: NonZeroUsize) -> Vec<Neighbor> {
        let start = self.tree.descend(query);
        let mut found = Vec::new();
        self.gather(query, count, start, &mut found);
        found.iter().map(|&(d, position)| self.neighbor(position as usize, d)).collect()
    }

    /// The distances and positions in the tree's order of the nearest places, into `found`.
    /// `start` is a leaf nearby.
    #[inline(always)]
    fn gather(&self, query: DVec3, count: NonZeroUsize, start: usize, found: &mut Vec<(f64, u32)>) {
        let count = count.get().min(self.tree.len());
        // Some places nearby, whose count-th bounds the search.
        found.clear();
        let whole = count.next_multiple_of(LEAF).div_ceil(LEAF).next_power_of_two();
        let leaves = self.tree.len().div_ceil(LEAF);
        let from = (start / whole * whole).min(leaves.saturating_sub(whole));
        for leaf in from..(from + whole).min(leaves) {
            self.collect(leaf, query, f64::INFINITY, found);
        }
        let (_, &mut (limit, _), _) = found.select_nth_unstable_by(count - 1, |a, b| a.0.total_cmp(&b.0));
        found.clear();
        self.tree.walk(query, limit, |leaf| {
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
        let mut wanted = count;
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
