//! The fit of a body to observations: its coefficients are solved for, its pose is searched.
//!
//! The cost of a pose is the negative logarithm of its evidence, the probability of the observations whatever the body's
//! coefficients β ~ N(μ, sd) are, by Laplace's approximation:
//! E = Σ huber(r/σ) + ½ Σ ((β−μ)/sd)² + Σ ln sd + ½ ln det A + ½ |c − c₀|² / (0.6 S)²,
//! with A the information of β. The best β of a pose is found by iterated least squares along with the steps of the pose.

use glam::DVec3;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SMatrix, SVector};

use super::basis::Basis;
use super::gram::weighted_gram;
use super::pose::{PARAMETERS, Pose};
use super::rows::{EXTRA, Observations};
use crate::parallel::{Cancelled, Watch};

/// The standard deviation of a misfit, in units of the fruit's size: noise, and what the harmonics cannot follow.
pub(super) const SIGMA: f64 = 0.035;
/// Huber's bound between squared and linear loss, in standard deviations.
const HUBER: f64 = 1.5;
/// The points of a surface err together. Their misfits count as those of so many independent ones.
const EFFECTIVE_POINTS: f64 = 250.0;
/// The expected distance of the center from its guess, in units of the fruit's size.
const CENTER_SPREAD: f64 = 0.6;
/// The longest step of the axis (radians), and of the center in units of the fruit's size.
const LONGEST: (f64, f64) = (0.35, 0.5);

/// What stays the same while a pose is searched.
#[derive(Debug)]
pub(super) struct Problem<'a> {
    basis: &'a Basis,
    observations: &'a Observations,
    /// The expected radius μ, and the spread of every coefficient, in centimeters.
    radius: f64,
    spreads: Vec<f64>,
    size: f64,
    center: DVec3,
    /// Weight of a squared misfit: the tempering, over σ².
    precision: f64,
}

/// A fitted body.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub(super) pose: Pose,
    pub(super) beta: Vec<f64>,
    /// E.
    pub(super) cost: f64,
    /// The weighted root mean square of the misfits, in centimeters.
    pub(super) rms: f64,
    /// The information of the pose, and minus the gradient of the cost by it.
    information: SMatrix<f64, PARAMETERS, PARAMETERS>,
    scale: SVector<f64, PARAMETERS>,
    descent: SVector<f64, PARAMETERS>,
    /// dβ/d(pose), by which the coefficients follow a step.
    follow: DMatrix<f64>,
}

fn huber(z: f64) -> f64 {
    if z <= HUBER {
        0.5 * z * z
    } else {
        HUBER * (z - 0.5 * HUBER)
    }
}

impl<'a> Problem<'a> {
    /// `radius` is the expected radius of the body and `size` the fruit's, in centimeters; `center` is the guess at the
    /// center.
    pub(super) fn new(
        basis: &'a Basis,
        observations: &'a Observations,
        radius: f64,
        size: f64,
        center: DVec3,
    ) -> Self {
        let points = observations.points.len().max(1) as f64;
        Self {
            basis,
            observations,
            radius,
            spreads: basis.spreads().iter().map(|s| s * radius).collect(),
            size,
            center,
            precision: EFFECTIVE_POINTS / points / (SIGMA * size).powi(2),
        }
    }

    /// Searches the pose of the least cost from `start` in at most `steps` steps; `None` if no body fits there.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if the watch cancels the work.
    pub(super) fn search(
        &self,
        start: Pose,
        steps: usize,
        watch: &dyn Watch,
    ) -> Result<Option<Fit>, Cancelled> {
        /// A decrease of the cost that ends the search.
        const LITTLE: f64 = 2e-3;
        let mut ball = vec![0.0; self.basis.terms()];
        ball[0] = self.radius;
        let Some(mut best) = self.fit(start, &ball, 2) else {
            return Ok(None);
        };
        let mut damping = 1e-2;
        for _ in 0..steps {
            if watch.is_cancelled() {
                return Err(Cancelled);
            }
            let Some(next) = self.step(&best, &mut damping) else {
                break;
            };
            let decrease = best.cost - next.cost;
            best = next;
            damping = (damping / 4.0).max(1e-4);
            if decrease < LITTLE {
                break;
            }
        }
        Ok(Some(best))
    }

    /// Returns the fit one step on; `None` if no damping of the step lowers the cost.
    fn step(&self, at: &Fit, damping: &mut f64) -> Option<Fit> {
        for _ in 0..3 {
            let damped = at.information + SMatrix::from_diagonal(&(at.scale * *damping));
            if let Some(cholesky) = damped.cholesky() {
                let step = self.shortened(cholesky.solve(&at.descent));
                let beta = DVector::from_column_slice(&at.beta) + &at.follow * step;
                let fit = self.fit(at.pose.moved(step.into()), beta.as_slice(), 1);
                if let Some(fit) = fit.filter(|fit| fit.cost < at.cost - 1e-9) {
                    return Some(fit);
                }
            }
            *damping *= 8.0;
        }
        None
    }

    /// A step no longer than one along which the misfits are still about linear.
    fn shortened(&self, mut step: SVector<f64, PARAMETERS>) -> SVector<f64, PARAMETERS> {
        for (from, to, longest) in [(0, 2, LONGEST.0), (2, PARAMETERS, LONGEST.1 * self.size)] {
            let mut part = step.rows_mut(from, to - from);
            let length = part.norm();
            if length > longest {
                part *= longest / length;
            }
        }
        step
    }

    /// Fits the coefficients to a pose, in `rounds` rounds of iterated least squares from `beta`; `None` if the numbers
    /// run out of range.
    fn fit(&self, pose: Pose, beta: &[f64], rounds: usize) -> Option<Fit> {
        let (terms, count) = (self.basis.terms(), self.observations.len());
        let width = terms + EXTRA;
        let mut rows = vec![0.0; width * count];
        self.observations.rows(self.basis, pose, beta, &mut rows);
        let sigma = SIGMA * self.size;
        let misfits = |beta: &[f64]| -> Vec<f64> {
            let misfit = |row: &[f64]| row[width - 1] - dot(&row[..terms], beta);
            rows.chunks_exact(width).map(misfit).collect()
        };
        let mut solved = beta.to_vec();
        let mut system = None;
        let mut weights = Vec::new();
        for _ in 0..rounds {
            let weight = |r: &f64| self.precision * (HUBER * sigma / r.abs()).min(1.0);
            weights = misfits(&solved).iter().map(weight).collect();
            let gram = weighted_gram(&rows, width, &weights);
            let block = |rows: std::ops::Range<usize>, from: usize, columns: usize| {
                let at = rows.start;
                DMatrix::from_fn(rows.len(), columns, |i, j| {
                    let (i, j) = (at + i, from + j);
                    gram[i.max(j) * width + i.min(j)]
                })
            };
            let mut information = block(0..terms, 0, terms);
            let mut right = block(0..terms, width - 1, 1).column(0).into_owned();
            for (j, spread) in self.spreads.iter().enumerate() {
                information[(j, j)] += spread.powi(-2);
            }
            right[0] += self.radius * self.spreads[0].powi(-2);
            let cholesky = Cholesky::new(information)?;
            solved = cholesky.solve(&right).as_slice().to_vec();
            system = Some((
                cholesky,
                block(0..terms, terms, PARAMETERS),
                block(terms..width, terms, PARAMETERS),
            ));
        }
        let (cholesky, by_pose, pose_block) = system?;
        let misfits = misfits(&solved);
        let cost = self.cost(&misfits, &solved, &cholesky, pose);
        if !cost.is_finite() {
            return None;
        }
        let follow = cholesky.solve(&by_pose);
        let beta = DVector::from_column_slice(&solved);
        let mut information: SMatrix<f64, PARAMETERS, PARAMETERS> =
            pose_block.fixed_view::<PARAMETERS, PARAMETERS>(0, 0).into_owned();
        // The last row of the Gram matrix has Jᵀ W k R, of which Jᵀ W k Σ β Y is taken.
        let with_radius = pose_block.row(PARAMETERS).transpose();
        let gradient = with_radius - by_pose.transpose() * beta;
        let mut descent = -SVector::<f64, PARAMETERS>::from_column_slice(gradient.as_slice());
        let precision = (CENTER_SPREAD * self.size).powi(-2);
        let away = pose.frame.transpose() * (pose.center - self.center);
        for (k, away) in away.to_array().into_iter().enumerate() {
            information[(2 + k, 2 + k)] += precision;
            descent[2 + k] -= precision * away;
        }
        let scale = information.diagonal();
        let coupled = by_pose.transpose() * &follow;
        information -= coupled.fixed_view::<PARAMETERS, PARAMETERS>(0, 0);
        let total: f64 = weights.iter().sum();
        let squared: f64 = misfits.iter().zip(&weights).map(|(r, w)| w * r * r).sum();
        Some(Fit {
            pose,
            beta: solved,
            cost,
            rms: (squared / total).sqrt(),
            information,
            scale,
            descent,
            follow,
        })
    }

    /// E.
    fn cost(&self, misfits: &[f64], beta: &[f64], cholesky: &Cholesky<f64, Dyn>, pose: Pose) -> f64 {
        let sigma = SIGMA * self.size;
        let mut cost: f64 = misfits.iter().map(|r| huber(r.abs() / sigma)).sum();
        cost *= self.precision * sigma * sigma;
        for (j, (&coefficient, &spread)) in beta.iter().zip(&self.spreads).enumerate() {
            let expected = if j == 0 { self.radius } else { 0.0 };
            cost += 0.5 * ((coefficient - expected) / spread).powi(2) + spread.ln();
        }
        cost += cholesky.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        let away = (pose.center - self.center) / (CENTER_SPREAD * self.size);
        cost + 0.5 * away.length_squared()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
