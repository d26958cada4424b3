//! § 3.1: the simulated ellipsoid at every depth, many runs each.

use glam::DVec3;

use super::readings::{Analyzed, EVERY_READING, READINGS, ReadingResult, ReadingResults};
use super::{ReproduceError, ReproduceSettings, Spread};
use crate::geometry::angle_between_lines_rad;
use crate::method::{Filters, NormalSource, symmetry_axis};
use crate::parallel::{Watch, map_pieces};
use crate::simulate::{EllipsoidSettings, seeds};

/// The normal of the upright candidate: the plane that divides the image into left and right. It is on the grid where
/// u is odd.
pub const UPRIGHT: DVec3 = DVec3::X;

/// The errors of all runs at one depth.
#[derive(Debug, Clone, PartialEq)]
pub struct EllipsoidDepth {
    /// The depth of the ellipsoid's center in centimeters.
    pub z0_cm: f64,
    /// The least error against the axis of revolution that Eq. 16 leaves possible, in degrees.
    pub least_error_to_revolution_axis_deg: f64,
    /// The error of the upright candidate with the true center against image-up, in degrees: by Eq. 16 it is
    /// atan(y₀ / z₀), whatever the points.
    pub upright_deg: f64,
    /// For each of [`ReproduceSettings::grid_sizes`], one for each of [`READINGS`]; `None` if no run gave an axis.
    pub grids: Vec<Vec<Option<EllipsoidErrors>>>,
}

/// One reading's errors at one depth.
#[derive(Debug, Clone, PartialEq)]
pub struct EllipsoidErrors {
    /// Errors against the axis that is taken as true, image-up, in degrees.
    pub to_image_up_deg: Spread,
    /// Errors against the nearest axis in the ellipsoid's equator, in degrees: each of those is an axis
    /// of symmetry.
    pub to_nearest_axis_deg: Spread,
    /// Errors of the upright candidate with the reading's centers against image-up, in degrees.
    pub upright_deg: Spread,
    /// The share of the runs that the upright candidate wins, 0 to 1.
    pub upright_wins: f64,
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
        let z0_cm = settings.depths_cm[depth];
        analyze_ellipsoid(settings, settings.grids_of_run(run), z0_cm, runs[run])
    })?;
    let results: Vec<ReadingResults> = results.into_iter().collect::<Result<_, _>>()?;
    let depths = settings.depths_cm.iter().zip(results.chunks(settings.runs));
    Ok(depths
        .map(|(&z0_cm, runs)| summarize(settings, z0_cm, runs))
        .collect())
}

fn analyze_ellipsoid(
    settings: &ReproduceSettings,
    grid_sizes: &[usize],
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
    let analyzed = Analyzed {
        filters: Filters {
            max_points: usize::MAX,
            ..Filters::default()
        },
        normals: NormalSource::Estimate,
        grid_sizes,
        readings: &EVERY_READING,
        search_seed: seed,
    };
    Ok(analyzed.analyze(ellipsoid.simulate()?.cloud, center_cm)?)
}

fn summarize(settings: &ReproduceSettings, z0_cm: f64, runs: &[ReadingResults]) -> EllipsoidDepth {
    let DVec3 { x, y, .. } = EllipsoidSettings::default().center_cm;
    let grid = |grid: usize| {
        let with_grid = runs.iter().enumerate().filter_map(move |(run, results)| {
            let place = settings
                .grids_of_run(run)
                .iter()
                .position(|&u| u == settings.grid_sizes[grid])?;
            Some(&results.grids[place])
        });
        (0..READINGS.len())
            .map(|i| EllipsoidErrors::of(with_grid.clone().filter_map(move |results| results[i].as_ref())))
            .collect()
    };
    EllipsoidDepth {
        z0_cm,
        least_error_to_revolution_axis_deg: 90.0 - x.hypot(y).atan2(z0_cm).to_degrees(),
        upright_deg: to_image_up_deg(upright_axis(DVec3::new(x, y, z0_cm))),
        grids: (0..settings.grid_sizes.len()).map(grid).collect(),
    }
}

impl EllipsoidErrors {
    fn of<'a>(results: impl Iterator<Item = &'a ReadingResult> + Clone) -> Option<Self> {
        let axes = || results.clone().map(|result| result.axis.direction);
        let upright = results.clone().map(|result| upright_axis(result.center_cm));
        let runs = results.clone().count();
        let wins = results
            .clone()
            .filter(|result| result.normal.distance(UPRIGHT) < 1e-9);
        Some(Self {
            to_image_up_deg: Spread::of(axes().map(to_image_up_deg))?,
            to_nearest_axis_deg: Spread::of(axes().map(|axis| axis.z.abs().asin().to_degrees()))?,
            upright_deg: Spread::of(upright.map(to_image_up_deg))?,
            upright_wins: wins.count() as f64 / runs as f64,
            partner_share: Spread::of(results.map(|result| result.partner_share))?,
            runs,
        })
    }
}

/// The axis of the upright candidate through a center in front of the camera (Eq. 16).
fn upright_axis(center_cm: DVec3) -> DVec3 {
    // The ray to a point in front is never along the image's rows.
    symmetry_axis(UPRIGHT, center_cm, DVec3::ZERO).unwrap_or(DVec3::NEG_Y)
}

fn to_image_up_deg(axis: DVec3) -> f64 {
    angle_between_lines_rad(axis, DVec3::NEG_Y).to_degrees()
}
