//! The share of a surface that was seen.

use super::depth_camera::{DepthCamera, DepthImage};
use super::mesh::Mesh;

/// The depth by which a triangle may lie behind the surface in its pixel and still be that surface, relative to its depth.
const SAME_SURFACE: f64 = 1e-3;

/// The triangles of a mesh that were seen from any view.
#[derive(Debug)]
pub(super) struct Seen(Vec<bool>);

impl Seen {
    pub(super) fn none_of(mesh: &Mesh) -> Self {
        Self(vec![false; mesh.triangles.len()])
    }

    /// Adds the triangles that one view sees: those whose middle is not behind another surface, is in the camera's
    /// range, and is seen at less than the grazing angle. `mesh` is in the camera's frame.
    ///
    /// Counting the triangles that the image's pixels show would miss those that are smaller than a pixel.
    pub(super) fn add(&mut self, camera: &DepthCamera, mesh: &Mesh, image: &DepthImage) {
        let cos_grazing = camera.grazing_deg.to_radians().cos();
        let range = camera.near_cm..=camera.far_cm;
        for (seen, corners) in self.0.iter_mut().zip(&mesh.triangles) {
            let [a, b, c] = corners.map(|i| mesh.positions[i as usize]);
            let middle = (a + b + c) / 3.0;
            let Some((pixel, ray)) = camera.pixel_of(middle).filter(|_| !*seen) else {
                continue;
            };
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let cos = normal.dot(middle.normalize()).abs();
            // The triangle's plane is compared where the pixel's depth was taken: a slanting surface is a little nearer
            // or farther there than in the triangle's middle.
            let depth_cm = normal.dot(middle) / normal.dot(ray);
            *seen = cos > 0.0
                && cos >= cos_grazing
                && range.contains(&middle.z)
                && depth_cm <= image.depths_cm[pixel] + middle.z * SAME_SURFACE;
        }
    }

    /// The share of the area of the mesh's triangles with this label that was seen; `None` if they have no area.
    pub(super) fn share(&self, mesh: &Mesh, label: i32) -> Option<f64> {
        let (mut seen_area, mut area) = (0.0, 0.0);
        for (corners, &seen) in mesh.triangles.iter().zip(&self.0) {
            if mesh.labels[corners[0] as usize] == label {
                let [a, b, c] = corners.map(|i| mesh.positions[i as usize]);
                let twice = (b - a).cross(c - a).length();
                area += twice;
                seen_area += if seen { twice } else { 0.0 };
            }
        }
        (area > 0.0).then_some(seen_area / area)
    }
}
