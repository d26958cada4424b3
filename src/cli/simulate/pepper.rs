//! The options of a simulated pepper.

use std::path::{Path, PathBuf};

use anyhow::Context;
use axiscope::files::read_at_most;
use axiscope::simulate::{FruitColor, PepperSettings, Settings, Truth};
use clap::Args;
use glam::DVec3;

use super::camera::{CameraOptions, ViewOptions};
use super::{Output, OutputUnit, set};
use crate::cli::options::{pair, position};

/// The settings of a pepper; the seed draws those that are not given.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct Pepper {
    #[command(flatten)]
    pub(super) output: Output,
    #[command(flatten)]
    pub(super) unit: OutputUnit,
    /// Leave the peduncle's points out: the paper's second variant (§ 3.2)
    #[arg(long)]
    pub(super) without_peduncle: bool,
    /// Start from the settings in a truth file (or a JSON object of settings) instead of the defaults
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,

    /// Height from the lowest lobe to the shoulders, in cm
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    height_cm: Option<f64>,
    /// Width in cm: twice the largest distance of a lobe from the axis
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    width_cm: Option<f64>,
    /// Number of lobes
    #[arg(long, value_name = "N", help_heading = "Fruit")]
    lobes: Option<u32>,
    /// Depth of the grooves between lobes, relative to the radius
    #[arg(long, value_name = "X", help_heading = "Fruit")]
    lobe_depth: Option<f64>,
    /// Narrowing towards the blossom end, relative to the width
    #[arg(long, value_name = "X", help_heading = "Fruit")]
    taper: Option<f64>,
    /// Depth of the dimple at the stem end, in cm
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    dimple_cm: Option<f64>,
    /// Departure from symmetry, relative to the fruit's size [default: 0.03]
    #[arg(long, value_name = "X", help_heading = "Fruit")]
    asymmetry: Option<f64>,
    /// The fruit's color
    #[arg(long, value_enum, help_heading = "Fruit")]
    color: Option<FruitColor>,
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

impl Pepper {
    /// Returns the settings that the options make; the caller sets the seed.
    pub(super) fn settings(&self) -> anyhow::Result<PepperSettings> {
        let mut s = match &self.settings {
            Some(path) => read_settings(path)?,
            None => PepperSettings::default(),
        };
        s.height_cm = self.height_cm.or(s.height_cm);
        s.width_cm = self.width_cm.or(s.width_cm);
        s.lobes = self.lobes.or(s.lobes);
        s.lobe_depth = self.lobe_depth.or(s.lobe_depth);
        s.taper = self.taper.or(s.taper);
        s.dimple_cm = self.dimple_cm.or(s.dimple_cm);
        s.color = self.color.or(s.color);
        s.peduncle_length_cm = self.peduncle_length_cm.or(s.peduncle_length_cm);
        s.peduncle_width_cm = self.peduncle_width_cm.or(s.peduncle_width_cm);
        s.peduncle_bend_deg = self.peduncle_bend_deg.or(s.peduncle_bend_deg);
        s.tilt_towards_camera_deg = self.tilt_towards_camera_deg.or(s.tilt_towards_camera_deg);
        s.tilt_sideways_deg = self.tilt_sideways_deg.or(s.tilt_sideways_deg);
        s.spin_deg = self.spin_deg.or(s.spin_deg);
        s.center_cm = self.center_cm.or(s.center_cm);
        set(&mut s.asymmetry, self.asymmetry);
        set(
            &mut s.max_tilt_towards_camera_deg,
            self.max_tilt_towards_camera_deg,
        );
        set(&mut s.max_tilt_sideways_deg, self.max_tilt_sideways_deg);
        set(&mut s.distance_cm, self.distance_cm);
        set(&mut s.leaf_cover, self.leaf_cover);
        self.camera.apply(&mut s.camera);
        self.views.apply(&mut s.scan)?;
        Ok(s)
    }
}

/// The longest file of settings, in bytes.
const LONGEST_SETTINGS: u64 = 1 << 20;

/// The settings of a truth file, or of a file that holds nothing else.
fn read_settings(path: &Path) -> anyhow::Result<PepperSettings> {
    let text = read_at_most(path, LONGEST_SETTINGS).with_context(|| path.display().to_string())?;
    if let Ok(truth) = serde_json::from_slice::<Truth>(&text) {
        return match truth.settings {
            Settings::Pepper(settings) => Ok(*settings),
            Settings::Ellipsoid(_) | Settings::Mesh(_) => {
                anyhow::bail!("{}: these are not a pepper's settings", path.display())
            }
        };
    }
    serde_json::from_slice(&text).with_context(|| format!("{}: no settings of a pepper", path.display()))
}
