//! Charts of an evaluation: the error of each cloud, its distribution, and its dependence on other quantities.

use crate::charts::{BarChart, BarSeries, Figure, Guide, Heatmap, Histogram, Labels, Scatter, ScatterSeries};
use crate::evaluate::{Row, Sweep};

/// The largest number of clouds with a bar each: more bars could not be told apart.
const MOST_BARS: usize = 120;
const ERROR: &str = "Error of the axis (°)";

/// Makes the figures of the rows, each with the name of its files.
pub(super) fn of_rows(rows: &[Row]) -> Vec<(&'static str, Figure)> {
    let mut figures = Vec::new();
    if rows.len() <= MOST_BARS {
        figures.push(("errors", error_per_cloud(rows)));
    }
    let errors = rows.iter().filter_map(|row| row.error_deg).collect();
    let histogram = Histogram {
        labels: Labels::new("How often an error occurs", ERROR, "Clouds"),
        values: errors,
        step: None,
    };
    figures.push(("histogram", histogram.into()));
    let against = |title: &str, x: &str, position: fn(&Row) -> Option<f64>| {
        let points = rows
            .iter()
            .filter_map(|row| Some((position(row)?, row.error_deg?)));
        let series = ScatterSeries {
            name: "clouds".into(),
            points: points.collect(),
        };
        Scatter {
            labels: Labels::new(title, x, ERROR),
            series: vec![series],
            guides: Vec::new(),
        }
    };
    let lead = against(
        "Error against the winner's lead over the runner-up",
        "Lead (% of the best score)",
        |row| row.lead.map(|lead| 100.0 * lead),
    );
    figures.push(("error_by_lead", lead.into()));
    let distance = against(
        "Error against the distance of the fruit",
        "Distance of the fruit center (cm)",
        |row| {
            let [x, y, z] = row.center?;
            Some((x * x + y * y + z * z).sqrt() * row.unit?.in_cm())
        },
    );
    figures.push(("error_by_distance", distance.into()));
    let lean = against(
        "Error against the lean of the true axis",
        "Lean towards the camera or away from it (°)",
        |row| row.error_parts.as_ref().map(|parts| parts.lean_deg),
    );
    figures.push(("error_by_lean", lean.into()));
    let coverage = against(
        "Error against the share of the fruit that was seen",
        "Coverage (% of the surface)",
        |row| row.coverage.map(|coverage| 100.0 * coverage),
    );
    figures.push(("error_by_coverage", coverage.into()));
    figures
}

fn error_per_cloud(rows: &[Row]) -> Figure {
    let errors: Vec<Option<f64>> = rows.iter().map(|row| row.error_deg).collect();
    let measured: Vec<f64> = errors.iter().copied().flatten().collect();
    let mean = measured.iter().sum::<f64>() / measured.len() as f64;
    let guide = (!measured.is_empty()).then(|| Guide::new(mean, format!("mean: {mean:.2}°")));
    let name = |row: &Row| row.file.trim_end_matches(".ply").to_owned();
    BarChart {
        labels: Labels::new("Error of each cloud", "Cloud", ERROR),
        categories: rows.iter().map(name).collect(),
        series: vec![BarSeries {
            name: "error".into(),
            values: errors,
        }],
        guides: guide.into_iter().collect(),
    }
    .into()
}

/// Makes the map of the mean error over u and τ.
pub(super) fn of_sweep(map: &Sweep) -> Figure {
    let settings = &map.settings;
    let cell = |u: usize, tau: usize| map.cell(u, tau).0;
    Heatmap {
        labels: Labels::new("Mean error over the settings", "u", "τ (cm/rad)"),
        value_label: "Mean error (°)".into(),
        columns: settings.u.iter().map(usize::to_string).collect(),
        rows: settings
            .tau_cm_per_rad
            .iter()
            .map(|tau| format!("{tau:.2}"))
            .collect(),
        cells: (0..settings.tau_cm_per_rad.len())
            .map(|tau| (0..settings.u.len()).map(|u| cell(u, tau)).collect())
            .collect(),
    }
    .into()
}
