//! A depth camera at the origin: the part of a mesh that it sees, and its errors of measurement.
//!
//! The model is a pinhole with a z-buffer. Each pixel measures one depth; the errors are those that
//! impair a search for symmetry: noise that grows with distance, depth in steps, and holes where the
//! surface turns away or at random. Errors of neighboring pixels are independent, and no pixel mixes
//! the depths on both sides of an edge; a real camera is worse in both.

use std::ops::Range;

use glam::{DVec2, DVec3, Vec3};
use rand::{Rng, RngExt};
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

use super::SimulateError;
use super::error::within;
use super::mesh::Mesh;

/// The working range of an Intel `RealSense` SR300, the paper's camera (§ 2.1).
pub(super) const SR300_RANGE_CM: (f64, f64) = (20.0, 150.0);

/// The distance at which the settings state the noise: about the working distance of a harvesting robot.
const NOISE_STATED_AT_CM: f64 = 40.0;

/// Computes the standard deviation of a depth measured at `depth_cm` from that at 40 cm. It grows with the
/// square of the distance, as for every camera that triangulates.
pub(super) fn noise_sd_cm(at_40_cm: f64, depth_cm: f64) -> f64 {
    at_40_cm * (depth_cm / NOISE_STATED_AT_CM).powi(2)
}

/// A pinhole depth camera at the origin that looks along +z, with the image's y axis down.
///
/// The defaults resemble an Intel `RealSense` SR300: 640 × 480 depth pixels, 475 px of focal length as
/// such cameras are calibrated (68° × 54° of view), and a range of 20 to 150 cm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DepthCamera {
    /// Pixels across, 16 to 4096.
    pub width_px: u32,
    /// Pixels down, 16 to 4096.
    pub height_px: u32,
    /// Focal length in pixels, the same across and down, 10 to 100,000. The principal point is the
    /// middle of the image.
    pub focal_px: f64,
    /// The nearest depth measured, above 0 cm.
    pub near_cm: f64,
    /// The farthest depth measured, above the nearest and at most 1000 cm.
    pub far_cm: f64,
    /// Standard deviation of a depth at 40 cm, 0 to 10 cm: σ(z) = `noise_cm` · (z / 40 cm)².
    pub noise_cm: f64,
    /// Depths are whole multiples of this, 0 to 10 cm; 0 for no steps. The default is the millimeter
    /// in which depth images are mostly stored; the sensor itself counts eighths of it.
    pub step_cm: f64,
    /// The angle between the ray and the surface's normal from which pixels begin to fail, 0 to 90°. The
    /// share that fails rises as the angle's cosine falls, and reaches all at 90°.
    pub grazing_deg: f64,
    /// The share of all other pixels that fail at random, 0 to 0.99.
    pub dropout: f64,
}

impl DepthCamera {
    /// The farthest depth that a camera may measure, in centimeters.
    pub const FARTHEST_CM: f64 = 1000.0;
}

impl Default for DepthCamera {
    fn default() -> Self {
        Self {
            width_px: 640,
            height_px: 480,
            focal_px: 475.0,
            near_cm: SR300_RANGE_CM.0,
            far_cm: SR300_RANGE_CM.1,
            noise_cm: 0.05,
            step_cm: 0.1,
            grazing_deg: 70.0,
            dropout: 0.01,
        }
    }
}

/// The measurement of one pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured {
    pub(super) point_in_camera: DVec3,
    pub(super) color: Vec3,
    pub(super) label: i32,
}

/// The nearest surface in each pixel.
#[derive(Debug, Clone)]
pub(super) struct DepthImage {
    width: usize,
    /// The depth of each pixel; infinite without a surface.
    pub(super) depths_cm: Vec<f64>,
    triangles: Vec<u32>,
}

impl DepthImage {
    /// The number of pixels that show a surface.
    pub(super) fn covered(&self) -> usize {
        self.depths_cm.iter().filter(|d| d.is_finite()).count()
    }

    /// Clears all pixels outside a rectangle.
    pub(super) fn crop(&mut self, (low, high): (DVec2, DVec2)) {
        for place in 0..self.depths_cm.len() {
            let pixel = self.pixel(place);
            if pixel.cmplt(low).any() || pixel.cmpgt(high).any() {
                self.depths_cm[place] = f64::INFINITY;
            }
        }
    }

    /// The indices of the pixels that show a surface, row by row.
    fn filled(&self) -> impl Iterator<Item = usize> {
        (0..self.depths_cm.len()).filter(|&i| self.depths_cm[i].is_finite())
    }

    /// The corners of the smallest rectangle of pixels that holds all surfaces.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        self.filled().fold(none, |(low, high), place| {
            let pixel = self.pixel(place);
            (low.min(pixel), high.max(pixel))
        })
    }

    /// The middle of a pixel, in pixels.
    fn pixel(&self, place: usize) -> DVec2 {
        DVec2::new((place % self.width) as f64, (place / self.width) as f64)
    }
}

/// A triangle in the image.
struct Projected {
    corners: [DVec2; 3],
    inverse_depths: [f64; 3],
    twice_the_area: f64,
}

impl Projected {
    /// Computes the inverse depth at a pixel and each corner's share in it; `None` if the pixel is outside.
    /// Edges belong to both neighbors, and the z-buffer keeps one of the two.
    fn at(&self, pixel: DVec2) -> Option<(f64, [f64; 3])> {
        let [a, b, c] = self.corners;
        let shares = [
            (c - b).perp_dot(pixel - b) / self.twice_the_area,
            (a - c).perp_dot(pixel - c) / self.twice_the_area,
            (b - a).perp_dot(pixel - a) / self.twice_the_area,
        ];
        if shares.iter().any(|&s| s < -1e-12) {
            return None;
        }
        let weighted = [
            shares[0] * self.inverse_depths[0],
            shares[1] * self.inverse_depths[1],
            shares[2] * self.inverse_depths[2],
        ];
        Some((weighted.iter().sum(), weighted))
    }
}

impl DepthCamera {
    /// Checks the settings.
    pub(super) fn check(&self) -> Result<(), SimulateError> {
        const PIXELS: (f64, f64) = (16.0, 4096.0);
        within("width_px", self.width_px.into(), PIXELS, "16 to 4096")?;
        within("height_px", self.height_px.into(), PIXELS, "16 to 4096")?;
        within("focal_px", self.focal_px, (10.0, 1e5), "10 to 100000")?;
        within("near_cm", self.near_cm, (1e-3, 1000.0), "0.001 to 1000")?;
        let beyond_near = (self.near_cm, 1000.0);
        within(
            "far_cm",
            self.far_cm,
            beyond_near,
            "above near_cm and at most 1000",
        )?;
        within("noise_cm", self.noise_cm, (0.0, 10.0), "0 to 10")?;
        within("step_cm", self.step_cm, (0.0, 10.0), "0 to 10")?;
        within("grazing_deg", self.grazing_deg, (0.0, 90.0), "0 to 90")?;
        within("dropout", self.dropout, (0.0, 0.99), "0 to 0.99")
    }

    /// The middle of the image, in pixels; pixel centers are whole numbers.
    fn middle(&self) -> DVec2 {
        DVec2::new(f64::from(self.width_px - 1), f64::from(self.height_px - 1)) / 2.0
    }

    /// Half the width and half the height of the view at a depth of 1.
    pub(super) fn half_view(&self) -> DVec2 {
        self.middle() / self.focal_px
    }

    /// The point at depth 1 that a pixel looks at.
    pub(super) fn ray(&self, pixel: DVec2) -> DVec3 {
        ((pixel - self.middle()) / self.focal_px).extend(1.0)
    }

    fn project(&self, mesh: &Mesh, triangle: u32) -> Option<Projected> {
        let corners = mesh.triangles[triangle as usize].map(|i| mesh.positions[i as usize]);
        // A triangle that reaches behind the camera cannot be projected, and is far nearer than any depth
        // camera sees.
        if corners.iter().any(|p| p.z < 1e-3) {
            return None;
        }
        let flat = corners.map(|p| p.truncate() * self.focal_px / p.z + self.middle());
        let twice_the_area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
        (twice_the_area != 0.0).then_some(Projected {
            corners: flat,
            inverse_depths: corners.map(|p| 1.0 / p.z),
            twice_the_area,
        })
    }

    /// Returns the index of the pixel nearest to a point's image, and the point at depth 1 that the pixel looks at; `None`
    /// if the point is outside the image.
    pub(super) fn pixel_of(&self, point: DVec3) -> Option<(usize, DVec3)> {
        if point.z < 1e-3 {
            return None;
        }
        let pixel = (point.truncate() * self.focal_px / point.z + self.middle()).round();
        let size = DVec2::new(self.width_px.into(), self.height_px.into());
        let inside = pixel.cmpge(DVec2::ZERO).all() && pixel.cmplt(size).all();
        let index = || pixel.y as usize * self.width_px as usize + pixel.x as usize;
        inside.then(|| (index(), self.ray(pixel)))
    }

    /// Renders the nearest surface of a range of the mesh's triangles in each pixel, without errors.
    pub(super) fn look(&self, mesh: &Mesh, triangles: Range<usize>) -> DepthImage {
        let (width, height) = (self.width_px as usize, self.height_px as usize);
        let mut image = DepthImage {
            width,
            depths_cm: vec![f64::INFINITY; width * height],
            triangles: vec![0; width * height],
        };
        self.look_on(mesh, triangles, &mut image);
        image
    }

    /// Adds a range of the mesh's triangles to the image of those before.
    pub(super) fn look_on(&self, mesh: &Mesh, triangles: Range<usize>, image: &mut DepthImage) {
        self.rasterize(mesh, triangles, |place, inverse, triangle| {
            if inverse * image.depths_cm[place] > 1.0 {
                image.depths_cm[place] = 1.0 / inverse;
                image.triangles[place] = triangle;
            }
        });
    }

    /// Counts the pixels of an image that the mesh would hide.
    pub(super) fn count_hidden(&self, mesh: &Mesh, image: &DepthImage) -> usize {
        let mut hidden = vec![false; image.depths_cm.len()];
        self.rasterize(mesh, 0..mesh.triangles.len(), |place, inverse, _| {
            let depth_cm = image.depths_cm[place];
            hidden[place] |= depth_cm.is_finite() && inverse * depth_cm > 1.0;
        });
        hidden.into_iter().filter(|&h| h).count()
    }

    /// Calls `visit` with the index of each pixel that a triangle covers, the inverse depth there, and the
    /// triangle. A pixel is visited once for each surface that covers it.
    fn rasterize(&self, mesh: &Mesh, triangles: Range<usize>, mut visit: impl FnMut(usize, f64, u32)) {
        let size = DVec2::new(self.width_px.into(), self.height_px.into());
        for triangle in triangles.start as u32..triangles.end as u32 {
            let Some(flat) = self.project(mesh, triangle) else {
                continue;
            };
            let [a, b, c] = flat.corners;
            // Clamped to the image before they become whole: the range is empty outside of it.
            let low = a.min(b).min(c).ceil().clamp(DVec2::ZERO, size);
            let high = (a.max(b).max(c).floor() + 1.0).clamp(DVec2::ZERO, size);
            for row in low.y as usize..high.y as usize {
                for column in low.x as usize..high.x as usize {
                    if let Some((inverse, _)) = flat.at(DVec2::new(column as f64, row as f64)) {
                        visit(row * self.width_px as usize + column, inverse, triangle);
                    }
                }
            }
        }
    }

    /// Measures the image: a point for each pixel that does not fail, row by row.
    pub(super) fn measure(&self, mesh: &Mesh, image: &DepthImage, rng: &mut impl Rng) -> Vec<Measured> {
        image
            .filled()
            .filter_map(|place| {
                // Every pixel draws three random numbers, used or not, so that a changed setting leaves
                // the random numbers of the other pixels as they were.
                let luck: [f64; 2] = rng.random();
                let error: f64 = rng.sample(StandardNormal);
                self.measure_pixel(mesh, image, place, luck, error)
            })
            .collect()
    }

    fn measure_pixel(
        &self,
        mesh: &Mesh,
        image: &DepthImage,
        place: usize,
        luck: [f64; 2],
        error: f64,
    ) -> Option<Measured> {
        let triangle = image.triangles[place];
        let corners = mesh.triangles[triangle as usize].map(|i| i as usize);
        let pixel = image.pixel(place);
        let ray = self.ray(pixel);
        let (inverse, weighted) = self.project(mesh, triangle)?.at(pixel)?;
        let share = weighted.map(|w| w / inverse);
        let normal = (0..3).map(|i| mesh.normals[corners[i]] * share[i]).sum::<DVec3>();
        let cos = (normal.dot(ray) / (normal.length() * ray.length())).abs();
        let cos_grazing = self.grazing_deg.to_radians().cos();
        let fails = luck[0] < self.dropout || luck[1] * cos_grazing > cos;
        let depth_cm = self.depth_read_cm(image.depths_cm[place], error);
        let seen = (self.near_cm..=self.far_cm).contains(&depth_cm);
        (seen && !fails).then(|| Measured {
            point_in_camera: ray * depth_cm,
            color: (0..3).map(|i| mesh.colors[corners[i]] * share[i] as f32).sum(),
            label: mesh.labels[corners[0]],
        })
    }

    /// Computes the measured depth from an error in standard deviations.
    fn depth_read_cm(&self, depth_cm: f64, error: f64) -> f64 {
        let noisy_cm = depth_cm + error * noise_sd_cm(self.noise_cm, depth_cm);
        if self.step_cm > 0.0 {
            (noisy_cm / self.step_cm).round() * self.step_cm
        } else {
            noisy_cm
        }
    }
}
