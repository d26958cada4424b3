//! Cameras: presets, framing and projections.

use glam::{DVec2, DVec3};

use super::look::Look;
use crate::app::state::State;
use crate::estimate::Estimator;
use crate::render::{Camera, Insets, Projection, Viewport};
use crate::view::{Overlay, Page, SceneSettings, ViewPreset, framed_cloud, framed_points, insets};

/// The approximate width of a text, for framing with room for the page: the window's font is not known here.
fn measure(text: &str, size_px: f64) -> f64 {
    0.5 * size_px * text.chars().count() as f64
}

/// The points that must be in the picture, and the room that the page takes.
fn framed(state: &State) -> (Vec<DVec3>, Insets) {
    let Some(shown) = state.shown() else {
        return (Vec::new(), Insets::default());
    };
    let look = state.look.as_deref();
    let style = &state.shown_style();
    let page = Page {
        viewport: state.viewport,
        theme: style.theme,
        legend: look
            .map(|l| &*l.legend)
            .filter(|_| style.overlays.has(Overlay::Legend)),
        scale_unit: None,
        has_triad: false,
        caption: Vec::new(),
        label: None,
    };
    let mut insets = insets(&page, &measure);
    // Scale bar and triad take the lower corners.
    insets.bottom_px += 24.0;
    let points = match (state.analysis(), plane_and_axis(state)) {
        (Some(_), (plane, axis)) => framed_points(
            shown,
            &SceneSettings {
                style,
                point_size_px: 1.0,
                plane,
                axis: axis.as_ref(),
                reference: state.reference().filter(|_| !state.true_axes.is_blind),
                references: &[],
            },
        ),
        (None, _) => framed_cloud(shown),
    };
    (points, insets)
}

fn plane_and_axis(
    state: &State,
) -> (
    Option<crate::geometry::Plane>,
    Option<crate::method::AxisEstimate>,
) {
    if state.true_axes.is_blind {
        return (None, None);
    }
    let plane = (state.analysis().zip(state.chosen_plane_index())).map(|(a, index)| a.plane(index));
    let axis = state.analysis().and_then(|a| a.axis.clone());
    (plane, axis)
}

/// The camera of a preset; `None` if the normal or axis to look along is missing.
pub(in crate::app) fn preset_camera(state: &State, preset: ViewPreset) -> Option<Camera> {
    let (points, insets) = framed(state);
    let analysis = state.analysis();
    let look = state.look.as_deref();
    let direction = match preset {
        ViewPreset::Normal => {
            let analysis = analysis?;
            analysis.planes.grid.candidate(state.plane_index()?).normal
        }
        ViewPreset::Axis if state.estimators.counts == Estimator::Body => {
            state.estimators.body_axis()?.direction
        }
        ViewPreset::Axis => look.and_then(|l: &Look| l.axis.as_ref())?.direction,
        _ => DVec3::ZERO,
    };
    let viewpoint = analysis.map_or(state.settings.request.params.viewpoint, |a| a.params.viewpoint);
    Some(preset.camera(
        &points,
        viewpoint,
        direction,
        state.camera.projection,
        state.viewport,
        insets,
    ))
}

/// The view that a cloud is first shown in: a little from the side and from above, since from the
/// depth camera's own place a cloud looks flat.
pub fn default_camera(state: &State) -> Camera {
    let Some(mut camera) = preset_camera(state, ViewPreset::Front) else {
        return state.camera;
    };
    camera.orbit(0.6, 0.35);
    let (points, insets) = framed(state);
    camera.frame(&points, state.viewport, insets);
    camera
}

/// The same direction, with everything in the picture.
pub(in crate::app) fn framed_camera(state: &State) -> Camera {
    let (points, insets) = framed(state);
    let mut camera = state.camera;
    camera.vertical_fov_rad = Camera::DEFAULT_FOV_RAD;
    if !points.is_empty() {
        camera.frame(&points, state.viewport, insets);
    }
    camera
}

/// The camera with another projection, in which things at the pivot are as large as before.
pub(in crate::app) fn projected(camera: &Camera, projection: Projection) -> Camera {
    let mut camera = *camera;
    let depth = camera.depth_of(camera.pivot_in_world);
    match (camera.projection, projection) {
        (Projection::Perspective, Projection::Orthographic) if depth > 0.0 => camera.focus_distance = depth,
        (Projection::Orthographic, Projection::Perspective) => {
            // The eye goes to where the pivot shows at the same size.
            let back = camera.focus_distance - depth;
            camera.eye_in_world -= back * camera.forward_in_world();
        }
        _ => {}
    }
    camera.projection = projection;
    camera
}

/// A point moved across the view by a drag, at its own depth.
pub fn dragged(point_in_world: DVec3, by_px: DVec2, camera: &Camera, viewport: Viewport) -> DVec3 {
    let size = camera.pixel_size_at(camera.depth_of(point_in_world), viewport);
    point_in_world + size * (by_px.x * camera.right_in_world() - by_px.y * camera.up_in_world())
}
