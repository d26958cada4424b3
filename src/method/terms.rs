//! What each candidate plane's score is made of (Eq. 12–15): n, ΣD and ΣΞ.

use glam::DVec3;

use super::partners::{Ordered, Take};
use super::{CandidateGrid, Surface};
use crate::geometry::{Plane, Unit};
use crate::parallel::{Cancelled, Watch, map_pieces};

/// The sums over one plane's points that have a visible partner. The score for any τ and any
/// aggregation follows from them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaneTerm {
    /// How many points have a visible symmetric partner.
    pub partners: usize,
    /// ΣD: the sum over them of d, the distance from the reflected point to its nearest neighbor,
    /// in centimeters.
    pub distance_sum_cm: f64,
    /// ΣΞ: the sum over them of ξ, the angle between the reflected normal and that neighbor's, in
    /// radians.
    pub angle_sum_rad: f64,
}

/// The terms of all u² planes, g-major.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneTerms {
    /// The planes.
    pub grid: CandidateGrid,
    /// One a plane, in the grid's order.
    pub terms: Vec<PlaneTerm>,
    /// How many points the surface has: what the partner fraction is a fraction of.
    pub points: usize,
}

/// Points that are summed in one go. Part of what makes a result repeat: the sums are added in this
/// order whatever the number of threads.
pub(super) const PIECE: usize = 2048;

/// Computes every candidate plane's terms on `surface`, for planes through `center`, seen from
/// `viewpoint` (both in the surface's unit and frame).
///
/// # Errors
/// [`Cancelled`] when the watch calls the work off.
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

/// Computes the terms of any planes, in their order; everything in the surface's unit and frame.
///
/// # Errors
/// [`Cancelled`] when the watch calls the work off.
pub fn terms_of_planes(
    surface: &Surface,
    unit: Unit,
    planes: &[Plane],
    viewpoint: DVec3,
    watch: &dyn Watch,
) -> Result<Vec<PlaneTerm>, Cancelled> {
    let Some(ordered) = Ordered::new(surface) else {
        return Ok(vec![PlaneTerm::default(); planes.len()]);
    };
    // One run of pieces over all planes' points, plane after plane, so that many cores find work
    // even where the planes are few.
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

/// Sums up what is found, point after point.
struct Sums {
    unit_in_cm: f64,
    term: PlaneTerm,
}

impl Take for Sums {
    #[inline]
    fn take(&mut self, points: &[u32], _partners: &[u32], distances: &[f64], angles_rad: &[f64]) {
        self.term.partners += points.len();
        for (distance, angle_rad) in distances.iter().zip(angles_rad) {
            self.term.distance_sum_cm += distance * self.unit_in_cm;
            self.term.angle_sum_rad += angle_rad;
        }
    }
}
