//! The data of the charts, computed when rows, order or reference change.

use std::sync::Arc;

use crate::app::State;
use crate::app::many::TableRow;

/// The mean errors that the paper reports, in degrees.
pub(in crate::ui) const FIG_8_DEG: f64 = 6.4710;
pub(in crate::ui) const FIG_12_DEG: f64 = 7.3729;
pub(in crate::ui) const FIG_13_DEG: f64 = 6.9343;

/// The width of the bins of distances in centimeters.
pub(in crate::ui) const DISTANCE_BIN_CM: f64 = 5.0;

/// A cloud in a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::ui) struct Mark {
    pub(in crate::ui) x: f64,
    pub(in crate::ui) y: f64,
    /// The cloud's place in the list.
    pub(in crate::ui) place: usize,
}

/// Everything that the charts draw.
#[derive(Debug, Clone, Default)]
pub(in crate::ui) struct Data {
    generation: u64,
    /// A bar a cloud, in the order of the table.
    pub(in crate::ui) bars: Vec<Mark>,
    /// Clouds without an error, at their places among the bars.
    pub(in crate::ui) failures: Vec<Mark>,
    pub(in crate::ui) mean_deg: Option<f64>,
    /// Against the distance of the fruit center in centimeters.
    pub(in crate::ui) by_distance: Vec<Mark>,
    /// The mean error of each bin of distances: its middle and the mean.
    pub(in crate::ui) distance_means: Vec<[f64; 2]>,
    /// Against the lead in percent.
    pub(in crate::ui) by_lead: Vec<Mark>,
    /// Against the true axis' lean out of the plane across the view ray, in degrees.
    pub(in crate::ui) by_lean: Vec<Mark>,
    /// Against the share of the surface that was seen, in percent.
    pub(in crate::ui) by_coverage: Vec<Mark>,
    /// A unit a cloud, stacked by their errors: x is the bin's middle, y the unit's lower edge.
    pub(in crate::ui) histogram: Vec<Mark>,
    /// The width of the histogram's bins in degrees.
    pub(in crate::ui) bin_deg: f64,
}

impl Data {
    /// Returns the data of the clouds in the table, computed anew only after a change.
    pub(in crate::ui) fn of(ui: &egui::Ui, state: &State) -> Arc<Self> {
        let id = egui::Id::unique("charts of clouds");
        let kept: Option<Arc<Self>> = ui.data(|data| data.get_temp(id));
        if let Some(kept) = kept.filter(|kept| kept.generation == state.many.generation) {
            return kept;
        }
        let made = Arc::new(Self::new(state));
        ui.data_mut(|data| data.insert_temp(id, made.clone()));
        made
    }

    fn new(state: &State) -> Self {
        let folder = &state.many;
        let mut data = Self {
            generation: folder.generation,
            ..Self::default()
        };
        for (slot, &place) in folder.order.iter().enumerate() {
            let row = &folder.rows[place];
            let x = slot as f64 + 1.0;
            match row.error_deg(folder.against) {
                Some(y) => data.bars.push(Mark { x, y, place }),
                None if row.outcome.is_some() => data.failures.push(Mark { x, y: 0.0, place }),
                None => {}
            }
        }
        let count = data.bars.len();
        let sum: f64 = data.bars.iter().map(|bar| bar.y).sum();
        data.mean_deg = (count > 0).then(|| sum / count as f64);
        let against = |value: &dyn Fn(&TableRow) -> Option<f64>| {
            let marks = data.bars.iter();
            marks
                .filter_map(|bar| {
                    Some(Mark {
                        x: value(&folder.rows[bar.place])?,
                        ..*bar
                    })
                })
                .collect::<Vec<_>>()
        };
        data.by_distance = against(&TableRow::distance_cm);
        data.by_lead = against(&TableRow::lead_percent);
        data.by_lean = against(&|row| row.lean_deg(folder.against));
        data.by_coverage = against(&TableRow::coverage_percent);
        data.distance_means = means(&data.by_distance);
        (data.histogram, data.bin_deg) = histogram(&data.bars);
        data
    }
}

/// Computes the mean of each bin with a cloud.
fn means(marks: &[Mark]) -> Vec<[f64; 2]> {
    let mut bins: std::collections::BTreeMap<i64, (f64, usize)> = std::collections::BTreeMap::new();
    for mark in marks {
        // A distance in centimeters is far within the range.
        let bin = (mark.x / DISTANCE_BIN_CM).floor() as i64;
        let (sum, count) = bins.entry(bin).or_default();
        *sum += mark.y;
        *count += 1;
    }
    let mean =
        |(bin, (sum, count)): (i64, (f64, usize))| [DISTANCE_BIN_CM * (bin as f64 + 0.5), sum / count as f64];
    bins.into_iter().map(mean).collect()
}

fn histogram(bars: &[Mark]) -> (Vec<Mark>, f64) {
    let largest = bars.iter().map(|bar| bar.y).fold(0.0, f64::max);
    let step = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|step| largest / step <= 24.0)
        .unwrap_or(5.0);
    let mut sorted = bars.to_vec();
    sorted.sort_by(|a, b| a.y.total_cmp(&b.y));
    let mut heights: std::collections::HashMap<i64, f64> = std::collections::HashMap::new();
    let units = sorted.into_iter().map(|bar| {
        // Errors are at most 90°.
        let bin = (bar.y / step).floor() as i64;
        let height = heights.entry(bin).or_default();
        *height += 1.0;
        Mark {
            x: step * (bin as f64 + 0.5),
            y: *height - 1.0,
            place: bar.place,
        }
    });
    (units.collect(), step)
}
