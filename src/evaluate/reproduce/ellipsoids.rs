//! § 3.1: the simulated ellipsoid at every depth, many runs each.

use glam::DVec3;

use super::readings::{READINGS, ReadingResult, ReadingResults, analyze_by_readings};
use super::{ReproduceError, ReproduceSettings, Spread};
use crate::geometry::angle_between_lines_rad;
use crate::method::Filters;
use crate::parallel::{Watch, map_pieces};
use crate::simulate::{EllipsoidSettings, seeds};

/// The errors of all runs at one depth.
#[derive(Debug, Clone, PartialEq)]
pub struct EllipsoidDepth {
    /// The depth of the ellipsoid's center in centimeters.
    pub z0_cm: f64,
    /// The least error against the axis of revolution that Eq. 16 leaves possible, in degrees.
    pub least_error_to_revolution_axis_deg: f64,
    /// One for each of [`READINGS`]; `None` if no run gave an axis.
    pub readings: Vec<Option<EllipsoidErrors>>,
}

/// One reading's errors at one depth.
#[derive(Debug, Clone, PartialEq)]
pub struct EllipsoidErrors {
    /// Errors against the axis that is taken as true, image-up, in degrees.
    pub to_image_up_deg: Spread,
    /// Errors against the nearest axis in the ellipsoid's equator, in degrees: each of those is an axis
    /// of symmetry.
    pub to_nearest_axis_deg: Spread,
    /// Shares of the points that have a partner under the symmetry plane, 0 to 1.
    pub partner_share: Spread,
    /// Runs that gave an axis.
    pub runs: usize,
}

/// Runs the experiment of § 3.1. The watch is told of each finished ellipsoid.
///
/// # Errors
/// Returns an error if an ellipsoid cannot be simulated or analyzed, or the watch cancels the work.
pub fn run_ellipsoids(
    settings: &ReproduceSettings,
    watch: &dyn Watch,
) -> Result<Vec<EllipsoidDepth>, ReproduceError> {
    let runs = seeds(settings.seed, settings.runs);
    let jobs = settings.depths_cm.len() * settings.runs;
    let results = map_pieces(jobs, 1, watch, |job| {
        let (depth, run) = (job.start / settings.runs, job.start % settings.runs);
        analyze_ellipsoid(settings, settings.depths_cm[depth], runs[run])
    })?;
    let results: Vec<ReadingResults> = results.into_iter().collect::<Result<_, _>>()?;
    let depths = settings.depths_cm.iter().zip(results.chunks(settings.runs));
    Ok(depths.map(|(&z0_cm, runs)| summarize(z0_cm, runs)).collect())
}

fn analyze_ellipsoid(
    settings: &ReproduceSettings,
    z0_cm: f64,
    seed: u64,
) -> Result<ReadingResults, ReproduceError> {
    let defaults = EllipsoidSettings::default();
    let center_cm = DVec3::new(defaults.center_cm.x, defaults.center_cm.y, z0_cm);
    let ellipsoid = EllipsoidSettings {
        center_cm,
        points: settings.points,
        seed,
        ..defaults
    };
    let every_point = Filters {
        max_points: usize::MAX,
        ..Filters::default()
    };
    let cloud = ellipsoid.simulate()?.cloud;
    Ok(analyze_by_readings(
        cloud,
        every_point,
        center_cm,
        settings.u,
        seed,
    )?)
}

fn summarize(z0_cm: f64, runs: &[ReadingResults]) -> EllipsoidDepth {
    let center = EllipsoidSettings::default().center_cm;
    let off_axis = center.x.hypot(center.y);
    let reading = |i: usize| {
        let results = || runs.iter().filter_map(move |run| run.readings[i].as_ref());
        let axes = || results().map(|result| result.axis.direction);
        let to_image_up_deg = |axis: DVec3| angle_between_lines_rad(axis, DVec3::NEG_Y).to_degrees();
        let partner_share = |result: &ReadingResult| result.partner_share;
        Some(EllipsoidErrors {
            to_image_up_deg: Spread::of(axes().map(to_image_up_deg))?,
            to_nearest_axis_deg: Spread::of(axes().map(|axis| axis.z.abs().asin().to_degrees()))?,
            partner_share: Spread::of(results().map(partner_share))?,
            runs: results().count(),
        })
    };
    EllipsoidDepth {
        z0_cm,
        least_error_to_revolution_axis_deg: 90.0 - off_axis.atan2(z0_cm).to_degrees(),
        readings: (0..READINGS.len()).map(reading).collect(),
    }
}
