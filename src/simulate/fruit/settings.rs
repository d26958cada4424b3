//! The settings of a simulated fruit and their ranges.

use serde::{Deserialize, Serialize};

use super::FruitKind;
use crate::simulate::error::{set_within, within};
use crate::simulate::{FruitColor, SimulateError, Surroundings};

/// A fruit of a kind and its surroundings.
///
/// The seed draws each field that is `None`, from the range of the kind. Setting one field leaves all others as
/// the seed draws them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FruitSettings {
    /// The kind.
    pub kind: FruitKind,
    /// The seed of everything that is drawn.
    #[serde(default)]
    pub seed: u64,
    /// The length along the axis, between the shoulders at the stem end and the blossom end; settable from 1 to 50 cm.
    pub length_cm: Option<f64>,
    /// Twice the largest distance of the surface from the axis, settable from 1 to 50 cm.
    pub width_cm: Option<f64>,
    /// The narrowing of the blossom end, relative to the width; below 0 it widens. Settable from -0.8 to 0.8.
    pub taper: Option<f64>,
    /// The narrowing of the neck at the stem end, relative to the width; settable from 0 to 0.8.
    pub neck: Option<f64>,
    /// The depth of the dent at the stem end, settable from 0 to a quarter of the length.
    pub dent_cm: Option<f64>,
    /// The number of ribs, settable from 1 to 12.
    pub ribs: Option<u32>,
    /// The depth of the grooves between ribs, relative to the radius; settable from 0 to 0.4.
    pub rib_depth: Option<f64>,
    /// The angle that a bent fruit turns by from end to end, 0 to 60°; never drawn. The axis of a bent fruit
    /// runs from end to end, through the mean of its middle line.
    #[serde(default)]
    pub bend_deg: f64,
    /// The departure from symmetry, relative to the fruit's size, as a pepper's; settable from 0 to 0.2.
    pub asymmetry: Option<f64>,
    /// The fruit's color.
    pub color: Option<FruitColor>,
    /// Peduncle, pose, leaf, camera and views. Without a length that is set, a ball has no peduncle.
    #[serde(default)]
    pub surroundings: Surroundings,
}

impl FruitSettings {
    /// Returns the settings of a fruit of a kind, all of which are left to the seed, straight and with nothing before it.
    pub fn new(kind: FruitKind) -> Self {
        Self {
            kind,
            seed: 0,
            length_cm: None,
            width_cm: None,
            taper: None,
            neck: None,
            dent_cm: None,
            ribs: None,
            rib_depth: None,
            bend_deg: 0.0,
            asymmetry: None,
            color: None,
            surroundings: Surroundings::default(),
        }
    }

    /// Checks the range of every setting, which NaN is out of.
    pub(super) fn check(&self) -> Result<(), SimulateError> {
        const SIZE: (f64, f64) = (1.0, 50.0);
        set_within("length_cm", self.length_cm, SIZE, "1 to 50")?;
        set_within("width_cm", self.width_cm, SIZE, "1 to 50")?;
        set_within("taper", self.taper, (-0.8, 0.8), "-0.8 to 0.8")?;
        set_within("neck", self.neck, (0.0, 0.8), "0 to 0.8")?;
        set_within("ribs", self.ribs.map(f64::from), (1.0, 12.0), "1 to 12")?;
        set_within("rib_depth", self.rib_depth, (0.0, 0.4), "0 to 0.4")?;
        within("bend_deg", self.bend_deg, (0.0, 60.0), "0 to 60")?;
        set_within("asymmetry", self.asymmetry, (0.0, 0.2), "0 to 0.2")?;
        self.surroundings.check()
    }
}
