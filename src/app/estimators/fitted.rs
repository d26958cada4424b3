//! The fit of the body, and everything that panels show of it.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::time::Instant;

use crate::estimate::body::{BodyFit, Candidate, Outline, SECTORS, fit_bodies};
use crate::estimate::{Estimate, EstimateError, Estimator, Prior, Surface};
use crate::evaluate::surface_of_fruit;
use crate::fruit::Fruit;
use crate::method::{AxisEstimate, AxisSource, Params};
use crate::parallel::{Cancelled, Watch};
use crate::text::sentence;
use crate::view::BodyDrawing;

/// The points along the profile's line.
const PROFILE_STEPS: usize = 96;

/// The body's estimate with all that there is to show of it.
#[derive(Debug, Clone)]
pub struct BodyResult {
    /// The estimate; without an axis, its warning says why.
    pub estimate: Estimate,
    /// The time of the preparation and the fit, in milliseconds.
    pub ms: f64,
    /// The prior that it was fitted with.
    pub prior: Prior,
    /// The body; `None` without one.
    pub fitted: Option<FittedBody>,
}

/// A fitted body. Lengths are in centimeters.
#[derive(Debug, Clone)]
pub struct FittedBody {
    /// The body as the view draws it.
    pub drawing: Arc<BodyDrawing>,
    /// Its whole cost.
    pub cost: f64,
    /// The part of the cost that the prior has.
    pub prior_cost: f64,
    /// The part of the cost that the outline's excess has, before its weight; `None` without an outline.
    pub outline_misfit: Option<f64>,
    /// The root mean square of the misfits.
    pub rms_cm: f64,
    /// The profile of the body of revolution: the distance ρ from the axis and the place t along it, upward in the image.
    pub profile: Vec<[f64; 2]>,
    /// Points of the surface by ρ and t.
    pub profile_points: Vec<[f64; 2]>,
    /// The seen edge and the body's in every sector of the image where points tell it; empty without an outline.
    pub outline: Vec<OutlineSector>,
}

/// One sector of the outline, by distances from the middle of the points in the image, at the distance of the fruit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutlineSector {
    /// The direction in the image, from the right and turning downward, in radians.
    pub angle_rad: f64,
    /// The distance of the seen edge.
    pub seen_cm: f64,
    /// The distance of the body's edge, if the body reaches into the sector.
    pub body_cm: Option<f64>,
    /// Whether the seen edge is the fruit's own contour; else something hides the fruit there.
    pub is_contour: bool,
}

impl BodyResult {
    /// Fits the body to a fruit. `params` are in the file's unit, as the analysis has them.
    pub(super) fn of(
        fruit: &Fruit,
        params: &Params,
        prior: Prior,
        watch: &dyn Watch,
    ) -> Result<Self, Cancelled> {
        let began = Instant::now();
        let fit = surface_of_fruit(fruit, params, watch)
            .and_then(|surface| Ok((fit_bodies(&surface, prior, watch)?, surface)));
        let ms = 1e3 * began.elapsed().as_secs_f64();
        match fit {
            Ok((fit, surface)) => {
                let estimate = fit.estimate(&surface);
                let fitted = FittedBody::new(&fit, &surface, &estimate);
                Ok(Self {
                    estimate,
                    ms,
                    prior,
                    fitted,
                })
            }
            Err(EstimateError::Cancelled(cancelled)) => Err(cancelled),
            Err(error) => Ok(Self {
                estimate: Estimate::without_axis(Estimator::Body, sentence(&error.to_string())),
                ms,
                prior,
                fitted: None,
            }),
        }
    }
}

impl FittedBody {
    fn new(fit: &BodyFit, surface: &Surface, estimate: &Estimate) -> Option<Self> {
        let best = fit.candidates.first()?;
        let axis = estimate.axis.clone()?;
        let alternatives = estimate.alternatives.iter().map(|other| AxisEstimate {
            source: AxisSource::Fitted(Estimator::Body.name()),
            origin: axis.origin,
            direction: other.direction,
            confidence: None,
        });
        let drawing = BodyDrawing::new(&best.body, surface, axis.clone(), alternatives.collect());
        let pose = best.body.pose;
        // The body's own axis may point down, where the estimate's points up in the image.
        let upward = pose.axis().dot(axis.direction).signum();
        let profile = (0..=PROFILE_STEPS).map(|step| {
            let (t, rho) = best.body.profile(step as f64 / PROFILE_STEPS as f64 * PI);
            [rho, upward * t]
        });
        let points = surface.fine.points.iter().map(|&point| {
            let offset = point - pose.center;
            let t = offset.dot(axis.direction);
            [(offset - t * axis.direction).length(), t]
        });
        let outline = fit
            .outline
            .as_ref()
            .map_or_else(Vec::new, |seen| sectors(seen, best, surface));
        Some(Self {
            drawing: Arc::new(drawing),
            cost: best.cost,
            prior_cost: best.prior_cost,
            outline_misfit: best.outline.as_ref().map(|outline| outline.misfit),
            rms_cm: best.rms * surface.size_cm,
            profile: profile.collect(),
            profile_points: points.collect(),
            outline,
        })
    }
}

fn sectors(seen: &Outline, best: &Candidate, surface: &Surface) -> Vec<OutlineSector> {
    let distance_cm = surface.mean.length();
    let excess_cm = best.outline.as_ref().map(|outline| &outline.excess_cm);
    let sector = |(place, edge): (usize, &Option<crate::estimate::body::Edge>)| {
        let edge = (*edge)?;
        let excess_cm = excess_cm.and_then(|excess| excess.get(place).copied().flatten());
        Some(OutlineSector {
            angle_rad: (place as f64 + 0.5) / SECTORS as f64 * TAU - PI,
            seen_cm: distance_cm * edge.reach,
            body_cm: excess_cm.map(|excess| distance_cm * (edge.reach + excess / edge.depth)),
            is_contour: edge.is_contour(),
        })
    };
    seen.edges.iter().enumerate().filter_map(sector).collect()
}
