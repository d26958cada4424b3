//! The filters that run before everything else.

use std::num::NonZeroUsize;

use egui::Ui;

use crate::method::{Filters, OutlierFilter};
use crate::ui::widgets::controls::{Edit, Number, checkbox, count, row, section};

/// The outlier filter as it is turned on.
const OUTLIERS: OutlierFilter = OutlierFilter {
    neighbors: const { NonZeroUsize::new(20).unwrap() },
    std_ratio: 1.0,
};
/// The edge of the voxel grid as it is turned on, in centimeters.
const VOXEL_CM: f64 = 0.2;

pub(super) fn show(ui: &mut Ui, edit: &mut Edit<'_>) {
    let differs = edit.request.params.filters != Filters::default();
    let is_reset = section(ui, "Filters", false, differs, |ui| {
        strays(ui, edit);
        outliers(ui, edit);
        voxels(ui, edit);
        sample(ui, edit);
    });
    if is_reset {
        edit.request.params.filters = Filters::default();
    }
}

fn sample(ui: &mut Ui, edit: &mut Edit<'_>) {
    let tip = "Of a larger cloud, a sample of at most this many points is analyzed, thinned evenly by a voxel grid; \
               the result says so, and all points are colored by it.";
    let (name, range) = ("Points that are analyzed at most", Filters::FEWEST..=100_000_000);
    let most = &mut edit.request.params.filters.max_points;
    let response = row(ui, "Most points", tip, |ui| count(ui, name, most, range, tip));
    edit.note(&response, "sample");
}

fn strays(ui: &mut Ui, edit: &mut Edit<'_>) {
    let mut leaves_out = !edit.request.params.filters.keep_strays;
    let tip = "Leave out points that lie far from all others, more than 4 radii of the cloud's inner half from its middle. \
               A single one can turn the axis. The bar below counts them, and the view shows them in green.";
    if checkbox(ui, &mut leaves_out, "Leave out strays", tip) {
        edit.request.params.filters.keep_strays = !leaves_out;
    }
}

fn outliers(ui: &mut Ui, edit: &mut Edit<'_>) {
    let mut filter = edit.request.params.filters.outliers;
    let mut is_on = filter.is_some();
    let tip = "Leave out points whose mean distance to their neighbors is far above the cloud's. The paper's \
               data were filtered in this way (§ 2.1).";
    if checkbox(ui, &mut is_on, "Leave out outliers", tip) {
        filter = is_on.then_some(OUTLIERS);
    }
    if let Some(filter) = &mut filter {
        ui.indent("outliers", |ui| {
            let tip = "The number of nearest points over which each point's mean distance is taken.";
            let name = "Neighbors of the outlier filter";
            let mut neighbors = filter.neighbors.get();
            let response = row(ui, "Neighbors", tip, |ui| {
                count(ui, name, &mut neighbors, 1..=100_000, tip)
            });
            filter.neighbors = NonZeroUsize::new(neighbors).unwrap_or(filter.neighbors);
            edit.note(&response, "outlier neighbors");
            let tip = "Standard deviations above the mean beyond which a point is an outlier. A smaller number \
                       leaves out more.";
            let name = "Standard deviations beyond which a point is an outlier";
            let number = Number::new(name, 0.01..=100.0)
                .suffix(" std. dev.")
                .steps(0.01, 2);
            let response = number.row(ui, "Beyond", &mut filter.std_ratio, tip);
            edit.note(&response, "outlier ratio");
        });
    }
    edit.request.params.filters.outliers = filter;
}

fn voxels(ui: &mut Ui, edit: &mut Edit<'_>) {
    let mut edge_cm = edit.request.params.filters.voxel_cm;
    let mut is_on = edge_cm.is_some();
    let tip = "Thin the cloud to one point per cube of this edge, so that near and far parts have the same weight. \
               The paper's data were filtered in this way (§ 2.1).";
    if checkbox(ui, &mut is_on, "Thin to a voxel grid", tip) {
        edge_cm = is_on.then_some(VOXEL_CM);
    }
    if let Some(edge_cm) = &mut edge_cm {
        ui.indent("voxels", |ui| {
            let number = Number::new("Voxel edge in centimeters", 0.001..=1000.0)
                .suffix(" cm")
                .steps(0.005, 3);
            let response = number.row(ui, "Edge", edge_cm, tip);
            edit.note(&response, "voxel");
        });
    }
    edit.request.params.filters.voxel_cm = edge_cm;
}
