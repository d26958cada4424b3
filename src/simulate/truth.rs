//! The truth about a simulated cloud: its axis, its pose and every setting that made it.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use super::{EllipsoidSettings, MeshScanSettings, PepperSettings};
use crate::geometry::{Cloud, Unit};

/// A cloud and the truth about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulated {
    /// The points that the camera saw, in the truth's unit and the camera's frame.
    pub cloud: Cloud,
    /// The truth about them.
    pub truth: Truth,
}

/// An axis through the fruit, with a sense.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrueAxis {
    /// A point of the axis: the fruit's center.
    pub origin: DVec3,
    /// From the fruit's center towards its stem end, of unit length.
    pub direction: DVec3,
}

/// The pose of the fruit: `point_in_camera = rotation · point_in_fruit + translation`.
///
/// The fruit's frame has its origin in the fruit's center and its y axis towards the stem end; an
/// upright fruit of zero spin has x to the image's right, y up and z towards the camera. A mesh has its file's own frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Three rows of a rotation matrix.
    pub rotation: [[f64; 3]; 3],
    /// The fruit's center, or the origin of a mesh's frame, in the camera's frame, in the truth's unit.
    pub translation: DVec3,
}

impl Pose {
    /// Makes a pose of a rotation and the fruit's center.
    pub fn new(camera_from_fruit: DMat3, translation: DVec3) -> Self {
        Self {
            rotation: camera_from_fruit.transpose().to_cols_array_2d(),
            translation,
        }
    }

    /// The rotation from the fruit's frame to the camera's.
    pub fn camera_from_fruit(&self) -> DMat3 {
        DMat3::from_cols_array_2d(&self.rotation).transpose()
    }
}

/// The settings of a simulation with nothing left to chance: each that was drawn at random holds the
/// value drawn, and simulating these settings gives the same cloud again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", content = "settings", rename_all = "lowercase")]
pub enum Settings {
    /// The paper's ellipsoid (§ 2.1).
    Ellipsoid(EllipsoidSettings),
    /// A pepper before a depth camera.
    Pepper(Box<PepperSettings>),
    /// A mesh before a depth camera.
    Mesh(Box<MeshScanSettings>),
}

/// The truth about a simulated cloud: the content of a `.truth.json` file.
///
/// Lengths are in [`Truth::unit`], the cloud's own, except in the settings, whose names say `_cm`.
/// In JSON the settings are two fields: `kind` (`"ellipsoid"`, `"pepper"` or `"mesh"`) and `settings`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// [`Truth::SCHEMA`].
    pub schema: String,
    /// The version of Axiscope that made the cloud.
    pub program_version: String,
    /// The unit of the cloud and of all lengths here outside the settings.
    pub unit: Unit,
    /// The seed of the cloud (the settings hold it too).
    pub seed: u64,
    /// The axis to be found.
    pub axis: TrueAxis,
    /// The axis about which the shape is a solid of revolution, where there is exactly one. Every
    /// plane that holds it is a mirror plane.
    pub revolution_axis: Option<DVec3>,
    /// A caveat about errors against [`Truth::axis`], in words.
    pub note: Option<String>,
    /// The fruit's center. A pepper's is the middle of its axis between the level of the stem end's
    /// shoulders and that of the blossom end; an ellipsoid's is its own.
    pub center: DVec3,
    /// The point where the axis leaves the fruit at the stem end: for a pepper at the level of its shoulders,
    /// above the floor of the dimple.
    pub stem_end: DVec3,
    /// The point where the axis leaves the fruit at the other end: for a pepper at the level of its lowest
    /// lobes, below the blossom end's dimple.
    pub blossom_end: DVec3,
    /// The position and rotation of the fruit.
    pub pose: Pose,
    /// The viewpoint `p_v`: the camera, the origin of the frame.
    pub viewpoint: DVec3,
    /// Whether the peduncle's points were removed afterwards (the paper's second variant, § 3.2).
    pub without_peduncle: bool,
    /// The fraction of the fruit's and the peduncle's pixels that a leaf hides, measured; `None` without a leaf.
    pub hidden_by_leaf: Option<f64>,
    /// The fraction of the fruit's surface, without peduncle and leaf, that was seen from any view at less than the
    /// camera's grazing angle; `None` in truths that were written before this was measured.
    #[serde(default)]
    pub coverage: Option<f64>,
    /// The kind of simulation and its settings.
    #[serde(flatten)]
    pub settings: Settings,
}

impl Truth {
    /// The name and version of the format.
    pub const SCHEMA: &'static str = "axiscope.truth/1";

    /// The lean: the angle between the axis and the plane across the view ray, in degrees, -90 to 90, positive where the
    /// stem end leans towards the viewpoint. Eq. 16 gives axes in that plane only, so that each is wrong by the lean at
    /// least.
    pub fn lean_deg(&self) -> f64 {
        let to_viewpoint = (self.viewpoint - self.center).normalize_or_zero();
        let sin = self.axis.direction.dot(to_viewpoint);
        sin.clamp(-1.0, 1.0).asin().to_degrees()
    }

    /// Converts all lengths to another unit, except for the settings, which stay in centimeters.
    #[must_use]
    pub fn in_unit(mut self, unit: Unit) -> Self {
        let scale = |length: DVec3| rescale(length, self.unit, unit);
        self.axis.origin = scale(self.axis.origin);
        self.center = scale(self.center);
        self.stem_end = scale(self.stem_end);
        self.blossom_end = scale(self.blossom_end);
        self.pose.translation = scale(self.pose.translation);
        self.viewpoint = scale(self.viewpoint);
        self.unit = unit;
        self
    }
}

impl Simulated {
    /// Converts points and truth to another unit.
    #[must_use]
    pub fn in_unit(self, unit: Unit) -> Self {
        Self {
            cloud: cloud_in_unit(&self.cloud, self.truth.unit, unit),
            truth: self.truth.in_unit(unit),
        }
    }

    /// Returns the same view with the peduncle's points removed, the paper's second variant (§ 3.2). The truth
    /// stays the same, except for its flag.
    #[must_use]
    pub fn without_peduncle(&self) -> Self {
        let cloud = match self.cloud.labels() {
            None => self.cloud.clone(),
            Some(labels) => {
                let kept: Vec<usize> = (0..labels.len())
                    .filter(|&i| labels[i] != Cloud::PEDUNCLE)
                    .collect();
                self.cloud.select(&kept)
            }
        };
        Self {
            cloud,
            truth: Truth {
                without_peduncle: true,
                ..self.truth.clone()
            },
        }
    }
}

/// Converts simulated points, which are at most meters away and thus finite in any unit.
pub(super) fn cloud_in_unit(cloud: &Cloud, from: Unit, to: Unit) -> Cloud {
    let positions = cloud.positions().iter().map(|&p| rescale(p, from, to));
    Cloud::new(positions.collect()).with_columns(
        cloud.normals().map(<[_]>::to_vec),
        cloud.colors().map(<[_]>::to_vec),
        cloud.labels().map(<[_]>::to_vec),
    )
}

fn rescale(length: DVec3, from: Unit, to: Unit) -> DVec3 {
    if from == to {
        length
    } else {
        length * from.in_cm() / to.in_cm()
    }
}
