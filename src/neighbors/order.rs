//! The order of points in a tree: each leaf's and each node's lie close together, and so do those
//! that follow one another.

use glam::{DVec3, Vec3};

use super::gaps::half_at_gap;
use super::leaf::LEAF;
use crate::parallel::join;

/// Points below which sorting is not worth another core.
const ALONE: usize = 512;

/// What is so much smaller than it is far away is seen from itself.
const SMALL: f32 = 1.0 / 1024.0;

/// A point and its number before sorting.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub(super) at: Vec3,
    number: u32,
}

/// A cut of items in two along an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    pub(super) axis: usize,
    /// The items' extent along it.
    pub(super) low: f32,
    pub(super) high: f32,
    /// Whether the first half is the one that lies higher.
    pub(super) backward: bool,
    /// How many items are in the first half.
    pub(super) half: usize,
}

impl Cut {
    /// Puts the items of the first half before all others.
    fn make(&self, items: &mut [Item]) {
        let axis = self.axis;
        if self.backward {
            items.select_nth_unstable_by(self.half, |a, b| b.at[axis].total_cmp(&a.at[axis]));
        } else {
            items.select_nth_unstable_by(self.half, |a, b| a.at[axis].total_cmp(&b.at[axis]));
        }
    }
}

/// Points in the tree's order, leaf by leaf.
pub(super) struct Order {
    pub(super) numbers: Vec<u32>,
    /// Where in `numbers` each leaf's start; then how many there are.
    pub(super) starts: Vec<u32>,
}

/// The order of `count` points.
pub(super) fn in_order(count: usize, point: &(impl Fn(u32) -> DVec3 + Sync)) -> Order {
    let items = (0..count as u32).map(|number| Item {
        at: point(number).as_vec3(),
        number,
    });
    let mut items: Vec<Item> = items.collect();
    let mut sizes = Vec::with_capacity(count.div_ceil(LEAF));
    if count > 0 {
        let from = extent(&items).0;
        sort(&mut items, from, DVec3::ZERO, point, &mut sizes);
    }
    let mut starts = Vec::with_capacity(sizes.len() + 1);
    let mut start = 0;
    starts.push(start);
    for size in sizes {
        start += size;
        starts.push(start);
    }
    let numbers = items.iter().map(|item| item.number).collect();
    Order { numbers, starts }
}

/// Halves along the longest side, again and again, so that each leaf and each sixteen of them lie
/// close together. The first half is a power of two of leaves, and so every node is full but the last,
/// unless that cuts through a clump: then the cut is in a gap. Of both halves the one nearer to `from`
/// comes first, so that what follows one another lies close together as well. The items are seen from
/// `origin`. The leaves' sizes are added to `sizes`.
fn sort(
    items: &mut [Item],
    mut from: Vec3,
    mut origin: DVec3,
    point: &(impl Fn(u32) -> DVec3 + Sync),
    sizes: &mut Vec<u32>,
) {
    let leaves = items.len().div_ceil(LEAF);
    if leaves < 2 {
        sizes.push(items.len() as u32);
        return;
    }
    let (mut low, mut high) = extent(items);
    let away = low.abs().max(high.abs()).max_element();
    if (high - low).max_element() < away * SMALL {
        // A clump far from the origin, where single precision has few steps left: seen from itself.
        let middle = (0.5 * (low + high)).as_dvec3();
        origin += middle;
        for item in &mut *items {
            item.at = (point(item.number) - origin).as_vec3();
        }
        from = (from.as_dvec3() - middle).as_vec3();
        (low, high) = extent(items);
    }
    let axis = (high - low).max_position();
    let middle = 0.5 * (low + high);
    let mut cut = Cut {
        axis,
        low: low[axis],
        high: high[axis],
        backward: from[axis] > middle[axis],
        half: leaves.next_power_of_two() / 2 * LEAF,
    };
    cut.make(items);
    if let Some(half) = half_at_gap(items, &cut) {
        cut.half = half;
        cut.make(items);
    }
    let (left, right) = items.split_at_mut(cut.half);
    if leaves * LEAF < ALONE {
        let last = left[cut.half - 1].at;
        sort(left, from, origin, point, sizes);
        sort(right, last, origin, point, sizes);
    } else {
        // Across, and at the other end sideways, is about where the first half ends.
        let mut last = low + high - from;
        last[axis] = middle[axis];
        let mut right_sizes = Vec::new();
        join(
            || sort(left, from, origin, point, sizes),
            || sort(right, last, origin, point, &mut right_sizes),
        );
        sizes.append(&mut right_sizes);
    }
}

fn extent(items: &[Item]) -> (Vec3, Vec3) {
    let first = items[0].at;
    items.iter().fold((first, first), |(low, high), item| {
        (low.min(item.at), high.max(item.at))
    })
}
