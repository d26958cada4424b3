//! Warnings: findings that make a result less certain without being errors.

use super::used_points::UsedPoints;
use super::{AxisError, BestPlane, Candidate, NoSymmetryPlane, NormalSource, Params, PlaneTerms};
use crate::geometry::angle_between_lines_rad;

/// A finding that makes the result less certain, without being an error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Warning {
    /// Strays were left out.
    #[error("{strays} of {points} points lie far from all others and are left out as strays")]
    StraysLeftOut {
        /// Points that were left out.
        strays: usize,
        /// Points of the cloud.
        points: usize,
    },
    /// Strays are analyzed with the other points.
    #[error(
        "{strays} of {points} points lie far from all others and are analyzed nevertheless: strays can turn the axis"
    )]
    StraysKept {
        /// Points that lie far from all others.
        strays: usize,
        /// Points of the cloud.
        points: usize,
    },
    /// A sample stands for the cloud.
    #[error(
        "{sampled} of {points} points are analyzed, the means of cubes of {edge_cm:.4} cm: more than the {most} that are allowed would take long"
    )]
    Sampled {
        /// Points of the sample, before those without a normal are left out.
        sampled: usize,
        /// Points before sampling, after the other filters.
        points: usize,
        /// The most points that [`super::Filters::max_points`] allowed.
        most: usize,
        /// The edge of the cubes in centimeters.
        edge_cm: f64,
    },
    /// Points without a normal were left out.
    #[error("{left_out} of {points} points have no normal and are left out")]
    PointsWithoutNormal {
        /// Points that were left out.
        left_out: usize,
        /// Points after the filters.
        points: usize,
    },
    /// k exceeds the number of points.
    #[error("k is {k}, but there are only {points} points: every normal is the whole cloud's")]
    FewerPointsThanNeighbors {
        /// k of Eq. 2.
        k: usize,
        /// Points after the filters.
        points: usize,
    },
    /// Many normals face away from the viewpoint.
    #[error(
        "{:.0} % of the normals face away from the viewpoint, as in a cloud fused from several views; the test for visible partners (Eq. 14) takes them at their word",
        100.0 * share
    )]
    NormalsFaceAway {
        /// Their share of all normals, 0 to 1.
        share: f64,
    },
    /// There is no symmetry plane.
    #[error("{0}")]
    NoSymmetryPlane(#[from] NoSymmetryPlane),
    /// There is no axis.
    #[error("{0}")]
    NoAxis(#[from] AxisError),
    /// The best plane's score is a sum over hardly any points.
    #[error(
        "the best plane wins with {partners} of {points} points: a sum over hardly any points is small, which is how Eq. 15 as printed goes wrong; compare the as-intended preset"
    )]
    HardlyAnyPartner {
        /// Points with a partner under the best plane.
        partners: usize,
        /// Used points.
        points: usize,
    },
    /// The runner-up is nearly as good.
    #[error(
        "the symmetry plane is ambiguous: the runner-up (g {}, h {}) scores only {:.1} % more and lies {:.0}° away",
        runner_up.g, runner_up.h, 100.0 * lead, angle_deg
    )]
    Ambiguous {
        /// The second best plane.
        runner_up: Candidate,
        /// The excess of its score, as a share of the best score.
        lead: f64,
        /// The angle between the two planes in degrees.
        angle_deg: f64,
    },
}

/// The share of normals that may face away from the viewpoint without a warning.
const FACING_AWAY_SHARE: f64 = 0.05;
/// The share of the points below which a plane has hardly any partner.
const HARDLY_ANY_SHARE: f64 = 0.1;
/// The lead, as a share of the best score, below which the best plane is called ambiguous: our own
/// convention, since the paper has none.
const AMBIGUOUS_LEAD: f64 = 0.02;

/// Warnings about the used points.
pub(super) fn point_warnings(used: &UsedPoints, params: &Params) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let (strays, points) = (used.strays.len(), used.all);
    if strays > 0 {
        warnings.push(if params.filters.keep_strays {
            Warning::StraysKept { strays, points }
        } else {
            Warning::StraysLeftOut { strays, points }
        });
    }
    let (points, k) = (used.filtered, params.k.get());
    if let Some(sample) = used.sample {
        warnings.push(Warning::Sampled {
            sampled: points,
            points: sample.points,
            most: params.filters.max_points,
            edge_cm: sample.edge * params.unit.in_cm(),
        });
    }
    if used.surface.len() < points {
        let left_out = points - used.surface.len();
        warnings.push(Warning::PointsWithoutNormal { left_out, points });
    }
    if params.normals == NormalSource::Estimate && k > points {
        warnings.push(Warning::FewerPointsThanNeighbors { k, points });
    }
    let share = used.facing_away as f64 / used.surface.len() as f64;
    if share > FACING_AWAY_SHARE {
        warnings.push(Warning::NormalsFaceAway { share });
    }
    warnings
}

/// Warnings about the best plane.
pub(super) fn plane_warnings(planes: &PlaneTerms, best: &Result<BestPlane, NoSymmetryPlane>) -> Vec<Warning> {
    let best = match best {
        Ok(best) => best,
        Err(none) => return vec![(*none).into()],
    };
    let mut warnings = Vec::new();
    let (partners, points) = (planes.terms[best.index].partners, planes.points);
    if (partners as f64) < HARDLY_ANY_SHARE * points as f64 {
        warnings.push(Warning::HardlyAnyPartner { partners, points });
    }
    if let (Some(lead), Some((runner_up, _))) = (best.lead(), best.runner_up)
        && lead < AMBIGUOUS_LEAD
    {
        let angle_rad = angle_between_lines_rad(best.candidate.normal, runner_up.normal);
        warnings.push(Warning::Ambiguous {
            runner_up,
            lead,
            angle_deg: angle_rad.to_degrees(),
        });
    }
    warnings
}
