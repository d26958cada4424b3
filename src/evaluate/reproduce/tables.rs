//! The numbers behind the report as CSV.

use serde::Serialize;

use super::readings::READINGS;
use super::{Reproduction, ScannedPeppers, TableError};

/// One row of `ellipsoids.csv`: a reading at a depth, over all runs.
#[derive(Serialize)]
struct EllipsoidRow {
    u: usize,
    z0_cm: f64,
    reading: String,
    runs: usize,
    error_mean_deg: Option<f64>,
    error_std_deg: Option<f64>,
    nearest_axis_error_mean_deg: Option<f64>,
    partner_share_mean: Option<f64>,
    upright_error_mean_deg: Option<f64>,
    upright_wins_share: Option<f64>,
}

/// One row of `peppers.csv`: a reading of a cloud.
#[derive(Serialize)]
struct PepperRow<'a> {
    arc_deg: f64,
    views: u32,
    max_lean_deg: f64,
    change: &'a str,
    set_seed: u64,
    u: usize,
    cloud: usize,
    seed: u64,
    coverage: Option<f64>,
    lean_deg: f64,
    peduncle: &'static str,
    points: usize,
    reading: String,
    error_deg: Option<f64>,
    true_axis_error_deg: Option<f64>,
    reference_to_true_axis_deg: Option<f64>,
    center_off_cm: Option<f64>,
    best_candidate_error_deg: Option<f64>,
}

/// The errors of § 3.1, a row for each u, depth and reading.
///
/// # Errors
/// Returns an error if memory runs out.
pub(super) fn ellipsoids(results: &Reproduction) -> Result<Vec<u8>, TableError> {
    let grids = results.settings.grid_sizes.iter().enumerate();
    let rows = grids.flat_map(|(grid, &u)| {
        let rows_of_depth = move |depth: &super::EllipsoidDepth| {
            let z0_cm = depth.z0_cm;
            let row = move |(reading, errors): (&super::Reading, &Option<super::EllipsoidErrors>)| {
                let errors = errors.as_ref();
                EllipsoidRow {
                    u,
                    z0_cm,
                    reading: reading.name(),
                    runs: errors.map_or(0, |e| e.runs),
                    error_mean_deg: errors.map(|e| e.to_image_up_deg.mean),
                    error_std_deg: errors.map(|e| e.to_image_up_deg.std),
                    nearest_axis_error_mean_deg: errors.map(|e| e.to_nearest_axis_deg.mean),
                    partner_share_mean: errors.map(|e| e.partner_share.mean),
                    upright_error_mean_deg: errors.map(|e| e.upright_deg.mean),
                    upright_wins_share: errors.map(|e| e.upright_wins),
                }
            };
            READINGS
                .iter()
                .zip(&depth.grids[grid])
                .map(row)
                .collect::<Vec<_>>()
        };
        results.depths.iter().flat_map(rows_of_depth)
    });
    csv_of(rows)
}

/// The errors of § 3.2, a row for each scan, u, cloud and reading.
///
/// # Errors
/// Returns an error if memory runs out.
pub(super) fn peppers(results: &Reproduction) -> Result<Vec<u8>, TableError> {
    let scans = results.scans.iter().map(|scan| ("", scan));
    let sets = results.other_sets.iter().map(|scan| ("other peppers", scan));
    let variations = results.variations.iter().map(|(v, scan)| (v.name.as_str(), scan));
    let rows = scans
        .chain(sets)
        .chain(variations)
        .flat_map(|(change, scanned)| pepper_rows(&results.settings.grid_sizes, change, scanned));
    csv_of(rows)
}

fn pepper_rows<'a>(grid_sizes: &[usize], change: &'a str, scanned: &ScannedPeppers) -> Vec<PepperRow<'a>> {
    let scan = &scanned.scan;
    let mut rows = Vec::new();
    for (grid, &u) in grid_sizes.iter().enumerate() {
        for (i, pepper) in scanned.peppers.iter().enumerate() {
            for (peduncle, with_peduncle) in [("with", true), ("without", false)] {
                let variant = pepper.variant(with_peduncle);
                for (reading, errors) in READINGS.iter().zip(&variant.grids[grid]) {
                    rows.push(PepperRow {
                        arc_deg: scan.arc_deg,
                        views: scan.views(),
                        max_lean_deg: scan.lean_deg,
                        change,
                        set_seed: scan.seed,
                        u,
                        cloud: i + 1,
                        seed: pepper.seed,
                        coverage: pepper.coverage,
                        lean_deg: pepper.lean_deg,
                        peduncle,
                        points: variant.points,
                        reading: reading.name(),
                        error_deg: errors.map(|e| e.to_reference_deg),
                        true_axis_error_deg: errors.map(|e| e.to_truth_deg),
                        reference_to_true_axis_deg: errors.map(|e| e.reference_to_truth_deg),
                        center_off_cm: errors.map(|e| e.center_off_cm),
                        best_candidate_error_deg: errors.map(|e| e.best_candidate_deg),
                    });
                }
            }
        }
    }
    rows
}

fn csv_of(rows: impl Iterator<Item = impl Serialize>) -> Result<Vec<u8>, TableError> {
    let mut table = csv::Writer::from_writer(Vec::new());
    for row in rows {
        table.serialize(row).map_err(|e| TableError::Csv(e.to_string()))?;
    }
    table.into_inner().map_err(|e| TableError::Csv(e.to_string()))
}
