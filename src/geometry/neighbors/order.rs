//! The order of points in a tree: each leaf's and each node's lie close together, and so do those
//! that follow one another.

use glam::Vec3;

use super::tree::LEAF;
use crate::geometry::parallel::join;

/// Points below which sorting is not worth another core.
const ALONE: usize = 512;

/// A point and its number before sorting.
#[derive(Debug, Clone, Copy)]
struct Item {
    at: Vec3,
    number: u32,
}

/// The points' numbers in the tree's order.
pub(super) fn in_order(points: impl Iterator<Item = Vec3>) -> Vec<u32> {
    let mut items: Vec<Item> = points.zip(0..).map(|(at, number)| Item { at, number }).collect();
    if let Some(from) = (!items.is_empty()).then(|| extent(&items).0) {
        sort(&mut items, from);
    }
    items.iter().map(|item| item.number).collect()
}

/// Halves along the longest side, again and again, so that each leaf and each sixteen of them lie
/// close together. The first half is a power of two of leaves, and so every node is full but the last.
/// Of both halves the one nearer to `from` comes first, so that what follows one another lies close
/// together as well.
fn sort(items: &mut [Item], from: Vec3) {
    let leaves = items.len().div_ceil(LEAF);
    if leaves < 2 {
        return;
    }
    let (low, high) = extent(items);
    let axis = (high - low).max_position();
    let half = leaves.next_power_of_two() / 2 * LEAF;
    let middle = 0.5 * (low + high);
    if from[axis] > middle[axis] {
        items.select_nth_unstable_by(half, |a, b| b.at[axis].total_cmp(&a.at[axis]));
    } else {
        items.select_nth_unstable_by(half, |a, b| a.at[axis].total_cmp(&b.at[axis]));
    }
    let (left, right) = items.split_at_mut(half);
    if leaves * LEAF < ALONE {
        sort(left, from);
        let last = left[half - 1].at;
        sort(right, last);
    } else {
        // Across, and at the other end sideways, is about where the first half ends.
        let mut last = low + high - from;
        last[axis] = middle[axis];
        join(|| sort(left, from), || sort(right, last));
    }
}

fn extent(items: &[Item]) -> (Vec3, Vec3) {
    let first = items[0].at;
    items.iter().fold((first, first), |(low, high), item| {
        (low.min(item.at), high.max(item.at))
    })
}
