//! The search that fitted bodies share: many starts on a coarse sample, then the best few on a fine one.

use glam::DVec3;

use super::body::Outline;
use super::{Alternative, Estimate, EstimateError, Estimator, Prior, Surface, View};
use crate::geometry::angle_between_lines_rad;
use crate::parallel::{Watch, map_pieces};

/// Directions at which searches start.
const STARTS: usize = 40;
/// Bodies of the search that are fitted to the fine sample: so many that are at least so many degrees apart, then so many
/// that are farther apart, since the best ones may all be of one valley.
const REFINED: [(usize, f64); 2] = [(4, SAME_DEG), (3, 25.0)];
/// Axes closer than this are one, found twice.
const SAME_DEG: f64 = 8.0;
/// The most alternatives that are reported.
const ALTERNATIVES: usize = 5;
/// The weight of the outline's misfit against the other costs.
const OUTLINE_WEIGHT: f64 = 20.0;
/// A lead below this may be chance: wrong axes of simulated fruits and axes of balls led by up to 4.
const LEAST_LEAD: f64 = 5.0;

/// The standard deviation of the body's radius, as a share of its mean, below which it is a ball, which has no axis.
const LEAST_SPREAD: f64 = 0.03;

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

    /// The misfit, relative to the fruit's size, above which the fruit is hardly of this family.
    const LARGEST_RMS: f64;

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
#[derive(Clone)]
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
        let mut found: Vec<Ranked<F::Body>> = found?.into_iter().flatten().collect();
        found.retain(|r| r.cost.is_finite());
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        Ok::<_, EstimateError>(found)
    };
    let searched = spread_out(&run(starts.len(), &|i| family.search(starts[i], watch))?);
    let refined = run(searched.len(), &|i| {
        family.refine(&searched[i].fitted.body, watch)
    })?;
    let refined = distinct(refined, usize::MAX, SAME_DEG, Vec::new());
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
    let mut doubt = |warning: String| {
        estimate.ambiguous = true;
        estimate.warnings.push(warning);
    };
    if best.fitted.rms > F::LARGEST_RMS {
        let percent = 100.0 * best.fitted.rms;
        doubt(format!(
            "The body misses the points by {percent:.1} % of the fruit's size, so that the fruit is hardly of its family."
        ));
    }
    if radius_spread(&family.surface(&best.fitted.body)) < LEAST_SPREAD {
        doubt("The body is about a ball, which has no axis.".into());
    }
    Ok((estimate, best.fitted))
}

type FitResult<B> = Result<Option<Fitted<B>>, EstimateError>;

/// The directions of the starts.
pub(super) fn starts() -> Vec<DVec3> {
    super::half_sphere(STARTS)
}

/// Adds to the bodies that are kept those of an ascending list whose axes are farther than `apart_deg` from all that are
/// kept, until there are `most`. The order of equal costs is that of the starts.
fn distinct<B>(
    ascending: Vec<Ranked<B>>,
    most: usize,
    apart_deg: f64,
    mut kept: Vec<Ranked<B>>,
) -> Vec<Ranked<B>> {
    for candidate in ascending {
        let apart =
            |other: &Ranked<B>| angle_between_lines_rad(other.axis, candidate.axis).to_degrees() > apart_deg;
        if kept.len() < most && kept.iter().all(apart) {
            kept.push(candidate);
        }
    }
    kept
}

/// Chooses the bodies that are fitted to the fine sample.
fn spread_out<B: Clone>(ascending: &[Ranked<B>]) -> Vec<Ranked<B>> {
    let (mut kept, mut most) = (Vec::new(), 0);
    for (count, apart_deg) in REFINED {
        most += count;
        kept = distinct(ascending.to_vec(), most, apart_deg, kept);
    }
    kept
}

/// The standard deviation of the distances of points from their mean, as a share of the mean distance.
fn radius_spread(points: &[DVec3]) -> f64 {
    let count = points.len() as f64;
    let mean = points.iter().sum::<DVec3>() / count;
    let distances = || points.iter().map(|p| p.distance(mean));
    let radius = distances().sum::<f64>() / count;
    (distances().map(|d| (d - radius).powi(2)).sum::<f64>() / count).sqrt() / radius
}
