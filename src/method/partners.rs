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

    /// The partners of the points of a range in this order.
    pub(super) fn partners(&self, range: Range<usize>, plane: &Plane, viewpoint: DVec3) -> Partners {
        FindPartners {
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
/// nothing is kept of the points beside the range. `None` for more points than can be indexed.
pub(super) fn partners_once(
    surface: &Surface,
    range: Range<usize>,
    plane: &Plane,
    viewpoint: DVec3,
) -> Option<Partners> {
    let neighbors = surface.neighbors()?;
    let order = &neighbors.order()[range];
    let (points, normals) = (
        columns(surface.points(), order),
        columns(surface.normals(), order),
    );
    let found = FindPartners {
        neighbors,
        order,
        points: points.each_ref().map(Vec::as_slice),
        normals: normals.each_ref().map(Vec::as_slice),
        normals_at: NormalsAt::Points(surface.normals()),
        plane,
        viewpoint,
    };
    Some(found.find())
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

struct FindPartners<'a> {
    neighbors: &'a Neighbors,
    /// The points' indices, and then the points and normals themselves.
    order: &'a [u32],
    points: [&'a [f64]; 3],
    normals: [&'a [f64]; 3],
    normals_at: NormalsAt<'a>,
    plane: &'a Plane,
    viewpoint: DVec3,
}

impl FindPartners<'_> {
    /// By the widest vector instructions that this machine has. They round like all others.
    fn find(self) -> Partners {
        pulp::Arch::new().dispatch(self)
    }
}

impl pulp::NullaryFnOnce for FindPartners<'_> {
    type Output = Partners;

    #[inline(always)]
    fn call(self) -> Partners {
        // Each block of lanes is written whole and then partly written over: no branch a point.
        let room = self.order.len() + LANES;
        let mut point = vec![0; room];
        let mut reflected = [vec![0.0; room], vec![0.0; room], vec![0.0; room]];
        let mut normals = [vec![0.0; room], vec![0.0; room], vec![0.0; room]];
        let mut count = 0;
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
            // Neighbors are mostly seen, or not, together.
            if seen == 0 {
                continue;
            }
            if seen as usize == LANES && lanes.len() == LANES {
                point[count..count + LANES].copy_from_slice(&order[lanes]);
                for e in 0..3 {
                    reflected[e][count..count + LANES].copy_from_slice(&p[e]);
                    normals[e][count..count + LANES].copy_from_slice(&n[e]);
                }
                count += LANES;
                continue;
            }
            for i in 0..lanes.len() {
                point[count] = order[from + i];
                for e in 0..3 {
                    reflected[e][count] = p[e][i];
                    normals[e][count] = n[e][i];
                }
                count += usize::from(facing[i] > 0.0);
            }
        }
        point.truncate(count);
        let nearest = self
            .neighbors
            .nearest_of_columns(reflected.each_ref().map(|column| &column[..count]));
        let first = self.neighbors.first();
        let mut found = Partners {
            point,
            index: nearest.position.iter().map(|&at| first[at as usize]).collect(),
            distance: nearest.distance_squared,
            angle_rad: vec![0.0; count],
        };
        for distance in &mut found.distance {
            *distance = distance.sqrt();
        }
        for from in (0..count).step_by(LANES) {
            let lanes = from..(from + LANES).min(count);
            let a = gather([&normals[0], &normals[1], &normals[2]], lanes.clone());
            let mut b = [[0.0; LANES]; 3];
            for (i, &at) in nearest.position[lanes.clone()].iter().enumerate() {
                let normal = match self.normals_at {
                    NormalsAt::Places(normals) => &normals[at as usize],
                    NormalsAt::Points(normals) => &normals[first[at as usize] as usize],
                };
                for e in 0..3 {
                    b[e][i] = normal[e];
                }
            }
            let angles = angles_between_directions_rad(&a, &b);
            found.angle_rad[lanes.clone()].copy_from_slice(&angles[..lanes.len()]);
        }
        found
    }
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
