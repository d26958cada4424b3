//! The partners of many points under one plane (Eq. 11–15).

#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "only what is inlined is built for each kind of vector instructions; loops over lanes"
)]

use std::ops::Range;

use glam::DVec3;
use pulp::Simd;

use super::Surface;
use crate::geometry::{Plane, angles_between_directions_rad};
use crate::neighbors::{BLOCK, BatchSearch, BlockResult, Neighbors};

/// Points that are reflected together: what the widest vectors hold of double precision.
const LANES: usize = 8;

/// What is made of the points of a surface that have a visible partner, and of that partner.
pub(super) trait Take {
    /// Takes the next ones, all slices as long: the points' indices in the surface, their partners'
    /// indices, d in the surface's unit, and ξ in radians.
    fn take(&mut self, points: &[u32], partners: &[u32], distances: &[f64], angles_rad: &[f64]);
}

/// A surface's points and normals in an order in which each point lies close to the one before it,
/// coordinate by coordinate: for many planes.
pub(super) struct Ordered<'a> {
    neighbors: &'a Neighbors,
    points: [Vec<f64>; 3],
    normals: [Vec<f64>; 3],
    /// The normals of the tree's places, in its order.
    normals_at: Vec<DVec3>,
}

impl<'a> Ordered<'a> {
    /// `None` for more points than can be indexed.
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

    /// The partners of the points of a range in this order, into `taker`.
    pub(super) fn partners<T: Take>(
        &self,
        range: Range<usize>,
        plane: &Plane,
        viewpoint: DVec3,
        taker: T,
    ) -> T {
        FindPartners {
            taker,
            neighbors: self.neighbors,
            order: &self.neighbors.order()[range.clone()],
            points: self.points.each_ref().map(|of| &of[range.clone()]),
            normals: self.normals.each_ref().map(|of| &of[range.clone()]),
            normals_at: NormalsAt::Places(&self.normals_at),
            plane,
            viewpoint,
        }
        .find()
    }
}

/// The partners of the points of a range in the order of the surface's neighbors, for a single plane:
/// nothing is kept of the points beside the range. Nothing is found where there are more points than
/// can be indexed.
pub(super) fn partners_once<T: Take>(
    surface: &Surface,
    range: Range<usize>,
    plane: &Plane,
    viewpoint: DVec3,
    taker: T,
) -> T {
    let Some(neighbors) = surface.neighbors() else {
        return taker;
    };
    let order = &neighbors.order()[range];
    let (points, normals) = (
        columns(surface.points(), order),
        columns(surface.normals(), order),
    );
    FindPartners {
        taker,
        neighbors,
        order,
        points: points.each_ref().map(Vec::as_slice),
        normals: normals.each_ref().map(Vec::as_slice),
        normals_at: NormalsAt::Points(surface.normals()),
        plane,
        viewpoint,
    }
    .find()
}

fn columns(of: &[DVec3], order: &[u32]) -> [Vec<f64>; 3] {
    std::array::from_fn(|e| order.iter().map(|&i| of[i as usize][e]).collect())
}

/// Where the normal of a place of the tree is found.
#[derive(Clone, Copy)]
enum NormalsAt<'a> {
    /// In the tree's order.
    Places(&'a [DVec3]),
    /// Under the lowest index of its points.
    Points(&'a [DVec3]),
}

struct FindPartners<'a, T> {
    taker: T,
    neighbors: &'a Neighbors,
    /// The points' indices, and then the points and normals themselves.
    order: &'a [u32],
    points: [&'a [f64]; 3],
    normals: [&'a [f64]; 3],
    normals_at: NormalsAt<'a>,
    plane: &'a Plane,
    viewpoint: DVec3,
}

/// Points with a visible partner that wait until they are a block.
struct Waiting {
    count: usize,
    point: [u32; BLOCK + LANES],
    reflected: [[f64; BLOCK + LANES]; 3],
    normals: [[f64; BLOCK + LANES]; 3],
}

impl<T: Take> FindPartners<'_, T> {
    /// By the widest vector instructions that this machine has. They round like all others.
    fn find(self) -> T {
        pulp::Arch::new().dispatch(self)
    }
}

impl<T: Take> pulp::WithSimd for FindPartners<'_, T> {
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
            let mut seen = 0;
            for i in 0..LANES {
                seen += u32::from(facing[i] > 0.0);
            }
            let at = waiting.count;
            // Neighbors are mostly seen, or not, together.
            if seen == 0 {
                continue;
            }
            if seen as usize == LANES && lanes.len() == LANES {
                waiting.point[at..at + LANES].copy_from_slice(&order[lanes]);
                for e in 0..3 {
                    waiting.reflected[e][at..at + LANES].copy_from_slice(&p[e]);
                    waiting.normals[e][at..at + LANES].copy_from_slice(&n[e]);
                }
                waiting.count += LANES;
            } else {
                // Each is written, and then perhaps written over: no branch a point.
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
        self.taker
    }
}

impl<T: Take> FindPartners<'_, T> {
    /// The partners of the first `size` points that wait.
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
                NormalsAt::Places(normals) => &normals[at],
                NormalsAt::Points(normals) => &normals[partner[i] as usize],
            };
            for e in 0..3 {
                b[e][i] = normal[e];
            }
            distance[i] = nearest.distance_squared[i].sqrt();
        }
        let angle_rad = angles_between_directions_rad(&first_block(&waiting.normals), &b);
        self.taker.take(
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
    /// Points and normals reflected, and what is positive where the partner is visible: operation
    /// for operation what [`super::has_visible_partner`] does.
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
