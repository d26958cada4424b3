//! The paper's Fig. 8, 12 and 13 from our runs, and the map of the error over coverage and lean.

use super::findings::{Comparison, PAPER_FIG_8_DEG, PAPER_FIG_8_RANGE_DEG, PEDUNCLE_VARIANTS};
use super::readings::{AS_INTENDED, AS_PRINTED, HALF, READINGS, TRUE_CENTER_MEAN_SCORE};
use super::scans::arc_name;
use super::{EllipsoidDepth, PepperErrors, Reproduction, Scan, Spread};
use crate::charts::{
    BarChart, BarSeries, Figure, Guide, Heatmap, Labels, LineChart, LinePanel, LinePoint, LineSeries,
};

/// The mean error at a depth and its standard deviation.
type ErrorAtDepth<'a> = &'a dyn Fn(&EllipsoidDepth) -> (Option<f64>, Option<f64>);

/// Fig. 8: the error at each depth, of the upright candidate alone and of the planes that win under the two presets and
/// with the true center. Bands are standard deviations over the runs.
pub(super) fn fig8(results: &Reproduction) -> Figure {
    let grid = results.settings.main_grid();
    let u = results.settings.grid_sizes[grid];
    let line = |name: String, point: ErrorAtDepth<'_>| LineSeries {
        name,
        points: (results.depths.iter())
            .map(|depth| {
                let (y, spread) = point(depth);
                LinePoint {
                    x: depth.z0_cm,
                    y,
                    spread,
                }
            })
            .collect(),
    };
    let winner = |reading: usize, name: &str| {
        line(format!("{name}, u = {u}"), &|depth| {
            let spread = depth.grids[grid][reading].as_ref().map(|e| e.to_image_up_deg);
            (spread.map(|s| s.mean), spread.map(|s| s.std))
        })
    };
    let upright = vec![
        line("upright candidate n = (1, 0, 0), true center".into(), &|depth| {
            (Some(depth.upright_deg), None)
        }),
        line("upright candidate, equidistant center".into(), &|depth| {
            let spread = depth.grids[grid][AS_INTENDED].as_ref().map(|e| e.upright_deg);
            (spread.map(|s| s.mean), spread.map(|s| s.std))
        }),
    ];
    let mean = Guide::new(PAPER_FIG_8_DEG, format!("paper's mean: {PAPER_FIG_8_DEG:.2}°"));
    let (least, largest) = PAPER_FIG_8_RANGE_DEG;
    let all_guides = vec![
        mean.clone(),
        Guide::new(least, format!("paper's least: {least}°")),
        Guide::new(largest, format!("paper's largest: {largest}°")),
    ];
    let panel = |series, guides| LinePanel {
        series,
        guides,
        y_range: None,
    };
    let panels = vec![
        panel(upright, all_guides),
        panel(
            vec![
                winner(AS_INTENDED, "as intended"),
                winner(TRUE_CENTER_MEAN_SCORE, "true center, mean"),
            ],
            vec![mean.clone()],
        ),
        panel(vec![winner(AS_PRINTED, "as printed")], vec![mean]),
    ];
    let labels = Labels::new(
        "Error of the symmetry axis of the simulated ellipsoid (as Fig. 8)",
        "Depth z₀ (cm)",
        "Error (°)",
    );
    LineChart { labels, panels }.into()
}

/// Fig. 12 (without the peduncle) and Fig. 13 (with it): the error of each cloud of the main scan.
pub(super) fn error_per_pepper(
    results: &Reproduction,
    grid: usize,
    reading: usize,
    with_peduncle: bool,
) -> Option<Figure> {
    let scanned = results.main_peppers()?;
    let values = |error: fn(&PepperErrors) -> f64| {
        let errors = scanned
            .peppers
            .iter()
            .map(|p| p.variant(with_peduncle).grids[grid][reading].as_ref());
        errors.map(|e| e.map(error)).collect()
    };
    let series = vec![
        BarSeries {
            name: "against the reference of § 3.2".into(),
            values: values(|e| e.to_reference_deg),
        },
        BarSeries {
            name: "against the true axis".into(),
            values: values(|e| e.to_truth_deg),
        },
    ];
    let paper = &PEDUNCLE_VARIANTS[usize::from(with_peduncle)];
    let title = format!(
        "Error of {} simulated peppers {}, {}, u = {}{} (as Fig. {})",
        scanned.peppers.len(),
        paper.name,
        scanned.scan.arc_name(),
        results.settings.grid_sizes[grid],
        if READINGS[reading].needs_half {
            ", half need a partner"
        } else {
            ""
        },
        paper.figure
    );
    let guides = vec![
        Guide::new(paper.mean_deg, format!("paper's mean: {:.2}°", paper.mean_deg)),
        Guide::new(
            paper.range_deg.0,
            format!("paper's least: {:.2}°", paper.range_deg.0),
        ),
        Guide::new(
            paper.range_deg.1,
            format!("paper's largest: {:.2}°", paper.range_deg.1),
        ),
    ];
    let chart = BarChart {
        labels: Labels::new(title, "Cloud", "Error (°)"),
        categories: (1..=scanned.peppers.len()).map(|i| i.to_string()).collect(),
        series,
        guides,
    };
    Some(chart.into())
}

/// The mean error against § 3.2's reference over coverage and lean, the mean over both of the paper's variants; `None`
/// if a scan was not run.
pub(super) fn map(results: &Reproduction, grid: usize) -> Option<Figure> {
    let settings = &results.settings;
    let scanned = |arc_deg: f64, lean_deg: f64| results.scanned(&Scan::new(arc_deg, lean_deg, settings.seed));
    let mut columns = Vec::new();
    for &arc_deg in &settings.arcs_deg {
        let of_arc: Option<Vec<_>> = settings
            .leans_deg
            .iter()
            .map(|&lean| scanned(arc_deg, lean))
            .collect();
        let seen = of_arc?
            .into_iter()
            .flat_map(|s| &s.peppers)
            .filter_map(|p| p.coverage);
        let seen = Spread::of(seen).map_or("?".to_owned(), |s| format!("{:.0}", 100.0 * s.mean));
        columns.push(format!("{}, {seen} %", arc_name(arc_deg)));
    }
    let cell = |arc_deg: f64, lean_deg: f64| {
        let [without, with] = Comparison::of(scanned(arc_deg, lean_deg)?, grid, HALF)?.cells;
        Some(f64::midpoint(without.to_reference.mean, with.to_reference.mean))
    };
    let row = |&lean: &f64| settings.arcs_deg.iter().map(|&arc| cell(arc, lean)).collect();
    let title = format!(
        "Error of {} peppers over what was seen and how they lean, u = {}",
        settings.peppers, settings.grid_sizes[grid]
    );
    let map = Heatmap {
        labels: Labels::new(
            title,
            "Camera's arc around the fruit, and the share of its surface that was seen",
            "Lean at most",
        ),
        value_label: "Mean error (°)".into(),
        columns,
        rows: settings.leans_deg.iter().map(|lean| format!("{lean}°")).collect(),
        cells: settings.leans_deg.iter().map(row).collect(),
    };
    Some(map.into())
}
