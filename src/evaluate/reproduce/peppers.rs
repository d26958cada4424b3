//! § 3.2 on simulated peppers, with and without their peduncle: the paper's own clouds are not ours to give.

use std::num::NonZeroUsize;

use super::readings::{Analyzed, READINGS, ReadingResult};
use super::scans::Scan;
use super::{ReproduceError, ReproduceSettings};
use crate::geometry::{Cloud, angle_between_lines_rad};
use crate::method::{CandidateGrid, Filters, OutlierFilter, symmetry_axis};
use crate::parallel::{Watch, map_pieces};
use crate::peduncle::Peduncle;
use crate::simulate::{Truth, seeds};

/// Neighbors of the outlier filter. § 2.1 names this filter and the voxel grid without a number.
pub(super) const OUTLIER_NEIGHBORS: usize = 50;
/// Standard deviations of the outlier filter.
pub(super) const OUTLIER_STD: f64 = 1.0;

/// A set of peppers that were scanned in one way.
#[derive(Debug, Clone, PartialEq)]
pub struct ScannedPeppers {
    /// The way that they were scanned and analyzed.
    pub scan: Scan,
    /// The peppers.
    pub peppers: Vec<ReproducedPepper>,
}

/// One pepper in both of the paper's variants.
#[derive(Debug, Clone, PartialEq)]
pub struct ReproducedPepper {
    /// The seed that it was made from.
    pub seed: u64,
    /// The share of the fruit's surface that was seen, 0 to 1.
    pub coverage: Option<f64>,
    /// The lean of its axis out of the plane across the view ray, in degrees, not negative: by Eq. 16 no error against
    /// the true axis is less.
    pub lean_deg: f64,
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
    /// For each of [`ReproduceSettings::grid_sizes`], one for each of [`READINGS`]; `None` for a reading without an
    /// axis, or that was not computed.
    pub grids: Vec<[Option<PepperErrors>; READINGS.len()]>,
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
    /// The error against the reference of § 3.2 of the candidate that is best by it, in degrees: the limit that the
    /// grid sets for this center.
    pub best_candidate_deg: f64,
}

impl ReproducedPepper {
    /// One of its two clouds.
    pub fn variant(&self, with_peduncle: bool) -> &PepperVariant {
        if with_peduncle {
            &self.with_peduncle
        } else {
            &self.without_peduncle
        }
    }
}

/// Runs the experiment of § 3.2 on one set of peppers, with the readings at the indices `readings`. The watch is told
/// of each finished pepper.
///
/// # Errors
/// Returns an error if a pepper cannot be simulated or analyzed, or the watch cancels the work.
pub fn run_peppers(
    settings: &ReproduceSettings,
    scan: &Scan,
    readings: &[usize],
    watch: &dyn Watch,
) -> Result<ScannedPeppers, ReproduceError> {
    let seeds = seeds(scan.seed, settings.peppers);
    let peppers = map_pieces(settings.peppers, 1, watch, |job| {
        analyze_pepper(scan, &settings.grid_sizes, readings, seeds[job.start])
    })?;
    Ok(ScannedPeppers {
        scan: scan.clone(),
        peppers: peppers.into_iter().collect::<Result<_, _>>()?,
    })
}

fn analyze_pepper(
    scan: &Scan,
    grid_sizes: &[usize],
    readings: &[usize],
    seed: u64,
) -> Result<ReproducedPepper, ReproduceError> {
    let simulated = scan.pepper(seed).simulate()?;
    let peduncle = Peduncle::by_label(&simulated.cloud)?;
    let analyzed = Analyzed {
        filters: filters(scan.voxel_cm),
        normals: scan.normals(),
        grid_sizes,
        readings,
        search_seed: seed.wrapping_add(scan.search),
    };
    let variant = |cloud: Cloud| analyze_variant(cloud, &peduncle, &simulated.truth, &analyzed);
    Ok(ReproducedPepper {
        seed,
        coverage: simulated.truth.coverage,
        lean_deg: simulated.truth.lean_deg().abs(),
        with_peduncle: variant(simulated.cloud.clone())?,
        without_peduncle: variant(peduncle.removed_from(&simulated.cloud))?,
    })
}

/// The filters that § 2.1 names.
pub(super) fn filters(voxel_cm: f64) -> Filters {
    Filters {
        keep_strays: false,
        outliers: Some(OutlierFilter {
            neighbors: const { NonZeroUsize::new(OUTLIER_NEIGHBORS).unwrap() },
            std_ratio: OUTLIER_STD,
        }),
        voxel_cm: Some(voxel_cm),
        max_points: usize::MAX,
    }
}

fn analyze_variant(
    cloud: Cloud,
    peduncle: &Peduncle,
    truth: &Truth,
    analyzed: &Analyzed<'_>,
) -> Result<PepperVariant, ReproduceError> {
    let errors = |result: &ReadingResult, u: usize| -> Result<PepperErrors, ReproduceError> {
        let (axis, true_axis) = (result.axis.direction, truth.axis.direction);
        let reference = peduncle.reference_axis(result.center_cm)?.direction;
        let to = |axis, reference| angle_between_lines_rad(axis, reference).to_degrees();
        let grid = CandidateGrid::new(u).map_err(crate::method::AnalysisError::from)?;
        let axes = grid
            .candidates()
            .filter_map(|c| symmetry_axis(c.normal, result.center_cm, truth.viewpoint).ok());
        Ok(PepperErrors {
            to_reference_deg: to(axis, reference),
            to_truth_deg: to(axis, true_axis),
            reference_to_truth_deg: to(reference, true_axis),
            center_off_cm: result.center_cm.distance(truth.center),
            best_candidate_deg: axes.map(|axis| to(axis, reference)).fold(90.0, f64::min),
        })
    };
    let results = analyzed.analyze(cloud, truth.center)?;
    let mut grids = vec![[None; READINGS.len()]; analyzed.grid_sizes.len()];
    for ((results, errors_of_grid), &u) in results.grids.iter().zip(&mut grids).zip(analyzed.grid_sizes) {
        for (result, reading) in results.iter().zip(errors_of_grid) {
            *reading = result.as_ref().map(|r| errors(r, u)).transpose()?;
        }
    }
    Ok(PepperVariant {
        points: results.points,
        grids,
    })
}
