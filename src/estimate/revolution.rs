//! A surface of revolution with a free profile, fitted to the visible surface.
//!
//! About an axis a through c, a point has t = (p − c)·a / S along the axis and ρ = ‖(p − c) − ((p − c)·a) a‖ / S from it;
//! S is the fruit's size. The surface is ρ² = f(t), with the square of the profile as a series of Legendre polynomials,
//!
//! f(t) = Σ `β_k` `P_k(t / T)`, k = 0..9,
//!
//! since a square has no vertical slope at the poles, and its first three terms hold every quadric of revolution (spheres,
//! spheroids, cones, cylinders) exactly. β is normally distributed: these three widely, the others narrowly. A residual
//! is Sampson's distance of first order, r = (ρ² − f) / √(4ρ² + f′²), under Huber's loss.
//!
//! Among the bodies that the starts end in, the outline in the image decides as well: one that reaches beyond the seen
//! contour cannot be the fruit (see [`super::body`]).
//!
//! The pose has four numbers: two turns of a and two shifts of c across it. A shift along a only relabels t. With q =
//! (p − c)/S, w its part across a, and g the denominator's inverse,
//!
//! ∂r/∂turn = −g (2t + f′) q,  ∂r/∂shift = −2 g w,  ∂r/∂`β_k` = −g `P_k`.
//!
//! Pose and β take Levenberg–Marquardt steps together, after which β, in which the problem is linear, is solved anew for
//! the new pose (variable projection). Poses are compared by the evidence: the loss at the best β, plus the prior's, plus
//! ½ log det of β's information, without which the axis with the most pliant profile would win.

use glam::DVec3;
use nalgebra::{DMatrix, DVector};

use super::robust::{Huber, rms};
use super::search::{self, Family, Fitted};
use super::{
    Estimate, EstimateError, Estimator, LeastSquares, Linearized, Options, Prior, Sample, Surface, minimize,
};
use crate::parallel::Watch;

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
/// A waist whose radius is below this share of that on either side parts two fruits.
const WAIST: f64 = 0.6;

/// Fits a surface of revolution from many starts.
///
/// # Errors
/// Returns an error if no start leads to a fit, or the watch cancels the work.
pub(super) fn estimate(
    surface: &Surface,
    prior: Prior,
    watch: &dyn Watch,
) -> Result<Estimate, EstimateError> {
    let family = Revolutions {
        coarse: Problem::new(surface, &surface.coarse, TERMS.0),
        fine: Problem::new(surface, &surface.fine, TERMS.1),
    };
    let starts = search::starts();
    let (mut estimate, best) =
        search::estimate(Estimator::Revolution, &family, &starts, surface, prior, watch)?;
    if family.fine.has_waist(&best.body) {
        estimate.ambiguous = true;
        let warning = "The profile has a deep waist: the points may be of two fruits.";
        estimate.warnings.push(warning.into());
    }
    Ok(estimate)
}

struct Revolutions<'a> {
    coarse: Problem<'a>,
    fine: Problem<'a>,
}

impl Family for Revolutions<'_> {
    type Body = State;

    /// Simulated fruits miss by up to 4.4 %, two peppers side by side by 4.3 to 5.8 %.
    const LARGEST_RMS: f64 = 0.047;

    fn search(&self, axis: DVec3, watch: &dyn Watch) -> Result<Option<Fitted<State>>, EstimateError> {
        let start = self.coarse.start(axis, self.coarse.first_center);
        self.coarse.fit(start, SEARCH, watch)
    }

    fn refine(&self, start: &State, watch: &dyn Watch) -> Result<Option<Fitted<State>>, EstimateError> {
        let start = self.fine.start(start.axis, start.center);
        self.fine.fit(start, REFINE, watch)
    }

    fn axis(&self, body: &State) -> (DVec3, DVec3) {
        (body.axis, body.center)
    }

    fn surface(&self, body: &State) -> Vec<DVec3> {
        const RINGS: usize = 40;
        const AROUND: usize = 56;
        let [low, high] = body.ends();
        let (e1, e2) = body.axis.any_orthonormal_pair();
        let mut points = Vec::with_capacity(RINGS * AROUND);
        for ring in 0..RINGS {
            let turn = (ring as f64 + 0.5) / RINGS as f64 * std::f64::consts::PI;
            let t = f64::midpoint(low, high) - 0.5 * (high - low) * turn.cos();
            let radius = body.profile(t).0.max(0.0).sqrt();
            for step in 0..AROUND {
                let (sin, cos) = (step as f64 / AROUND as f64 * std::f64::consts::TAU).sin_cos();
                let offset = t * body.axis + radius * (cos * e1 + sin * e2);
                points.push(body.center + self.fine.size * offset);
            }
        }
        points
    }
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
    /// f and its derivative at t. Beyond the range of the points, which moves with the pose, polynomials grow without
    /// bound.
    fn profile(&self, t: f64) -> (f64, f64) {
        let (basis, slopes) = legendre(self.argument(t), self.beta.len());
        let sum = |values: &[f64]| self.beta.iter().zip(values).map(|(b, v)| b * v).sum::<f64>();
        (sum(&basis), sum(&slopes) / self.reach)
    }

    fn argument(&self, t: f64) -> f64 {
        (t / self.reach).clamp(-1.2, 1.2)
    }

    /// Where the body ends along the axis: where f vanishes on either side of its largest value, or the series does.
    fn ends(&self) -> [f64; 2] {
        const STEPS: i32 = 60;
        let at = |i: i32| f64::from(i) / f64::from(STEPS) * 1.2 * self.reach;
        let f = |i: i32| self.profile(at(i)).0;
        let widest = (-STEPS..=STEPS).max_by(|&i, &j| f(i).total_cmp(&f(j)));
        let widest = widest.unwrap_or(0);
        let beyond = |step: i32| {
            let mut i = widest;
            while (i + step).abs() <= STEPS && f(i + step) > 0.0 {
                i += step;
            }
            at(i)
        };
        [beyond(-1), beyond(1)]
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
    /// The derivative of f.
    slope: f64,
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
            _ => 0.3 * (3.0 / k as f64).powi(2),
        };
        1.0 / (sd * sd)
    }

    fn row(&self, state: &State, point: DVec3) -> Row {
        let q = (point - state.center) / self.size;
        let t = q.dot(state.axis);
        let across = q - t * state.axis;
        let (basis, slopes) = legendre(state.argument(t), self.terms);
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
            slope,
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
    ) -> Result<Option<Fitted<State>>, EstimateError> {
        let minimum = minimize(self, start, options, watch)?;
        Ok(minimum.map(|minimum| Fitted {
            rms: rms(
                &self.loss,
                self.points.iter().map(|&p| self.row(&minimum.state, p).residual),
            ),
            cost: minimum.linearized.cost,
            body: minimum.state,
        }))
    }

    /// Whether the profile narrows deeply somewhere between the points' ends.
    fn has_waist(&self, state: &State) -> bool {
        const STEPS: usize = 40;
        let mut along: Vec<f64> = self.points.iter().map(|&p| self.row(state, p).t).collect();
        along.sort_unstable_by(f64::total_cmp);
        let Some((low, high)) = along.get(along.len() / 20).zip(along.get(along.len() * 19 / 20)) else {
            return false;
        };
        let at = |i: usize| low + (high - low) * i as f64 / STEPS as f64;
        let squares: Vec<f64> = (0..=STEPS).map(|i| state.profile(at(i)).0).collect();
        let largest = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        (1..STEPS).any(|i| {
            let sides = largest(&squares[..i]).min(largest(&squares[i + 1..]));
            squares[i] < WAIST * WAIST * sides
        })
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
            let turn = -row.scale * (2.0 * row.t + row.slope);
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
