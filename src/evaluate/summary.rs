//! Statistics over the rows of many clouds.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Row;

/// Statistics of the errors of a set of clouds, and the reasons why some have none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Clouds in the set.
    pub clouds: usize,
    /// Clouds that have an error.
    pub measured: usize,
    /// Mean error in degrees.
    pub mean_deg: Option<f64>,
    /// Median error in degrees (the mean of the middle two of an even number).
    pub median_deg: Option<f64>,
    /// 95th percentile in degrees: the smallest error that 95 % of the clouds do not exceed.
    pub p95_deg: Option<f64>,
    /// The worst error in degrees, and its file.
    pub worst: Option<Worst>,
    /// Share of the measured clouds under 5°, 0 to 1.
    pub share_under_5_deg: Option<f64>,
    /// Share of the measured clouds under 10°, 0 to 1.
    pub share_under_10_deg: Option<f64>,
    /// Share of the measured clouds under 15°, 0 to 1.
    pub share_under_15_deg: Option<f64>,
    /// The number of clouds without an error, by reason.
    pub failures: BTreeMap<String, usize>,
}

/// The cloud with the largest error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Worst {
    /// The file's name.
    pub file: String,
    /// The error in degrees.
    pub error_deg: f64,
}

impl Summary {
    /// Computes the statistics of the rows.
    pub fn of(rows: &[Row]) -> Self {
        let mut errors: Vec<(f64, &str)> = rows
            .iter()
            .filter_map(|row| Some((row.error_deg?, row.file.as_str())))
            .collect();
        errors.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(a.1)));
        let count = errors.len();
        let some = |value: f64| (count > 0).then_some(value);
        let share_under = |limit: f64| {
            let under = errors.iter().filter(|e| e.0 < limit).count();
            some(under as f64 / count as f64)
        };
        let median = || f64::midpoint(errors[(count - 1) / 2].0, errors[count / 2].0);
        let mut failures = BTreeMap::new();
        for reason in rows.iter().filter_map(|row| row.failure.as_ref()) {
            *failures.entry(reason.clone()).or_insert(0) += 1;
        }
        Self {
            clouds: rows.len(),
            measured: count,
            mean_deg: some(errors.iter().map(|e| e.0).sum::<f64>() / count as f64),
            median_deg: (count > 0).then(median),
            p95_deg: (count > 0).then(|| errors[(count * 95).div_ceil(100) - 1].0),
            worst: errors.last().map(|&(error_deg, file)| Worst {
                file: file.into(),
                error_deg,
            }),
            share_under_5_deg: share_under(5.0),
            share_under_10_deg: share_under(10.0),
            share_under_15_deg: share_under(15.0),
            failures,
        }
    }
}
