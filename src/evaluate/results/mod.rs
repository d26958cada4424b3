//! The results of a set of clouds as files: tables, summary, figures, and a self-contained page. The caller writes
//! the bytes to disk.

mod figures;
mod html;
mod tables;

use std::path::Path;

use serde::Serialize;

use super::{Row, Summary, Sweep, TableError};
use crate::charts::FigureError;
use crate::fruit::Request;

pub use tables::{csv, parquet};

/// A picture of one of the worst clouds, for the page.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstPicture {
    /// The file of the cloud.
    pub file: String,
    /// The error in degrees.
    pub error_deg: Option<f64>,
    /// PNG bytes.
    pub png: Vec<u8>,
}

/// The reason why results could not be made. A clause.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The summary could not be written.
    #[error("the summary could not be written: {0}")]
    Summary(#[from] serde_json::Error),
    /// A figure could not be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
}

/// Makes results.csv, results.parquet, summary.json, report.html, the figures as SVG and PNG, and the table and the
/// map of a sweep: name and bytes of each file.
///
/// # Errors
/// Returns an error if a table, the summary or a figure cannot be made.
pub fn result_files(
    folder: &Path,
    request: &Request,
    rows: &[Row],
    sweep: Option<&Sweep>,
    pictures: &[WorstPicture],
) -> Result<Vec<(String, Vec<u8>)>, ResultsError> {
    let summary = Summary::of(rows);
    let mut files = vec![
        ("results.csv".to_owned(), csv(rows)?),
        ("results.parquet".to_owned(), parquet(rows)?),
        (
            "summary.json".to_owned(),
            (serde_json::to_string_pretty(&summary)? + "\n").into_bytes(),
        ),
    ];
    let mut figures = figures::of_rows(rows);
    if let Some(map) = sweep {
        files.push(("sweep.csv".to_owned(), sweep_table(map)?));
        figures.push(("sweep", figures::of_sweep(map)));
    }
    let mut drawn = Vec::new();
    for (name, figure) in figures {
        // A figure without a value cannot be drawn.
        let Ok(svg) = figure.svg() else { continue };
        files.push((format!("{name}.svg"), svg.clone().into_bytes()));
        files.push((format!("{name}.png"), figure.png(1.0)?));
        drawn.push(svg);
    }
    let page = html::report(folder, request, rows, &summary, &drawn, pictures);
    files.push(("report.html".to_owned(), page.into_bytes()));
    Ok(files)
}

/// Returns the rows that have an error, the largest error first.
pub fn worst_first(rows: &[Row]) -> Vec<&Row> {
    let mut worst: Vec<(f64, &Row)> = rows
        .iter()
        .filter_map(|row| Some((row.error_deg?, row)))
        .collect();
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    worst.into_iter().map(|(_, row)| row).collect()
}

/// One row of `sweep.csv`.
#[derive(Serialize)]
struct SweepRow {
    u: usize,
    tau_cm_per_rad: f64,
    clouds: usize,
    mean_error_deg: Option<f64>,
}

/// Writes the map as CSV.
fn sweep_table(map: &Sweep) -> Result<Vec<u8>, TableError> {
    let failed = |error: String| TableError::Csv(error);
    let mut table = ::csv::Writer::from_writer(Vec::new());
    for (i, &u) in map.settings.u.iter().enumerate() {
        for (j, &tau_cm_per_rad) in map.settings.tau_cm_per_rad.iter().enumerate() {
            let (mean_error_deg, clouds) = map.cell(i, j);
            let row = SweepRow {
                u,
                tau_cm_per_rad,
                clouds,
                mean_error_deg,
            };
            table.serialize(row).map_err(|e| failed(e.to_string()))?;
        }
    }
    table.into_inner().map_err(|e| failed(e.to_string()))
}
