//! A scan of the cloud in the view by a depth camera in the place of the view's eye.

use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

use glam::{DMat3, DQuat, DVec3};

use super::source::Source;
use crate::fruit::{CloudFile, MeshFile, ReadError, read_mesh};
use crate::geometry::{Cloud, Unit};
use crate::parallel::Watch;
use crate::peduncle::median_spacing;
use crate::ply::PlyCloud;
use crate::render::Camera;
use crate::simulate::{DepthCamera, MeshScanSettings, SimulateError, seen_points};

/// A cloud as it is seen from a place. Two are the same if cloud, unit, place and direction are.
///
/// Where the cloud's file has faces, it is the depth image of the faces; else those of its points that no other hides.
#[derive(Debug, Clone)]
pub struct ScanFromHere {
    of: Box<Source>,
    /// The unit of the cloud; `None`: as its file says, or else guessed.
    unit: Option<Unit>,
    eye: DVec3,
    /// The rotation from the view's frame to the cloud's.
    cloud_from_view: DQuat,
    path: PathBuf,
}

impl ScanFromHere {
    /// The scan of a cloud by a camera in the place of the view's.
    pub(super) fn new(of: &Source, unit: Option<Unit>, camera: &Camera) -> Self {
        let name = of.path().file_stem().unwrap_or_default().to_string_lossy();
        Self {
            path: format!("<scanned>/{name}_from_here.ply").into(),
            of: Box::new(of.clone()),
            unit,
            eye: camera.eye_in_world,
            cloud_from_view: camera.world_from_view,
        }
    }

    /// The name that stands in for a path.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The points that are seen, in the camera's frame.
    ///
    /// # Errors
    /// Returns an error if the cloud cannot be read, or the camera sees nothing of its faces.
    pub(super) fn read(&self, watch: &dyn Watch) -> Result<CloudFile, ReadError> {
        match self.mesh() {
            Some(mesh) => self.seen_of_mesh(&mesh).map_err(|error| ReadError {
                path: self.path.clone(),
                kind: error.into(),
            }),
            None => Ok(self.seen_of_points(&self.of.read(watch)?.file)),
        }
    }

    /// The mesh of the file, if it has faces that can be used.
    fn mesh(&self) -> Option<MeshFile> {
        match &*self.of {
            Source::File(path) => read_mesh(path, self.unit).ok(),
            _ => None,
        }
    }

    /// The depth image of the faces.
    fn seen_of_mesh(&self, file: &MeshFile) -> Result<CloudFile, SimulateError> {
        let in_cm = file.unit.in_cm();
        let (center, radius) = file.mesh.ball();
        let (distance_cm, radius_cm) = (self.eye.distance(center) * in_cm, radius * in_cm);
        let camera = DepthCamera::default();
        let settings = MeshScanSettings {
            mesh_unit: file.unit,
            from: Some(self.eye),
            towards: Some(self.eye + self.cloud_from_view * DVec3::NEG_Z * radius),
            up: self.cloud_from_view * DVec3::Y,
            // The view's eye may be nearer or farther than the camera's own range allows.
            camera: DepthCamera {
                near_cm: camera.near_cm.min(0.9 * (distance_cm - radius_cm)).max(0.1),
                far_cm: camera
                    .far_cm
                    .max(distance_cm + radius_cm)
                    .min(DepthCamera::FARTHEST_CM),
                ..camera
            },
            ..MeshScanSettings::default()
        };
        let (cloud, _) = settings.scan(&file.mesh)?.in_unit(file.unit);
        Ok(CloudFile {
            path: self.path.clone(),
            sha256: file.sha256.clone(),
            ply: PlyCloud {
                cloud,
                dropped_not_finite: 0,
                stated_unit: Some(file.unit),
                notes: Vec::new(),
            },
        })
    }

    /// The part of the whole cloud that no point hides.
    fn seen_of_points(&self, whole: &CloudFile) -> CloudFile {
        // The view looks along −z with y up, a depth camera along z with y down.
        let view_from_cloud = DMat3::from_quat(self.cloud_from_view.conjugate());
        let camera_from_cloud = DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)) * view_from_cloud;
        let cloud = &whole.ply.cloud;
        let seen = match median_spacing(cloud.positions()) {
            Some(spacing) => seen_points(cloud, self.eye, camera_from_cloud, spacing),
            None => Cloud::new(Vec::new()),
        };
        CloudFile {
            path: self.path.clone(),
            sha256: whole.sha256.clone(),
            ply: PlyCloud {
                cloud: seen,
                ..whole.ply.clone()
            },
        }
    }

    fn bits(&self) -> [u64; 7] {
        let [x, y, z] = self.eye.to_array();
        let [i, j, k, w] = self.cloud_from_view.to_array();
        [x, y, z, i, j, k, w].map(f64::to_bits)
    }
}

impl PartialEq for ScanFromHere {
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits() && self.unit == other.unit && self.of == other.of
    }
}

impl Eq for ScanFromHere {}

impl Hash for ScanFromHere {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.of.hash(state);
        self.bits().hash(state);
    }
}
