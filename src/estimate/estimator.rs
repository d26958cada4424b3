//! The estimators, and the one call that runs any of them.

use std::fmt;
use std::str::FromStr;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Estimate, EstimateError, Surface, body, paper, plane, revolution, superquadric};
use crate::geometry::angle_between_lines_rad;
use crate::method::Analysis;
use crate::parallel::Cancelled;
use crate::parallel::Watch;
use crate::text::sentence;

/// A way to estimate the axis of a fruit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Estimator {
    /// The paper's: the best plane of the grid, and Eq. 16.
    Paper,
    /// The paper's plane refined without the grid, and Eq. 16.
    Plane,
    /// A tapered superquadric.
    Superquadric,
    /// A surface of revolution with a free profile.
    Revolution,
    /// A nearly rotational body of unknown shape: spherical harmonics about the axis.
    Body,
}

impl Estimator {
    /// All estimators, in the order of reports.
    pub const ALL: &[Self] = &[
        Self::Paper,
        Self::Plane,
        Self::Superquadric,
        Self::Revolution,
        Self::Body,
    ];

    /// Returns the name that the command line and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Plane => "plane",
            Self::Superquadric => "superquadric",
            Self::Revolution => "revolution",
            Self::Body => "body",
        }
    }
}

/// An assumption about the axis, beside the evidence of the points. It is named in every report of an estimate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Prior {
    /// No assumption.
    None,
    /// The axis leans towards the viewpoint, or away from it, by little: a soft form of Eq. 16, which allows no lean at
    /// all. Leans cost nothing up to `free_deg`, and beyond it as a normal distribution with the standard deviation
    /// `sd_deg`.
    Lean {
        /// The lean out of the image plane that costs nothing, in degrees.
        free_deg: f64,
        /// The standard deviation of what exceeds it, in degrees.
        sd_deg: f64,
    },
    /// The axis is about upright in the image, where y points down: fruits hang.
    Up,
}

impl Default for Prior {
    /// A lean of up to 30° out of the image plane is free: fruits hang, and cameras look about level.
    fn default() -> Self {
        Self::Lean {
            free_deg: 30.0,
            sd_deg: 8.0,
        }
    }
}

impl fmt::Display for Prior {
    /// Writes the prior as the command line takes it: `none`, `up`, or `lean=30,8` in degrees.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::Lean { free_deg, sd_deg } => write!(f, "lean={free_deg},{sd_deg}"),
            Self::Up => f.write_str("up"),
        }
    }
}

/// The text of no prior.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("expected none, up, or lean=FREE,SD in degrees, FREE from 0 to 90 and SD above 0")]
pub struct InvalidPrior;

impl FromStr for Prior {
    type Err = InvalidPrior;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let lean = |text: &str| {
            let (free, sd) = text.strip_prefix("lean=")?.split_once(',')?;
            let (free_deg, sd_deg) = (free.trim().parse().ok()?, sd.trim().parse().ok()?);
            let is_valid = (0.0..=90.0).contains(&free_deg) && sd_deg > 0.0 && f64::is_finite(sd_deg);
            is_valid.then_some(Self::Lean { free_deg, sd_deg })
        };
        match text {
            "none" => Ok(Self::None),
            "up" => Ok(Self::Up),
            _ => lean(text).ok_or(InvalidPrior),
        }
    }
}

/// The estimators to run on a cloud, and their assumption.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EstimateSettings {
    /// The estimators, each once.
    pub estimators: Vec<Estimator>,
    /// The assumption about the axis; the paper's estimator makes its own.
    pub prior: Prior,
}

impl Prior {
    /// Returns the cost of an axis through a center, relative to the viewpoint, by this assumption: the negative logarithm
    /// of its probability.
    pub(super) fn cost(self, axis: DVec3, center: DVec3) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Lean { free_deg, sd_deg } => {
                let lean_deg = 90.0 - angle_between_lines_rad(axis, center).to_degrees();
                0.5 * ((lean_deg - free_deg).max(0.0) / sd_deg).powi(2)
            }
            Self::Up => {
                /// The standard deviation of fruits' axes from upright, in degrees.
                const SPREAD_DEG: f64 = 25.0;
                let from_up_deg = angle_between_lines_rad(axis, DVec3::Y).to_degrees();
                0.5 * (from_up_deg / SPREAD_DEG).powi(2)
            }
        }
    }
}

/// Runs one estimator.
///
/// `surface` is the fruit without its peduncle, as far as the peduncle is known; `analysis` is the paper's, which the
/// paper's estimator reports. The result repeats to the bit on any number of threads. An error other than a cancellation
/// is an estimate without an axis, with the reason as its warning.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
pub fn estimate(
    estimator: Estimator,
    analysis: &Analysis,
    surface: &Result<Surface, EstimateError>,
    prior: Prior,
    watch: &dyn Watch,
) -> Result<Estimate, Cancelled> {
    let fitted = |run: fn(&Surface, Prior, &dyn Watch) -> Result<Estimate, EstimateError>| {
        run(surface.as_ref().map_err(|error| *error)?, prior, watch)
    };
    let result = match estimator {
        Estimator::Paper => Ok(paper::estimate(analysis)),
        Estimator::Plane => (surface.as_ref().map_err(|error| *error))
            .and_then(|surface| plane::estimate(surface, analysis, watch)),
        Estimator::Superquadric => fitted(superquadric::estimate),
        Estimator::Revolution => fitted(revolution::estimate),
        Estimator::Body => fitted(body::estimate),
    };
    match result {
        Err(EstimateError::Cancelled(cancelled)) => Err(cancelled),
        Err(error) => Ok(Estimate::without_axis(estimator, sentence(&error.to_string()))),
        Ok(estimate) => Ok(estimate),
    }
}
