//! Every point's part in one plane's score: side, partner, d and ξ.

use glam::DVec3;

use super::Surface;
use super::partners::{Take, partners_once};
use super::terms::PIECE;
use crate::geometry::{Plane, Unit};
use crate::parallel::{Cancelled, Watch, map_pieces};

/// Which side of a plane a point lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The side that the normal points to, or in the plane.
    Front,
    /// The other side.
    Back,
}

/// A point's visible partner, and what it adds to the score.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Partner {
    /// The index of the nearest neighbor of the reflected point, in the surface.
    pub index: usize,
    /// d in centimeters.
    pub distance_cm: f64,
    /// ξ in radians, 0 to π.
    pub angle_rad: f64,
}

impl Partner {
    /// The point's score S = d + τ·ξ in centimeters (Eq. 15).
    pub fn score_cm(&self, tau_cm_per_rad: f64) -> f64 {
        self.distance_cm + tau_cm_per_rad * self.angle_rad
    }
}

/// One point under one plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointDetail {
    /// The point's side of the plane.
    pub side: Side,
    /// Its visible partner, if it has one.
    pub partner: Option<Partner>,
}

/// Every point of a surface under one plane.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneDetail {
    /// The plane.
    pub plane: Plane,
    /// One a point of the surface.
    pub points: Vec<PointDetail>,
}

/// Computes every point's part in the score of one plane, seen from `viewpoint`. Kept apart from
/// [`super::plane_terms`], since keeping it for all planes would take u²·N rows.
///
/// # Errors
/// [`Cancelled`] when the watch calls the work off.
pub fn plane_detail(
    surface: &Surface,
    unit: Unit,
    plane: Plane,
    viewpoint: DVec3,
    watch: &dyn Watch,
) -> Result<PlaneDetail, Cancelled> {
    let side = |&point: &DVec3| {
        if plane.signed_distance(point) >= 0.0 {
            Side::Front
        } else {
            Side::Back
        }
    };
    let mut points: Vec<PointDetail> = (surface.points().iter())
        .map(|point| PointDetail {
            side: side(point),
            partner: None,
        })
        .collect();
    // Nothing is indexed, and nothing found, where there are more points than can be.
    if surface.neighbors().is_some() {
        let pieces = map_pieces(surface.len(), PIECE, watch, |range| {
            let found = Found {
                unit_in_cm: unit.in_cm(),
                partners: Vec::with_capacity(range.len()),
            };
            partners_once(surface, range, &plane, viewpoint, found).partners
        })?;
        for (i, partner) in pieces.into_iter().flatten() {
            points[i as usize].partner = Some(partner);
        }
    }
    Ok(PlaneDetail { plane, points })
}

/// Keeps what is found, with the points' indices.
struct Found {
    unit_in_cm: f64,
    partners: Vec<(u32, Partner)>,
}

impl Take for Found {
    #[inline]
    fn take(&mut self, points: &[u32], partners: &[u32], distances: &[f64], angles_rad: &[f64]) {
        for i in 0..points.len() {
            let partner = Partner {
                index: partners[i] as usize,
                distance_cm: distances[i] * self.unit_in_cm,
                angle_rad: angles_rad[i],
            };
            self.partners.push((points[i], partner));
        }
    }
}
