//! Picking the point under the cursor.

use glam::{DVec2, DVec3};

use super::ShownPoints;
use crate::render::{Camera, Projection, Viewport};

/// The point under `pixel`: of the points whose disc of `radius_px` covers it, the one nearest to the eye; if none does,
/// the one whose projection is nearest within `reach_px`.
///
/// Pixels are the viewport's, so that a view of twice the pixels picks the same.
pub fn pick_point(
    shown: &ShownPoints,
    camera: &Camera,
    viewport: Viewport,
    pixel: DVec2,
    radius_px: f64,
    reach_px: f64,
) -> Option<usize> {
    // A ray's neighborhood is tested first: most points are far from it, and need no projection.
    let ray = camera.ray_through(pixel, viewport);
    let (origin, direction) = (ray.origin_in_world, ray.direction_in_world);
    let forward = camera.forward_in_world();
    let margin_px = radius_px.max(reach_px);
    let mut covering: Option<(f64, usize)> = None;
    let mut near: Option<(f64, usize)> = None;
    for (i, &point) in shown.positions.iter().enumerate() {
        let to_point: DVec3 = point - origin;
        let depth = (point - camera.eye_in_world).dot(forward);
        if depth <= 0.0 && camera.projection == Projection::Perspective {
            continue;
        }
        // Half as much again, since pixels away from the middle of a perspective view are longer.
        let reach = 1.5 * margin_px * camera.pixel_size_at(depth, viewport);
        let along = to_point.dot(direction);
        if to_point.length_squared() - along * along > reach * reach {
            continue;
        }
        let Some(at) = camera.project(point, viewport) else {
            continue;
        };
        let distance = at.distance(pixel);
        if distance <= radius_px {
            if covering.is_none_or(|(nearest, _)| depth < nearest) {
                covering = Some((depth, i));
            }
        } else if distance <= reach_px && near.is_none_or(|(nearest, _)| distance < nearest) {
            near = Some((distance, i));
        }
    }
    covering.or(near).map(|(_, i)| i)
}
