//! The options of a fruit's surroundings: peduncle, pose, leaf, camera and views.

use axiscope::simulate::Surroundings;
use clap::Args;
use glam::DVec3;

use super::camera::{CameraOptions, ViewOptions};
use super::set;
use crate::cli::options::{pair, position};

/// The settings of the surroundings; the seed draws those that are not given.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct SurroundingsOptions {
    /// Length of the peduncle, in cm
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    peduncle_length_cm: Option<f64>,
    /// Thickness of the peduncle, in cm
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    peduncle_width_cm: Option<f64>,
    /// Angle between the fruit's axis and the peduncle's free end, in degrees
    #[arg(long, value_name = "DEG", help_heading = "Fruit")]
    peduncle_bend_deg: Option<f64>,

    /// Lean of the stem end towards the camera, in degrees
    #[arg(long, value_name = "DEG", help_heading = "Pose")]
    tilt_towards_camera_deg: Option<f64>,
    /// Lean of the axis to the image's right, in degrees
    #[arg(long, value_name = "DEG", help_heading = "Pose")]
    tilt_sideways_deg: Option<f64>,
    /// Largest lean towards or away from the camera that the seed draws, in degrees [default: 25]
    #[arg(long, value_name = "DEG", help_heading = "Pose")]
    max_tilt_towards_camera_deg: Option<f64>,
    /// Largest lean to a side that the seed draws, in degrees [default: 25]
    #[arg(long, value_name = "DEG", help_heading = "Pose")]
    max_tilt_sideways_deg: Option<f64>,
    /// Turn about the fruit's own axis, in degrees
    #[arg(long, value_name = "DEG", help_heading = "Pose")]
    spin_deg: Option<f64>,
    /// Nearest and farthest depth that the seed draws, in cm [default: 30,60]
    #[arg(long, value_name = "NEAR,FAR", value_parser = pair, help_heading = "Pose")]
    distance_cm: Option<[f64; 2]>,
    /// Position of the fruit's center in the camera's frame, in cm
    #[arg(long, value_name = "X,Y,Z", value_parser = position, allow_hyphen_values = true, help_heading = "Pose")]
    center_cm: Option<DVec3>,

    /// Fraction of the fruit that a leaf in front of it hides
    #[arg(long, value_name = "F", help_heading = "Camera")]
    leaf_cover: Option<f64>,
    #[command(flatten)]
    camera: CameraOptions,
    #[command(flatten)]
    views: ViewOptions,
}

impl SurroundingsOptions {
    /// Changes the settings that are given.
    ///
    /// # Errors
    /// Returns an error if the file of poses cannot be read.
    pub(super) fn apply(&self, s: &mut Surroundings) -> anyhow::Result<()> {
        s.peduncle_length_cm = self.peduncle_length_cm.or(s.peduncle_length_cm);
        s.peduncle_width_cm = self.peduncle_width_cm.or(s.peduncle_width_cm);
        s.peduncle_bend_deg = self.peduncle_bend_deg.or(s.peduncle_bend_deg);
        s.tilt_towards_camera_deg = self.tilt_towards_camera_deg.or(s.tilt_towards_camera_deg);
        s.tilt_sideways_deg = self.tilt_sideways_deg.or(s.tilt_sideways_deg);
        s.spin_deg = self.spin_deg.or(s.spin_deg);
        s.center_cm = self.center_cm.or(s.center_cm);
        set(
            &mut s.max_tilt_towards_camera_deg,
            self.max_tilt_towards_camera_deg,
        );
        set(&mut s.max_tilt_sideways_deg, self.max_tilt_sideways_deg);
        set(&mut s.distance_cm, self.distance_cm);
        set(&mut s.leaf_cover, self.leaf_cover);
        self.camera.apply(&mut s.camera);
        self.views.apply(&mut s.scan)
    }
}
