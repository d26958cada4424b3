//! The places around a point: its k nearest neighbors.

use std::num::NonZeroUsize;

use glam::DVec3;
use pulp::Scalar;

use super::leaf::LEAF;
use super::walk::Walk;
use super::{Neighbor, Neighbors};

impl Neighbors {
    /// The places nearest to `query` that together hold at least `count` points (all of them where
    /// there are fewer), nearest first, of those as near the one of the lowest index first. The last
    /// place may hold more points than are still wanted.
    pub fn nearest_places(&self, query: DVec3, count: NonZeroUsize) -> Vec<Neighbor> {
        let start = self.tree.descend(self.tree.in_frame(query).to_array());
        let mut found = Vec::new();
        self.gather(query, count, start, &mut found);
        self.put_in_order(count, &mut found);
        found
            .iter()
            .map(|&(d, position)| self.neighbor(position as usize, d))
            .collect()
    }

    /// As [`Neighbors::nearest_places`], around the place at a position of the tree's order: squared
    /// distances and positions, in no order where no place holds more than one point.
    #[inline(always)]
    pub(crate) fn around(&self, position: usize, count: NonZeroUsize, found: &mut Vec<(f64, u32)>) {
        let (leaf, place) = self.tree.leaf_at(position);
        let query = self.tree.place(leaf, place);
        self.gather(query, count, leaf, found);
        if self.first.len() < self.order.len() {
            self.put_in_order(count, found);
        }
    }

    /// The points at a position of the tree's order, by index.
    pub(crate) fn points_at(&self, position: usize) -> &[u32] {
        &self.order[self.start[position] as usize..self.start[position + 1] as usize]
    }

    /// The distances and positions in the tree's order of `count` nearest places, into `found`.
    /// `start` is a leaf nearby.
    #[inline(always)]
    fn gather(&self, query: DVec3, count: NonZeroUsize, start: usize, found: &mut Vec<(f64, u32)>) {
        let count = count.get().min(self.tree.len());
        // Some places nearby, whose count-th bounds the search.
        found.clear();
        // One leaf more than they fill, since leaves may be short.
        let window = count.div_ceil(LEAF) + 1;
        let leaves = self.tree.leaves();
        let mut from = start
            .saturating_sub(window / 2)
            .min(leaves.saturating_sub(window));
        let mut to = (from + window).min(leaves);
        for leaf in from..to {
            self.collect(leaf, query, f64::INFINITY, found);
        }
        while found.len() < count {
            if to < leaves {
                self.collect(to, query, f64::INFINITY, found);
                to += 1;
            } else {
                from -= 1;
                self.collect(from, query, f64::INFINITY, found);
            }
        }
        let (_, &mut (limit, _), _) = found.select_nth_unstable_by(count - 1, |a, b| a.0.total_cmp(&b.0));
        found.clear();
        let (from, reach) = self.tree.single(self.tree.in_frame(query).to_array(), limit);
        let mut walk = Walk::new();
        walk.begin(&self.tree, from);
        while let Some((leaf, _)) = walk.next::<Scalar, false>(&self.tree, reach) {
            self.collect(leaf, query, limit, found);
        }
        if found.len() > count {
            found.select_nth_unstable_by(count - 1, |a, b| self.by_distance(a, b));
            found.truncate(count);
        }
    }

    /// Nearest first; those at the end go that are not needed for so many points.
    fn put_in_order(&self, count: NonZeroUsize, found: &mut Vec<(f64, u32)>) {
        found.sort_unstable_by(|a, b| self.by_distance(a, b));
        let mut wanted = count.get();
        let enough = found.iter().position(|&(_, position)| {
            let here = self.multiplicity(position as usize);
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
        let distances = self.tree.leaf_distances_squared(leaf, query);
        for (position, &d) in self.tree.positions(leaf).zip(&distances) {
            if d <= limit {
                found.push((d, position as u32));
            }
        }
    }
}
