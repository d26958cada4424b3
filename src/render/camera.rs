//! An orbit camera: its position and direction, and the projection of the world to pixels.

use glam::{DMat4, DQuat, DVec2, DVec3, DVec4};
use serde::{Deserialize, Serialize};

use super::Bounds;

/// The kind of projection.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Projection {
    /// Near things are larger.
    Perspective,
    /// Parallel lines stay parallel, and lengths across the view can be compared.
    Orthographic,
}

/// The picture's size in physical pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewport {
    /// From left to right.
    pub width_px: f64,
    /// From top to bottom.
    pub height_px: f64,
}

impl Viewport {
    /// A picture of so many pixels; at least one each way.
    pub fn new(width_px: f64, height_px: f64) -> Self {
        Self {
            width_px: width_px.max(1.0),
            height_px: height_px.max(1.0),
        }
    }

    /// Width by height.
    pub fn aspect(&self) -> f64 {
        self.width_px / self.height_px
    }

    fn ndc_from_pixel(self, pixel: DVec2) -> DVec2 {
        DVec2::new(
            2.0 * pixel.x / self.width_px - 1.0,
            1.0 - 2.0 * pixel.y / self.height_px,
        )
    }

    fn pixel_from_ndc(self, ndc: DVec2) -> DVec2 {
        DVec2::new(
            0.5 * (ndc.x + 1.0) * self.width_px,
            0.5 * (1.0 - ndc.y) * self.height_px,
        )
    }
}

/// A half-line in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Its origin.
    pub origin_in_world: DVec3,
    /// Its unit direction.
    pub direction_in_world: DVec3,
}

/// An orbit camera. In its view frame x points right, y up, and it looks along −z; pixels count from
/// the picture's upper left corner, their centers at halves.
///
/// Eye and pivot are kept apart, so that picking another pivot leaves the picture as it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// The position of the eye.
    pub eye_in_world: DVec3,
    /// The rotation from the view frame to the world.
    pub world_from_view: DQuat,
    /// The point that orbiting turns about.
    pub pivot_in_world: DVec3,
    /// The depth at which both projections show lengths at the same size.
    pub focus_distance: f64,
    /// The angle of view from the picture's lower to its upper edge.
    pub vertical_fov_rad: f64,
    /// The kind of projection.
    pub projection: Projection,
    /// The place at which the optical axis meets the picture, in normalized device coordinates (zero for its middle), as
    /// with a shifted lens. It keeps the fruit clear of a legend.
    pub lens_shift_ndc: DVec2,
}

impl Camera {
    /// The default angle of view: close to that of a person before the screen.
    pub const DEFAULT_FOV_RAD: f64 = 0.5;

    /// A camera at `eye_in_world` that looks at `target_in_world`, which becomes the pivot.
    /// `up_in_world` shows upward as far as it is not along the line of sight.
    pub fn looking_at(eye_in_world: DVec3, target_in_world: DVec3, up_in_world: DVec3) -> Self {
        let offset = eye_in_world - target_in_world;
        Self {
            eye_in_world,
            world_from_view: orientation(offset, up_in_world),
            pivot_in_world: target_in_world,
            focus_distance: offset.length().max(f64::MIN_POSITIVE),
            vertical_fov_rad: Self::DEFAULT_FOV_RAD,
            projection: Projection::Perspective,
            lens_shift_ndc: DVec2::ZERO,
        }
    }

    /// Whether its numbers are valid: all finite, a unit rotation, and positive lengths and angles.
    pub fn is_sound(&self) -> bool {
        self.eye_in_world.is_finite()
            && self.pivot_in_world.is_finite()
            && self.lens_shift_ndc.is_finite()
            && (self.world_from_view.length() - 1.0).abs() < 1e-3
            && self.focus_distance.is_finite()
            && self.focus_distance > 0.0
            && (1e-6..3.1).contains(&self.vertical_fov_rad)
    }

    /// The unit direction in which the camera looks.
    pub fn forward_in_world(&self) -> DVec3 {
        self.world_from_view * DVec3::NEG_Z
    }

    /// The unit direction that shows upward.
    pub fn up_in_world(&self) -> DVec3 {
        self.world_from_view * DVec3::Y
    }

    /// The unit direction that shows to the right.
    pub fn right_in_world(&self) -> DVec3 {
        self.world_from_view * DVec3::X
    }

    /// The distance of a point before the eye, along the line of sight; negative behind it.
    pub fn depth_of(&self, point_in_world: DVec3) -> f64 {
        (point_in_world - self.eye_in_world).dot(self.forward_in_world())
    }

    /// Turns about the pivot: `yaw_rad` about the view's up direction (positive moves the scene to
    /// the right), `pitch_rad` about its right direction (positive moves the scene down). There is
    /// no pole at which the picture flips.
    pub fn orbit(&mut self, yaw_rad: f64, pitch_rad: f64) {
        let turn_in_view =
            DQuat::from_axis_angle(DVec3::Y, -yaw_rad) * DQuat::from_axis_angle(DVec3::X, -pitch_rad);
        let turn_in_world = self.world_from_view * turn_in_view * self.world_from_view.inverse();
        self.eye_in_world = self.pivot_in_world + turn_in_world * (self.eye_in_world - self.pivot_in_world);
        self.world_from_view = (self.world_from_view * turn_in_view).normalize();
    }

    /// Moves the scene by `by_px` (x right, y down) at the pivot's depth.
    pub fn pan(&mut self, by_px: DVec2, viewport: Viewport) {
        let size = self.pixel_size_at(self.pivot_depth(), viewport);
        let offset = size * (by_px.y * self.up_in_world() - by_px.x * self.right_in_world());
        self.eye_in_world += offset;
        self.pivot_in_world += offset;
    }

    /// Scales every distance to `anchor_in_world` by `factor` (below one: closer). The anchor stays
    /// at its pixel.
    pub fn zoom_toward(&mut self, anchor_in_world: DVec3, factor: f64) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        let scaled = |p: DVec3| anchor_in_world + factor * (p - anchor_in_world);
        self.eye_in_world = scaled(self.eye_in_world);
        self.pivot_in_world = scaled(self.pivot_in_world);
        self.focus_distance *= factor;
    }

    /// Zooms with the point under the cursor, at the pivot's depth, kept in place.
    pub fn zoom_at_pixel(&mut self, pixel: DVec2, factor: f64, viewport: Viewport) {
        let anchor = self.point_at_depth(pixel, self.pivot_depth(), viewport);
        self.zoom_toward(anchor, factor);
    }

    /// Makes `point_in_world` the pivot. The picture stays as it is.
    pub fn set_pivot(&mut self, point_in_world: DVec3) {
        self.pivot_in_world = point_in_world;
        let depth = self.depth_of(point_in_world);
        // In an orthographic picture the focus decides the scale.
        if self.projection == Projection::Perspective && depth > 0.0 {
            self.focus_distance = depth;
        }
    }

    fn pivot_depth(&self) -> f64 {
        let depth = self.depth_of(self.pivot_in_world);
        if depth > 0.0 { depth } else { self.focus_distance }
    }

    /// Half the height of the visible part of the world at `depth`.
    pub(super) fn half_height_at(&self, depth: f64) -> f64 {
        let depth = match self.projection {
            Projection::Perspective => depth,
            Projection::Orthographic => self.focus_distance,
        };
        depth * (0.5 * self.vertical_fov_rad).tan()
    }

    /// The size of one pixel at `depth`, in the world's unit.
    pub fn pixel_size_at(&self, depth: f64, viewport: Viewport) -> f64 {
        2.0 * self.half_height_at(depth) / viewport.height_px
    }

    /// The nearest and the farthest depth that must be drawn to show all of `bounds`. The eye's own
    /// surroundings, a thousandth of the farthest, are given up for a resolution of depth.
    pub fn near_far(&self, bounds: &Bounds) -> (f64, f64) {
        let middle = self.depth_of(bounds.center_in_world);
        let radius = (1.001 * bounds.radius).max(1e-9 * middle.abs()).max(1e-12);
        match self.projection {
            Projection::Orthographic => (middle - radius, middle + radius),
            Projection::Perspective => {
                let far = (middle + radius).max(1e-3 * self.focus_distance);
                ((middle - radius).max(1e-3 * far), far)
            }
        }
    }

    /// The world in the view frame.
    pub fn view_from_world(&self) -> DMat4 {
        DMat4::from_quat(self.world_from_view.inverse()) * DMat4::from_translation(-self.eye_in_world)
    }

    /// The world in clip coordinates. Depth runs from 1 at `near` to 0 at `far`: reversed, since
    /// floats are dense near zero, where perspective crowds what is far.
    pub fn clip_from_world(&self, viewport: Viewport, near_far: (f64, f64)) -> DMat4 {
        let (near, far) = near_far;
        let span = far - near;
        let clip_from_view = match self.projection {
            Projection::Perspective => {
                let f = 1.0 / (0.5 * self.vertical_fov_rad).tan();
                DMat4::from_cols(
                    DVec4::new(f / viewport.aspect(), 0.0, 0.0, 0.0),
                    DVec4::new(0.0, f, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, near / span, -1.0),
                    DVec4::new(0.0, 0.0, near * far / span, 0.0),
                )
            }
            Projection::Orthographic => {
                let f = 1.0 / self.half_height_at(0.0);
                DMat4::from_cols(
                    DVec4::new(f / viewport.aspect(), 0.0, 0.0, 0.0),
                    DVec4::new(0.0, f, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, 1.0 / span, 0.0),
                    DVec4::new(0.0, 0.0, far / span, 1.0),
                )
            }
        };
        let shift = DMat4::from_translation(self.lens_shift_ndc.extend(0.0));
        shift * clip_from_view * self.view_from_world()
    }

    /// The projection of a point, in pixels; `None` behind the eye.
    pub fn project(&self, point_in_world: DVec3, viewport: Viewport) -> Option<DVec2> {
        let p = self.world_from_view.inverse() * (point_in_world - self.eye_in_world);
        let depth = -p.z;
        if self.projection == Projection::Perspective && depth <= 0.0 {
            return None;
        }
        let half = self.half_height_at(depth);
        let ndc = DVec2::new(p.x / (half * viewport.aspect()), p.y / half) + self.lens_shift_ndc;
        Some(viewport.pixel_from_ndc(ndc))
    }

    /// The ray of all points that project to a pixel. In an orthographic picture it starts beside the eye.
    pub fn ray_through(&self, pixel: DVec2, viewport: Viewport) -> Ray {
        let ndc = viewport.ndc_from_pixel(pixel) - self.lens_shift_ndc;
        let half = self.half_height_at(1.0);
        let across = DVec3::new(ndc.x * half * viewport.aspect(), ndc.y * half, 0.0);
        let (origin_in_view, direction_in_view) = match self.projection {
            Projection::Perspective => (DVec3::ZERO, (across + DVec3::NEG_Z).normalize()),
            Projection::Orthographic => (across, DVec3::NEG_Z),
        };
        Ray {
            origin_in_world: self.eye_in_world + self.world_from_view * origin_in_view,
            direction_in_world: self.world_from_view * direction_in_view,
        }
    }

    /// The point at `depth` that projects to a pixel.
    pub fn point_at_depth(&self, pixel: DVec2, depth: f64, viewport: Viewport) -> DVec3 {
        let ray = self.ray_through(pixel, viewport);
        let along = ray.direction_in_world.dot(self.forward_in_world());
        ray.origin_in_world + ray.direction_in_world * (depth / along)
    }
}

/// The orientation of a view whose eye lies in direction `backward` from its target.
pub(super) fn orientation(backward: DVec3, up: DVec3) -> DQuat {
    let z = backward.try_normalize().unwrap_or(DVec3::NEG_Z);
    // Where up lies along the line of sight, any direction across it will do.
    let x = up
        .normalize_or_zero()
        .cross(z)
        .try_normalize()
        .filter(|_| up.normalize_or_zero().cross(z).length() > 1e-6)
        .unwrap_or_else(|| z.any_orthonormal_vector());
    DQuat::from_mat3(&glam::DMat3::from_cols(x, z.cross(x), z)).normalize()
}
