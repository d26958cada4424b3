//! The search that fitted bodies share: many starts on a coarse sample, then the best few on a fine one.

use glam::DVec3;

use super::body::Outline;
use super::{Alternative, Estimate, EstimateError, Estimator, Prior, Surface, View};
use crate::geometry::angle_between_lines_rad;
use crate::parallel::{Watch, map_pieces};

/// Directions at which searches start.
const STARTS: usize = 40;
/// Bodies of the search that are fitted to the fine sample.
const REFINED: usize = 7;
/// Axes closer than this are one, found twice.
const SAME_DEG: f64 = 8.0;
/// The most alternatives that are reported.
const ALTERNATIVES: usize = 5;
/// The weight of the outline's misfit against the other costs.
const OUTLINE_WEIGHT: f64 = 20.0;
/// A lead below this may be chance.
const LEAST_LEAD: f64 = 4.0;

/// The misfit, relative to the fruit's size, above which the fruit is no body of the family.
const LARGEST_RMS: f64 = 0.0;

/// A body that was fitted.
#[derive(Debug, Clone)]
pub(super) struct Fitted<B> {
    pub(super) body: B,
    /// The negative logarithm of its probability, without the outline's part.
    pub(super) cost: f64,
    /// The root mean square of its weighted residuals, relative to the fruit's size.
    pub(super) rms: f64,
}

/// A family of bodies.
pub(super) trait Family: Sync {
    /// One body.
    type Body: Clone + Send + Sync;

    /// Fits a body to the coarse sample from an axis at which the search starts.
    ///
    /// # Errors
    /// Returns an error if the watch cancels the work.
    fn search(&self, axis: DVec3, watch: &dyn Watch) -> Result<Option<Fitted<Self::Body>>, EstimateError>;

    /// Fits a body to the fine sample.
    ///
    /// # Errors
    /// Returns an error if the watch cancels the work.
    fn refine(
        &self,
        start: &Self::Body,
        watch: &dyn Watch,
    ) -> Result<Option<Fitted<Self::Body>>, EstimateError>;

    /// The body's axis, and a point on it.
    fn axis(&self, body: &Self::Body) -> (DVec3, DVec3);

    /// Points all over the body's surface, about two degrees apart, in centimeters relative to the viewpoint.
    fn surface(&self, body: &Self::Body) -> Vec<DVec3>;
}

/// The best bodies of a search, the best first, each with its axis, the point on it and its whole cost.
struct Ranked<B> {
    fitted: Fitted<B>,
    axis: DVec3,
    center: DVec3,
    cost: f64,
    seen_share: Option<f64>,
}

/// Fits bodies of a family from many starts. Returns the estimate and the best body.
///
/// # Errors
/// Returns an error if no start leads to a fit, or the watch cancels the work.
pub(super) fn estimate<F: Family>(
    estimator: Estimator,
    family: &F,
    starts: &[DVec3],
    surface: &Surface,
    prior: Prior,
    watch: &dyn Watch,
) -> Result<(Estimate, Fitted<F::Body>), EstimateError> {
    let outline = (surface.view == View::OneCamera)
        .then(|| Outline::of(&surface.points, &surface.normals))
        .flatten();
    let rank = |fitted: Fitted<F::Body>| {
        let (axis, center) = family.axis(&fitted.body);
        let compared = (outline.as_ref())
            .map(|seen| seen.compare_points(family.surface(&fitted.body).into_iter(), surface.size_cm));
        let misfit = compared.as_ref().map_or(0.0, |c| c.misfit);
        Ranked {
            cost: fitted.cost + OUTLINE_WEIGHT * misfit + prior.cost(axis, center),
            seen_share: compared.map(|c| c.seen_share),
            axis,
            center,
            fitted,
        }
    };
    let run = |count: usize, fit: &(dyn Fn(usize) -> FitResult<F::Body> + Sync)| {
        let found = map_pieces(count, 1, watch, |range| Ok(fit(range.start)?.map(rank)))?;
        let found: Result<Vec<_>, EstimateError> = found.into_iter().collect();
        Ok::<_, EstimateError>(distinct(found?.into_iter().flatten().collect()))
    };
    let searched = run(starts.len(), &|i| family.search(starts[i], watch))?;
    let refined = run(searched.len().min(REFINED), &|i| {
        family.refine(&searched[i].fitted.body, watch)
    })?;
    let mut refined = refined.into_iter();
    let best = refined.next().ok_or(EstimateError::NoFit)?;
    let alternative = |ranked: &Ranked<F::Body>| Alternative {
        direction: ranked.axis,
        cost: ranked.cost,
    };
    let others = refined.take(ALTERNATIVES).map(|r| alternative(&r)).collect();
    let mut estimate = Estimate::fitted(estimator, surface, best.center, &alternative(&best), others);
    estimate.ambiguous = estimate.lead.is_some_and(|lead| lead < LEAST_LEAD);
    estimate.seen_share = best.seen_share;
    if best.fitted.rms > LARGEST_RMS {
        estimate.ambiguous = true;
        let percent = 100.0 * best.fitted.rms;
        let warning = format!(
            "The body misses the points by {percent:.1} % of the fruit's size: it is not of this family."
        );
        estimate.warnings.push(warning);
    }
    Ok((estimate, best.fitted))
}

type FitResult<B> = Result<Option<Fitted<B>>, EstimateError>;

/// The directions of the starts.
pub(super) fn starts() -> Vec<DVec3> {
    super::half_sphere(STARTS)
}

/// Sorts bodies by their costs and leaves out those whose axis is that of a better one. The order of equal costs is
/// that of the starts.
fn distinct<B>(mut ranked: Vec<Ranked<B>>) -> Vec<Ranked<B>> {
    ranked.retain(|r| r.cost.is_finite());
    ranked.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut kept: Vec<Ranked<B>> = Vec::new();
    for candidate in ranked {
        let apart =
            |other: &Ranked<B>| angle_between_lines_rad(other.axis, candidate.axis).to_degrees() > SAME_DEG;
        if kept.iter().all(apart) {
            kept.push(candidate);
        }
    }
    kept
}
