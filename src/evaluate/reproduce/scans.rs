//! The ways to scan peppers that § 3.2 is run under: what the paper leaves open, as settings.

use glam::DVec3;

use crate::method::NormalSource;
use crate::simulate::{PepperSettings, ScanSettings};

/// From one depth image of a fused scan to the next, in degrees.
const DEG_BETWEEN_VIEWS: f64 = 15.0;

/// The distance of a fruit in the middle of the image, in centimeters: the middle of those that the simulator draws.
const DISTANCE_CM: f64 = 45.0;

/// A way to scan and analyze a set of peppers.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// The whole arc of the camera around the fruit in degrees; 0 is one depth image.
    pub arc_deg: f64,
    /// The largest lean of a fruit towards the camera and, drawn apart, to a side, in degrees.
    pub lean_deg: f64,
    /// The seed of the set of peppers.
    pub seed: u64,
    /// A number that is added to each pepper's seed for Eq. 3's random points: another one, other points.
    pub search: u64,
    /// Whether every normal is turned to the viewpoint, rather than to the cameras that saw the point.
    pub normals_to_viewpoint: bool,
    /// The error of the camera's poses, in multiples of the simulator's default.
    pub pose_noise: f64,
    /// The edge of the voxel grid of § 2.1 in centimeters.
    pub voxel_cm: f64,
    /// Whether the fruit lies anywhere in the image, 30 to 60 cm ahead, rather than in its middle: the camera of a scan is
    /// aimed at the fruit.
    pub anywhere: bool,
}

impl Scan {
    /// A scan by the settings that stand in the report where no others are named.
    pub fn new(arc_deg: f64, lean_deg: f64, seed: u64) -> Self {
        Self {
            arc_deg,
            lean_deg,
            seed,
            search: 0,
            normals_to_viewpoint: false,
            pose_noise: 1.0,
            voxel_cm: 0.2,
            anywhere: false,
        }
    }

    /// The number of depth images.
    pub fn views(&self) -> u32 {
        (self.arc_deg / DEG_BETWEEN_VIEWS).ceil() as u32 + 1
    }

    /// The name of its arc.
    pub fn arc_name(&self) -> String {
        arc_name(self.arc_deg)
    }

    /// The settings of one pepper.
    pub(super) fn pepper(&self, seed: u64) -> PepperSettings {
        let defaults = ScanSettings::default();
        PepperSettings {
            seed,
            max_tilt_towards_camera_deg: self.lean_deg,
            max_tilt_sideways_deg: self.lean_deg,
            center_cm: (!self.anywhere).then_some(DVec3::new(0.0, 0.0, DISTANCE_CM)),
            scan: ScanSettings {
                views: self.views(),
                arc_deg: self.arc_deg,
                pose_noise_deg: defaults.pose_noise_deg * self.pose_noise,
                pose_noise_cm: defaults.pose_noise_cm * self.pose_noise,
                ..defaults
            },
            ..PepperSettings::default()
        }
    }

    /// The source of the normals. One depth image has none of its own, and turning them to its camera is turning
    /// them to the viewpoint.
    pub(super) fn normals(&self) -> NormalSource {
        if self.normals_to_viewpoint || self.views() == 1 {
            NormalSource::Estimate
        } else {
            NormalSource::File
        }
    }
}

/// The name of an arc: ±90° for 180.
pub(super) fn arc_name(arc_deg: f64) -> String {
    if arc_deg > 0.0 {
        format!("±{}°", arc_deg / 2.0)
    } else {
        "one view".to_owned()
    }
}
