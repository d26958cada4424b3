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
    /// The means of the parts of the error; `None` if no cloud has them.
    pub error_parts: Option<MeanParts>,
    /// The mean share of the fruit's surface that the camera saw, over the clouds whose truth tells it, 0 to 1.
    pub mean_coverage: Option<f64>,
    /// The number of clouds without an error, by reason.
    pub failures: BTreeMap<String, usize>,
}

/// The means of the parts of the error over the clouds that have one, in degrees. The three parts add up to the error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeanParts {
    /// The number of clouds.
    pub clouds: usize,
    /// The error.
    pub error_deg: f64,
    /// The lean of the true axis.
    pub lean_deg: f64,
    /// The part that is unavoidable by the lean.
    pub lean_part_deg: f64,
    /// The part of the grid.
    pub grid_part_deg: f64,
    /// The part of the choice of the plane.
    pub choice_part_deg: f64,
    /// The share of the center; `None` if no cloud's true center is known.
    pub true_center: Option<MeanGivenCenter>,
}

/// The means over the clouds with an error both with the computed and with the true center.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeanGivenCenter {
    /// The number of clouds.
    pub clouds: usize,
    /// The error with the computed center in degrees.
    pub error_deg: f64,
    /// The error with the true center in degrees.
    pub error_true_center_deg: f64,
    /// The distance of the two centers in centimeters.
    pub center_distance_cm: f64,
}

impl MeanParts {
    fn of(rows: &[Row]) -> Option<Self> {
        let (mut known, mut given) = (Vec::new(), Vec::new());
        for parts in rows.iter().filter_map(|row| row.error_parts.as_ref()) {
            if let Some((error, choice)) = parts.error_deg.zip(parts.choice_part_deg) {
                known.push([
                    error,
                    parts.lean_deg,
                    parts.lean_part_deg,
                    parts.grid_part_deg,
                    choice,
                ]);
                if let Some(center) = &parts.true_center
                    && let Some(with_true) = center.error_deg
                {
                    given.push([error, with_true, center.distance_cm]);
                }
            }
        }
        let [error_deg, lean_deg, lean_part_deg, grid_part_deg, choice_part_deg] = means(&known)?;
        let true_center =
            means(&given).map(
                |[error_deg, error_true_center_deg, center_distance_cm]| MeanGivenCenter {
                    clouds: given.len(),
                    error_deg,
                    error_true_center_deg,
                    center_distance_cm,
                },
            );
        Some(Self {
            clouds: known.len(),
            error_deg,
            lean_deg,
            lean_part_deg,
            grid_part_deg,
            choice_part_deg,
            true_center,
        })
    }
}

/// Computes the mean of each column; `None` without a row.
fn means<const N: usize>(rows: &[[f64; N]]) -> Option<[f64; N]> {
    let mean = |column: usize| rows.iter().map(|row| row[column]).sum::<f64>() / rows.len() as f64;
    (!rows.is_empty()).then(|| std::array::from_fn(mean))
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
        let coverages: Vec<[f64; 1]> = rows.iter().filter_map(|row| Some([row.coverage?])).collect();
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
            error_parts: MeanParts::of(rows),
            mean_coverage: means(&coverages).map(|[mean]| mean),
            failures,
        }
    }
}
