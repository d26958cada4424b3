//! The terms of each candidate plane's score (Eq. 12–15): n, ΣD and ΣΞ.

use glam::DVec3;

use super::partners::{OrderedSurface, PartnerSink};
use super::{CandidateGrid, Surface};
use crate::geometry::{Plane, Unit};
use crate::parallel::{Cancelled, Watch, map_pieces};

/// The sums over one plane's points that have a visible partner. The score for any τ and any
/// aggregation follows from them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaneTerm {
    /// n: the number of points that have a visible symmetric partner.
    pub partners: usize,
    /// ΣD: the sum over them of d, the distance from the reflected point to its nearest neighbor,
    /// in centimeters.
    pub distance_sum_cm: f64,
    /// ΣΞ: the sum over them of ξ, the angle between the reflected normal and that neighbor's, in
    /// radians.
    pub angle_sum_rad: f64,
}

/// The terms of all u² candidate planes, g-major.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneTerms {
    /// The planes.
    pub grid: CandidateGrid,
    /// One for each plane, in the grid's order.
    pub terms: Vec<PlaneTerm>,
    /// The number of points of the surface, which the partner fraction is a fraction of.
    pub points: usize,
}

/// Points of a piece of work. The sums of the pieces are added in a fixed order, so that the result is the
/// same to the bit on any number of threads; another size would give other last digits.
pub(super) const PIECE: usize = 2048;

/// Computes every candidate plane's terms on `surface`, for planes through `center`, seen from
/// `viewpoint` (both in the surface's unit and frame).
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
pub fn plane_terms(
    surface: &Surface,
    unit: Unit,
    center: DVec3,
    viewpoint: DVec3,
    grid: CandidateGrid,
    watch: &dyn Watch,
) -> Result<PlaneTerms, Cancelled> {
    let planes: Vec<Plane> = grid
        .candidates()
        .map(|candidate| Plane {
            point: center,
            normal: candidate.normal,
        })
        .collect();
    Ok(PlaneTerms {
        grid,
        terms: terms_of_planes(surface, unit, &planes, viewpoint, watch)?,
        points: surface.len(),
    })
}

/// Computes the terms of any planes, in their order. Planes and viewpoint are in the surface's unit and
/// frame.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
pub fn terms_of_planes(
    surface: &Surface,
    unit: Unit,
    planes: &[Plane],
    viewpoint: DVec3,
    watch: &dyn Watch,
) -> Result<Vec<PlaneTerm>, Cancelled> {
    surface.neighbors_watched(watch)?;
    let Some(ordered) = OrderedSurface::new(surface) else {
        return Ok(vec![PlaneTerm::default(); planes.len()]);
    };
    // One sequence of pieces over the points of all planes, plane after plane, so that there is work for
    // many cores even if the planes are few.
    let pieces_a_plane = surface.len().div_ceil(PIECE);
    let partial = map_pieces(planes.len() * pieces_a_plane, 1, watch, |range| {
        let (plane, piece) = (range.start / pieces_a_plane, range.start % pieces_a_plane);
        let range = piece * PIECE..((piece + 1) * PIECE).min(surface.len());
        let sums = Sums {
            unit_in_cm: unit.in_cm(),
            term: PlaneTerm::default(),
        };
        ordered.partners(range, &planes[plane], viewpoint, sums).term
    })?;
    let whole = |pieces: &[PlaneTerm]| {
        pieces.iter().fold(PlaneTerm::default(), |sum, piece| PlaneTerm {
            partners: sum.partners + piece.partners,
            distance_sum_cm: sum.distance_sum_cm + piece.distance_sum_cm,
            angle_sum_rad: sum.angle_sum_rad + piece.angle_sum_rad,
        })
    };
    Ok(partial.chunks(pieces_a_plane).map(whole).collect())
}

/// Adds up the contributions of the points, one after the other.
struct Sums {
    unit_in_cm: f64,
    term: PlaneTerm,
}

impl PartnerSink for Sums {
    #[inline]
    fn accept(&mut self, points: &[u32], _partners: &[u32], distances: &[f64], angles_rad: &[f64]) {
        self.term.partners += points.len();
        for (distance, angle_rad) in distances.iter().zip(angles_rad) {
            self.term.distance_sum_cm += distance * self.unit_in_cm;
            self.term.angle_sum_rad += angle_rad;
        }
    }
}
