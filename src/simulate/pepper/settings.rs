//! The settings of a simulated pepper and their ranges.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::simulate::error::{set_within, within};
use crate::simulate::{DepthCamera, FruitColor, ScanSettings, SimulateError, Surroundings};

/// A pepper and the camera that looks at it.
///
/// The seed draws each field that is `None`, from the range that the field names. Setting one field leaves
/// all others as the seed draws them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PepperSettings {
    /// The seed of everything that is drawn.
    pub seed: u64,

    /// The height from the lowest lobe to the shoulders; drawn from 7 to 11, settable from 1 to 50 cm.
    pub height_cm: Option<f64>,
    /// Twice the largest distance of a lobe from the axis; drawn from 0.75 to 0.95 of the height, as blocky
    /// sweet peppers have it, settable from 1 to 50 cm.
    pub width_cm: Option<f64>,
    /// The number of lobes; drawn 3 or 4, settable from 1 to 12.
    pub lobes: Option<u32>,
    /// Depth of the grooves between lobes relative to the radius; drawn from 0.08 to 0.16, settable
    /// from 0 to 0.4.
    pub lobe_depth: Option<f64>,
    /// The narrowing of the blossom end, relative to the width; drawn from 0.1 to 0.35, settable from 0 to 0.8.
    pub taper: Option<f64>,
    /// The depth of the dimple at the stem end; drawn from 0.1 to 0.15 of the height, settable from 0 to a quarter of it.
    pub dimple_cm: Option<f64>,
    /// The departure from symmetry, relative to the fruit's size: unequal lobes, an oval
    /// section, slanting shoulders, a blossom end beside the axis. 0 to 0.2; 0 is perfect.
    pub asymmetry: f64,
    /// The fruit's color; drawn evenly.
    pub color: Option<FruitColor>,

    /// Length of the peduncle along its curve, from the calyx in the dimple; drawn from 3.5 to 5, settable from 0.5 to 20 cm.
    pub peduncle_length_cm: Option<f64>,
    /// Its thickness; drawn from 0.7 to 0.95, settable from 0.1 to 5 cm.
    pub peduncle_width_cm: Option<f64>,
    /// The angle between the fruit's axis and the peduncle's free end; drawn from 10 to 50, settable from 0 to 120°.
    pub peduncle_bend_deg: Option<f64>,
    /// The direction that the peduncle bends to, around the fruit's axis; drawn from 0 to 360, settable from -360 to 360°.
    pub peduncle_bend_towards_deg: Option<f64>,

    /// The largest lean towards the camera or away that is drawn, 0 to 90°.
    pub max_tilt_towards_camera_deg: f64,
    /// The largest lean to a side that is drawn, 0 to 180°.
    pub max_tilt_sideways_deg: f64,
    /// The lean of the stem end out of the image plane, positive towards the camera; -90 to 90°.
    pub tilt_towards_camera_deg: Option<f64>,
    /// The lean of the axis, as the image shows it, from image-up to the right; -180 to 180°.
    pub tilt_sideways_deg: Option<f64>,
    /// The turn about the fruit's own axis; drawn from 0 to 360, settable from -360 to 360°.
    pub spin_deg: Option<f64>,
    /// The nearest and farthest depth of the fruit's center that are drawn, in the camera's range.
    pub distance_cm: [f64; 2],
    /// The fruit's center in the camera's frame; drawn so that the whole fruit is in the image.
    pub center_cm: Option<DVec3>,

    /// The share of the fruit (peduncle included) that a leaf before it hides, 0 to 0.9; 0 for no leaf.
    /// The truth holds the share that it does hide.
    pub leaf_cover: f64,
    /// The camera.
    pub camera: DepthCamera,
    /// The views that are taken and fused.
    pub scan: ScanSettings,
}

impl Default for PepperSettings {
    /// A pepper of any size and color, upright to within 25° both ways, 30 to 60 cm ahead, slightly
    /// irregular, with nothing before it.
    fn default() -> Self {
        Self {
            seed: 0,
            height_cm: None,
            width_cm: None,
            lobes: None,
            lobe_depth: None,
            taper: None,
            dimple_cm: None,
            asymmetry: 0.03,
            color: None,
            peduncle_length_cm: None,
            peduncle_width_cm: None,
            peduncle_bend_deg: None,
            peduncle_bend_towards_deg: None,
            max_tilt_towards_camera_deg: 25.0,
            max_tilt_sideways_deg: 25.0,
            tilt_towards_camera_deg: None,
            tilt_sideways_deg: None,
            spin_deg: None,
            distance_cm: [30.0, 60.0],
            center_cm: None,
            leaf_cover: 0.0,
            camera: DepthCamera::default(),
            scan: ScanSettings::default(),
        }
    }
}

impl PepperSettings {
    /// Checks the range of every setting, which NaN is out of.
    pub(super) fn check(&self) -> Result<(), SimulateError> {
        const SIZE: (f64, f64) = (1.0, 50.0);
        set_within("height_cm", self.height_cm, SIZE, "1 to 50")?;
        set_within("width_cm", self.width_cm, SIZE, "1 to 50")?;
        set_within("lobes", self.lobes.map(f64::from), (1.0, 12.0), "1 to 12")?;
        set_within("lobe_depth", self.lobe_depth, (0.0, 0.4), "0 to 0.4")?;
        set_within("taper", self.taper, (0.0, 0.8), "0 to 0.8")?;
        within("asymmetry", self.asymmetry, (0.0, 0.2), "0 to 0.2")?;
        self.surroundings().check()
    }

    /// The settings of the surroundings.
    pub fn surroundings(&self) -> Surroundings {
        Surroundings {
            peduncle_length_cm: self.peduncle_length_cm,
            peduncle_width_cm: self.peduncle_width_cm,
            peduncle_bend_deg: self.peduncle_bend_deg,
            peduncle_bend_towards_deg: self.peduncle_bend_towards_deg,
            max_tilt_towards_camera_deg: self.max_tilt_towards_camera_deg,
            max_tilt_sideways_deg: self.max_tilt_sideways_deg,
            tilt_towards_camera_deg: self.tilt_towards_camera_deg,
            tilt_sideways_deg: self.tilt_sideways_deg,
            spin_deg: self.spin_deg,
            distance_cm: self.distance_cm,
            center_cm: self.center_cm,
            leaf_cover: self.leaf_cover,
            camera: self.camera.clone(),
            scan: self.scan.clone(),
        }
    }

    /// The same pepper in other surroundings.
    #[must_use]
    pub fn with_surroundings(self, surroundings: Surroundings) -> Self {
        Self {
            peduncle_length_cm: surroundings.peduncle_length_cm,
            peduncle_width_cm: surroundings.peduncle_width_cm,
            peduncle_bend_deg: surroundings.peduncle_bend_deg,
            peduncle_bend_towards_deg: surroundings.peduncle_bend_towards_deg,
            max_tilt_towards_camera_deg: surroundings.max_tilt_towards_camera_deg,
            max_tilt_sideways_deg: surroundings.max_tilt_sideways_deg,
            tilt_towards_camera_deg: surroundings.tilt_towards_camera_deg,
            tilt_sideways_deg: surroundings.tilt_sideways_deg,
            spin_deg: surroundings.spin_deg,
            distance_cm: surroundings.distance_cm,
            center_cm: surroundings.center_cm,
            leaf_cover: surroundings.leaf_cover,
            camera: surroundings.camera,
            scan: surroundings.scan,
            ..self
        }
    }
}
