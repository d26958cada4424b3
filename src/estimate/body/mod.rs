//! The estimator `body`: the axis of a nearly rotational body of unknown shape, by the evidence of the points.
//!
//! About a candidate axis through a center, a body that is star-shaped is R(s) = Σ `β_j` `Y_j(s)`, a sum of spherical
//! harmonics with the axis as their pole. The zonal ones are a free profile of revolution; those with m ≥ 1 are lobes and
//! are expected to be small. The probability of the points whatever β is (the evidence) tells how well *some* nearly
//! rotational body about this axis explains them, and is largest for the axis about which the fruit is most nearly
//! rotational. What tells right axes from those across them is often the outline: a body that reaches beyond the fruit's
//! true contour in the image cannot be the fruit.

mod basis;
mod confidence;
mod fit;
mod gram;
mod occlusion;
mod outline;
mod pose;
mod rows;
mod search;
mod shape;

pub use outline::{Comparison, Edge, Outline, SECTORS};
pub use pose::Pose;
pub use search::{BodyFit, Candidate, fit_bodies};
pub use shape::Body;

use glam::DVec3;

use super::{Alternative, Estimate, EstimateError, Estimator, Occlusion, Prior, Surface, View};
use crate::geometry::angle_between_lines_rad;
use crate::parallel::Watch;

/// Estimates the axis of a surface.
///
/// # Errors
/// Returns an error if no body fits, or the watch cancels the work.
pub(super) fn estimate(
    surface: &Surface,
    prior: Prior,
    watch: &dyn Watch,
) -> Result<Estimate, EstimateError> {
    let fit = fit_bodies(surface, prior, watch)?;
    Ok(fit.estimate(surface))
}

/// The narrowness of a waist from which on a body may be two fruits. Pears keep to 0.9 and more.
const WAIST: f64 = 0.8;

impl BodyFit {
    /// Returns the estimate that the fitted bodies give.
    pub fn estimate(&self, surface: &Surface) -> Estimate {
        let considered = |c: &Candidate| Alternative {
            direction: upward(c.body.pose.axis()),
            cost: c.cost,
        };
        let (best, others) = (&self.candidates[0], &self.candidates[1..]);
        let axis = considered(best);
        let others = distinct(&axis, others.iter().map(considered));
        let mut estimate = Estimate::fitted(Estimator::Body, surface, best.body.pose.center, &axis, others);
        let misfit = best.outline.as_ref().map_or(0.0, |outline| outline.misfit);
        let confidence = confidence::confidence(estimate.lead, misfit);
        estimate.confidence = Some(confidence);
        if let Some(axis) = &mut estimate.axis {
            axis.confidence = Some(confidence);
        }
        let has_waist = best.body.waist().is_some_and(|waist| waist < WAIST);
        estimate.ambiguous = has_waist || confidence::is_ambiguous(estimate.lead, confidence, best.rms);
        if let (Some(outline), Some(comparison)) = (&self.outline, &best.outline) {
            let share = occlusion::seen_share(outline, comparison);
            estimate.seen_share = Some(share);
            estimate.occlusion = Some(occlusion::occlusion(share));
        }
        estimate.warnings = self.warnings(surface, &estimate, has_waist);
        estimate
    }

    fn warnings(&self, surface: &Surface, estimate: &Estimate, has_waist: bool) -> Vec<String> {
        let mut warnings: Vec<String> = Vec::new();
        let mut warn = |text: &str| warnings.push(text.into());
        match surface.view {
            View::OneCamera if self.outline.is_none() => {
                warn("Points lie beside the camera or behind it, so that the fruit has no outline.");
            }
            View::OneCamera => {}
            View::Fused => warn(
                "Points lie behind one another, as in a cloud fused from several views: the axis is fitted without an outline.",
            ),
            View::Inside => {
                warn("The viewpoint lies among the points: the axis is fitted without an outline.");
            }
        }
        if self
            .outline
            .as_ref()
            .is_some_and(|outline| outline.contour_share() == 0.0)
        {
            warn("No edge of the points is the fruit's own contour, so that the outline tells nothing.");
        }
        if has_waist {
            warn("The fitted body has a waist, as two fruits in one cloud have: its axis may join them.");
        } else if estimate.ambiguous {
            warn(match estimate.lead {
                Some(lead) if lead < confidence::LEAST_LEAD => {
                    "Another axis explains the points about as well: the fruit may be turned otherwise."
                }
                _ => {
                    "The axis is not sure: the fitted body leads little over others, or fits the points badly."
                }
            });
        }
        if let (Some(Occlusion::Serious), Some(seen)) = (estimate.occlusion, estimate.seen_share) {
            let hidden = 100.0 * (1.0 - seen);
            warn(&format!(
                "Half of the fruit or more may be hidden: about {hidden:.0} % of its cross-section is not seen."
            ));
        }
        warnings
    }
}

/// The direction of an axis whose end is up in the image, where y points down.
fn upward(direction: DVec3) -> DVec3 {
    if direction.y > 0.0 { -direction } else { direction }
}

/// The alternatives that are not the best axis or one another again.
fn distinct(best: &Alternative, others: impl Iterator<Item = Alternative>) -> Vec<Alternative> {
    /// The angle in degrees below which two axes are one.
    const SAME_DEG: f64 = 4.0;
    let mut kept: Vec<Alternative> = Vec::new();
    for other in others {
        let far =
            |a: &Alternative| angle_between_lines_rad(a.direction, other.direction).to_degrees() > SAME_DEG;
        if far(best) && kept.iter().all(far) {
            kept.push(other);
        }
    }
    kept
}
