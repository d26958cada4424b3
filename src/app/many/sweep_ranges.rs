//! The ranges of u and τ that a sweep goes through.

use serde::{Deserialize, Serialize};

use crate::evaluate::SweepSettings;
use crate::method::CandidateGrid;

/// The largest number of values of τ.
pub const MOST_TAUS: usize = 200;

/// The ranges of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SweepRanges {
    /// The smallest and the largest number of grid steps.
    pub u: [usize; 2],
    /// The step from one u to the next.
    pub u_step: usize,
    /// The smallest and the largest weight of angles, in centimeters per radian.
    pub tau_cm_per_rad: [f64; 2],
    /// The step from one weight to the next, in centimeters per radian.
    pub tau_step_cm_per_rad: f64,
    /// Whether only the current cloud is swept, instead of all that the table shows.
    pub only_current: bool,
}

impl Default for SweepRanges {
    fn default() -> Self {
        Self {
            u: [5, 16],
            u_step: 1,
            tau_cm_per_rad: [0.0, 2.0],
            tau_step_cm_per_rad: 0.25,
            only_current: false,
        }
    }
}

impl SweepRanges {
    /// Returns every setting; `None` if there is none, or if a range is invalid.
    pub fn settings(&self) -> Option<SweepSettings> {
        let [from, to] = self.u;
        let is_u_sound = CandidateGrid::new(from).is_ok() && CandidateGrid::new(to).is_ok() && from <= to;
        let [low, high] = self.tau_cm_per_rad;
        let step = self.tau_step_cm_per_rad;
        let is_tau_sound = low >= 0.0 && low <= high && high.is_finite() && step > 0.0 && step.is_finite();
        if !is_u_sound || !is_tau_sound || self.u_step == 0 {
            return None;
        }
        let count = ((high - low) / step + 1e-9).floor();
        if count >= MOST_TAUS as f64 {
            return None;
        }
        Some(SweepSettings {
            u: (from..=to).step_by(self.u_step).collect(),
            // Bounded just before.
            tau_cm_per_rad: (0..=count as usize)
                .map(|i| rounded(low + step * i as f64))
                .collect(),
        })
    }
}

/// Rounds away the error of added-up steps behind the ninth decimal.
fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}
