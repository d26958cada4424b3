//! Depth images of a scene from one or more places, as one cloud.

use glam::DVec3;

use super::SimulateError;
use super::coverage::Seen;
use super::depth_camera::{DepthCamera, DepthImage, Measured};
use super::mesh::Mesh;
use super::random::{Stream, stream, view_stream};
use super::views::{ScanSettings, View};
use crate::geometry::{Cloud, Unit, estimate_normals, voxel_grid};
use crate::method::{Params, Preset};

/// A fruit and the leaves about it, in centimeters in the frame of the middle view.
#[derive(Debug)]
pub(super) struct Scene {
    mesh: Mesh,
    /// The triangles of the fruit and its peduncle, which are the first.
    fruit: usize,
}

/// The points of a scan, and the share of the fruit's surface that was seen.
#[derive(Debug)]
pub(super) struct Scanned {
    pub(super) cloud: Cloud,
    pub(super) coverage: Option<f64>,
}

impl Scene {
    pub(super) fn new(fruit: Mesh) -> Self {
        Self {
            fruit: fruit.triangles.len(),
            mesh: fruit,
        }
    }

    /// Renders the fruit alone, as the middle view sees it.
    pub(super) fn fruit_in_middle_view(&self, camera: &DepthCamera) -> DepthImage {
        camera.look(&self.mesh, 0..self.fruit)
    }

    pub(super) fn add_leaf(&mut self, leaf: &Mesh) {
        self.mesh.append(leaf);
    }

    /// Takes and fuses all views of a fruit whose center is at `center_cm`.
    ///
    /// # Errors
    /// Returns an error if no view sees a point of the fruit.
    pub(super) fn scan(
        &self,
        camera: &DepthCamera,
        settings: &ScanSettings,
        center_cm: DVec3,
        seed: u64,
    ) -> Result<Scanned, SimulateError> {
        let mut seen = Seen::none_of(&self.mesh);
        let points = if settings.is_fused() {
            let views = settings.views(center_cm);
            let known = settings.known(&views, seed);
            let mut frames = Vec::with_capacity(views.len());
            for (i, (view, known)) in views.iter().zip(known).enumerate() {
                let mesh = self.mesh.clone().seen_from(*view);
                let image = self.look(camera, &mesh);
                seen.add(camera, &mesh, &image);
                let measured = camera.measure(&mesh, &image, &mut view_stream(seed, i));
                frames.push((known, measured));
            }
            fuse(&frames, settings.voxel_cm)
        } else {
            let image = self.look(camera, &self.mesh);
            seen.add(camera, &self.mesh, &image);
            cloud_of(&camera.measure(&self.mesh, &image, &mut stream(seed, Stream::Camera)))
        };
        let labels = points.labels().unwrap_or_default();
        if !labels.contains(&Cloud::FRUIT) {
            return Err(SimulateError::NothingVisible);
        }
        Ok(Scanned {
            coverage: seen.share(&self.mesh, Cloud::FRUIT),
            cloud: points,
        })
    }

    /// Renders one view. Leaves are cropped to the rectangle of the image that the fruit takes up, as a
    /// detector's box would.
    fn look(&self, camera: &DepthCamera, mesh: &Mesh) -> DepthImage {
        let mut image = camera.look(mesh, 0..self.fruit);
        if mesh.triangles.len() > self.fruit {
            let around_fruit = image.bounds();
            camera.look_on(mesh, self.fruit..mesh.triangles.len(), &mut image);
            image.crop(around_fruit);
        }
        image
    }
}

/// Fuses depth images, each with the camera's pose as it is known: the mean of all points in a cube of the grid,
/// with the normal of the points around it (Eq. 2) turned towards the cameras that saw it.
fn fuse(frames: &[(View, Vec<Measured>)], voxel_cm: f64) -> Cloud {
    let mut points = Vec::new();
    let mut to_camera = Vec::new();
    for (view, measured) in frames {
        for m in measured {
            let point = view.to_frame(m.point_in_camera);
            to_camera.push((view.position_cm - point).normalize_or_zero().as_vec3());
            points.push(Measured {
                point_in_camera: point,
                ..*m
            });
        }
    }
    // The grid's mean of directions is that of the cameras that saw a cube's points.
    let fused = cloud_of(&points).with_normals(to_camera).expect(LENGTHS);
    let fused = voxel_grid(&fused, voxel_cm);
    let directions = fused.normals().unwrap_or_default();
    let k = Params::new(Preset::AsIntended, Unit::Centimeter).k;
    let estimated = estimate_normals(fused.positions(), k, DVec3::ZERO, &());
    let normals = estimated.unwrap_or_default().into_iter().zip(directions);
    let normals = normals.map(|(normal, to_camera)| {
        let normal = normal.unwrap_or_default().as_vec3();
        if normal.dot(*to_camera) < 0.0 {
            -normal
        } else {
            normal
        }
    });
    let normals = normals.collect();
    fused.with_normals(normals).expect(LENGTHS)
}

const LENGTHS: &str = "a row of each column for each point";

/// Makes a cloud of the measured points.
///
/// # Panics
/// Never: each point brings its own color and label, and none is infinitely far away.
fn cloud_of(measured: &[Measured]) -> Cloud {
    // Clamped to bytes before they become whole.
    let byte = |channel: f32| channel.round().clamp(0.0, 255.0) as u8;
    let colors = measured.iter().map(|m| {
        let [r, g, b] = m.color.to_array().map(byte);
        [r, g, b, u8::MAX]
    });
    Cloud::new(measured.iter().map(|m| m.point_in_camera).collect())
        .with_colors(colors.collect())
        .expect(LENGTHS)
        .with_labels(measured.iter().map(|m| m.label).collect())
        .expect(LENGTHS)
}
