//! The paper's estimator: the best plane of the grid and the axis that Eq. 16 gives for it.

use super::{Alternative, Estimate, Estimator, lead_over};
use crate::method::{Analysis, Warning};
use crate::text::sentence;

/// The planes after the best one that are reported as alternatives.
const ALTERNATIVES: usize = 5;

/// Reports the analysis as an estimate. Costs are scores in centimeters.
pub(super) fn estimate(analysis: &Analysis) -> Estimate {
    let scores = analysis.ranking.scores_cm();
    let considered = |&index: &usize| {
        let direction = analysis.axis_of(index).ok()?.direction;
        scores[index].map(|cost| Alternative { direction, cost })
    };
    let ranked: Vec<Alternative> = analysis.ranking.order().iter().filter_map(considered).collect();
    // The warnings about the points are the analysis's own, and stand in its report.
    let of_axis = |warning: &&Warning| {
        let about = [
            matches!(warning, Warning::Ambiguous { .. }),
            matches!(warning, Warning::NoSymmetryPlane(_) | Warning::NoAxis(_)),
            matches!(warning, Warning::HardlyAnyPartner { .. }),
        ];
        about.contains(&true)
    };
    let warnings: Vec<&Warning> = analysis.warnings.iter().filter(of_axis).collect();
    let (lead, alternatives) = match (&analysis.axis, ranked.split_first()) {
        (Some(_), Some((best, others))) => (
            lead_over(best, others),
            others.iter().take(ALTERNATIVES).copied().collect(),
        ),
        _ => (None, Vec::new()),
    };
    Estimate {
        estimator: Estimator::Paper,
        axis: analysis.axis.clone(),
        center: Some(analysis.center),
        confidence: None,
        ambiguous: !warnings.is_empty(),
        lead,
        alternatives,
        seen_share: None,
        occlusion: None,
        warnings: warnings.iter().map(|w| sentence(&w.to_string())).collect(),
    }
}
