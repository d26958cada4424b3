//! The error over a range of the settings u and τ, with all others fixed.

use serde::{Deserialize, Serialize};

use super::{Examination, TruthChoice, reference_of};
use crate::method::{AnalysisError, Observe, Params, axis_error_rad};

/// The settings to try: every u with every τ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepSettings {
    /// The numbers of steps of the candidate grid.
    pub u: Vec<usize>,
    /// The weights of the angle in centimeters per radian.
    pub tau_cm_per_rad: Vec<f64>,
}

/// The mean error of a set of clouds at each setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// The settings.
    pub settings: SweepSettings,
    sums_deg: Vec<f64>,
    counts: Vec<usize>,
}

impl Sweep {
    /// Creates a sweep without clouds.
    pub fn new(settings: SweepSettings) -> Self {
        let cells = settings.u.len() * settings.tau_cm_per_rad.len();
        Self {
            settings,
            sums_deg: vec![0.0; cells],
            counts: vec![0; cells],
        }
    }

    /// Adds the errors of one cloud in degrees, u-major.
    pub fn add(&mut self, errors_deg: &[Option<f64>]) {
        let cells = self.sums_deg.iter_mut().zip(&mut self.counts);
        for ((sum, count), error) in cells.zip(errors_deg) {
            if let Some(error) = error {
                *sum += error;
                *count += 1;
            }
        }
    }

    /// Returns the mean error in degrees and the number of clouds at a setting, given by its indices. There is no mean
    /// without clouds.
    pub fn cell(&self, u: usize, tau: usize) -> (Option<f64>, usize) {
        let i = u * self.settings.tau_cm_per_rad.len() + tau;
        let (sum, count) = (self.sums_deg[i], self.counts[i]);
        ((count > 0).then(|| sum / count as f64), count)
    }
}

/// Computes one cloud's error in degrees at each setting, u-major; `None` if it has no axis there or no
/// reference. The planes' terms are computed once for each u, and ranked anew for each τ.
///
/// # Errors
/// Returns an error if a u or τ is out of range, or `observe` cancels the work.
pub fn sweep_cloud(
    examined: &Examination,
    choice: TruthChoice,
    settings: &SweepSettings,
    observe: &dyn Observe,
) -> Result<Vec<Option<f64>>, AnalysisError> {
    let truth = reference_of(&examined.references, choice);
    let mut stages = examined.stages.clone();
    let mut errors = Vec::with_capacity(settings.u.len() * settings.tau_cm_per_rad.len());
    for &u in &settings.u {
        for &tau_cm_per_rad in &settings.tau_cm_per_rad {
            let params = Params {
                u,
                tau_cm_per_rad,
                ..examined.analysis.params.clone()
            };
            let axis = stages.analyze(&params, observe)?.axis;
            let error_rad = axis.zip(truth).map(|(axis, truth)| axis_error_rad(&axis, truth));
            errors.push(error_rad.map(f64::to_degrees));
        }
    }
    Ok(errors)
}
