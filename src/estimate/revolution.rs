//! A surface of revolution with a free profile, fitted to the visible surface.
//!
//! About an axis a through c, a point has t = (p − c)·a / S along the axis and ρ = ‖(p − c) − ((p − c)·a) a‖ / S from it;
//! S is the fruit's size. The surface is ρ² = f(t), with the square of the profile as a series of Legendre polynomials,
//!
//! f(t) = Σ β_k P_k(t / T), k = 0..9,
//!
//! since a square has no vertical slope at the poles, and its first three terms hold every quadric of revolution (spheres,
//! spheroids, cones, cylinders) exactly. β is normally distributed: these three widely, the others narrowly. A residual
//! is Sampson's distance of first order, r = (ρ² − f) / √(4ρ² + f′²), under Huber's loss.
//!
//! The pose has four numbers: two turns of a and two shifts of c across it. A shift along a only relabels t. With q =
//! (p − c)/S, w its part across a, and g the denominator's inverse,
//!
//! ∂r/∂turn = −g (2t + f′) q,  ∂r/∂shift = −2 g w,  ∂r/∂β_k = −g P_k.
//!
//! Pose and β take Levenberg–Marquardt steps together, after which β, in which the problem is linear, is solved anew for
//! the new pose (variable projection). Poses are compared by the evidence: the loss at the best β, plus the prior's, plus
//! ½ log det of β's information, without which the axis with the most pliant profile would win.

use glam::DVec3;
use nalgebra::{DMatrix, DVector};

use super::fits::{Fit, distinct, estimate_of};
use super::robust::Huber;
use super::{
    Estimate, EstimateError, Estimator, LeastSquares, Linearized, Options, Prior, Sample, Surface,
    half_sphere, minimize,
};
use crate::parallel::{Watch, map_pieces};

/// Directions at which searches start.
const STARTS: usize = 40;
/// Axes of the search that are fitted to the fine sample.
const REFINED: usize = 6;
/// The terms of the profile in the search and in the last fit.
const TERMS: (usize, usize) = (6, 10);
const SEARCH: Options = Options {
    steps: 6,
    least_decrease: 0.02,
};
const REFINE: Options = Options {
    steps: 12,
    least_decrease: 0.002,
};
/// The standard deviation of the center about the first guess, relative to the size.
const CENTER_SD: f64 = 0.6;
/// The least of √(4ρ² + f′²): near a pole that the profile does not meet the distance is not of first order.
const LEAST_SLOPE: f64 = 0.6;
/// A lead below this may be chance.
const LEAST_LEAD: f64 = 3.0;

/// Fits a surface of revolution from many starts.
///
/// # Errors
/// Returns an error if no start leads to a fit, or the watch cancels the work.
pub(super) fn estimate(
    surface: &Surface,
    _prior: Prior,
    watch: &dyn Watch,
) -> Result<Estimate, EstimateError> {
    let starts = half_sphere(STARTS);
    let searches = Problem::new(surface, &surface.coarse, TERMS.0);
    let found = map_pieces(starts.len(), 1, watch, |range| {
        searches.fit(searches.start(starts[range.start], surface.center), SEARCH, watch)
    })?;
    let mut fits = Vec::new();
    for fit in found {
        fits.extend(fit?);
    }
    let fits = distinct(fits, REFINED, |(state, cost)| state.fit(*cost));
    let refines = Problem::new(surface, &surface.fine, TERMS.1);
    let refined = map_pieces(fits.len(), 1, watch, |range| {
        let (state, _) = &fits[range.start];
        refines.fit(refines.start(state.axis, state.center), REFINE, watch)
    })?;
    let mut fits = Vec::new();
    for fit in refined {
        fits.extend(fit?.map(|(state, cost)| state.fit(cost)));
    }
    let mut estimate = estimate_of(Estimator::Revolution, surface, fits)?;
    estimate.ambiguous = estimate.lead.is_some_and(|lead| lead < LEAST_LEAD);
    Ok(estimate)
}

/// A pose and a profile.
#[derive(Debug, Clone)]
struct State {
    axis: DVec3,
    center: DVec3,
    beta: DVector<f64>,
    /// T: the half range of t that the polynomials span.
    reach: f64,
}

impl State {
    fn fit(&self, cost: f64) -> Fit {
        Fit {
            direction: self.axis,
            center_cm: self.center,
            cost,
        }
    }
}

struct Problem<'a> {
    points: &'a [DVec3],
    size: f64,
    first_center: DVec3,
    terms: usize,
    loss: Huber,
}

/// A point about an axis.
struct Row {
    q: DVec3,
    across: DVec3,
    t: f64,
    basis: [f64; MOST_TERMS],
    /// f and its derivative by t.
    profile: (f64, f64),
    /// 1 / √(4ρ² + f′²).
    scale: f64,
    residual: f64,
}

const MOST_TERMS: usize = 10;

impl<'a> Problem<'a> {
    fn new(surface: &Surface, sample: &'a Sample, terms: usize) -> Self {
        Self {
            points: &sample.points,
            size: surface.size_cm,
            first_center: surface.center,
            terms,
            loss: Huber::of(sample.len()),
        }
    }

    /// The state at which a search starts: a sphere's profile, solved once.
    fn start(&self, axis: DVec3, center: DVec3) -> State {
        let along = self
            .points
            .iter()
            .map(|p| ((*p - center).dot(axis) / self.size).abs());
        let reach = 1.15 * along.fold(0.3, f64::max);
        let mut state = State {
            axis,
            center,
            beta: self.mean(reach),
            reach,
        };
        self.solve_profile(&mut state);
        state
    }

    /// The profile of a sphere of the fruit's size, 1 − t², as t² = T² (2 P₂ + P₀)/3.
    fn mean(&self, reach: f64) -> DVector<f64> {
        let mut mean = DVector::zeros(self.terms);
        mean[0] = 1.0 - reach * reach / 3.0;
        mean[2] = -2.0 / 3.0 * reach * reach;
        mean
    }

    /// The inverse variance of a term.
    fn precision(k: usize, reach: f64) -> f64 {
        let sd = match k {
            0 => 1.0,
            1 | 2 => 0.8 * reach.max(0.7),
            _ => 0.6 * (3.0 / k as f64).powi(2),
        };
        1.0 / (sd * sd)
    }

    fn row(&self, state: &State, point: DVec3) -> Row {
        let q = (point - state.center) / self.size;
        let t = q.dot(state.axis);
        let across = q - t * state.axis;
        // Beyond the range of the points, which moves with the pose, polynomials grow without bound.
        let x = (t / state.reach).clamp(-1.2, 1.2);
        let (basis, slopes) = legendre(x, self.terms);
        let (mut f, mut slope) = (0.0, 0.0);
        for k in 0..self.terms {
            f += state.beta[k] * basis[k];
            slope += state.beta[k] * slopes[k] / state.reach;
        }
        let squared = across.length_squared();
        let scale = 1.0 / (4.0 * squared + slope * slope).sqrt().max(LEAST_SLOPE);
        Row {
            q,
            across,
            t,
            basis,
            profile: (f, slope),
            scale,
            residual: (squared - f) * scale,
        }
    }

    /// Solves the profile for the pose, twice: the second time with the weights and slopes of the first.
    fn solve_profile(&self, state: &mut State) {
        for _ in 0..2 {
            let mut information = DMatrix::zeros(self.terms, self.terms);
            let mut right = DVector::zeros(self.terms);
            let mean = self.mean(state.reach);
            for k in 0..self.terms {
                let precision = Self::precision(k, state.reach);
                information[(k, k)] = precision;
                right[k] = precision * mean[k];
            }
            for &point in self.points {
                let row = self.row(state, point);
                let weight = self.loss.weight(row.residual) * row.scale * row.scale;
                let squared = row.across.length_squared();
                for i in 0..self.terms {
                    right[i] += weight * row.basis[i] * squared;
                    for j in 0..=i {
                        information[(i, j)] += weight * row.basis[i] * row.basis[j];
                    }
                }
            }
            // Cholesky's method reads the lower triangle alone.
            let Some(solved) = information.cholesky().map(|c| c.solve(&right)) else {
                return;
            };
            state.beta = solved;
        }
    }

    fn fit(
        &self,
        start: State,
        options: Options,
        watch: &dyn Watch,
    ) -> Result<Option<(State, f64)>, EstimateError> {
        let minimum = minimize(self, start, options, watch)?;
        Ok(minimum.map(|m| (m.state, m.linearized.cost)))
    }
}

/// The Legendre polynomials P₀..P_(terms−1) at x, and their derivatives.
fn legendre(x: f64, terms: usize) -> ([f64; MOST_TERMS], [f64; MOST_TERMS]) {
    let (mut p, mut slope) = ([0.0; MOST_TERMS], [0.0; MOST_TERMS]);
    (p[0], p[1], slope[1]) = (1.0, x, 1.0);
    for k in 2..terms {
        let n = k as f64;
        p[k] = ((2.0 * n - 1.0) * x * p[k - 1] - (n - 1.0) * p[k - 2]) / n;
        slope[k] = slope[k - 2] + (2.0 * n - 1.0) * p[k - 1];
    }
    (p, slope)
}

const POSE: usize = 4;

impl LeastSquares for Problem<'_> {
    type State = State;

    fn linearize(&self, state: &State) -> Option<Linearized> {
        let (e1, e2) = state.axis.any_orthonormal_pair();
        let mut problem = Linearized::zeros(POSE + self.terms);
        let mut derivatives = vec![0.0; POSE + self.terms];
        for &point in self.points {
            let row = self.row(state, point);
            let turn = -row.scale * (2.0 * row.t + row.profile.1);
            let shift = -2.0 * row.scale;
            derivatives[0] = turn * row.q.dot(e1);
            derivatives[1] = turn * row.q.dot(e2);
            derivatives[2] = shift * row.across.dot(e1);
            derivatives[3] = shift * row.across.dot(e2);
            for k in 0..self.terms {
                derivatives[POSE + k] = -row.scale * row.basis[k];
            }
            problem.add(row.residual, &derivatives, self.loss.weight(row.residual));
        }
        let mean = self.mean(state.reach);
        for k in 0..self.terms {
            let precision = Self::precision(k, state.reach);
            problem.information[(POSE + k, POSE + k)] += precision;
            problem.descent[POSE + k] -= precision * (state.beta[k] - mean[k]);
        }
        let off = (state.center - self.first_center) / self.size;
        let precision = 1.0 / (CENTER_SD * CENTER_SD);
        for (i, e) in [(2, e1), (3, e2)] {
            problem.information[(i, i)] += precision;
            problem.descent[i] -= precision * off.dot(e);
        }
        problem.cost = self.cost(state)?;
        Some(problem)
    }

    fn cost(&self, state: &State) -> Option<f64> {
        let mut information = DMatrix::zeros(self.terms, self.terms);
        let mean = self.mean(state.reach);
        let mut cost = 0.0;
        for k in 0..self.terms {
            let precision = Self::precision(k, state.reach);
            information[(k, k)] = precision;
            cost += 0.5 * precision * (state.beta[k] - mean[k]).powi(2) - 0.5 * precision.ln();
        }
        for &point in self.points {
            let row = self.row(state, point);
            cost += self.loss.loss(row.residual);
            let weight = self.loss.weight(row.residual) * row.scale * row.scale;
            for i in 0..self.terms {
                for j in 0..=i {
                    information[(i, j)] += weight * row.basis[i] * row.basis[j];
                }
            }
        }
        let off = (state.center - self.first_center) / self.size;
        let off = off - off.dot(state.axis) * state.axis;
        cost += 0.5 * off.length_squared() / (CENTER_SD * CENTER_SD);
        let factor = information.cholesky()?;
        // Half the logarithm of the determinant is the sum of the factor's.
        cost += factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        cost.is_finite().then_some(cost)
    }

    fn moved(&self, state: &State, step: &DVector<f64>) -> State {
        let (e1, e2) = state.axis.any_orthonormal_pair();
        let turn = (step[0] * e1 + step[1] * e2).clamp_length_max(0.35);
        let shift = (step[2] * e1 + step[3] * e2).clamp_length_max(0.5) * self.size;
        let mut moved = State {
            axis: (state.axis + turn).normalize(),
            center: state.center + shift,
            beta: &state.beta + step.rows(POSE, self.terms),
            reach: state.reach,
        };
        self.solve_profile(&mut moved);
        moved
    }
}
