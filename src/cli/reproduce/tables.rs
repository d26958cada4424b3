//! Every number behind the report, as CSV.

use serde::Serialize;

use super::ellipsoids::Depth;
use super::peppers::Pepper;
use super::readings::READINGS;

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

pub(super) fn ellipsoids(depths: &[Depth]) -> anyhow::Result<Vec<u8>> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for depth in depths {
        for (reading, errors) in READINGS.iter().zip(&depth.readings) {
            let errors = errors.as_ref();
            table.serialize(EllipsoidRow {
                z0_cm: depth.z0_cm,
                reading: reading.name(),
                runs: errors.map_or(0, |e| e.runs),
                error_mean_deg: errors.map(|e| e.to_image_up_deg.mean),
                error_std_deg: errors.map(|e| e.to_image_up_deg.std),
                nearest_axis_error_mean_deg: errors.map(|e| e.to_nearest_axis_deg.mean),
                partner_share_mean: errors.map(|e| e.partner_share.mean),
            })?;
        }
    }
    Ok(table.into_inner()?)
}

pub(super) fn peppers(peppers: &[Pepper]) -> anyhow::Result<Vec<u8>> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for (i, pepper) in peppers.iter().enumerate() {
        for (peduncle, variant) in [
            ("with", &pepper.with_peduncle),
            ("without", &pepper.without_peduncle),
        ] {
            for (reading, errors) in READINGS.iter().zip(&variant.readings) {
                table.serialize(PepperRow {
                    cloud: i + 1,
                    seed: pepper.seed,
                    peduncle,
                    points: variant.points,
                    reading: reading.name(),
                    error_deg: errors.map(|e| e.to_reference_deg),
                    true_axis_error_deg: errors.map(|e| e.to_truth_deg),
                    reference_to_true_axis_deg: errors.map(|e| e.reference_to_truth_deg),
                    center_off_cm: errors.map(|e| e.center_off_cm),
                })?;
            }
        }
    }
    Ok(table.into_inner()?)
}
