//! What each candidate plane's score is made of (Eq. 12–15): n, ΣD and ΣΞ.

use glam::DVec3;

use super::{CandidateGrid, Surface, has_visible_partner};
use crate::geometry::map_pieces;
use crate::geometry::{Cancelled, Neighbors, Plane, Unit, Watch, angle_between_directions_rad};

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
const PIECE: usize = 2048;

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
    let Some(neighbors) = Neighbors::new(surface.points()) else {
        return Ok(vec![PlaneTerm::default(); planes.len()]);
    };
    // Points in an order in which each asks for nearly what the one before it asked for.
    let order = neighbors.order();
    // One run of pieces over all planes' points, plane after plane, so that many cores find work
    // even where the planes are few.
    let pieces_a_plane = surface.len().div_ceil(PIECE);
    let partial = map_pieces(planes.len() * pieces_a_plane, 1, watch, |range| {
        let (plane, piece) = (range.start / pieces_a_plane, range.start % pieces_a_plane);
        let range = piece * PIECE..((piece + 1) * PIECE).min(surface.len());
        let mut sum = PlaneTerm::default();
        let plane = &planes[plane];
        let (points, normals) = (surface.points(), surface.normals());
        let visible: Vec<usize> = order[range]
            .iter()
            .map(|&i| i as usize)
            .filter(|&i| has_visible_partner(plane, points[i], normals[i], viewpoint))
            .collect();
        let reflected: Vec<DVec3> = visible.iter().map(|&i| plane.reflect_point(points[i])).collect();
        for (i, nearest) in visible.into_iter().zip(neighbors.nearest_of_each(&reflected)) {
            sum.partners += 1;
            sum.distance_sum_cm += nearest.distance_squared.sqrt() * unit.in_cm();
            sum.angle_sum_rad +=
                angle_between_directions_rad(plane.reflect_direction(normals[i]), normals[nearest.index]);
        }
        sum
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

/// The partner of point `i` under `plane`: its index in the surface, d in the surface's unit, and ξ
/// in radians; `None` where it has no visible one.
pub(super) fn partner_of(
    surface: &Surface,
    neighbors: &Neighbors,
    plane: &Plane,
    viewpoint: DVec3,
    i: usize,
) -> Option<(usize, f64, f64)> {
    let (point, normal) = (surface.points()[i], surface.normals()[i]);
    if !has_visible_partner(plane, point, normal, viewpoint) {
        return None;
    }
    let nearest = neighbors.nearest(plane.reflect_point(point));
    let angle_rad =
        angle_between_directions_rad(plane.reflect_direction(normal), surface.normals()[nearest.index]);
    Some((nearest.index, nearest.distance_squared.sqrt(), angle_rad))
}
