//! The k nearest places of a point.

use std::num::NonZeroUsize;

use glam::DVec3;
use pulp::Scalar;

use super::traversal::Traversal;
use super::tree::LEAF;
use super::{Neighbor, Neighbors};

impl Neighbors {
    /// The places nearest to `query` that together hold at least `count` points (all of them where
    /// there are fewer), nearest first, of those as near the one of the lowest index first. The last
    /// place may hold more points than are still wanted.
    pub fn nearest_places(&self, query: DVec3, count: NonZeroUsize) -> Vec<Neighbor> {
        let mut found = Vec::new();
        self.gather(query, count, self.tree.descend(&query.to_array()), &mut found);
        self.put_in_order(count, &mut found);
        let neighbor = |&(squared, position): &(f64, u32)| self.neighbor(position as usize, squared);
        found.iter().map(neighbor).collect()
    }

    /// The positions of the places that [`Neighbors::nearest_places`] finds around the place at a position of
    /// the tree's order, in no order where no place holds more than one point.
    #[inline(always)]
    pub(crate) fn around(&self, position: usize, count: NonZeroUsize, found: &mut Vec<(f64, u32)>) {
        self.gather(self.tree.point(position), count, position / LEAF, found);
        if self.first.len() < self.order.len() {
            self.put_in_order(count, found);
        }
    }

    /// The points at a position of the tree's order, by index.
    pub(crate) fn points_at(&self, position: usize) -> &[u32] {
        &self.order[self.start[position] as usize..self.start[position + 1] as usize]
    }

    /// Finds the squared distances and positions of the `count` nearest places. `start` is a leaf nearby.
    #[inline(always)]
    fn gather(&self, query: DVec3, count: NonZeroUsize, start: usize, found: &mut Vec<(f64, u32)>) {
        let (tree, count) = (&self.tree, count.get().min(self.tree.len));
        // The count-th nearest in some leaves nearby bounds the search. One leaf more than it takes, since the
        // last one may be short.
        found.clear();
        let (window, leaves) = (count.div_ceil(LEAF) + 1, tree.leaves.len());
        let from = (start.saturating_sub(window / 2)).min(leaves.saturating_sub(window));
        for leaf in from..(from + window).min(leaves) {
            self.collect(leaf, query, f64::INFINITY, found);
        }
        let (_, &mut (limit, _), _) = found.select_nth_unstable_by(count - 1, |a, b| a.0.total_cmp(&b.0));
        found.clear();
        let mut traversal = Traversal::new(tree, query.to_array(), limit);
        while let Some((leaf, _)) = traversal.next::<Scalar>(tree, 0.0) {
            self.collect(leaf, query, limit, found);
        }
        if found.len() > count {
            found.select_nth_unstable_by(count - 1, |a, b| self.by_distance(a, b));
            found.truncate(count);
        }
    }

    /// Puts the nearest first, and drops those at the end that are not needed for so many points.
    fn put_in_order(&self, count: NonZeroUsize, found: &mut Vec<(f64, u32)>) {
        found.sort_unstable_by(|a, b| self.by_distance(a, b));
        let mut wanted = count.get();
        let enough = found.iter().position(|&(_, position)| {
            let here = self.points_at(position as usize).len();
            let last = here >= wanted;
            wanted = wanted.saturating_sub(here);
            last
        });
        found.truncate(enough.map_or(found.len(), |last| last + 1));
    }

    fn by_distance(&self, a: &(f64, u32), b: &(f64, u32)) -> std::cmp::Ordering {
        (a.0.total_cmp(&b.0)).then_with(|| self.first[a.1 as usize].cmp(&self.first[b.1 as usize]))
    }

    #[inline(always)]
    fn collect(&self, leaf: usize, query: DVec3, limit: f64, found: &mut Vec<(f64, u32)>) {
        let distances = self.tree.distances_squared(leaf, query);
        for (position, &squared) in self.tree.positions(leaf).zip(&distances) {
            if squared <= limit {
                found.push((squared, position as u32));
            }
        }
    }
}
