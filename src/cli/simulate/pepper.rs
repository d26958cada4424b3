//! The options of a simulated pepper.

use std::path::PathBuf;

use axiscope::simulate::{FruitColor, PepperSettings, Settings};
use clap::Args;

use super::surroundings::SurroundingsOptions;
use super::{Output, OutputUnit, read_settings, set};

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
    #[command(flatten)]
    surroundings: SurroundingsOptions,
}

impl Pepper {
    /// Returns the settings that the options make; the caller sets the seed.
    pub(super) fn settings(&self) -> anyhow::Result<PepperSettings> {
        let mut s = match &self.settings {
            Some(path) => read_settings(path, "pepper", |settings| match settings {
                Settings::Pepper(settings) => Some(*settings),
                _ => None,
            })?,
            None => PepperSettings::default(),
        };
        s.height_cm = self.height_cm.or(s.height_cm);
        s.width_cm = self.width_cm.or(s.width_cm);
        s.lobes = self.lobes.or(s.lobes);
        s.lobe_depth = self.lobe_depth.or(s.lobe_depth);
        s.taper = self.taper.or(s.taper);
        s.dimple_cm = self.dimple_cm.or(s.dimple_cm);
        s.color = self.color.or(s.color);
        set(&mut s.asymmetry, self.asymmetry);
        let mut surroundings = s.surroundings();
        self.surroundings.apply(&mut surroundings)?;
        Ok(s.with_surroundings(surroundings))
    }
}
