//! The options of the depth camera, and of the views that it takes.

use std::path::PathBuf;

use anyhow::Context;
use axiscope::simulate::{DepthCamera, ScanSettings, parse_trajectory};
use clap::Args;

use super::set;
use crate::cli::options::pair;
use crate::cli::usage_error;

/// The camera's errors of measurement.
#[derive(Debug, Args)]
#[command(next_help_heading = "Camera")]
pub(super) struct CameraOptions {
    /// Standard deviation of a depth at 40 cm, in cm; it grows with the square of the distance [default: 0.05]
    #[arg(long, value_name = "CM")]
    noise_cm: Option<f64>,
    /// Step of the depths, which are whole multiples of it, in cm; 0 for none [default: 0.1]
    #[arg(long, value_name = "CM")]
    depth_step_cm: Option<f64>,
    /// Angle between ray and normal beyond which pixels begin to fail, in degrees [default: 70]
    #[arg(long, value_name = "DEG")]
    grazing_deg: Option<f64>,
    /// Fraction of all other pixels that fail at random [default: 0.01]
    #[arg(long, value_name = "F")]
    dropout: Option<f64>,
}

impl CameraOptions {
    pub(super) fn apply(&self, camera: &mut DepthCamera) {
        set(&mut camera.noise_cm, self.noise_cm);
        set(&mut camera.step_cm, self.depth_step_cm);
        set(&mut camera.grazing_deg, self.grazing_deg);
        set(&mut camera.dropout, self.dropout);
    }
}

/// The views of a scan. Several are fused in the frame of the middle one.
#[derive(Debug, Args)]
#[command(next_help_heading = "Views")]
pub(super) struct ViewOptions {
    /// Number of depth images, taken on a way around the fruit and fused to one cloud with normals [default: 1]
    #[arg(long, value_name = "N", conflicts_with = "poses")]
    views: Option<u32>,
    /// Whole arc of the way around the vertical through the fruit, in degrees: 180 is ±90° [default: 180]
    #[arg(long, value_name = "DEG", conflicts_with = "poses")]
    arc: Option<f64>,
    /// Whole arc up and down, in degrees: on its way around, the camera waves by half of it [default: 0]
    #[arg(long, value_name = "DEG", conflicts_with = "poses")]
    arc_up: Option<f64>,
    /// Camera poses instead of a way: a file with a time, x y z in meters and a quaternion x y z w in each line (TUM
    /// RGB-D); the frame is that of the middle pose
    #[arg(long, value_name = "FILE")]
    poses: Option<PathBuf>,
    /// Standard deviations with which the camera's rotation (about each axis, in degrees) and position (along each axis,
    /// in cm) are known when views are fused [default: 0.2,0.1]
    #[arg(long, value_name = "DEG,CM", value_parser = pair, allow_hyphen_values = true)]
    pose_noise: Option<[f64; 2]>,
    /// Edge of the voxel grid in which views are fused, in cm [default: 0.2]
    #[arg(long, value_name = "CM")]
    voxel_cm: Option<f64>,
}

impl ViewOptions {
    /// # Errors
    /// Returns an error if there is a way for a single view, or the file of poses cannot be read.
    pub(super) fn apply(&self, scan: &mut ScanSettings) -> anyhow::Result<()> {
        let on_a_way = self.views.is_some() || self.arc.is_some() || self.arc_up.is_some();
        if on_a_way {
            scan.poses.clear();
        }
        set(&mut scan.views, self.views);
        set(&mut scan.arc_deg, self.arc);
        set(&mut scan.arc_up_deg, self.arc_up);
        set(&mut scan.voxel_cm, self.voxel_cm);
        if (self.arc.is_some() || self.arc_up.is_some()) && !scan.is_fused() {
            return Err(usage_error(
                "--arc and --arc-up describe the way of several views: give --views, too",
            ));
        }
        if let Some([degrees, cm]) = self.pose_noise {
            (scan.pose_noise_deg, scan.pose_noise_cm) = (degrees, cm);
        }
        if let Some(path) = &self.poses {
            let name = || path.display().to_string();
            let text = std::fs::read_to_string(path).with_context(name)?;
            scan.poses = parse_trajectory(&text).with_context(name)?;
        }
        Ok(())
    }
}
