//! The estimator `body`: the axis of a nearly rotational body of unknown shape, by the evidence of the points.
//!
//! About a candidate axis through a center, a body that is star-shaped is R(s) = Σ β_j Y_j(s), a sum of spherical
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
        let confidence = confidence::confidence(estimate.lead, best.rms);
        estimate.confidence = Some(confidence);
        if let Some(axis) = &mut estimate.axis {
            axis.confidence = Some(confidence);
        }
        estimate.ambiguous = confidence::is_ambiguous(estimate.lead, confidence);
        if let (Some(outline), Some(comparison)) = (&self.outline, &best.outline) {
            let occlusion = occlusion::occlusion(outline, comparison);
            estimate.seen_share = Some(comparison.seen_share);
            estimate.occlusion = Some(occlusion);
        }
        self.warn(surface, &mut estimate);
        estimate
    }

    fn warn(&self, surface: &Surface, estimate: &mut Estimate) {
        let mut warn = |text: String| estimate.warnings.push(text);
        match surface.view {
            View::OneCamera if self.outline.is_none() => {
                warn("Points lie beside the camera or behind it, so that the fruit has no outline.".into());
            }
            View::OneCamera => {}
            View::Fused => warn(
                "Points lie behind one another, as in a cloud fused from several views: the axis is fitted without an outline."
                    .into(),
            ),
            View::Inside => {
                warn("The viewpoint lies among the points: the axis is fitted without an outline.".into());
            }
        }
        if let Some(outline) = &self.outline
            && outline.contour_share() == 0.0
        {
            warn(
                "No edge of the points is the fruit's own contour, so that the outline tells nothing.".into(),
            );
        }
        if estimate.ambiguous
            && let (Some(lead), Some(rival)) = (estimate.lead, estimate.alternatives.first())
        {
            let _ = (lead, rival);
        }
        if estimate.occlusion == Some(Occlusion::Serious) {
            let hidden = 100.0 * (1.0 - estimate.seen_share.unwrap_or(1.0));
            warn(format!(
                "Half of the fruit or more may be hidden: {hidden:.0} % of its outline's area is not seen."
            ));
        }
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
