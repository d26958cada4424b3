//! The error over a range of the settings u and τ, with all others fixed.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Examination, TruthChoice, reference_of};
use crate::geometry::angle_between_lines_rad;
use crate::method::{CandidateGrid, ParamError, Ranking, plane_terms, symmetry_axis};
use crate::parallel::{Cancelled, Watch};

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

/// The reason why a cloud was not swept.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// A u is out of range.
    #[error(transparent)]
    Params(#[from] ParamError),
    /// The watch cancelled the work.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
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

/// Computes the error of one cloud in degrees at each setting, u-major; `None` where there is no axis or no
/// reference. The terms of the planes are computed once for each u, and ranked anew for each τ.
///
/// # Errors
/// Returns an error if a u is out of range, or the watch cancels the work.
pub fn sweep_cloud(
    examined: &Examination,
    choice: TruthChoice,
    settings: &SweepSettings,
    watch: &dyn Watch,
) -> Result<Vec<Option<f64>>, SweepError> {
    let analysis = &examined.analysis;
    let params = &analysis.params;
    let truth = reference_of(&examined.references, choice);
    let error_deg = |axis: DVec3| truth.map(|t| angle_between_lines_rad(axis, t.direction).to_degrees());
    let mut errors = Vec::with_capacity(settings.u.len() * settings.tau_cm_per_rad.len());
    for &u in &settings.u {
        let grid = CandidateGrid::new(u)?;
        let terms = plane_terms(
            &analysis.surface,
            params.unit,
            analysis.center,
            params.viewpoint,
            grid,
            watch,
        )?;
        for &tau in &settings.tau_cm_per_rad {
            let ranking = Ranking::new(&terms, tau, params.aggregation, params.min_partner_fraction);
            let axis = ranking.best().ok().and_then(|best| {
                symmetry_axis(grid.candidate(best).normal, analysis.center, params.viewpoint).ok()
            });
            errors.push(axis.and_then(error_deg));
        }
    }
    Ok(errors)
}
