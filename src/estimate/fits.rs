//! The fits that the starts of a search end in: the best one becomes the estimate, the others its alternatives.

use glam::DVec3;

use super::{Alternative, Estimate, EstimateError, Estimator, Surface};
use crate::geometry::angle_between_lines_rad;

/// One fit: an axis through a center (both as in [`Surface`]) and its cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fit {
    pub(super) direction: DVec3,
    pub(super) center_cm: DVec3,
    pub(super) cost: f64,
}

/// Axes closer than this are one, found twice.
const SAME_DEG: f64 = 8.0;
/// The most alternatives that are reported.
const ALTERNATIVES: usize = 5;

/// Sorts fits by their costs, leaves out those whose axis is that of a better one, and keeps at most `most`. The order
/// of equal costs is that of the starts.
pub(super) fn distinct<T>(mut fits: Vec<T>, most: usize, fit: impl Fn(&T) -> Fit) -> Vec<T> {
    fits.retain(|f| fit(f).cost.is_finite());
    fits.sort_by(|a, b| fit(a).cost.total_cmp(&fit(b).cost));
    let mut kept: Vec<T> = Vec::with_capacity(most);
    for candidate in fits {
        let axis = fit(&candidate).direction;
        let apart = |other: &T| angle_between_lines_rad(fit(other).direction, axis).to_degrees() > SAME_DEG;
        if kept.len() < most && kept.iter().all(apart) {
            kept.push(candidate);
        }
    }
    kept
}

/// Makes an estimate of fits, the first of which is the best.
///
/// # Errors
/// Returns an error if there is none.
pub(super) fn estimate_of(
    estimator: Estimator,
    surface: &Surface,
    fits: Vec<Fit>,
) -> Result<Estimate, EstimateError> {
    let fits = distinct(fits, ALTERNATIVES + 1, |fit| *fit);
    let (best, others) = fits.split_first().ok_or(EstimateError::NoFit)?;
    let alternative = |fit: &Fit| Alternative {
        direction: fit.direction,
        cost: fit.cost,
    };
    let others = others.iter().map(alternative).collect();
    Ok(Estimate::fitted(
        estimator,
        surface,
        best.center_cm,
        &alternative(best),
        others,
    ))
}
