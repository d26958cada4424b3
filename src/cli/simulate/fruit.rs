//! The options of a simulated fruit of another kind than a pepper.

use std::path::PathBuf;

use axiscope::simulate::{FruitColor, FruitKind, FruitSettings, Settings};
use clap::Args;

use super::surroundings::SurroundingsOptions;
use super::{Output, OutputUnit, read_settings, set};
use crate::cli::usage_error;

/// The settings of a fruit; the seed draws those that are not given, from the ranges of its kind.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct Fruit {
    #[command(flatten)]
    pub(super) output: Output,
    #[command(flatten)]
    pub(super) unit: OutputUnit,
    /// Kind of fruit
    #[arg(long, value_enum, required_unless_present = "settings")]
    kind: Option<FruitKind>,
    /// Leave the peduncle's points out
    #[arg(long)]
    pub(super) without_peduncle: bool,
    /// Start from the settings in a truth file (or a JSON object of settings) instead of the defaults
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,

    /// Length along the axis, in cm
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    length_cm: Option<f64>,
    /// Width in cm: twice the largest distance of the surface from the axis
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    width_cm: Option<f64>,
    /// Narrowing towards the blossom end, relative to the width; below 0 it widens
    #[arg(long, value_name = "X", help_heading = "Fruit")]
    taper: Option<f64>,
    /// Narrowing of the neck at the stem end, relative to the width
    #[arg(long, value_name = "X", help_heading = "Fruit")]
    neck: Option<f64>,
    /// Depth of the dent at the stem end, in cm
    #[arg(long, value_name = "CM", help_heading = "Fruit")]
    dent_cm: Option<f64>,
    /// Number of ribs
    #[arg(long, value_name = "N", help_heading = "Fruit")]
    ribs: Option<u32>,
    /// Depth of the grooves between ribs, relative to the radius
    #[arg(long, value_name = "X", help_heading = "Fruit")]
    rib_depth: Option<f64>,
    /// Angle that the fruit turns by from end to end, in degrees [default: 0]
    #[arg(long, value_name = "DEG", help_heading = "Fruit")]
    bend_deg: Option<f64>,
    /// Departure from symmetry, relative to the fruit's size
    #[arg(long, value_name = "X", help_heading = "Fruit")]
    asymmetry: Option<f64>,
    /// The fruit's color
    #[arg(long, value_enum, help_heading = "Fruit")]
    color: Option<FruitColor>,
    #[command(flatten)]
    surroundings: SurroundingsOptions,
}

impl Fruit {
    /// Returns the settings that the options make; the caller sets the seed.
    pub(super) fn settings(&self) -> anyhow::Result<FruitSettings> {
        let mut s = match (&self.settings, self.kind) {
            (Some(path), _) => read_settings(path, "fruit", |settings| match settings {
                Settings::Fruit(settings) => Some(*settings),
                _ => None,
            })?,
            (None, Some(kind)) => FruitSettings::new(kind),
            (None, None) => return Err(usage_error("--kind names the kind of fruit")),
        };
        set(&mut s.kind, self.kind);
        s.length_cm = self.length_cm.or(s.length_cm);
        s.width_cm = self.width_cm.or(s.width_cm);
        s.taper = self.taper.or(s.taper);
        s.neck = self.neck.or(s.neck);
        s.dent_cm = self.dent_cm.or(s.dent_cm);
        s.ribs = self.ribs.or(s.ribs);
        s.rib_depth = self.rib_depth.or(s.rib_depth);
        set(&mut s.bend_deg, self.bend_deg);
        s.asymmetry = self.asymmetry.or(s.asymmetry);
        s.color = self.color.or(s.color);
        self.surroundings.apply(&mut s.surroundings)?;
        Ok(s)
    }
}
