//! The paper's simulated cloud (§ 2.1, Eq. 1): the part of an ellipsoid that faces the camera.

use glam::{DMat3, DVec3};
use rand::{Rng, RngExt};
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

use super::depth_camera::{SR300_RANGE_CM, noise_sd_cm};
use super::error::{each_within, within};
use super::random::{Stream, stream};
use super::{Pose, Settings, SimulateError, Simulated, TrueAxis, Truth};
use crate::geometry::{Cloud, Unit};

/// An ellipsoid with its half-axes along those of the camera, seen from the origin.
///
/// The defaults are the paper's numbers (§ 2.1) at the nearest distance of its series, 25 to 70 cm by
/// steps of 1 cm; the caller loops over them by `center_cm.z`. The paper does not say how many points
/// its clouds have, nor whether they were noisy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EllipsoidSettings {
    /// Half-axes along x, y and z (x₁, y₁, z₁ of Eq. 1), each above 0 and at most 1000 cm.
    pub half_axes_cm: DVec3,
    /// The center (x₀, y₀, z₀ of Eq. 1); its depth z must be in the camera's range, 20 to 150 cm.
    pub center_cm: DVec3,
    /// The exact number of visible points, 1 to 10 million.
    pub points: usize,
    /// Standard deviation of the depth at 40 cm, 0 to 10 cm; it grows with the square of the
    /// distance as the depth camera's does. 0 puts every point on the surface.
    pub noise_cm: f64,
    /// The seed of the points' positions and noise.
    pub seed: u64,
}

impl Default for EllipsoidSettings {
    fn default() -> Self {
        Self {
            half_axes_cm: DVec3::new(2.5, 2.5, 2.0),
            center_cm: DVec3::new(3.0, 5.0, 25.0),
            points: 3000,
            noise_cm: 0.0,
            seed: 0,
        }
    }
}

/// The draws for each wanted point after which the search is given up. The paper's ellipsoid needs three.
const DRAWS_PER_POINT: usize = 2000;

impl EllipsoidSettings {
    /// Simulates points spread evenly over the area of the surface, of which those that face the camera
    /// are kept: `⟨n, p_v − p⟩ > 0` (Eq. 11), which on a convex body is the same as being seen.
    ///
    /// The cloud is in centimeters and holds the surface's own normals, even for points moved by noise.
    ///
    /// # Errors
    /// Returns an error if a setting is out of range, the viewpoint is inside, or too little of the surface
    /// faces it.
    pub fn simulate(&self) -> Result<Simulated, SimulateError> {
        self.check()?;
        let mut rng = stream(self.seed, Stream::Shape);
        let mut noise = stream(self.seed, Stream::Camera);
        // A sphere stretched to the ellipsoid is stretched most where its normal is along the
        // shortest half-axis; a draw is kept in proportion to the stretch.
        let largest_stretch = self.half_axes_cm.recip().max_element();
        let mut positions = Vec::with_capacity(self.points);
        let mut normals = Vec::with_capacity(self.points);
        let mut on_surface = 0_usize;
        for _ in 0..self.points.saturating_mul(DRAWS_PER_POINT) {
            if positions.len() == self.points {
                break;
            }
            let on_sphere = unit_vector(&mut rng);
            let gradient = on_sphere / self.half_axes_cm;
            let stretch = gradient.length();
            if rng.random::<f64>() * largest_stretch > stretch {
                continue;
            }
            on_surface += 1;
            let point = on_sphere * self.half_axes_cm + self.center_cm;
            let normal = gradient / stretch;
            if normal.dot(-point) <= 0.0 {
                continue;
            }
            positions.push(self.measured(point, &mut noise));
            normals.push(normal.as_vec3());
        }
        let too_little = SimulateError::TooLittleVisible {
            found: positions.len(),
            wanted: self.points,
        };
        if positions.len() < self.points {
            return Err(too_little);
        }
        let cloud = Cloud::new(positions)
            .with_normals(normals)
            .map_err(|_| too_little)?;
        Ok(Simulated {
            cloud,
            truth: self.truth(self.points as f64 / on_surface as f64),
        })
    }

    /// Adds the camera's error to a point: an error of depth moves it along its ray.
    fn measured(&self, point: DVec3, noise: &mut impl Rng) -> DVec3 {
        if self.noise_cm == 0.0 || point.z <= 0.0 {
            return point;
        }
        let error: f64 = noise.sample(StandardNormal);
        point * (1.0 + error * noise_sd_cm(self.noise_cm, point.z) / point.z)
    }

    fn check(&self) -> Result<(), SimulateError> {
        let sizes = (f64::MIN_POSITIVE, 1000.0);
        each_within(
            "half_axes_cm",
            self.half_axes_cm,
            sizes,
            "above 0 and at most 1000",
        )?;
        let sideways = DVec3::new(self.center_cm.x, self.center_cm.y, 0.0);
        each_within("center_cm", sideways, (-1000.0, 1000.0), "-1000 to 1000")?;
        within(
            "center_cm.z",
            self.center_cm.z,
            SR300_RANGE_CM,
            "20 to 150, the camera's range",
        )?;
        within("points", self.points as f64, (1.0, 1e7), "1 to 10000000")?;
        within("noise_cm", self.noise_cm, (0.0, 10.0), "0 to 10")?;
        if (self.center_cm / self.half_axes_cm).length_squared() <= 1.0 {
            return Err(SimulateError::ViewpointInside);
        }
        Ok(())
    }

    fn truth(&self, coverage: f64) -> Truth {
        let up = DVec3::NEG_Y;
        let to_stem_end = up * self.half_axes_cm.y;
        let (revolution_axis, note) = self.uniqueness();
        Truth {
            schema: Truth::SCHEMA.into(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            unit: Unit::Centimeter,
            seed: self.seed,
            axis: TrueAxis {
                origin: self.center_cm,
                direction: up,
            },
            revolution_axis,
            note: Some(note.into()),
            center: self.center_cm,
            stem_end: self.center_cm + to_stem_end,
            blossom_end: self.center_cm - to_stem_end,
            pose: Pose::new(DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)), self.center_cm),
            viewpoint: DVec3::ZERO,
            without_peduncle: false,
            hidden_by_leaf: None,
            coverage: Some(coverage),
            settings: Settings::Ellipsoid(self.clone()),
        }
    }

    /// The axis of revolution, if there is exactly one, and a note on what the half-axes mean for "the" true
    /// axis.
    #[expect(clippy::float_cmp, reason = "half-axes are equal where they were set equal")]
    fn uniqueness(&self) -> (Option<DVec3>, &'static str) {
        let DVec3 { x, y, z } = self.half_axes_cm;
        match (x == y, y == z, x == z) {
            (true, true, _) => (
                None,
                "A sphere: every plane through the center is a mirror plane and every line through \
                 it an axis. The axis given is image-up by convention only.",
            ),
            (true, ..) => (
                Some(DVec3::Z),
                "A solid of revolution about the depth axis z: every plane that holds this axis is \
                 a mirror plane, so the symmetry axis is not unique. The axis given is image-up \
                 (0, -1, 0), the one that the reproduction takes as true; a plane that holds the \
                 depth axis and is turned about it is no worse a symmetry plane.",
            ),
            (_, true, _) => (
                Some(DVec3::X),
                "A solid of revolution about the x axis. The axis given is image-up (0, -1, 0), \
                 which lies in one of its mirror planes but is not the axis of revolution.",
            ),
            (.., true) => (
                Some(DVec3::Y),
                "A solid of revolution about the y axis, which is the axis given, image-up (0, -1, 0).",
            ),
            _ => (
                None,
                "Three different half-axes: the mirror planes are those across x, y and z, and \
                 no axis of revolution exists. The axis given is image-up (0, -1, 0).",
            ),
        }
    }
}

/// Draws a direction, all alike likely. Points outside the unit ball are rejected, since sines and
/// logarithms differ between platforms in their last digit.
fn unit_vector(rng: &mut impl Rng) -> DVec3 {
    loop {
        let v = DVec3::from_array(rng.random::<[f64; 3]>()) * 2.0 - 1.0;
        let square = v.length_squared();
        if square <= 1.0 && square > 1e-6 {
            return v / square.sqrt();
        }
    }
}
