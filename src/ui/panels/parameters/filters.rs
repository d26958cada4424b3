//! The filters that run before everything else.

use std::num::NonZeroUsize;

use egui::Ui;

use crate::method::{Filters, OutlierFilter};
use crate::ui::widgets::controls::{Edit, Number, count, row, section};

/// What a filter begins with when it is turned on.
const OUTLIERS: OutlierFilter = OutlierFilter {
    neighbors: const { NonZeroUsize::new(20).unwrap() },
    std_ratio: 1.0,
};
const VOXEL_CM: f64 = 0.2;

pub(in crate::ui) fn show(ui: &mut Ui, edit: &mut Edit<'_>) {
    let differs = edit.request.params.filters != Filters::default();
    let is_reset = section(ui, "Filters", false, differs, |ui| {
        outliers(ui, edit);
        voxels(ui, edit);
        sample(ui, edit);
    });
    if is_reset {
        edit.request.params.filters = Filters::default();
    }
}

fn sample(ui: &mut Ui, edit: &mut Edit<'_>) {
    let tip = "Of a cloud of more points a sample of at most so many is analyzed, thinned evenly by a voxel grid; \
               the result says so, and all points are colored by it.";
    let most = &mut edit.request.params.filters.max_points;
    let response = row(ui, "Most points", tip, |ui| {
        count(
            ui,
            "Points that are analyzed at most",
            most,
            Filters::FEWEST..=100_000_000,
            tip,
        )
    });
    edit.note(&response, "sample");
}

fn outliers(ui: &mut Ui, edit: &mut Edit<'_>) {
    let mut filter = edit.request.params.filters.outliers;
    let mut is_on = filter.is_some();
    let tip = "Leave out points whose mean distance to their neighbors is far above the cloud's. The paper's \
               data were filtered so (§ 2.1).";
    if ui
        .checkbox(&mut is_on, "Leave out outliers")
        .on_hover_text(tip)
        .changed()
    {
        filter = is_on.then_some(OUTLIERS);
    }
    if let Some(filter) = &mut filter {
        ui.indent("outliers", |ui| {
            let tip = "How many nearest points each point's mean distance is taken over.";
            let mut neighbors = filter.neighbors.get();
            let response = row(ui, "Neighbors", tip, |ui| {
                count(
                    ui,
                    "Neighbors of the outlier filter",
                    &mut neighbors,
                    1..=100_000,
                    tip,
                )
            });
            filter.neighbors = NonZeroUsize::new(neighbors).unwrap_or(filter.neighbors);
            edit.note(&response, "outlier neighbors");
            let tip = "Standard deviations above the mean beyond which a point is an outlier. Smaller leaves \
                       out more.";
            let response = row(ui, "Beyond", tip, |ui| {
                Number {
                    name: "Standard deviations beyond which a point is an outlier",
                    suffix: " std. dev.",
                    range: 0.01..=100.0,
                    speed: 0.01,
                    decimals: 2,
                    width: Number::WIDTH,
                }
                .show(ui, &mut filter.std_ratio, tip)
            });
            edit.note(&response, "outlier ratio");
        });
    }
    edit.request.params.filters.outliers = filter;
}

fn voxels(ui: &mut Ui, edit: &mut Edit<'_>) {
    let mut edge_cm = edit.request.params.filters.voxel_cm;
    let mut is_on = edge_cm.is_some();
    let tip = "Thin the cloud to one point a cube of this edge, so that near and far parts count alike. The \
               paper's data were filtered so (§ 2.1).";
    if ui
        .checkbox(&mut is_on, "Thin to a voxel grid")
        .on_hover_text(tip)
        .changed()
    {
        edge_cm = is_on.then_some(VOXEL_CM);
    }
    if let Some(edge_cm) = &mut edge_cm {
        ui.indent("voxels", |ui| {
            let response = row(ui, "Edge", tip, |ui| {
                Number {
                    name: "Voxel edge in centimeters",
                    suffix: " cm",
                    range: 0.001..=1000.0,
                    speed: 0.005,
                    decimals: 3,
                    width: Number::WIDTH,
                }
                .show(ui, edge_cm, tip)
            });
            edit.note(&response, "voxel");
        });
    }
    edit.request.params.filters.voxel_cm = edge_cm;
}
