//! The partners of many points under one plane (Eq. 11–15).

#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "only what is inlined is built for each kind of vector instructions; loops over lanes"
)]

use std::ops::Range;

use glam::DVec3;

use super::Surface;
use crate::geometry::{Neighbors, Plane, angles_between_directions_rad};

/// Points that are reflected together: what the widest vectors hold of double precision.
const LANES: usize = 8;

/// The points of a surface that have a visible partner, and that partner.
#[derive(Debug, Default)]
pub(super) struct Partners {
    /// The points' indices in the surface.
    pub(super) point: Vec<u32>,
    /// Their partners' indices.
    pub(super) index: Vec<u32>,
    /// d in the surface's unit.
    pub(super) distance: Vec<f64>,
    /// ξ in radians.
    pub(super) angle_rad: Vec<f64>,
}

/// A surface's points and normals in an order in which each point lies close to the one before it,
/// coordinate by coordinate.
pub(super) struct Ordered<'a> {
    surface: &'a Surface,
    neighbors: &'a Neighbors,
    points: [Vec<f64>; 3],
    normals: [Vec<f64>; 3],
}

impl<'a> Ordered<'a> {
    /// `None` for more points than can be indexed.
    pub(super) fn new(surface: &'a Surface) -> Option<Self> {
        let neighbors = surface.neighbors()?;
        let column = |of: &[DVec3], e: usize| neighbors.order().iter().map(|&i| of[i as usize][e]).collect();
        Some(Self {
            surface,
            neighbors,
            points: std::array::from_fn(|e| column(surface.points(), e)),
            normals: std::array::from_fn(|e| column(surface.normals(), e)),
        })
    }

    /// The partners of the points of a range in this order.
    pub(super) fn partners(&self, range: Range<usize>, plane: &Plane, viewpoint: DVec3) -> Partners {
        // The widest vector instructions that this machine has. They round like all others.
        pulp::Arch::new().dispatch(FindPartners {
            of: self,
            range,
            plane,
            viewpoint,
        })
    }
}

struct FindPartners<'a> {
    of: &'a Ordered<'a>,
    range: Range<usize>,
    plane: &'a Plane,
    viewpoint: DVec3,
}

impl pulp::NullaryFnOnce for FindPartners<'_> {
    type Output = Partners;

    #[inline(always)]
    fn call(self) -> Partners {
        let mut reflected = Vec::with_capacity(self.range.len());
        let mut reflected_normals = Vec::with_capacity(self.range.len());
        let mut found = Partners::default();
        found.point.reserve(self.range.len());
        let order = self.of.neighbors.order();
        for from in self.range.clone().step_by(LANES) {
            let lanes = from..(from + LANES).min(self.range.end);
            let (p, n) = (
                gather(&self.of.points, lanes.clone()),
                gather(&self.of.normals, lanes.clone()),
            );
            let (p, n, facing) = self.reflect(p, n);
            for i in 0..lanes.len() {
                if facing[i] > 0.0 {
                    found.point.push(order[from + i]);
                    reflected.push(DVec3::new(p[0][i], p[1][i], p[2][i]));
                    reflected_normals.push(DVec3::new(n[0][i], n[1][i], n[2][i]));
                }
            }
        }
        let nearest = self.of.neighbors.nearest_of_each(&reflected);
        found.index.reserve(nearest.len());
        found.distance.reserve(nearest.len());
        found.angle_rad.reserve(nearest.len());
        let normals = self.of.surface.normals();
        for (nearest, reflected) in nearest.chunks(LANES).zip(reflected_normals.chunks(LANES)) {
            let (mut a, mut b) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3]);
            for i in 0..nearest.len() {
                let normal = normals[nearest[i].index];
                for e in 0..3 {
                    a[e][i] = reflected[i][e];
                    b[e][i] = normal[e];
                }
            }
            let angles = angles_between_directions_rad(&a, &b);
            for i in 0..nearest.len() {
                found.index.push(nearest[i].index as u32);
                found.distance.push(nearest[i].distance_squared.sqrt());
                found.angle_rad.push(angles[i]);
            }
        }
        found
    }
}

type Lanes = [[f64; LANES]; 3];

#[inline(always)]
fn gather(columns: &[Vec<f64>; 3], lanes: Range<usize>) -> Lanes {
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

impl FindPartners<'_> {
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
