//! A tree of boxes over leaves of points, laid out by number alone: a node holds sixteen leaves that
//! follow one another, or sixteen nodes of the level below.

use std::ops::Range;

use glam::DVec3;
use pulp::Scalar;

use super::boxes::{Boxes, FAR_OFF_SQUARED, SLACK, WIDTH};
use super::leaf::{LEAF, Leaf, Near, extent};
use super::order::{Order, in_order};
use super::walk::{Reach, Standpoint};
use crate::parallel::{join, map_pieces};

/// Leaves so many times as large as most are coarse.
const COARSE: f32 = 256.0;
/// Queries that lie so many times as far from each other as small leaves are large may be in groups.
const APART: f32 = 32.0;

#[derive(Debug)]
pub(super) struct Tree {
    leaves: Vec<Leaf>,
    near: Vec<Near>,
    /// The leaves' boxes, then those of sixteen leaves each, up to a single group.
    levels: Vec<Vec<Boxes>>,
    /// Where in the tree's order each leaf's points start; then how many there are.
    starts: Vec<u32>,
    /// The boxes' frame: `(p - origin) * scale` lies within -1..1 for each point.
    origin: DVec3,
    scale: f64,
    /// The radius beyond which a leaf is coarse.
    coarse: f32,
    /// The radius beyond which queries may lie in groups far apart.
    apart: f32,
    /// The squared distance beside which small leaves are far off.
    far_off: f64,
}

impl Tree {
    /// Builds the tree on `points`, of which there must be some. Their numbers in its order come along.
    pub(super) fn new(points: &[DVec3]) -> (Self, Vec<u32>) {
        let (low, high) = extent(points);
        let origin = low + 0.5 * (high - low);
        let half = 0.5 * (high - low).max_element();
        let scale = if half > 0.0 { 1.0 / half } else { 1.0 };
        let in_frame = |number: u32| (points[number as usize] - origin) * scale;
        let Order {
            numbers: mut order,
            starts,
        } = in_order(points.len(), &in_frame);
        let count = starts.len() - 1;
        let mut leaves = vec![[[f64::INFINITY; LEAF]; 3]; count];
        let mut near = vec![Near::NONE; count];
        let mut boxes = vec![Boxes::NONE; count.div_ceil(WIDTH)];
        let mut bounds = vec![(DVec3::ZERO, DVec3::ZERO); boxes.len()];
        let pieces = Pieces {
            numbers: &mut order,
            starts: &starts,
            leaves: &mut leaves,
            near: &mut near,
            boxes: &mut boxes,
            bounds: &mut bounds,
        };
        pieces.each(&|piece: Pieces<'_>| {
            let mut local = [DVec3::ZERO; LEAF * WIDTH];
            let count = piece.leaves.len();
            let range = |leaf: usize| {
                let from = piece.starts[0];
                (piece.starts[leaf] - from) as usize..(piece.starts[leaf + 1] - from) as usize
            };
            // By number, so that the first of equals is the lowest.
            for leaf in 0..count {
                piece.numbers[range(leaf)].sort_unstable();
            }
            for (at, &number) in local.iter_mut().zip(&*piece.numbers) {
                *at = in_frame(number);
            }
            piece.bounds[0] = extent(&local[..piece.numbers.len()]);
            let mut own = [DVec3::ZERO; WIDTH];
            for leaf in 0..count {
                for (i, &number) in piece.numbers[range(leaf)].iter().enumerate() {
                    for e in 0..3 {
                        piece.leaves[leaf][e][i] = points[number as usize][e];
                    }
                }
                piece.near[leaf] = Near::new(&local[range(leaf)]);
                own[leaf] = DVec3::from_array(piece.near[leaf].center);
            }
            piece.boxes[0] = Boxes::among(&own[..count]);
            for leaf in 0..count {
                piece.boxes[0].set(leaf, own[leaf], local[range(leaf)].iter().copied());
            }
            piece.boxes[0].finish(count);
        });
        let mut levels = vec![boxes];
        let mut size = 1;
        while bounds.len() > 1 {
            size *= WIDTH;
            // One by one where there are few.
            let piece = if bounds.len() > 16 * WIDTH { WIDTH } else { 1 };
            let above: Vec<(DVec3, DVec3)> = bounds.chunks(WIDTH).map(union).collect();
            let below = bounds.len();
            let part = |range: Range<usize>| {
                let group = range.start / WIDTH * WIDTH;
                let own = bounds[group..(group + WIDTH).min(below)]
                    .iter()
                    .map(|&b| middle(b));
                let mut boxes = Boxes::among(&own.collect::<Vec<DVec3>>());
                for (lane, number) in range.enumerate() {
                    let own = middle(bounds[number]);
                    let (first, end) = (number * size, ((number + 1) * size).min(count));
                    let numbers = &order[starts[first] as usize..starts[end] as usize];
                    boxes.set(lane, own, numbers.iter().map(|&number| in_frame(number)));
                }
                boxes
            };
            let parts = map_pieces(bounds.len(), piece, &(), part).unwrap_or_default();
            let whole = |(group, parts): (usize, &[Boxes])| {
                let mut boxes = Boxes::together(parts, piece);
                boxes.finish((below - group * WIDTH).min(WIDTH));
                boxes
            };
            levels.push(parts.chunks(WIDTH / piece).enumerate().map(whole).collect());
            bounds = above;
        }
        let mut radii: Vec<f32> = near.iter().map(|near| near.radius).collect();
        let (_, &mut typical, _) = radii.select_nth_unstable_by(count / 2, f32::total_cmp);
        let (_, &mut small, _) = radii.select_nth_unstable_by(count / 16, f32::total_cmp);
        let tree = Self {
            leaves,
            near,
            levels,
            starts,
            origin,
            scale,
            coarse: COARSE * typical,
            apart: APART * small,
            far_off: FAR_OFF_SQUARED * f64::from(small) * f64::from(small),
        };
        (tree, order)
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

    /// The boxes of a level by sixteens, from those around leaves up to a single group.
    #[inline(always)]
    pub(super) fn boxes(&self, level: usize) -> &[Boxes] {
        &self.levels[level]
    }

    /// The highest level.
    #[inline(always)]
    pub(super) fn top(&self) -> u32 {
        self.levels.len() as u32 - 1
    }

    /// How many leaves there are.
    #[inline(always)]
    pub(super) fn leaves(&self) -> usize {
        self.leaves.len()
    }

    /// A leaf near `q`, which is in the boxes' frame, down the nearest boxes.
    pub(super) fn descend(&self, q: [f64; 3]) -> usize {
        let mut group = 0;
        for (level, boxes) in self.levels.iter().enumerate().rev() {
            let below = if level > 0 {
                self.levels[level - 1].len()
            } else {
                self.leaves.len()
            };
            let promises = boxes[group].promises::<Scalar>(q);
            let lanes = 0..WIDTH.min(below - group * WIDTH);
            let nearest = lanes.min_by(|&a, &b| promises[a].total_cmp(&promises[b]));
            group = group * WIDTH + nearest.unwrap_or(0);
        }
        group
    }

    /// What walks of a single query begin with, `q` in the boxes' frame, where a point was found that
    /// is as far as `limit_squared`, and how far to walk to find all that is as near.
    #[inline(always)]
    pub(super) fn single(&self, q: [f64; 3], limit_squared: f64) -> (Standpoint, Reach) {
        let from = Standpoint {
            center: q,
            radius: 0.0,
            toward: q,
            reference: limit_squared * self.scale * self.scale,
        };
        (from, self.reach(from.reference, limit_squared))
    }

    /// How far to walk on to find all that is as near as `limit_squared`.
    #[inline(always)]
    pub(super) fn reach(&self, reference: f64, limit_squared: f64) -> Reach {
        let squared = limit_squared * self.scale * self.scale;
        let excess = (squared - reference) as f32;
        let excess = excess + SLACK * excess.abs();
        Reach {
            excess,
            root: squared.sqrt() as f32 * (1.0 + SLACK),
            excess_toward: excess,
        }
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

    /// The point of a leaf that lies nearest to `from`, both in the boxes' frame, or nearly so.
    pub(super) fn nearest_in_leaf(&self, leaf: usize, from: [f64; 3]) -> [f64; 3] {
        let from = DVec3::from_array(from);
        let places = (0..self.positions(leaf).len()).map(|place| self.in_frame(self.place(leaf, place)));
        let nearest = places.min_by(|a, b| (a.distance_squared(from)).total_cmp(&b.distance_squared(from)));
        nearest.unwrap_or(from).to_array()
    }

    #[inline(always)]
    pub(super) fn leaf_center(&self, leaf: usize) -> [f64; 3] {
        self.near[leaf].center
    }

    #[inline(always)]
    pub(super) fn leaf_near(&self, leaf: usize) -> &Near {
        &self.near[leaf]
    }

    /// The boxes that hold a leaf's, and its lane there.
    #[inline(always)]
    pub(super) fn leaf_box(&self, leaf: usize) -> (&Boxes, usize) {
        (&self.levels[0][leaf / WIDTH], leaf % WIDTH)
    }

    /// Whether some leaves are far off at a distance, given squared.
    #[inline(always)]
    pub(super) fn is_far_off(&self, squared: f64) -> bool {
        !(squared < self.far_off)
    }

    /// The radius beyond which queries may lie in groups far apart, as the points of some leaves do.
    #[inline(always)]
    pub(super) fn apart(&self) -> f32 {
        self.apart
    }

    /// Whether a leaf is so much larger than most that single precision blurs what lies in it.
    #[inline(always)]
    pub(super) fn is_coarse(&self, leaf: usize) -> bool {
        self.near[leaf].radius > self.coarse
    }

    /// Length in the boxes' frame of what is one long.
    #[inline(always)]
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// The positions of a leaf's points in the tree's order.
    #[inline(always)]
    pub(super) fn positions(&self, leaf: usize) -> Range<usize> {
        self.starts[leaf] as usize..self.starts[leaf + 1] as usize
    }

    /// The leaf that holds a position, and the place there.
    #[inline(always)]
    pub(super) fn leaf_at(&self, position: usize) -> (usize, usize) {
        // That one, if all leaves are full.
        let full = position / LEAF;
        let leaf = if self.positions(full).contains(&position) {
            full
        } else {
            self.starts.partition_point(|&start| start as usize <= position) - 1
        };
        (leaf, position - self.starts[leaf] as usize)
    }

    /// How many points there are.
    pub(super) fn len(&self) -> usize {
        self.positions(self.leaves() - 1).end
    }
}

/// What is made of some of a tree's points, by groups of sixteen leaves.
struct Pieces<'a> {
    numbers: &'a mut [u32],
    /// Where each leaf's numbers start, and where the last one's end, from `starts[0]`.
    starts: &'a [u32],
    leaves: &'a mut [Leaf],
    near: &'a mut [Near],
    boxes: &'a mut [Boxes],
    /// The extent of each group's points.
    bounds: &'a mut [(DVec3, DVec3)],
}

impl Pieces<'_> {
    /// Runs `work` on each group.
    fn each(self, work: &(impl Fn(Pieces<'_>) + Sync)) {
        let groups = self.boxes.len();
        if groups == 1 {
            return work(self);
        }
        let half = groups / 2;
        let starts = &self.starts[..=half * WIDTH];
        let other_starts = &self.starts[half * WIDTH..];
        let (numbers, other_numbers) = (self.numbers).split_at_mut((other_starts[0] - starts[0]) as usize);
        let (leaves, other_leaves) = self.leaves.split_at_mut(half * WIDTH);
        let (near, other_near) = self.near.split_at_mut(half * WIDTH);
        let (boxes, other_boxes) = self.boxes.split_at_mut(half);
        let (bounds, other_bounds) = self.bounds.split_at_mut(half);
        let (one, other) = (
            Pieces {
                numbers,
                starts,
                leaves,
                near,
                boxes,
                bounds,
            },
            Pieces {
                numbers: other_numbers,
                starts: other_starts,
                leaves: other_leaves,
                near: other_near,
                boxes: other_boxes,
                bounds: other_bounds,
            },
        );
        join(|| one.each(work), || other.each(work));
    }
}

/// The extent of several together.
fn union(extents: &[(DVec3, DVec3)]) -> (DVec3, DVec3) {
    extents
        .iter()
        .fold(extents[0], |a, b| (a.0.min(b.0), a.1.max(b.1)))
}

fn middle((low, high): (DVec3, DVec3)) -> DVec3 {
    0.5 * (low + high)
}
