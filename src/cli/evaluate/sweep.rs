//! `--sweep`: the ranges of settings.

use std::str::FromStr;

use axiscope::evaluate::SweepSettings;
use axiscope::method::TAU_CM_PER_RAD;

use crate::cli::options::{grid_size, range};
use crate::cli::usage_error;

/// One range of settings.
#[derive(Debug, Clone)]
pub(super) enum SweepOption {
    U(Vec<usize>),
    Tau(Vec<f64>),
}

impl FromStr for SweepOption {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some(("u", values)) => {
                let whole = |u: f64| grid_size(&u.to_string());
                Ok(Self::U(
                    range(values)?.into_iter().map(whole).collect::<Result<_, _>>()?,
                ))
            }
            Some(("tau", values)) => {
                let values = range(values)?;
                if values[0] < 0.0 {
                    return Err("τ is 0 or more".into());
                }
                Ok(Self::Tau(values))
            }
            _ => Err("expected u=FROM..TO[:STEP] or tau=FROM..TO[:STEP]".into()),
        }
    }
}

impl SweepOption {
    /// Returns all settings to try; a setting without a range keeps its value. `None` without any range.
    pub(super) fn settings(
        options: &[Self],
        u: usize,
        tau: Option<f64>,
    ) -> anyhow::Result<Option<SweepSettings>> {
        let (mut u_range, mut tau_range) = (None, None);
        for option in options {
            let twice = match option {
                Self::U(values) => u_range.replace(values.clone()).is_some(),
                Self::Tau(values) => tau_range.replace(values.clone()).is_some(),
            };
            if twice {
                return Err(usage_error("--sweep names the same setting twice"));
            }
        }
        Ok((!options.is_empty()).then(|| SweepSettings {
            u: u_range.unwrap_or_else(|| vec![u]),
            tau_cm_per_rad: tau_range.unwrap_or_else(|| vec![tau.unwrap_or(TAU_CM_PER_RAD)]),
        }))
    }
}
