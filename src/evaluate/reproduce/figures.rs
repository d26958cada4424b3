//! The paper's Fig. 8, 12 and 13, drawn from our runs.

use super::readings::{AS_INTENDED, AS_PRINTED, READINGS};
use super::report::{PAPER_FIG_8_DEG, PAPER_FIG_12_DEG, PAPER_FIG_13_DEG};
use super::{EllipsoidDepth, PepperErrors, ReproducedPepper};
use crate::charts::{BarChart, BarSeries, Figure, Guide, Labels, LineChart, LinePoint, LineSeries};

/// Fig. 8: the mean error at each depth, for every reading.
pub(super) fn error_per_depth(depths: &[EllipsoidDepth]) -> Figure {
    let point = |depth: &EllipsoidDepth, reading: usize| {
        let errors = depth.readings[reading].as_ref().map(|e| e.to_image_up_deg);
        LinePoint {
            x: depth.z0_cm,
            y: errors.map(|e| e.mean),
            spread: None,
        }
    };
    let series = READINGS.iter().enumerate().map(|(i, reading)| LineSeries {
        name: reading.name(),
        points: depths.iter().map(|depth| point(depth, i)).collect(),
    });
    let labels = Labels::new(
        "Error of the symmetry axis of the simulated ellipsoid (as Fig. 8)",
        "Depth z₀ (cm)",
        "Mean error against image-up (°)",
    );
    let paper = Guide::new(PAPER_FIG_8_DEG, format!("paper: {PAPER_FIG_8_DEG:.2}°"));
    LineChart::new(labels, series.collect(), vec![paper]).into()
}

/// Fig. 12 (without the peduncle) and Fig. 13 (with it): the error of each cloud.
pub(super) fn error_per_pepper(peppers: &[ReproducedPepper], without_peduncle: bool) -> Figure {
    let variant = |pepper: &ReproducedPepper, reading: usize| {
        let variant = if without_peduncle {
            &pepper.without_peduncle
        } else {
            &pepper.with_peduncle
        };
        variant.readings[reading].map(|e: PepperErrors| e.to_reference_deg)
    };
    let series =
        [(AS_PRINTED, "as printed"), (AS_INTENDED, "as intended")].map(|(reading, name)| BarSeries {
            name: name.into(),
            values: peppers.iter().map(|pepper| variant(pepper, reading)).collect(),
        });
    let (title, paper) = if without_peduncle {
        (
            "Error of simulated peppers without their peduncle (as Fig. 12)",
            PAPER_FIG_12_DEG,
        )
    } else {
        (
            "Error of simulated peppers with their peduncle (as Fig. 13)",
            PAPER_FIG_13_DEG,
        )
    };
    BarChart {
        labels: Labels::new(title, "Cloud", "Error against the peduncle's axis (°)"),
        categories: (1..=peppers.len()).map(|i| i.to_string()).collect(),
        series: series.into(),
        guides: vec![Guide::new(paper, format!("paper's mean: {paper:.2}°"))],
    }
    .into()
}
