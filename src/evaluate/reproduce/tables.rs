//! The numbers behind the report as CSV.

use serde::Serialize;

use super::readings::READINGS;
use super::{EllipsoidDepth, ReproducedPepper, TableError};

/// One row of `ellipsoids.csv`: a reading at a depth, over all runs.
#[derive(Serialize)]
struct EllipsoidRow {
    z0_cm: f64,
    reading: String,
    runs: usize,
    error_mean_deg: Option<f64>,
    error_std_deg: Option<f64>,
    nearest_axis_error_mean_deg: Option<f64>,
    partner_share_mean: Option<f64>,
}

/// One row of `peppers.csv`: a reading of a cloud.
#[derive(Serialize)]
struct PepperRow {
    cloud: usize,
    seed: u64,
    peduncle: &'static str,
    points: usize,
    reading: String,
    error_deg: Option<f64>,
    true_axis_error_deg: Option<f64>,
    reference_to_true_axis_deg: Option<f64>,
    center_off_cm: Option<f64>,
}

/// The errors of § 3.1, a row for each depth and reading.
///
/// # Errors
/// Returns an error if memory runs out.
pub(super) fn ellipsoids(depths: &[EllipsoidDepth]) -> Result<Vec<u8>, TableError> {
    let rows = depths.iter().flat_map(|depth| {
        READINGS.iter().zip(&depth.readings).map(|(reading, errors)| {
            let errors = errors.as_ref();
            EllipsoidRow {
                z0_cm: depth.z0_cm,
                reading: reading.name(),
                runs: errors.map_or(0, |e| e.runs),
                error_mean_deg: errors.map(|e| e.to_image_up_deg.mean),
                error_std_deg: errors.map(|e| e.to_image_up_deg.std),
                nearest_axis_error_mean_deg: errors.map(|e| e.to_nearest_axis_deg.mean),
                partner_share_mean: errors.map(|e| e.partner_share.mean),
            }
        })
    });
    csv_of(rows)
}

/// The errors of § 3.2, a row for each cloud and reading.
///
/// # Errors
/// Returns an error if memory runs out.
pub(super) fn peppers(peppers: &[ReproducedPepper]) -> Result<Vec<u8>, TableError> {
    let rows = peppers.iter().enumerate().flat_map(|(i, pepper)| {
        let variants = [
            ("with", &pepper.with_peduncle),
            ("without", &pepper.without_peduncle),
        ];
        variants.into_iter().flat_map(move |(peduncle, variant)| {
            let readings = READINGS.iter().zip(&variant.readings);
            readings.map(move |(reading, errors)| PepperRow {
                cloud: i + 1,
                seed: pepper.seed,
                peduncle,
                points: variant.points,
                reading: reading.name(),
                error_deg: errors.map(|e| e.to_reference_deg),
                true_axis_error_deg: errors.map(|e| e.to_truth_deg),
                reference_to_true_axis_deg: errors.map(|e| e.reference_to_truth_deg),
                center_off_cm: errors.map(|e| e.center_off_cm),
            })
        })
    });
    csv_of(rows)
}

fn csv_of(rows: impl Iterator<Item = impl Serialize>) -> Result<Vec<u8>, TableError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for row in rows {
        table.serialize(row).map_err(|e| TableError::Csv(e.to_string()))?;
    }
    table.into_inner().map_err(|e| TableError::Csv(e.to_string()))
}
