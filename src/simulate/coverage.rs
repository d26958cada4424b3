//! The share of a surface that was seen.

use super::depth_camera::{DepthCamera, DepthImage};
use super::mesh::Mesh;

/// The greatest slope of the surface against the image plane for which neighboring pixels' depths are compared.
const STEEPEST: f64 = 8.0;

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
            let Some(pixel) = camera.pixel_of(middle).filter(|_| !*seen) else {
                continue;
            };
            let cos = ((b - a).cross(c - a).normalize_or_zero())
                .dot(middle.normalize())
                .abs();
            // Within half a pixel the depth of a slanting surface changes by up to this much.
            let slope = (1.0 - cos * cos).sqrt() / cos.max(STEEPEST.recip());
            let tolerance_cm = middle.z * (slope / camera.focal_px + 1e-4);
            *seen = cos > 0.0
                && cos >= cos_grazing
                && range.contains(&middle.z)
                && middle.z <= image.depths_cm[pixel] + tolerance_cm;
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
