//! Places of the views in which an axis is edited: where a click lands, and the locked cameras.

use glam::{DVec2, DVec3};

use super::handles::Handle;
use super::state::{Draft, Grab, Subject, TrueAxesState};
use crate::annotate::Ends;
use crate::app::inspector::navigate::dragged;
use crate::render::{Camera, Projection, Viewport};

/// The distance in logical pixels within which a press grabs a handle.
const REACH_PX: f64 = 14.0;

impl TrueAxesState {
    /// The handle that a press at `pixel` would grab.
    pub fn handle_at(&self, pixel: DVec2, camera: &Camera, viewport: Viewport) -> Option<Handle> {
        if !self.can_edit() || self.next_end().is_some() {
            return None;
        }
        let ends = self.ends()?;
        let distance = |handle: Handle| {
            let at = camera.project(handle.place(&ends), viewport)?;
            Some(at.distance(pixel)).filter(|&d| d <= REACH_PX)
        };
        let near = Handle::ALL
            .into_iter()
            .filter_map(|handle| Some((distance(handle)?, handle)));
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, handle)| handle)
    }

    /// The point at which a click at `pixel` lands. The axis lies inside the fruit: the peduncle's base lands as deep
    /// as the fruit's middle, the blossom end as deep as the point that is opposite the base.
    pub fn landing_at(&self, pixel: DVec2, camera: &Camera, viewport: Viewport) -> Option<DVec3> {
        let middle = self.subject.as_ref()?.middle;
        let as_deep_as = match self.draft {
            Draft::Base(base) => 2.0 * middle - base,
            Draft::None | Draft::Anew => middle,
        };
        let mut depth = camera.depth_of(as_deep_as);
        if camera.projection == Projection::Perspective && depth <= 0.0 {
            depth = camera.focus_distance;
        }
        Some(camera.point_at_depth(pixel, depth, viewport)).filter(|p| p.is_finite())
    }

    /// The position of a held handle with the cursor at `pixel`: in the plane that faces the camera.
    pub fn held_at(&self, grab: &Grab, pixel: DVec2, camera: &Camera, viewport: Viewport) -> DVec3 {
        dragged(grab.place, pixel - grab.at_px, camera, viewport)
    }
}

/// The three locked cameras of an axis: without perspective, with the axis upright in the first two.
/// Without an axis yet, that of a fruit that hangs upright: *up* in a camera's frame is −y.
pub(super) fn locked_cameras(subject: &Subject, ends: Option<&Ends>) -> [Camera; 3] {
    let up = ends.map_or(DVec3::NEG_Y, Ends::direction);
    let ray = subject.extent.center() - subject.viewpoint;
    let front = (ray - ray.dot(up) * up)
        .try_normalize()
        .unwrap_or_else(|| up.any_orthonormal_vector());
    // What the fruit and the axis span along the axis, and how far they reach from it.
    let on_axis = ends.map_or(subject.middle, Ends::middle);
    let of_ends = ends.map(|ends| [ends.peduncle_base(), ends.blossom_end()]);
    let (mut low, mut high, mut reach) = (0.0_f64, 0.0_f64, 0.0_f64);
    for &p in subject.sample.iter().chain(of_ends.iter().flatten()) {
        let along = (p - on_axis).dot(up);
        (low, high) = (low.min(along), high.max(along));
        reach = reach.max((p - on_axis - along * up).length());
    }
    let size = subject.extent.size().length().max(1e-9);
    // In steps, so that a nudge does not zoom.
    let step = 0.05 * size;
    let half = ((1.1 * reach.max(0.5 * (high - low))) / step).ceil().max(1.0) * step;
    let target = on_axis + 0.5 * (low + high) * up;
    [(front, up), (up.cross(front), up), (-up, front)].map(|(forward, up)| {
        let mut camera = Camera::along(forward, up, target, size);
        camera.projection = Projection::Orthographic;
        camera.focus_distance = half / (0.5 * camera.vertical_fov_rad).tan();
        camera
    })
}
