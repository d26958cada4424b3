//! One point's steps as JSON.

use serde::Serialize;

use super::PointRow;
use crate::method::{Candidate, PartnerSteps};

/// The steps of the method for one point under one plane (Eq. 12–15), in the file's unit and frame.
#[derive(Debug, Clone, Serialize)]
pub(super) struct PointReport {
    g: usize,
    h: usize,
    index: Option<usize>,
    position: [f64; 3],
    normal: [f64; 3],
    side: &'static str,
    plane_distance_cm: f64,
    reflection: [f64; 3],
    reflected_normal: [f64; 3],
    visibility_cm: f64,
    partner: Option<PartnerReport>,
}

#[derive(Debug, Clone, Serialize)]
struct PartnerReport {
    index: Option<usize>,
    position: [f64; 3],
    normal: [f64; 3],
    d_cm: f64,
    xi_rad: f64,
    score_cm: f64,
}

impl PointReport {
    pub(super) fn new(candidate: &Candidate, row: &PointRow) -> Self {
        let steps = &row.steps;
        let partner = |partner: &PartnerSteps| PartnerReport {
            index: row.partner_in_file,
            position: partner.position.to_array(),
            normal: partner.normal.to_array(),
            d_cm: partner.distance_cm,
            xi_rad: partner.angle_rad,
            score_cm: partner.score_cm,
        };
        Self {
            g: candidate.g,
            h: candidate.h,
            index: row.index_in_file,
            position: steps.position.to_array(),
            normal: steps.normal.to_array(),
            side: steps.side.name(),
            plane_distance_cm: steps.plane_distance_cm,
            reflection: steps.reflection.to_array(),
            reflected_normal: steps.reflected_normal.to_array(),
            visibility_cm: steps.visibility_cm,
            partner: steps.partner.as_ref().map(partner),
        }
    }
}
