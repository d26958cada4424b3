//! The order of points in a tree: each leaf's and each node's lie close together, and so do those
//! that follow one another.

use glam::{DVec3, Vec3};

use super::tree::LEAF;
use crate::geometry::parallel::join;

/// Points below which sorting is not worth another core.
const ALONE: usize = 512;

/// What is so much smaller than it is far away is seen from itself.
const SMALL: f32 = 1.0 / 1024.0;

/// A point and its number before sorting.
#[derive(Debug, Clone, Copy)]
struct Item {
    at: Vec3,
    number: u32,
}

/// The numbers of `count` points in the tree's order.
pub(super) fn in_order(count: usize, point: &(impl Fn(u32) -> DVec3 + Sync)) -> Vec<u32> {
    let items = (0..count as u32).map(|number| Item {
        at: point(number).as_vec3(),
        number,
    });
    let mut items: Vec<Item> = items.collect();
    if count > 0 {
        let from = extent(&items).0;
        sort(&mut items, from, DVec3::ZERO, point);
    }
    items.iter().map(|item| item.number).collect()
}

/// Halves along the longest side, again and again, so that each leaf and each sixteen of them lie
/// close together. The first half is a power of two of leaves, and so every node is full but the last.
/// Of both halves the one nearer to `from` comes first, so that what follows one another lies close
/// together as well. The items are seen from `origin`.
fn sort(items: &mut [Item], mut from: Vec3, mut origin: DVec3, point: &(impl Fn(u32) -> DVec3 + Sync)) {
    let leaves = items.len().div_ceil(LEAF);
    if leaves < 2 {
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
    let half = leaves.next_power_of_two() / 2 * LEAF;
    let middle = 0.5 * (low + high);
    if from[axis] > middle[axis] {
        items.select_nth_unstable_by(half, |a, b| b.at[axis].total_cmp(&a.at[axis]));
    } else {
        items.select_nth_unstable_by(half, |a, b| a.at[axis].total_cmp(&b.at[axis]));
    }
    let (left, right) = items.split_at_mut(half);
    if leaves * LEAF < ALONE {
        let last = left[half - 1].at;
        sort(left, from, origin, point);
        sort(right, last, origin, point);
    } else {
        // Across, and at the other end sideways, is about where the first half ends.
        let mut last = low + high - from;
        last[axis] = middle[axis];
        join(
            || sort(left, from, origin, point),
            || sort(right, last, origin, point),
        );
    }
}

fn extent(items: &[Item]) -> (Vec3, Vec3) {
    let first = items[0].at;
    items.iter().fold((first, first), |(low, high), item| {
        (low.min(item.at), high.max(item.at))
    })
}
