//! The estimators, and the one call that runs any of them.

use serde::{Deserialize, Serialize};

use super::{Estimate, EstimateError, Surface, body, paper};
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
    /// A nearly rotational body of unknown shape: spherical harmonics about the axis.
    Body,
}

impl Estimator {
    /// All estimators, in the order of reports.
    pub const ALL: &[Self] = &[Self::Paper, Self::Body];

    /// Returns the name that the command line and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
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
        Estimator::Body => fitted(body::estimate),
    };
    match result {
        Err(EstimateError::Cancelled(cancelled)) => Err(cancelled),
        Err(error) => Ok(Estimate::without_axis(estimator, sentence(&error.to_string()))),
        Ok(estimate) => Ok(estimate),
    }
}
