//! The error of a cloud against one of its reference axes, taken apart, in degrees.

use serde::{Deserialize, Serialize};

use crate::fruit::Fruit;
use crate::method::{AxisEstimate, AxisSource, CandidateAxes, ErrorParts, lean_rad};

/// The error against one reference axis, taken apart as [`ErrorParts`] explains: lean, grid and choice add up to it.
/// Angles are in degrees, 0 to 90.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ErrorBreakdown {
    /// The source of the reference axis, which counts as the truth.
    pub truth: String,
    /// The angle between that axis and the plane across the view ray, seen with the true center if it is known, else
    /// with the computed one.
    pub lean_deg: f64,
    /// The error; `None` without a symmetry axis.
    pub error_deg: Option<f64>,
    /// The part that Eq. 16 makes unavoidable: the lean as it is seen with the computed center.
    pub lean_part_deg: f64,
    /// The part of the grid: the excess of the nearest candidate's error over the lean.
    pub grid_part_deg: f64,
    /// The part of the choice of the plane: the excess of the error over the nearest candidate's; `None` without a
    /// symmetry axis.
    pub choice_part_deg: Option<f64>,
    /// The candidate whose axis is nearest to the reference.
    pub nearest_candidate: NearestPlane,
    /// The same with the true center given; `None` if it is not known.
    pub true_center: Option<GivenCenter>,
}

/// The candidate plane whose axis is nearest to a reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NearestPlane {
    /// Its step of α, from 1.
    pub g: u64,
    /// Its step of β, from 1.
    pub h: u64,
    /// Its place in the ranking of the scores, from 1; `None` if it has no score.
    pub rank: Option<u64>,
    /// The error of its axis.
    pub error_deg: f64,
}

/// The error of the analysis that was given the true center, and its parts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GivenCenter {
    /// The true center, in the file's unit and frame.
    pub center: [f64; 3],
    /// The distance of the computed center from it, in centimeters.
    pub distance_cm: f64,
    /// The error with it; `None` without a symmetry axis.
    pub error_deg: Option<f64>,
    /// The part of the lean.
    pub lean_part_deg: f64,
    /// The part of the grid.
    pub grid_part_deg: f64,
    /// The part of the choice of the plane; `None` without a symmetry axis.
    pub choice_part_deg: Option<f64>,
}

impl ErrorBreakdown {
    /// Takes the error of an analysis against a reference axis apart, and compares it with that of the analysis
    /// `at_true_center`, which was given the true center. `None` if Eq. 16 gives no axis at all, since the viewpoint is the center.
    ///
    /// The peduncle's reference of § 3.2 starts from the center in use, so with the true center it is another line.
    pub fn new(
        fruit: &Fruit,
        computed: &CandidateAxes<'_>,
        at_true_center: Option<&CandidateAxes<'_>>,
        reference: &AxisEstimate,
    ) -> Option<Self> {
        let analysis = computed.analysis();
        let parts = ErrorParts::new(computed, reference.direction).ok()?;
        let given = at_true_center.and_then(|axes| {
            let given = axes.analysis();
            let reference = match reference.source {
                AxisSource::Peduncle => &fruit.peduncle.as_ref()?.reference_axis(given.center).ok()?,
                _ => reference,
            };
            let parts = ErrorParts::new(axes, reference.direction).ok()?;
            let distance = analysis.center.distance(given.center);
            Some(GivenCenter {
                center: given.center.to_array(),
                distance_cm: distance * given.params.unit.in_cm(),
                error_deg: parts.error_rad.map(f64::to_degrees),
                lean_part_deg: parts.lean_rad.to_degrees(),
                grid_part_deg: parts.grid_rad().to_degrees(),
                choice_part_deg: parts.choice_rad().map(f64::to_degrees),
            })
        });
        let viewpoint = analysis.params.viewpoint;
        let center = fruit.truth.as_ref().map_or(analysis.center, |truth| truth.center);
        let nearest = parts.nearest;
        Some(Self {
            truth: reference.source.name().into_owned(),
            lean_deg: lean_rad(reference.direction, center, viewpoint)
                .ok()?
                .to_degrees(),
            error_deg: parts.error_rad.map(f64::to_degrees),
            lean_part_deg: parts.lean_rad.to_degrees(),
            grid_part_deg: parts.grid_rad().to_degrees(),
            choice_part_deg: parts.choice_rad().map(f64::to_degrees),
            nearest_candidate: NearestPlane {
                g: nearest.candidate.g as u64,
                h: nearest.candidate.h as u64,
                rank: nearest.rank.map(|rank| rank as u64),
                error_deg: nearest.error_rad.to_degrees(),
            },
            true_center: given,
        })
    }
}
