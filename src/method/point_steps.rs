//! The steps of the method for one point under one plane (Eq. 12–15, Fig. 6).

use glam::DVec3;

use super::{Analysis, PlaneDetail, Side};
use crate::geometry::Plane;

/// The steps for one point. Positions and directions are in the file's frame, positions in its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSteps {
    /// The point's index in the surface.
    pub surface_index: usize,
    /// The point p.
    pub position: DVec3,
    /// Its unit normal n (Eq. 2).
    pub normal: DVec3,
    /// The plane.
    pub plane: Plane,
    /// The point's side of it.
    pub side: Side,
    /// The point's distance from the plane in centimeters, positive in front.
    pub plane_distance_cm: f64,
    /// p̈, the point's mirror image (Eq. 12).
    pub reflection: DVec3,
    /// ñ, its normal's mirror image (Eq. 13), of unit length.
    pub reflected_normal: DVec3,
    /// The viewpoint p_v.
    pub viewpoint: DVec3,
    /// ⟨ñ, p_v − p̈⟩ in centimeters (Eq. 14): positive where a partner would be visible.
    pub visibility_cm: f64,
    /// The visible partner; `None` if it would face away from the viewpoint.
    pub partner: Option<PartnerSteps>,
}

/// A point's reflection beside its nearest neighbor (Fig. 6a).
#[derive(Debug, Clone, PartialEq)]
pub struct PartnerSteps {
    /// The neighbor's index in the surface.
    pub surface_index: usize,
    /// The neighbor's position.
    pub position: DVec3,
    /// Its unit normal.
    pub normal: DVec3,
    /// d: the distance from the reflection to the neighbor, in centimeters.
    pub distance_cm: f64,
    /// ξ: the angle between the reflected normal and the neighbor's, in radians, 0 to π.
    pub angle_rad: f64,
    /// τ in centimeters per radian.
    pub tau_cm_per_rad: f64,
    /// τξ in centimeters.
    pub weighted_angle_cm: f64,
    /// S = d + τξ in centimeters (Eq. 15).
    pub score_cm: f64,
}

impl PointSteps {
    /// Computes the steps for a point by its index in the analysis' surface, under the plane of `detail`;
    /// `None` if there is no such point.
    pub fn new(analysis: &Analysis, detail: &PlaneDetail, surface_index: usize) -> Option<Self> {
        let (surface, params) = (&analysis.surface, &analysis.params);
        let position = *surface.points().get(surface_index)?;
        let normal = *surface.normals().get(surface_index)?;
        let point = *detail.points.get(surface_index)?;
        let plane = detail.plane;
        let reflection = plane.reflect_point(position);
        let reflected_normal = plane.reflect_direction(normal);
        let in_cm = params.unit.in_cm();
        let tau_cm_per_rad = params.tau_cm_per_rad;
        let partner = point.partner.and_then(|partner| {
            Some(PartnerSteps {
                surface_index: partner.index,
                position: *surface.points().get(partner.index)?,
                normal: *surface.normals().get(partner.index)?,
                distance_cm: partner.distance_cm,
                angle_rad: partner.angle_rad,
                tau_cm_per_rad,
                weighted_angle_cm: tau_cm_per_rad * partner.angle_rad,
                score_cm: partner.score_cm(tau_cm_per_rad),
            })
        });
        Some(Self {
            surface_index,
            position,
            normal,
            plane,
            side: point.side,
            plane_distance_cm: plane.signed_distance(position) * in_cm,
            reflection,
            reflected_normal,
            viewpoint: params.viewpoint,
            visibility_cm: reflected_normal.dot(params.viewpoint - reflection) * in_cm,
            partner,
        })
    }
}
