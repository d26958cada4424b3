//! Nearest neighbors, exact. The only file that names the tree's library.

use std::num::NonZeroUsize;

use glam::DVec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};

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
/// Exact duplicates are stored once with their number: the tree's buckets slow down a thousandfold
/// on them, and depth cameras make many. The answers count each of them.
pub struct Neighbors {
    tree: ImmutableKdTree<f64, 3>,
    /// For each place in the tree: its lowest point index, and how many points lie there.
    places: Vec<(u32, u32)>,
}

impl std::fmt::Debug for Neighbors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Neighbors")
            .field("places", &self.places.len())
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
        // Adding zero turns -0.0 into 0.0, so that equal coordinates have equal bits.
        let key = |i: u32| (points[i as usize] + 0.0).to_array();
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        order.sort_unstable_by(|&a, &b| {
            let (p, q) = (key(a), key(b));
            p[0].total_cmp(&q[0])
                .then(p[1].total_cmp(&q[1]))
                .then(p[2].total_cmp(&q[2]))
                .then(a.cmp(&b))
        });
        let mut places: Vec<(u32, u32)> = order
            .chunk_by(|&a, &b| key(a) == key(b))
            .map(|same| (same[0], same.len() as u32))
            .collect();
        // In the points' own order, so that ties between places do not hang on the sort.
        places.sort_unstable();
        let coordinates: Vec<[f64; 3]> = places.iter().map(|&(first, _)| key(first)).collect();
        let tree = ImmutableKdTree::new_from_slice(&coordinates).ok()?;
        Some(Self { tree, places })
    }

    /// How many distinct places the points occupy.
    pub fn distinct(&self) -> usize {
        self.places.len()
    }

    /// The place nearest to `query`, which must be finite.
    pub fn nearest(&self, query: DVec3) -> Neighbor {
        let found = self
            .tree
            .query(&query.to_array())
            .nearest_one::<SquaredEuclidean<f64>>()
            .execute();
        self.neighbor(found.item, found.distance)
    }

    /// The places nearest to `query` that together hold at least `count` points (all of them where
    /// there are fewer), nearest first. The last place may hold more points than are still wanted.
    pub fn nearest_places(&self, query: DVec3, count: NonZeroUsize) -> Vec<Neighbor> {
        let mut wanted = count.get();
        let mut found: Vec<Neighbor> = self
            .tree
            .query(&query.to_array())
            .nearest_n::<SquaredEuclidean<f64>>(count)
            .execute()
            .into_iter()
            .map(|place| self.neighbor(place.item, place.distance))
            .collect();
        let enough = found
            .iter()
            .position(|n| {
                let last = n.multiplicity >= wanted;
                wanted = wanted.saturating_sub(n.multiplicity);
                last
            })
            .map_or(found.len(), |last| last + 1);
        found.truncate(enough);
        found
    }

    fn neighbor(&self, place: u32, distance_squared: f64) -> Neighbor {
        let (first, multiplicity) = self.places[place as usize];
        Neighbor {
            index: first as usize,
            distance_squared,
            multiplicity: multiplicity as usize,
        }
    }
}
