//! The search for the body that explains a surface best: many starts, a few candidates, the best one.

use glam::DVec3;

use super::basis::{self, Basis};
use super::fit::{Problem, SIGMA};
use super::outline::{Comparison, Outline};
use super::pose::Pose;
use super::rows::Observations;
use super::shape::Body;
use crate::estimate::{EstimateError, Prior, Sample, Surface, View, half_sphere};
use crate::geometry::angle_between_lines_rad;
use crate::parallel::{Cancelled, Watch, map_pieces};

/// The starts of the search, and the steps of each.
const STARTS: (usize, usize) = (40, 6);
/// The steps of a candidate's last fit.
const LAST_STEPS: usize = 12;
/// Candidates: so many that are at least so many degrees apart, then so many that are farther apart.
const CANDIDATES: [(usize, f64); 2] = [(4, 8.0), (3, 25.0)];
/// The weight of the outline's misfit against the evidence, in the search and in the last fit.
const OUTLINE_WEIGHT: (f64, f64) = (10.0, 20.0);

/// A body that was fitted, with its cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The body.
    pub body: Body,
    /// The whole cost: the negative logarithm of the evidence, the outline's misfit and the prior.
    pub cost: f64,
    /// The part of the cost that the prior has.
    pub prior_cost: f64,
    /// The root mean square of the misfits, in units of the fruit's size.
    pub rms: f64,
    /// The body's outline against the seen one; `None` if there is none.
    pub outline: Option<Comparison>,
}

/// Everything that the search for a body found.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyFit {
    /// The bodies, the best first; at least one.
    pub candidates: Vec<Candidate>,
    /// The seen outline; `None` unless one camera saw the fruit.
    pub outline: Option<Outline>,
}

struct Search<'a> {
    surface: &'a Surface,
    prior: Prior,
    outline: Option<&'a Outline>,
}

/// Fits bodies to a surface from many starts.
///
/// # Errors
/// Returns an error if no body fits, or the watch cancels the work.
pub fn fit_bodies(surface: &Surface, prior: Prior, watch: &dyn Watch) -> Result<BodyFit, EstimateError> {
    let one_camera = surface.view == View::OneCamera;
    let outline = one_camera
        .then(|| Outline::of(&surface.points, &surface.normals))
        .flatten();
    let search = Search {
        surface,
        prior,
        outline: outline.as_ref(),
    };
    let rays = outline
        .as_ref()
        .map_or(Vec::new(), |o| o.rays(surface.size_cm, SIGMA));
    let few_rays = rays.iter().copied().step_by(2).collect();
    let coarse = observations(&surface.coarse, few_rays);
    let fine = observations(&surface.fine, rays);
    let starts: Vec<(DVec3, DVec3)> = half_sphere(STARTS.0)
        .into_iter()
        .map(|axis| (axis, surface.center))
        .collect();
    let mut found = search.fit_all(
        &basis::COARSE,
        &coarse,
        &starts,
        STARTS.1,
        OUTLINE_WEIGHT.0,
        watch,
    )?;
    sort(&mut found);
    let kept: Vec<(DVec3, DVec3)> = spread_out(&found)
        .iter()
        .map(|c| (c.body.pose.axis(), c.body.pose.center))
        .collect();
    let mut candidates = search.fit_all(&basis::FINE, &fine, &kept, LAST_STEPS, OUTLINE_WEIGHT.1, watch)?;
    sort(&mut candidates);
    if candidates.is_empty() {
        return Err(EstimateError::NoFit);
    }
    Ok(BodyFit { candidates, outline })
}

fn observations(sample: &Sample, rays: Vec<(DVec3, f64)>) -> Observations {
    Observations {
        points: sample.points.clone(),
        normals: sample.normals.clone(),
        rays,
    }
}

fn sort(candidates: &mut [Candidate]) {
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
}

/// The best candidates that are not all the same axis.
fn spread_out(sorted: &[Candidate]) -> Vec<&Candidate> {
    let mut kept: Vec<&Candidate> = Vec::new();
    let mut most = 0;
    for (count, apart_deg) in CANDIDATES {
        most += count;
        for candidate in sorted {
            let axis = candidate.body.pose.axis();
            let far =
                |k: &&Candidate| angle_between_lines_rad(k.body.pose.axis(), axis).to_degrees() > apart_deg;
            if kept.len() < most && kept.iter().all(far) {
                kept.push(candidate);
            }
        }
    }
    kept
}

impl Search<'_> {
    /// Fits a body from each start, an axis and a center. Those that fit come in the order of the starts.
    fn fit_all(
        &self,
        basis: &'static Basis,
        observations: &Observations,
        starts: &[(DVec3, DVec3)],
        steps: usize,
        outline_weight: f64,
        watch: &dyn Watch,
    ) -> Result<Vec<Candidate>, Cancelled> {
        let fitted = map_pieces(starts.len(), 1, watch, |range| {
            let (axis, center) = starts[range.start];
            self.fit(basis, observations, (axis, center), steps, outline_weight, watch)
        })?;
        let fitted: Result<Vec<_>, Cancelled> = fitted.into_iter().collect();
        Ok(fitted?.into_iter().flatten().collect())
    }

    fn fit(
        &self,
        basis: &'static Basis,
        observations: &Observations,
        (axis, center): (DVec3, DVec3),
        steps: usize,
        outline_weight: f64,
        watch: &dyn Watch,
    ) -> Result<Option<Candidate>, Cancelled> {
        let size = self.surface.size_cm;
        let (stretch, radius) = proportions(&observations.points, axis, center, size);
        let problem = Problem::new(basis, observations, radius, size, self.surface.center);
        let start = Pose::new(axis, center, stretch);
        let Some(fit) = problem.search(start, steps, watch)? else {
            return Ok(None);
        };
        let body = Body::new(fit.pose, fit.beta);
        let outline = self.outline.map(|seen| seen.compare(&body, size));
        let prior_cost = prior_cost(self.prior, body.pose);
        let misfit = outline.as_ref().map_or(0.0, |o| o.misfit);
        Ok(Some(Candidate {
            cost: fit.cost + outline_weight * misfit + prior_cost,
            prior_cost,
            rms: fit.rms / size,
            outline,
            body,
        }))
    }
}

/// The stretch of a body about an axis, and its expected radius in centimeters: those of a round fruit unless the points
/// reach much farther along the axis than across.
fn proportions(points: &[DVec3], axis: DVec3, center: DVec3, size: f64) -> (f64, f64) {
    /// The stretch below which a fruit counts as round.
    const ROUND: f64 = 1.5;
    let along = |p: &DVec3| (*p - center).dot(axis);
    let across = |p: &DVec3| (*p - center).cross(axis).length();
    let mut heights: Vec<f64> = points.iter().map(along).collect();
    let mut distances: Vec<f64> = points.iter().map(across).collect();
    heights.sort_unstable_by(f64::total_cmp);
    distances.sort_unstable_by(f64::total_cmp);
    let extent = quantile(&heights, 0.99) - quantile(&heights, 0.01);
    let stretch = 0.5 * extent / quantile(&distances, 0.9);
    // A comparison with NaN is false, as it should be here.
    if stretch > ROUND && stretch.is_finite() {
        (stretch, quantile(&distances, 0.5))
    } else {
        (1.0, size)
    }
}

/// The value below which a share of ascending values lies; zero if there are none.
fn quantile(ascending: &[f64], share: f64) -> f64 {
    let Some(last) = ascending.len().checked_sub(1) else {
        return 0.0;
    };
    let at = share * last as f64;
    let (low, part) = (at.floor() as usize, at.fract());
    ascending[low] + part * (ascending[(low + 1).min(last)] - ascending[low])
}

/// The cost of an axis by the assumption that was asked for.
fn prior_cost(prior: Prior, pose: Pose) -> f64 {
    match prior {
        Prior::None => 0.0,
        Prior::Lean { free_deg, sd_deg } => {
            let lean_deg = 90.0 - angle_between_lines_rad(pose.axis(), pose.center).to_degrees();
            0.5 * ((lean_deg - free_deg).max(0.0) / sd_deg).powi(2)
        }
        Prior::Up => {
            /// The standard deviation of fruits' axes from upright, in degrees.
            const SPREAD_DEG: f64 = 25.0;
            let from_up_deg = angle_between_lines_rad(pose.axis(), DVec3::Y).to_degrees();
            0.5 * (from_up_deg / SPREAD_DEG).powi(2)
        }
    }
}
