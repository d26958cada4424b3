//! A balanced tree of boxes over leaves of points, laid out by position alone: leaf `i` holds the
//! points from `i * LEAF`, and a node of a level the sixteen nodes below it.

use glam::{DVec3, Vec3};
use pulp::{Scalar, Simd};

use super::boxes::{Boxes, SLACK, WIDTH};
use crate::geometry::parallel::{join, map_pieces};

/// Points in a leaf.
pub(super) const LEAF: usize = 16;

/// Points below which sorting is not worth another core.
const ALONE: usize = 1024;

/// A point and its number before sorting.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub(super) at: DVec3,
    pub(super) id: u32,
}

/// Points of a leaf, coordinate by coordinate; what is left over lies at infinity.
type Leaf = [[f64; LEAF]; 3];

/// The same points in single precision, seen from the leaf's center, in the tree's frame.
#[derive(Debug)]
pub(super) struct Near {
    /// -2 times their coordinates.
    pub(super) minus_twice: [[f32; LEAF]; 3],
    /// Their squared distances from the center; what is left over lies at infinity.
    pub(super) squared: [f32; LEAF],
    /// The largest distance from the center, or a little more.
    pub(super) radius: f32,
    /// In the tree's frame.
    center: [f64; 3],
}

impl Near {
    fn new(chunk: &[Item], in_frame: impl Fn(DVec3) -> DVec3) -> Self {
        let (low, high) = extent(chunk);
        let center = in_frame(low + 0.5 * (high - low));
        let mut near = Self {
            minus_twice: [[0.0; LEAF]; 3],
            squared: [f32::INFINITY; LEAF],
            radius: 0.0,
            center: center.to_array(),
        };
        for (i, item) in chunk.iter().enumerate() {
            let p = (in_frame(item.at) - center).as_vec3();
            for e in 0..3 {
                near.minus_twice[e][i] = -2.0 * p[e];
            }
            near.squared[i] = p.as_dvec3().length_squared() as f32;
            near.radius = near.radius.max(p.length());
        }
        near.radius *= 1.0 + 1e-6;
        near
    }
}

#[derive(Debug)]
pub(super) struct Tree {
    leaves: Vec<Leaf>,
    near: Vec<Near>,
    /// The leaves' boxes, then those of sixteen leaves each, up to a single group.
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
        let from = items.first().map_or(DVec3::ZERO, |_| extent(items).0);
        sort(items, from);
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
        let near = items
            .chunks(LEAF)
            .map(|chunk| Near::new(chunk, |p| (p - origin) * scale))
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
            near,
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

    /// Walks over all leaves that may hold a point within a reach of `from`, which is in
    /// the boxes' frame, and perhaps some more.
    #[inline(always)]
    pub(super) fn walk(&self, from: Vec3) -> Walk {
        let mut walk = Walk::new();
        walk.begin(self, from);
        walk
    }

    /// A leaf near `q`, down the nearest boxes.
    pub(super) fn descend(&self, q: DVec3) -> usize {
        let in_frame = self.in_frame(q).as_vec3().to_array();
        let mut group = 0;
        for (level, boxes) in self.levels.iter().enumerate().rev() {
            let distances = boxes[group].distances_squared::<Scalar>(in_frame);
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

    /// How far a box may seem to be from a query and still hold a point within the root of
    /// `limit_squared` of it, squared.
    #[inline(always)]
    pub(super) fn reach_squared(&self, in_frame: Vec3, limit_squared: f64) -> f32 {
        let slack = SLACK * (1.0 + in_frame.length());
        let reach = (limit_squared.sqrt() * self.scale) as f32 * (1.0 + SLACK) + slack;
        reach * reach
    }

    #[inline(always)]
    pub(super) fn in_frame(&self, p: DVec3) -> DVec3 {
        (p - self.origin) * self.scale
    }

    /// A point of a leaf.
    #[inline(always)]
    pub(super) fn place(&self, leaf: usize, place: usize) -> DVec3 {
        let [x, y, z] = &self.leaves[leaf];
        DVec3::new(x[place], y[place], z[place])
    }

    /// One coordinate of it.
    #[inline(always)]
    pub(super) fn in_frame_along(&self, e: usize, coordinate: f64) -> f64 {
        (coordinate - self.origin[e]) * self.scale
    }

    /// The squared distance from `q` to a point of a leaf, as [`Tree::leaf_distances_squared`] has it.
    #[inline(always)]
    pub(super) fn distance_squared(&self, leaf: usize, place: usize, q: DVec3) -> f64 {
        let [x, y, z] = &self.leaves[leaf];
        let d = [q.x - x[place], q.y - y[place], q.z - z[place]];
        d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
    }

    #[inline(always)]
    pub(super) fn leaf_center(&self, leaf: usize) -> [f64; 3] {
        self.near[leaf].center
    }

    #[inline(always)]
    pub(super) fn leaf_near(&self, leaf: usize) -> &Near {
        &self.near[leaf]
    }

    /// Whether any query may have a point of `leaf` within its reach.
    #[inline(always)]
    pub(super) fn any_within<S: Simd, const N: usize>(
        &self,
        leaf: usize,
        queries: &[[f32; N]; 3],
        reach_squared: &[f32; N],
    ) -> bool {
        self.levels[0][leaf / WIDTH].any_within::<S, N>(leaf % WIDTH, queries, reach_squared)
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

/// A walk from box to box, down to the leaves. No iterator and without closures, since only what is
/// inlined is built for each kind of vector instructions.
pub(super) struct Walk {
    from: [f32; 3],
    /// Distances, levels and numbers of the groups to go into.
    stack: [(f32, u32, u32); 12 * WIDTH],
    height: usize,
    /// Which leaves of `group` are still to be visited, a bit each, and how far all of them are.
    near: u32,
    group: usize,
    distances: [f32; WIDTH],
}

impl Walk {
    /// A walk that has ended.
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self {
            from: [0.0; 3],
            stack: [(0.0, 0, 0); 12 * WIDTH],
            height: 0,
            near: 0,
            group: 0,
            distances: [0.0; WIDTH],
        }
    }

    /// Begins again, as [`Tree::walk`].
    #[inline(always)]
    pub(super) fn begin(&mut self, tree: &Tree, from: Vec3) {
        self.from = from.to_array();
        self.stack[0] = (0.0, tree.levels.len() as u32 - 1, 0);
        (self.height, self.near) = (1, 0);
    }

    /// The next leaf within the root of `reach_squared`, which must not grow from call to call.
    #[inline(always)]
    pub(super) fn next<S: Simd>(&mut self, tree: &Tree, reach_squared: f32) -> Option<usize> {
        loop {
            while self.near != 0 {
                let i = self.near.trailing_zeros() as usize;
                self.near &= self.near - 1;
                let leaf = self.group * WIDTH + i;
                // Where rounding left no number, better look.
                if !(self.distances[i] > reach_squared) && leaf < tree.leaves.len() {
                    return Some(leaf);
                }
            }
            if self.height == 0 {
                return None;
            }
            self.height -= 1;
            let (distance, level, group) = self.stack[self.height];
            if distance > reach_squared {
                continue;
            }
            let (level, group) = (level as usize, group as usize);
            let distances = tree.levels[level][group].distances_squared::<S>(self.from);
            // Bit after bit and then all at once, as vectors can.
            let mut bits = [0u32; WIDTH];
            for i in 0..WIDTH {
                bits[i] = if distances[i] > reach_squared { 0 } else { 1 << i };
            }
            let mut near = bits.iter().fold(0, |all, bit| all | bit);
            if level == 0 {
                (self.near, self.group, self.distances) = (near, group, distances);
                continue;
            }
            while near != 0 {
                let i = near.trailing_zeros() as usize;
                near &= near - 1;
                let below = group * WIDTH + i;
                if below < tree.levels[level - 1].len() {
                    self.stack[self.height] = (distances[i], level as u32 - 1, below as u32);
                    self.height += 1;
                }
            }
        }
    }
}

fn extent(items: &[Item]) -> (DVec3, DVec3) {
    items.iter().fold((items[0].at, items[0].at), |(low, high), p| {
        (low.min(p.at), high.max(p.at))
    })
}

/// Halves along the longest side, again and again, so that each leaf and each sixteen of them lie
/// close together. The first half is a power of two of leaves, and so every node is full but the last.
/// Of both halves the one nearer to `from` comes first, so that what follows one another lies close
/// together as well.
fn sort(items: &mut [Item], from: DVec3) {
    let leaves = items.len().div_ceil(LEAF);
    if leaves < 2 {
        return;
    }
    let (low, high) = extent(items);
    let axis = (high - low).max_position();
    let half = leaves.next_power_of_two() / 2 * LEAF;
    let middle = low + 0.5 * (high - low);
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
