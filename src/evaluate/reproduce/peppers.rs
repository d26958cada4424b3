//! § 3.2 on simulated peppers, with and without their peduncle: the paper's own clouds are not ours to give.

use std::num::NonZeroUsize;

use super::readings::{READINGS, ReadingResult, analyze_by_readings};
use super::{ReproduceError, ReproduceSettings};
use crate::geometry::{Cloud, angle_between_lines_rad};
use crate::method::{Filters, OutlierFilter};
use crate::parallel::{Watch, map_pieces};
use crate::peduncle::Peduncle;
use crate::simulate::{PepperSettings, Truth, seeds};

/// The edge of the voxel grid in centimeters. § 2.1 names this filter and the next without a number.
pub(super) const VOXEL_CM: f64 = 0.2;
/// Neighbors of the outlier filter.
pub(super) const OUTLIER_NEIGHBORS: usize = 50;
/// Standard deviations of the outlier filter.
pub(super) const OUTLIER_STD: f64 = 1.0;

/// One pepper in both of the paper's variants.
#[derive(Debug, Clone, PartialEq)]
pub struct ReproducedPepper {
    /// The seed that it was made from.
    pub seed: u64,
    /// The cloud with its peduncle.
    pub with_peduncle: PepperVariant,
    /// The cloud without its peduncle.
    pub without_peduncle: PepperVariant,
}

/// One of a pepper's clouds under every reading.
#[derive(Debug, Clone, PartialEq)]
pub struct PepperVariant {
    /// Used points.
    pub points: usize,
    /// One for each of [`READINGS`]; `None` for a reading without an axis.
    pub readings: [Option<PepperErrors>; READINGS.len()],
}

/// One reading's errors on one cloud.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PepperErrors {
    /// Against the reference of § 3.2, from the reading's own center through the peduncle, in degrees.
    pub to_reference_deg: f64,
    /// Against the axis that the pepper was made around, in degrees.
    pub to_truth_deg: f64,
    /// The error of the reference itself against that axis, in degrees.
    pub reference_to_truth_deg: f64,
    /// The distance of the reading's center from the true one, in centimeters.
    pub center_off_cm: f64,
}

/// Runs the experiment of § 3.2. The watch is told of each finished pepper.
///
/// # Errors
/// Returns an error if a pepper cannot be simulated or analyzed, or the watch cancels the work.
pub fn run_peppers(
    settings: &ReproduceSettings,
    watch: &dyn Watch,
) -> Result<Vec<ReproducedPepper>, ReproduceError> {
    let seeds = seeds(settings.seed, settings.peppers);
    let peppers = map_pieces(settings.peppers, 1, watch, |job| {
        analyze_pepper(seeds[job.start], settings.u)
    })?;
    peppers.into_iter().collect()
}

fn analyze_pepper(seed: u64, u: usize) -> Result<ReproducedPepper, ReproduceError> {
    let simulated = PepperSettings {
        seed,
        ..PepperSettings::default()
    }
    .simulate()?;
    let peduncle = Peduncle::by_label(&simulated.cloud)?;
    let variant = |cloud: Cloud| analyze_variant(cloud, &peduncle, &simulated.truth, u);
    Ok(ReproducedPepper {
        seed,
        with_peduncle: variant(simulated.cloud.clone())?,
        without_peduncle: variant(peduncle.removed_from(&simulated.cloud))?,
    })
}

fn analyze_variant(
    cloud: Cloud,
    peduncle: &Peduncle,
    truth: &Truth,
    u: usize,
) -> Result<PepperVariant, ReproduceError> {
    let filters = Filters {
        keep_strays: false,
        outliers: Some(OutlierFilter {
            neighbors: const { NonZeroUsize::new(OUTLIER_NEIGHBORS).unwrap() },
            std_ratio: OUTLIER_STD,
        }),
        voxel_cm: Some(VOXEL_CM),
        max_points: usize::MAX,
    };
    let errors = |result: &ReadingResult| -> Result<PepperErrors, ReproduceError> {
        let (axis, true_axis) = (result.axis.direction, truth.axis.direction);
        let reference = peduncle.reference_axis(result.center_cm)?.direction;
        Ok(PepperErrors {
            to_reference_deg: angle_between_lines_rad(axis, reference).to_degrees(),
            to_truth_deg: angle_between_lines_rad(axis, true_axis).to_degrees(),
            reference_to_truth_deg: angle_between_lines_rad(reference, true_axis).to_degrees(),
            center_off_cm: result.center_cm.distance(truth.center),
        })
    };
    let results = analyze_by_readings(cloud, filters, truth.center, u, truth.seed)?;
    let mut readings = [None; READINGS.len()];
    for (result, reading) in results.readings.iter().zip(&mut readings) {
        *reading = result.as_ref().map(errors).transpose()?;
    }
    Ok(PepperVariant {
        points: results.points,
        readings,
    })
}
