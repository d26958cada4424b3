//! Framing: the placement of a camera so that given points fill the picture.

use glam::{DVec2, DVec3};

use super::camera::orientation;
use super::{Camera, Projection, Viewport};
use crate::geometry::Extent;

/// Room at the picture's edges that is kept free, for a legend or a caption, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Insets {
    /// At the left edge.
    pub left_px: f64,
    /// At the right edge.
    pub right_px: f64,
    /// At the upper edge.
    pub top_px: f64,
    /// At the lower edge.
    pub bottom_px: f64,
}

/// The box of some points in a view's frame.
struct ViewBox {
    min: DVec3,
    max: DVec3,
}

impl Camera {
    /// A camera that sees in `forward_in_world`, with `up_in_world` upward, at `target_in_world` from
    /// `distance`: front, side, top, along a normal or along an axis.
    pub fn along(forward_in_world: DVec3, up_in_world: DVec3, target_in_world: DVec3, distance: f64) -> Self {
        let forward = forward_in_world.try_normalize().unwrap_or(DVec3::Z);
        Self::looking_at(target_in_world - distance * forward, target_in_world, up_in_world)
    }

    /// The corners of a box, which frame it when they are all in the picture.
    pub fn corners(extent: &Extent) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 {
                    extent.min[axis]
                } else {
                    extent.max[axis]
                }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }

    /// Moves eye and pivot, without turning, so that the points fill the picture between the insets.
    /// Without a finite point nothing changes.
    pub fn frame(&mut self, points_in_world: &[DVec3], viewport: Viewport, insets: Insets) {
        let Some(view_box) = self.box_of(points_in_world) else {
            return;
        };
        let (inner_ndc, shift) = inner(viewport, insets);
        self.lens_shift_ndc = shift;
        let middle_in_view = 0.5 * (view_box.min + view_box.max);
        let middle = self.world_from_view * middle_in_view;
        let tan = (0.5 * self.vertical_fov_rad).tan();
        let (tan_x, tan_y) = (tan * viewport.aspect() * inner_ndc.x, tan * inner_ndc.y);
        let perspective = self.projection == Projection::Perspective;
        let inverse = self.world_from_view.inverse();
        let needed = points_in_world.iter().filter(|p| p.is_finite()).map(|&p| {
            let q = inverse * (p - middle);
            let reach = (q.x.abs() / tan_x).max(q.y.abs() / tan_y);
            if perspective { reach + q.z } else { reach }
        });
        let size = view_box.max - view_box.min;
        let smallest = 1e-6 * size.length().max(1e-6);
        let distance = needed.fold(smallest, f64::max);
        self.pivot_in_world = middle;
        self.eye_in_world = middle - distance * self.forward_in_world();
        self.focus_distance = distance;
    }

    /// Turns toward the points and narrows or widens the lens, without moving the eye, so that they
    /// fill the picture between the insets: the depth camera's own view, enlarged.
    pub fn frame_from_here(&mut self, points_in_world: &[DVec3], viewport: Viewport, insets: Insets) {
        let finite = || points_in_world.iter().filter(|p| p.is_finite());
        let up = self.up_in_world();
        // Twice: the middle of what is seen hangs on the direction, if only slightly.
        for _ in 0..2 {
            let inverse = self.world_from_view.inverse();
            let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
            for &p in finite() {
                let q = inverse * (p - self.eye_in_world);
                if -q.z > 0.0 {
                    let slope = q.truncate() / -q.z;
                    (low, high) = (low.min(slope), high.max(slope));
                }
            }
            if !(low.is_finite() && high.is_finite()) {
                return;
            }
            let middle = (0.5 * (low + high)).extend(-1.0);
            self.world_from_view = orientation(-(self.world_from_view * middle), up);
        }
        let (inner_ndc, shift) = inner(viewport, insets);
        self.lens_shift_ndc = shift;
        let inverse = self.world_from_view.inverse();
        let tan = finite()
            .map(|&p| inverse * (p - self.eye_in_world))
            .filter(|q| -q.z > 0.0)
            .map(|q| {
                let slope = q.truncate().abs() / -q.z;
                (slope.x / (inner_ndc.x * viewport.aspect())).max(slope.y / inner_ndc.y)
            })
            .fold(1e-6, f64::max);
        self.vertical_fov_rad = (2.0 * tan.atan()).min(2.5);
        if let Some(view_box) = self.box_of(points_in_world) {
            let middle = self.world_from_view * (0.5 * (view_box.min + view_box.max));
            let depth = self.depth_of(middle).max(f64::MIN_POSITIVE);
            self.focus_distance = depth;
            self.pivot_in_world = self.eye_in_world + depth * self.forward_in_world();
        }
    }

    fn box_of(&self, points_in_world: &[DVec3]) -> Option<ViewBox> {
        let inverse = self.world_from_view.inverse();
        let finite = points_in_world.iter().filter(|p| p.is_finite());
        finite.map(|&p| inverse * p).fold(None, |found, p| {
            let (min, max) = found.map_or((p, p), |b: ViewBox| (b.min.min(p), b.max.max(p)));
            Some(ViewBox { min, max })
        })
    }
}

/// The share of the picture between the insets, each way, and the place of its middle.
fn inner(viewport: Viewport, insets: Insets) -> (DVec2, DVec2) {
    // At least half of the picture is left for the content.
    let share = |low: f64, high: f64, all: f64| {
        let scale = (0.5 * all / (low + high).max(1e-9)).min(1.0);
        let (low, high) = (low * scale, high * scale);
        ((all - low - high) / all, (low - high) / all)
    };
    let (width, right) = share(insets.left_px, insets.right_px, viewport.width_px);
    let (height, down) = share(insets.top_px, insets.bottom_px, viewport.height_px);
    (DVec2::new(width, height), DVec2::new(right, -down))
}
