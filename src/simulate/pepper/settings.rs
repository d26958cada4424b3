//! The settings of a simulated pepper and their ranges.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::FruitColor;
use crate::simulate::error::{each_within, within};
use crate::simulate::{DepthCamera, ScanSettings, SimulateError};

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
        self.camera.check()?;
        self.scan.check()?;
        self.check_shape()?;
        self.check_pose()?;
        within("leaf_cover", self.leaf_cover, (0.0, 0.9), "0 to 0.9")
    }

    fn check_shape(&self) -> Result<(), SimulateError> {
        const SIZE: (f64, f64) = (1.0, 50.0);
        set("height_cm", self.height_cm, SIZE, "1 to 50")?;
        set("width_cm", self.width_cm, SIZE, "1 to 50")?;
        set("lobes", self.lobes.map(f64::from), (1.0, 12.0), "1 to 12")?;
        set("lobe_depth", self.lobe_depth, (0.0, 0.4), "0 to 0.4")?;
        set("taper", self.taper, (0.0, 0.8), "0 to 0.8")?;
        within("asymmetry", self.asymmetry, (0.0, 0.2), "0 to 0.2")?;
        let length = (0.5, 20.0);
        set("peduncle_length_cm", self.peduncle_length_cm, length, "0.5 to 20")?;
        set(
            "peduncle_width_cm",
            self.peduncle_width_cm,
            (0.1, 5.0),
            "0.1 to 5",
        )?;
        set(
            "peduncle_bend_deg",
            self.peduncle_bend_deg,
            (0.0, 120.0),
            "0 to 120",
        )?;
        let towards = self.peduncle_bend_towards_deg;
        set("peduncle_bend_towards_deg", towards, TURN, "-360 to 360")
    }

    fn check_pose(&self) -> Result<(), SimulateError> {
        let out_of_image = self.max_tilt_towards_camera_deg;
        within(
            "max_tilt_towards_camera_deg",
            out_of_image,
            (0.0, 90.0),
            "0 to 90",
        )?;
        let in_image = self.max_tilt_sideways_deg;
        within("max_tilt_sideways_deg", in_image, (0.0, 180.0), "0 to 180")?;
        let out_of_image = self.tilt_towards_camera_deg;
        set(
            "tilt_towards_camera_deg",
            out_of_image,
            (-90.0, 90.0),
            "-90 to 90",
        )?;
        let in_image = self.tilt_sideways_deg;
        set("tilt_sideways_deg", in_image, (-180.0, 180.0), "-180 to 180")?;
        set("spin_deg", self.spin_deg, TURN, "-360 to 360")?;
        let (near, far) = (self.camera.near_cm, self.camera.far_cm);
        let [nearest, farthest] = self.distance_cm;
        within("distance_cm[0]", nearest, (near, far), "in the camera's range")?;
        let beyond = (nearest, far);
        within(
            "distance_cm[1]",
            farthest,
            beyond,
            "at least the first and in the camera's range",
        )?;
        if let Some(center) = self.center_cm {
            each_within("center_cm", center, (-1000.0, 1000.0), "-1000 to 1000")?;
            within("center_cm.z", center.z, (near, far), "in the camera's range")?;
        }
        Ok(())
    }
}

const TURN: (f64, f64) = (-360.0, 360.0);

/// Checks a value that may be left to chance.
fn set(
    name: &'static str,
    value: Option<f64>,
    range: (f64, f64),
    allowed: &'static str,
) -> Result<(), SimulateError> {
    value.map_or(Ok(()), |value| within(name, value, range, allowed))
}
