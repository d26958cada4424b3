//! The search for the visible partners of many points under one plane (Eq. 11–15).
//!
//! Points and normals are reflected eight at a time by vector instructions. Those whose partner is visible
//! wait until they are a block, whose nearest neighbors are then searched for together.

#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "only inlined functions are compiled for each kind of vector instructions; lanes are looped over"
)]

use std::ops::Range;

use glam::DVec3;
use pulp::Simd;

use super::Surface;
use crate::geometry::{Plane, angles_between_directions_rad};
use crate::neighbors::{BLOCK, BatchSearch, BlockResult, Neighbors};

/// Points that are reflected together: as many as the widest vectors hold numbers of double precision.
const LANES: usize = 8;

/// A consumer of the points that have a visible partner.
pub(super) trait PartnerSink {
    /// Accepts the next points, a value for each in every slice: the indices in the surface of the points
    /// and of their partners, d in the surface's unit, and ξ in radians.
    fn accept(&mut self, points: &[u32], partners: &[u32], distances: &[f64], angles_rad: &[f64]);
}

/// The points and normals of a surface, coordinate by coordinate, in an order in which each point lies
/// close to the one before it. Worth its copies for many planes.
pub(super) struct OrderedSurface<'a> {
    neighbors: &'a Neighbors,
    points: [Vec<f64>; 3],
    normals: [Vec<f64>; 3],
    /// The normals in the order of the positions in the search tree.
    normals_at: Vec<DVec3>,
}

impl<'a> OrderedSurface<'a> {
    /// Returns `None` for more points than the search tree can hold.
    pub(super) fn new(surface: &'a Surface) -> Option<Self> {
        let neighbors = surface.neighbors()?;
        let normals = surface.normals();
        let first = neighbors.first().iter();
        Some(Self {
            neighbors,
            points: columns(surface.points(), neighbors.order()),
            normals: columns(normals, neighbors.order()),
            normals_at: first.map(|&i| normals[i as usize]).collect(),
        })
    }

    /// Passes the partners of the points of a range of this order to `sink`, and returns it.
    pub(super) fn partners<T: PartnerSink>(
        &self,
        range: Range<usize>,
        plane: &Plane,
        viewpoint: DVec3,
        sink: T,
    ) -> T {
        FindPartners {
            sink,
            neighbors: self.neighbors,
            order: &self.neighbors.order()[range.clone()],
            points: self.points.each_ref().map(|of| &of[range.clone()]),
            normals: self.normals.each_ref().map(|of| &of[range.clone()]),
            normals_at: NormalLookup::ByPosition(&self.normals_at),
            plane,
            viewpoint,
        }
        .find()
    }
}

/// Passes the partners of the points of a range of the search tree's order to `sink`, and returns it. For
/// a single plane: only the points of the range are copied. A surface of more points than the search tree
/// can hold has no partners.
pub(super) fn partners_once<T: PartnerSink>(
    surface: &Surface,
    range: Range<usize>,
    plane: &Plane,
    viewpoint: DVec3,
    sink: T,
) -> T {
    let Some(neighbors) = surface.neighbors() else {
        return sink;
    };
    let order = &neighbors.order()[range];
    let (points, normals) = (
        columns(surface.points(), order),
        columns(surface.normals(), order),
    );
    FindPartners {
        sink,
        neighbors,
        order,
        points: points.each_ref().map(Vec::as_slice),
        normals: normals.each_ref().map(Vec::as_slice),
        normals_at: NormalLookup::ByPoint(surface.normals()),
        plane,
        viewpoint,
    }
    .find()
}

fn columns(of: &[DVec3], order: &[u32]) -> [Vec<f64>; 3] {
    std::array::from_fn(|e| order.iter().map(|&i| of[i as usize][e]).collect())
}

/// The normals of the positions in the search tree. Equal points share a position, whose normal is that of
/// the one with the lowest index.
#[derive(Clone, Copy)]
enum NormalLookup<'a> {
    /// A normal for each position, in their order.
    ByPosition(&'a [DVec3]),
    /// A normal for each point of the surface.
    ByPoint(&'a [DVec3]),
}

struct FindPartners<'a, T> {
    sink: T,
    neighbors: &'a Neighbors,
    /// The indices of the points in the surface.
    order: &'a [u32],
    points: [&'a [f64]; 3],
    normals: [&'a [f64]; 3],
    normals_at: NormalLookup<'a>,
    plane: &'a Plane,
    viewpoint: DVec3,
}

/// Points with a visible partner that wait until they are a block, with their reflections.
struct Waiting {
    count: usize,
    point: [u32; BLOCK + LANES],
    reflected: [[f64; BLOCK + LANES]; 3],
    normals: [[f64; BLOCK + LANES]; 3],
}

impl<T: PartnerSink> FindPartners<'_, T> {
    /// Searches with the widest vector instructions that the machine has, all of which round alike.
    fn find(self) -> T {
        pulp::Arch::new().dispatch(self)
    }
}

impl<T: PartnerSink> pulp::WithSimd for FindPartners<'_, T> {
    type Output = T;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> T {
        let mut search = BatchSearch::new(self.neighbors, simd);
        let mut nearest = BlockResult::default();
        let mut waiting = Waiting {
            count: 0,
            point: [0; BLOCK + LANES],
            reflected: [[0.0; BLOCK + LANES]; 3],
            normals: [[0.0; BLOCK + LANES]; 3],
        };
        let order = self.order;
        for from in (0..order.len()).step_by(LANES) {
            let lanes = from..(from + LANES).min(order.len());
            let (p, n) = (
                gather(self.points, lanes.clone()),
                gather(self.normals, lanes.clone()),
            );
            let (p, n, facing) = self.reflect(p, n);
            let mut visible = 0;
            for i in 0..LANES {
                visible += u32::from(facing[i] > 0.0);
            }
            let at = waiting.count;
            // Points close to one another mostly have a visible partner all or none.
            if visible == 0 {
                continue;
            }
            if visible as usize == LANES && lanes.len() == LANES {
                waiting.point[at..at + LANES].copy_from_slice(&order[lanes]);
                for e in 0..3 {
                    waiting.reflected[e][at..at + LANES].copy_from_slice(&p[e]);
                    waiting.normals[e][at..at + LANES].copy_from_slice(&n[e]);
                }
                waiting.count += LANES;
            } else {
                // Every point is written, and the next one overwrites it unless its partner is visible:
                // that takes no branch for each point.
                for i in 0..lanes.len() {
                    waiting.point[waiting.count] = order[from + i];
                    for e in 0..3 {
                        waiting.reflected[e][waiting.count] = p[e][i];
                        waiting.normals[e][waiting.count] = n[e][i];
                    }
                    waiting.count += usize::from(facing[i] > 0.0);
                }
            }
            if waiting.count >= BLOCK {
                self.find_block(&mut search, &mut nearest, &waiting, BLOCK);
                waiting.point.copy_within(BLOCK.., 0);
                for e in 0..3 {
                    waiting.reflected[e].copy_within(BLOCK.., 0);
                    waiting.normals[e].copy_within(BLOCK.., 0);
                }
                waiting.count -= BLOCK;
            }
        }
        if waiting.count > 0 {
            let size = waiting.count;
            for e in 0..3 {
                let last = waiting.reflected[e][size - 1];
                waiting.reflected[e][size..BLOCK].fill(last);
            }
            self.find_block(&mut search, &mut nearest, &waiting, size);
        }
        self.sink
    }
}

impl<T: PartnerSink> FindPartners<'_, T> {
    /// Searches for the partners of the first `size` waiting points and passes them on.
    #[inline(always)]
    fn find_block<S: Simd>(
        &mut self,
        search: &mut BatchSearch<'_, S>,
        nearest: &mut BlockResult,
        waiting: &Waiting,
        size: usize,
    ) {
        search.find(&first_block(&waiting.reflected), size, nearest);
        let first = self.neighbors.first();
        let (mut partner, mut distance) = ([0; BLOCK], [0.0; BLOCK]);
        let mut b = [[0.0; BLOCK]; 3];
        for i in 0..BLOCK {
            let at = nearest.position[i] as usize;
            partner[i] = first[at];
            let normal = match self.normals_at {
                NormalLookup::ByPosition(normals) => &normals[at],
                NormalLookup::ByPoint(normals) => &normals[partner[i] as usize],
            };
            for e in 0..3 {
                b[e][i] = normal[e];
            }
            distance[i] = nearest.distance_squared[i].sqrt();
        }
        let angle_rad = angles_between_directions_rad(&first_block(&waiting.normals), &b);
        self.sink.accept(
            &waiting.point[..size],
            &partner[..size],
            &distance[..size],
            &angle_rad[..size],
        );
    }
}

#[inline(always)]
fn first_block(columns: &[[f64; BLOCK + LANES]; 3]) -> [[f64; BLOCK]; 3] {
    let mut block = [[0.0; BLOCK]; 3];
    for e in 0..3 {
        block[e].copy_from_slice(&columns[e][..BLOCK]);
    }
    block
}

type Lanes = [[f64; LANES]; 3];

#[inline(always)]
fn gather(columns: [&[f64]; 3], lanes: Range<usize>) -> Lanes {
    let mut all = [[0.0; LANES]; 3];
    for e in 0..3 {
        let column = &columns[e][lanes.clone()];
        match <&[f64; LANES]>::try_from(column) {
            Ok(whole) => all[e] = *whole,
            Err(_) => all[e][..column.len()].copy_from_slice(column),
        }
    }
    all
}

impl<T> FindPartners<'_, T> {
    /// Reflects points and normals; the third result is positive if the partner is visible. The operations
    /// and their order are those of [`super::has_visible_partner`], so that both agree to the bit.
    #[inline(always)]
    fn reflect(&self, p: Lanes, n: Lanes) -> (Lanes, Lanes, [f64; LANES]) {
        let (c, m, v) = (self.plane.point, self.plane.normal, self.viewpoint);
        let (mut points, mut normals, mut facing) = (p, n, [0.0; LANES]);
        for i in 0..LANES {
            let from_plane = (p[0][i] - c.x) * m.x + (p[1][i] - c.y) * m.y + (p[2][i] - c.z) * m.z;
            let along = n[0][i] * m.x + n[1][i] * m.y + n[2][i] * m.z;
            let (twice, twice_along) = (2.0 * from_plane, 2.0 * along);
            let q = [
                p[0][i] - twice * m.x,
                p[1][i] - twice * m.y,
                p[2][i] - twice * m.z,
            ];
            let r = [
                n[0][i] - twice_along * m.x,
                n[1][i] - twice_along * m.y,
                n[2][i] - twice_along * m.z,
            ];
            facing[i] = r[0] * (v.x - q[0]) + r[1] * (v.y - q[1]) + r[2] * (v.z - q[2]);
            for e in 0..3 {
                points[e][i] = q[e];
                normals[e][i] = r[e];
            }
        }
        (points, normals, facing)
    }
}
