//! § 3.2 on simulated peppers, with and without their peduncle: the paper's own clouds are not ours to give.

use std::num::NonZeroUsize;

use axiscope::geometry::{Cloud, Unit, angle_between_lines_rad, statistical_inliers, voxel_grid};
use axiscope::method::{Params, Preset, Surface};
use axiscope::parallel::{Watch, map_pieces};
use axiscope::peduncle::Peduncle;
use axiscope::simulate::{PepperSettings, Truth, seeds};
use glam::DVec3;

use super::readings::{Found, all_readings};

/// The edge of the voxel grid, and the outlier filter's two numbers: § 2.1 names both filters and
/// tells no number.
pub(super) const VOXEL_CM: f64 = 0.2;
pub(super) const OUTLIER_NEIGHBORS: usize = 50;
pub(super) const OUTLIER_STD: f64 = 1.0;

/// One pepper in both of the paper's variants.
pub(super) struct Pepper {
    pub(super) seed: u64,
    pub(super) with_peduncle: Variant,
    pub(super) without_peduncle: Variant,
}

/// One cloud under every reading.
pub(super) struct Variant {
    pub(super) points: usize,
    pub(super) readings: [Option<PepperErrors>; 8],
}

/// One reading's errors on one cloud.
#[derive(Debug, Clone, Copy)]
pub(super) struct PepperErrors {
    /// Against the reference of § 3.2, from the reading's own center through the peduncle.
    pub(super) to_reference_deg: f64,
    /// Against the axis that the pepper was made around.
    pub(super) to_truth_deg: f64,
    /// How far the reference itself is from that axis.
    pub(super) reference_to_truth_deg: f64,
    /// How far the reading's center is from the true one.
    pub(super) center_off_cm: f64,
}

pub(super) fn run(count: usize, u: usize, seed: u64, watch: &dyn Watch) -> anyhow::Result<Vec<Pepper>> {
    let seeds = seeds(seed, count);
    let peppers = map_pieces(count, 1, watch, |job| one_pepper(seeds[job.start], u))?;
    peppers.into_iter().collect()
}

fn one_pepper(seed: u64, u: usize) -> anyhow::Result<Pepper> {
    let simulated = PepperSettings {
        seed,
        ..PepperSettings::default()
    }
    .simulate()?;
    let peduncle = Peduncle::by_label(&simulated.cloud)?;
    let variant = |cloud: &Cloud| variant(cloud, &peduncle, &simulated.truth, u);
    Ok(Pepper {
        seed,
        with_peduncle: variant(&simulated.cloud)?,
        without_peduncle: variant(&peduncle.removed_from(&simulated.cloud))?,
    })
}

fn variant(cloud: &Cloud, peduncle: &Peduncle, truth: &Truth, u: usize) -> anyhow::Result<Variant> {
    let neighbors = const { NonZeroUsize::new(OUTLIER_NEIGHBORS).unwrap() };
    let inliers = statistical_inliers(cloud.positions(), neighbors, OUTLIER_STD, &())?;
    let cloud = voxel_grid(&cloud.select(&inliers), VOXEL_CM);
    let k = Params::new(Preset::AsIntended, Unit::Centimeter).k;
    let surface = Surface::with_estimated_normals(&cloud, k, DVec3::ZERO, &())?;
    let errors = |found: Found| -> anyhow::Result<PepperErrors> {
        let reference = peduncle.reference_axis(found.center_cm)?.direction;
        Ok(PepperErrors {
            to_reference_deg: found.error_deg(reference),
            to_truth_deg: found.error_deg(truth.axis.direction),
            reference_to_truth_deg: angle_between_lines_rad(reference, truth.axis.direction).to_degrees(),
            center_off_cm: found.center_cm.distance(truth.center),
        })
    };
    let mut readings = [None; 8];
    for (found, errors_of) in all_readings(&surface, truth.center, u, truth.seed)?
        .into_iter()
        .zip(&mut readings)
    {
        *errors_of = found.map(errors).transpose()?;
    }
    Ok(Variant {
        points: surface.len(),
        readings,
    })
}
