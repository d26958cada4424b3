//! The order of points in the tree: the points of each leaf and of each node lie close together, and
//! so do those that follow one another.

use glam::{DVec3, Vec3};

use super::leaf::LEAF;
use crate::parallel::join;

/// The number of points from which sorting is worth another core.
const PARALLEL: usize = 512;

/// Points whose extent is smaller than this part of their distance from the origin get an origin among
/// them: single precision has too few digits left to tell them apart.
const SMALL: f32 = 1.0 / 1024.0;

/// A point, seen from the current origin, and its number.
#[derive(Debug, Clone, Copy)]
struct Item {
    at: Vec3,
    number: u32,
}

/// The numbers of the points, in the tree's order.
pub(super) fn spatial_order(points: &[DVec3]) -> Vec<u32> {
    let items = (points.iter().zip(0..)).map(|(p, number)| Item {
        at: p.as_vec3(),
        number,
    });
    let mut items: Vec<Item> = items.collect();
    if !items.is_empty() {
        let from = extent(&items).0;
        sort(points, &mut items, from, DVec3::ZERO);
    }
    items.iter().map(|item| item.number).collect()
}

/// Halves the items, seen from `origin`, along their longest side, again and again. The first half is a
/// power of two of leaves, so that every leaf and node but the last is full. Of both halves the one
/// nearer to `from` comes first, so that items that follow one another lie close together as well.
fn sort(points: &[DVec3], items: &mut [Item], mut from: Vec3, mut origin: DVec3) {
    let leaves = items.len().div_ceil(LEAF);
    if leaves < 2 {
        items.sort_unstable_by_key(|item| item.number);
        return;
    }
    let (mut low, mut high) = extent(items);
    let away = low.abs().max(high.abs()).max_element();
    if (high - low).max_element() < away * SMALL {
        let middle = (0.5 * (low + high)).as_dvec3();
        origin += middle;
        for item in &mut *items {
            item.at = (points[item.number as usize] - origin).as_vec3();
        }
        from = (from.as_dvec3() - middle).as_vec3();
        (low, high) = extent(items);
    }
    let axis = (high - low).max_position();
    let middle = 0.5 * (low + high);
    let half = leaves.next_power_of_two() / 2 * LEAF;
    if from[axis] > middle[axis] {
        items.select_nth_unstable_by(half, |a, b| b.at[axis].total_cmp(&a.at[axis]));
    } else {
        items.select_nth_unstable_by(half, |a, b| a.at[axis].total_cmp(&b.at[axis]));
    }
    // The first half ends about opposite to where it starts.
    let mut between = low + high - from;
    between[axis] = middle[axis];
    let is_large = items.len() > PARALLEL;
    let (left, right) = items.split_at_mut(half);
    if is_large {
        join(
            || sort(points, left, from, origin),
            || sort(points, right, between, origin),
        );
    } else {
        between = left[half - 1].at;
        sort(points, left, from, origin);
        sort(points, right, between, origin);
    }
}

fn extent(items: &[Item]) -> (Vec3, Vec3) {
    let first = items[0].at;
    items.iter().fold((first, first), |(low, high), item| {
        (low.min(item.at), high.max(item.at))
    })
}
