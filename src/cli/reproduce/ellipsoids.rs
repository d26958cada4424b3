//! § 3.1: the simulated ellipsoid at every depth, many runs each.

use std::num::NonZeroUsize;

use axiscope::method::{Preset, Surface};
use axiscope::parallel::{Watch, map_pieces};
use axiscope::simulate::{EllipsoidSettings, seeds};
use glam::DVec3;

use super::readings::{Found, READINGS, Summary, all_readings};

/// What is simulated.
pub(super) struct Settings<'a> {
    pub(super) depths_cm: &'a [f64],
    pub(super) runs: usize,
    pub(super) points: usize,
    pub(super) u: usize,
    pub(super) seed: u64,
}

/// All runs at one depth, summarized.
pub(super) struct Depth {
    pub(super) z0_cm: f64,
    /// The least error against the axis of revolution that Eq. 16 leaves possible, in degrees.
    pub(super) least_error_to_revolution_axis_deg: f64,
    /// One a reading; `None` where no run gave an axis.
    pub(super) readings: Vec<Option<Errors>>,
}

/// One reading's errors at one depth.
pub(super) struct Errors {
    /// Against the axis that is taken as true, image-up, in degrees.
    pub(super) to_image_up_deg: Summary,
    /// Against the nearest axis in the ellipsoid's equator, in degrees: each of them is an axis of
    /// symmetry.
    pub(super) to_nearest_axis_deg: Summary,
    /// Partners under the winning plane, as a share of the points.
    pub(super) partner_share: Summary,
    /// Runs that gave an axis.
    pub(super) runs: usize,
}

pub(super) fn run(settings: &Settings<'_>, watch: &dyn Watch) -> anyhow::Result<Vec<Depth>> {
    let runs = seeds(settings.seed, settings.runs);
    let jobs = settings.depths_cm.len() * settings.runs;
    let found = map_pieces(jobs, 1, watch, |job| {
        let (depth, run) = (job.start / settings.runs, job.start % settings.runs);
        one_run(settings, settings.depths_cm[depth], runs[run])
    })?;
    let found: Vec<[Option<Found>; 8]> = found.into_iter().collect::<Result<_, _>>()?;
    let depths = settings.depths_cm.iter().zip(found.chunks(settings.runs));
    Ok(depths.map(|(&z0_cm, runs)| summarize(z0_cm, runs)).collect())
}

fn one_run(settings: &Settings<'_>, z0_cm: f64, seed: u64) -> anyhow::Result<[Option<Found>; 8]> {
    let defaults = EllipsoidSettings::default();
    let center_cm = DVec3::new(defaults.center_cm.x, defaults.center_cm.y, z0_cm);
    let ellipsoid = EllipsoidSettings {
        center_cm,
        points: settings.points,
        seed,
        ..defaults
    };
    let cloud = ellipsoid.simulate()?.cloud;
    let k = axiscope::method::Params::new(Preset::AsIntended, axiscope::geometry::Unit::Centimeter).k;
    let surface = surface(&cloud, k)?;
    all_readings(&surface, center_cm, settings.u, seed)
}

fn surface(cloud: &axiscope::geometry::Cloud, k: NonZeroUsize) -> anyhow::Result<Surface> {
    Ok(Surface::with_estimated_normals(cloud, k, DVec3::ZERO, &())?)
}

fn summarize(z0_cm: f64, runs: &[[Option<Found>; 8]]) -> Depth {
    let center = EllipsoidSettings::default().center_cm;
    let off_axis = center.x.hypot(center.y);
    let reading = |i: usize| {
        let found = || runs.iter().filter_map(move |run| run[i]);
        Some(Errors {
            to_image_up_deg: Summary::of(found().map(|f| f.error_deg(DVec3::NEG_Y)))?,
            to_nearest_axis_deg: Summary::of(found().map(|f| f.axis.z.abs().asin().to_degrees()))?,
            partner_share: Summary::of(found().map(|f| f.partner_share))?,
            runs: found().count(),
        })
    };
    Depth {
        z0_cm,
        least_error_to_revolution_axis_deg: 90.0 - off_axis.atan2(z0_cm).to_degrees(),
        readings: (0..READINGS.len()).map(reading).collect(),
    }
}
