//! A scan of anybody's mesh.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use super::error::{each_within, within};
use super::scan::Scene;
use super::truth::cloud_in_unit;
use super::{DepthCamera, Pose, ScanSettings, Settings, SimulateError, TriangleMesh, TrueAxis, Truth};
use crate::geometry::{Cloud, Unit};

/// The views of a mesh: where it stands and from where it is looked at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MeshScanSettings {
    /// The seed of the camera's noise and of the errors of its poses.
    pub seed: u64,
    /// The mesh's file, for people.
    pub mesh_file: Option<String>,
    /// SHA-256 of the mesh's file, in 64 lowercase hexadecimal digits.
    pub mesh_sha256: Option<String>,
    /// The unit of the mesh's coordinates, and of all points here.
    pub mesh_unit: Unit,
    /// The direction, in the mesh's frame, that is up in the image.
    pub up: DVec3,
    /// The camera's place in the mesh's frame; `None` for one in front: towards z where y is up, towards −y where z is up,
    /// as far away as the mesh fills half of the image's height, but with all of it in the camera's range.
    pub from: Option<DVec3>,
    /// The point in the middle of the image, about which a moving camera goes around; `None` for the center of the box
    /// around the mesh.
    pub towards: Option<DVec3>,
    /// The true axis: the stem end and the blossom end, in the mesh's frame.
    pub axis: Option<[DVec3; 2]>,
    /// The camera.
    pub camera: DepthCamera,
    /// The views that are taken and fused.
    pub scan: ScanSettings,
}

impl Default for MeshScanSettings {
    /// One view of a mesh in centimeters whose y axis is up, from in front of it.
    fn default() -> Self {
        Self {
            seed: 0,
            mesh_file: None,
            mesh_sha256: None,
            mesh_unit: Unit::Centimeter,
            up: DVec3::Y,
            from: None,
            towards: None,
            axis: None,
            camera: DepthCamera::default(),
            scan: ScanSettings::default(),
        }
    }
}

/// The points of a scanned mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ScannedMesh {
    /// The points, in centimeters in the frame of the middle view.
    pub cloud: Cloud,
    /// The share of the mesh's surface that was seen from any view at less than the grazing angle; of a mesh with labels,
    /// that of the fruit's.
    pub coverage: f64,
    /// The mesh's place: `point_in_camera = rotation · point_in_mesh + translation`, in centimeters.
    pub pose: Pose,
    /// The truth, in centimeters; `None` unless an axis was set.
    pub truth: Option<Truth>,
}

impl ScannedMesh {
    /// Returns the cloud in a unit, with its truth if there is one.
    pub fn in_unit(&self, unit: Unit) -> (Cloud, Option<Truth>) {
        let cloud = cloud_in_unit(&self.cloud, Unit::Centimeter, unit);
        (cloud, self.truth.clone().map(|truth| truth.in_unit(unit)))
    }
}

impl MeshScanSettings {
    /// Scans a mesh by the camera, with its noise and holes.
    ///
    /// The points have the colors and labels of the mesh's corners if it has any. Normals as for peppers: none of one
    /// view, those of the fused points of several.
    ///
    /// # Errors
    /// Returns an error if a setting is out of range, the mesh is larger than the camera's range, or no view sees any of it.
    pub fn scan(&self, mesh: &TriangleMesh) -> Result<ScannedMesh, SimulateError> {
        self.check()?;
        let scale = self.mesh_unit.in_cm();
        let (center, radius) = mesh.ball();
        let target_cm = self.towards.unwrap_or(center) * scale;
        let from_cm = match self.from {
            Some(from) => from * scale,
            None => target_cm + self.front() * self.usual_distance_cm(radius * scale)?,
        };
        if from_cm.distance(target_cm) <= 1e-6 {
            return Err(SimulateError::LooksAtItself);
        }
        let camera_from_mesh = look_at((target_cm - from_cm).normalize(), self.up);
        let translation = -(camera_from_mesh * from_cm);
        let target_in_camera = camera_from_mesh * target_cm + translation;
        let scene = Scene::new(mesh.scaled(scale).moved(camera_from_mesh, translation));
        let scanned = scene.scan(&self.camera, &self.scan, target_in_camera, self.seed)?;
        let pose = Pose::new(camera_from_mesh, translation);
        Ok(ScannedMesh {
            cloud: scanned
                .cloud
                .without_columns(mesh.has_colors(), mesh.has_labels()),
            coverage: scanned.coverage.ok_or(SimulateError::NothingVisible)?,
            pose,
            truth: self.truth(pose, scanned.coverage),
        })
    }

    fn check(&self) -> Result<(), SimulateError> {
        const FAR: (f64, f64) = (-1e6, 1e6);
        self.camera.check()?;
        self.scan.check()?;
        let points = [
            self.from,
            self.towards,
            self.axis.map(|a| a[0]),
            self.axis.map(|a| a[1]),
        ];
        for (name, point) in ["from", "towards", "axis", "axis"].into_iter().zip(points) {
            point.map_or(Ok(()), |p| each_within(name, p, FAR, "-1000000 to 1000000"))?;
        }
        within("up", self.up.length(), (1e-6, 1e6), "a direction, not zero")?;
        let length = self.axis.map_or(1.0, |[stem, blossom]| stem.distance(blossom));
        within("axis", length, (1e-9, 1e7), "two different points")
    }

    /// The direction from the mesh to a camera in front of it, level.
    fn front(&self) -> DVec3 {
        let up = self.up.normalize();
        let front = if up.z.abs() < 0.9 { DVec3::Z } else { DVec3::NEG_Y };
        front.reject_from_normalized(up).normalize()
    }

    fn usual_distance_cm(&self, radius_cm: f64) -> Result<f64, SimulateError> {
        let camera = &self.camera;
        let (nearest, farthest) = (camera.near_cm + radius_cm, camera.far_cm - radius_cm);
        if nearest > farthest {
            return Err(SimulateError::MeshTooLarge {
                size_cm: 2.0 * radius_cm,
                near_cm: camera.near_cm,
                far_cm: camera.far_cm,
            });
        }
        // A ball of this radius takes half of the shorter side of the image.
        let fills_half = 2.0 * radius_cm / camera.half_view().min_element();
        Ok(fills_half.clamp(nearest, farthest))
    }

    fn truth(&self, pose: Pose, coverage: Option<f64>) -> Option<Truth> {
        let to_camera = |p: DVec3| pose.camera_from_fruit() * (p * self.mesh_unit.in_cm()) + pose.translation;
        let [stem_end, blossom_end] = self.axis?.map(to_camera);
        let center = stem_end.midpoint(blossom_end);
        Some(Truth {
            schema: Truth::SCHEMA.into(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            unit: Unit::Centimeter,
            seed: self.seed,
            axis: TrueAxis {
                origin: center,
                direction: (stem_end - blossom_end).normalize(),
            },
            revolution_axis: None,
            note: None,
            center,
            stem_end,
            blossom_end,
            pose,
            viewpoint: DVec3::ZERO,
            without_peduncle: false,
            hidden_by_leaf: None,
            coverage,
            settings: Settings::Mesh(Box::new(self.clone())),
        })
    }
}

/// The rotation into the frame of a camera that looks along `ahead`: x to the image's right, y down, z ahead.
fn look_at(ahead: DVec3, up: DVec3) -> DMat3 {
    let up = up.normalize();
    // Straight up or down, what is in front of the mesh is at the image's bottom or top.
    let down = [-up, DVec3::NEG_Z, DVec3::Y]
        .into_iter()
        .map(|down| down.reject_from_normalized(ahead))
        .find(|down| down.length() > 1e-6)
        .map_or(DVec3::X, DVec3::normalize);
    DMat3::from_cols(down.cross(ahead), down, ahead).transpose()
}
