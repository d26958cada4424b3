//! The order of points in the tree: those of a leaf or node lie close together, and so do consecutive ones.

use glam::DVec3;

use super::tree::LEAF;
use crate::parallel::{Cancelled, Watch, join};

/// The number of points from which sorting is worth another core.
const PARALLEL: usize = 512;
/// The number of points above which the watch is asked first: fewer take less than some milliseconds.
const ASKING: usize = 1 << 14;

/// A point and its number.
type Item = (DVec3, u32);

/// The numbers of the points, of which there must be some, in the tree's order.
pub(super) fn spatial_order(points: &[DVec3], watch: &dyn Watch) -> Result<Vec<u32>, Cancelled> {
    let mut items: Vec<Item> = points.iter().copied().zip(0..).collect();
    let from = extent(&items).0;
    sort(&mut items, from, watch)?;
    let mut order: Vec<u32> = items.iter().map(|item| item.1).collect();
    // Of a leaf's points that are equally far the first is the one of the lowest number.
    order.chunks_mut(LEAF).for_each(<[u32]>::sort_unstable);
    Ok(order)
}

/// Halves the items along their longest side, again and again. The first half is a power of two of leaves,
/// so that every leaf and node but the last is full. Of both halves the one nearer to `from` comes first, so
/// that items that follow one another lie close together as well.
fn sort(items: &mut [Item], from: DVec3, watch: &dyn Watch) -> Result<(), Cancelled> {
    let leaves = items.len().div_ceil(LEAF);
    if leaves < 2 {
        return Ok(());
    }
    if items.len() > ASKING {
        watch.go_on()?;
    }
    let (low, high) = extent(items);
    let axis = (high - low).max_position();
    let middle = 0.5 * (low + high);
    let half = leaves.next_power_of_two() / 2 * LEAF;
    if from[axis] > middle[axis] {
        items.select_nth_unstable_by(half, |a, b| b.0[axis].total_cmp(&a.0[axis]));
    } else {
        items.select_nth_unstable_by(half, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    }
    let is_large = items.len() > PARALLEL;
    let (left, right) = items.split_at_mut(half);
    if is_large {
        // The first half ends about opposite to where it starts.
        let mut between = low + high - from;
        between[axis] = middle[axis];
        let (mut of_left, mut of_right) = (Ok(()), Ok(()));
        join(
            || of_left = sort(left, from, watch),
            || of_right = sort(right, between, watch),
        );
        of_left.and(of_right)
    } else {
        let between = left[half - 1].0;
        sort(left, from, watch)?;
        sort(right, between, watch)
    }
}

fn extent(items: &[Item]) -> (DVec3, DVec3) {
    let first = items[0].0;
    items.iter().fold((first, first), |(low, high), item| {
        (low.min(item.0), high.max(item.0))
    })
}
