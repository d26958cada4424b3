//! Every point's part in one plane's score: side, partner, d and ξ.

use glam::DVec3;

use super::Surface;
use super::partners::{PartnerSink, partners_once};
use super::terms::PIECE;
use crate::geometry::{Plane, Unit};
use crate::parallel::{Cancelled, Watch, map_pieces};

/// A side of a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The side that the normal points to, with the plane itself.
    Front,
    /// The other side.
    Back,
}

impl Side {
    /// Returns its name in tables and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
        }
    }
}

/// The visible partner of a point, and its contribution to the score.
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
    /// Computes the point's score S = d + τ·ξ in centimeters (Eq. 15).
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
    /// One for each point of the surface.
    pub points: Vec<PointDetail>,
}

/// Computes every point's part in the score of one plane, seen from `viewpoint`; plane and viewpoint are
/// in the surface's unit and frame. [`super::plane_terms`] keeps only the sums, since the details of all
/// planes would take u²·N rows.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
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
    // A surface of more points than the search tree can hold has no partners.
    if surface.neighbors_watched(watch)?.is_some() {
        let pieces = map_pieces(surface.len(), PIECE, watch, |range| {
            let list = PartnerList {
                unit_in_cm: unit.in_cm(),
                partners: Vec::with_capacity(range.len()),
            };
            partners_once(surface, range, &plane, viewpoint, list).partners
        })?;
        for (i, partner) in pieces.into_iter().flatten() {
            points[i as usize].partner = Some(partner);
        }
    }
    Ok(PlaneDetail { plane, points })
}

/// The partners of some points, with the points' indices.
struct PartnerList {
    unit_in_cm: f64,
    partners: Vec<(u32, Partner)>,
}

impl PartnerSink for PartnerList {
    #[inline]
    fn accept(&mut self, points: &[u32], partners: &[u32], distances: &[f64], angles_rad: &[f64]) {
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
