//! A balanced tree of boxes over leaves of points, laid out by position alone: leaf `i` holds the
//! points from `i * LEAF`, and a node of a level the eight nodes below it.

use glam::{DVec3, Vec3};

use super::boxes::{Boxes, SLACK, WIDTH};
use crate::geometry::parallel::{join, map_pieces};

/// Points in a leaf.
pub(super) const LEAF: usize = 16;

/// Points below which sorting is not worth another core.
const ALONE: usize = 4096;

/// A point and its number before sorting.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub(super) at: DVec3,
    pub(super) id: u32,
}

/// Points of a leaf, coordinate by coordinate; what is left over lies at infinity.
type Leaf = [[f64; LEAF]; 3];

#[derive(Debug)]
pub(super) struct Tree {
    leaves: Vec<Leaf>,
    /// The leaves' boxes, then those of eight leaves each, up to a single group.
    levels: Vec<Vec<Boxes>>,
    len: usize,
    /// The boxes' frame: `(p - origin) * scale` lies within -1..1 for each point.
    origin: DVec3,
    scale: f64,
}

impl Tree {
    /// Sorts `items`, of which there must be some, into the tree's order, and builds the tree on them.
    pub(super) fn new(items: &mut [Item]) -> Self {
        let len = items.len();
        sort(items);
        // Within a leaf by number, so that the first of equals is the lowest.
        for leaf in items.chunks_mut(LEAF) {
            leaf.sort_unstable_by_key(|item| item.id);
        }
        let (low, high) = extent(items);
        let origin = low + 0.5 * (high - low);
        let half = 0.5 * (high - low).max_element();
        let scale = if half > 0.0 { 1.0 / half } else { 1.0 };
        let items = &*items;
        let leaves = items
            .chunks(LEAF)
            .map(|chunk| {
                let mut leaf = [[f64::INFINITY; LEAF]; 3];
                for (i, item) in chunk.iter().enumerate() {
                    for e in 0..3 {
                        leaf[e][i] = item.at[e];
                    }
                }
                leaf
            })
            .collect();
        let mut levels = Vec::new();
        let mut size = LEAF;
        loop {
            let group = |range: std::ops::Range<usize>| {
                let mut boxes = Boxes::NONE;
                let from = range.start * size * WIDTH;
                let to = (from + size * WIDTH).min(len);
                for (lane, chunk) in items[from..to].chunks(size).enumerate() {
                    boxes.set(lane, chunk.iter().map(|p| (p.at - origin) * scale));
                }
                boxes
            };
            let level = map_pieces(len.div_ceil(size * WIDTH), 1, &(), group).unwrap_or_default();
            let top = level.len() == 1;
            levels.push(level);
            if top {
                break;
            }
            size *= WIDTH;
        }
        Self {
            leaves,
            levels,
            len,
            origin,
            scale,
        }
    }

    /// The squared distances from `q` to the points of a leaf, in their order.
    #[inline(always)]
    pub(super) fn leaf_distances_squared(&self, leaf: usize, q: DVec3) -> [f64; LEAF] {
        let [x, y, z] = &self.leaves[leaf];
        let mut sum = [0.0; LEAF];
        for i in 0..LEAF {
            let d = [q.x - x[i], q.y - y[i], q.z - z[i]];
            sum[i] = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        }
        sum
    }

    /// Walks over all leaves that may hold a point within `limit_squared` of `q`, and perhaps some
    /// more. `visit` gets each and returns the limit from there on, which must not grow.
    #[inline(always)]
    pub(super) fn walk(&self, q: DVec3, mut limit_squared: f64, mut visit: impl FnMut(usize, f32) -> f64) {
        let q = self.in_frame(q);
        let reach_squared = |limit_squared| self.reach_squared(q, limit_squared);
        let in_frame = q.to_array();
        let mut reach = reach_squared(limit_squared);
        let mut stack = [(0.0, 0u32, 0u32); 12 * WIDTH];
        stack[0].1 = self.levels.len() as u32 - 1;
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (distance, level, group) = stack[height];
            if distance > reach {
                continue;
            }
            let distances = self.levels[level as usize][group as usize].distances_squared(in_frame);
            let mut near = 0u32;
            for (i, d) in distances.iter().enumerate() {
                // Where rounding left no number, better look.
                near |= u32::from(!(*d > reach)) << i;
            }
            while near != 0 {
                let i = near.trailing_zeros() as usize;
                near &= near - 1;
                let below = group as usize * WIDTH + i;
                if level > 0 {
                    if below < self.levels[level as usize - 1].len() {
                        stack[height] = (distances[i], level - 1, below as u32);
                        height += 1;
                    }
                } else if !(distances[i] > reach) && below < self.leaves.len() {
                    let limit = visit(below, distances[i]);
                    if limit != limit_squared {
                        limit_squared = limit;
                        reach = reach_squared(limit);
                    }
                }
            }
        }
    }

    /// A leaf near `q`, down the nearest boxes.
    pub(super) fn descend(&self, q: DVec3) -> usize {
        let in_frame = self.in_frame(q).to_array();
        let mut group = 0;
        for (level, boxes) in self.levels.iter().enumerate().rev() {
            let distances = boxes[group].distances_squared(in_frame);
            let nearest = (0..WIDTH)
                .min_by(|&a, &b| distances[a].total_cmp(&distances[b]))
                .unwrap_or(0);
            let below = if level > 0 {
                self.levels[level - 1].len()
            } else {
                self.leaves.len()
            };
            // Far beyond single precision all boxes are as far as no box.
            group = (group * WIDTH + nearest).min(below - 1);
        }
        group
    }

    /// How far a box may seem to be from a query in the boxes' frame and still hold a point within
    /// the root of `limit_squared` of it, squared.
    #[inline(always)]
    pub(super) fn reach_squared(&self, in_frame: Vec3, limit_squared: f64) -> f32 {
        let slack = SLACK * (1.0 + in_frame.length());
        let reach = (limit_squared.sqrt() * self.scale) as f32 * (1.0 + SLACK) + slack;
        reach * reach
    }

    #[inline(always)]
    pub(super) fn in_frame(&self, p: DVec3) -> Vec3 {
        ((p - self.origin) * self.scale).as_vec3()
    }

    /// Whether any query may have a point of `leaf` within its reach.
    #[inline(always)]
    pub(super) fn any_within<const N: usize>(
        &self,
        leaf: usize,
        queries: &[[f32; N]; 3],
        reach_squared: &[f32; N],
    ) -> bool {
        self.levels[0][leaf / WIDTH].any_within(leaf % WIDTH, queries, reach_squared)
    }

    /// For each query the nearest point of a leaf: its squared distance, and its place in the leaf,
    /// the lowest of equals.
    #[inline(always)]
    pub(super) fn nearest_in_leaf<const N: usize>(
        &self,
        leaf: usize,
        queries: &[[f64; N]; 3],
    ) -> ([f64; N], [f64; N]) {
        let [xs, ys, zs] = &self.leaves[leaf];
        let (mut least, mut which) = ([f64::INFINITY; N], [0.0; N]);
        // A whole number as f64, as wide as what it goes along with.
        let mut number = 0.0;
        for j in 0..LEAF {
            let (x, y, z) = (xs[j], ys[j], zs[j]);
            for i in 0..N {
                let d = [queries[0][i] - x, queries[1][i] - y, queries[2][i] - z];
                let d = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                let nearer = d < least[i];
                least[i] = if nearer { d } else { least[i] };
                which[i] = if nearer { number } else { which[i] };
            }
            number += 1.0;
        }
        (least, which)
    }

    /// The positions of a leaf's points in the tree's order.
    #[inline(always)]
    pub(super) fn positions(&self, leaf: usize) -> std::ops::Range<usize> {
        leaf * LEAF..((leaf + 1) * LEAF).min(self.len)
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }
}

fn extent(items: &[Item]) -> (DVec3, DVec3) {
    items.iter().fold((items[0].at, items[0].at), |(low, high), p| {
        (low.min(p.at), high.max(p.at))
    })
}

/// Halves along the longest side, again and again, so that each leaf and each eight of them lie
/// close together. The first half is a power of two of leaves, and so every node is full but the last.
fn sort(items: &mut [Item]) {
    let leaves = items.len().div_ceil(LEAF);
    if leaves < 2 {
        return;
    }
    let (low, high) = extent(items);
    let axis = (high - low).max_position();
    let half = leaves.next_power_of_two() / 2 * LEAF;
    items.select_nth_unstable_by(half, |a, b| a.at[axis].total_cmp(&b.at[axis]));
    let (left, right) = items.split_at_mut(half);
    if leaves * LEAF < ALONE {
        sort(left);
        sort(right);
    } else {
        join(|| sort(left), || sort(right));
    }
}
