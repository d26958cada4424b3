//! Which points have a partner that the camera could see (§ 2.5, Eq. 11–14).

use glam::DVec3;

use crate::geometry::Plane;

/// Whether the mirror partner of a surface point would be visible from `viewpoint`: whether the
/// reflected normal faces it from the reflected point (the negation of Eq. 14).
pub fn has_visible_partner(plane: &Plane, point: DVec3, normal: DVec3, viewpoint: DVec3) -> bool {
    plane
        .reflect_direction(normal)
        .dot(viewpoint - plane.reflect_point(point))
        > 0.0
}

/// Points that a camera's view of one fruit may hold behind the camera before the cloud counts as
/// surrounding it: strays happen.
const STRAY_SHARE: f64 = 0.01;

/// Whether `viewpoint` lies inside the cloud: no direction has all points (but for a stray
/// hundredth) ahead. Then no single camera there can have seen them.
pub fn is_viewpoint_inside(points: &[DVec3], viewpoint: DVec3) -> bool {
    if points.is_empty() {
        return false;
    }
    let allowed = (points.len() as f64 * STRAY_SHARE) as usize;
    // Walk towards the point of the directions' convex hull that is nearest to the viewpoint
    // (Gilbert): while that point is not the viewpoint itself, it is a direction with all points
    // ahead, or soon becomes one. From a camera outside the first or second step settles it.
    let toward = |p: &DVec3| (*p - viewpoint).try_normalize();
    let mut ahead = points.iter().filter_map(toward).sum::<DVec3>() / points.len() as f64;
    for _ in 0..64 {
        let (mut behind, mut worst, mut worst_dot) = (0, DVec3::ZERO, f64::INFINITY);
        for p in points {
            let direction = toward(p).unwrap_or(DVec3::ZERO);
            let dot = direction.dot(ahead);
            behind += usize::from(dot <= 0.0);
            if dot < worst_dot {
                (worst, worst_dot) = (direction, dot);
            }
        }
        if behind <= allowed {
            return false;
        }
        let step = ahead - worst;
        let length_squared = step.length_squared();
        if length_squared == 0.0 {
            break;
        }
        ahead -= step * (step.dot(ahead) / length_squared).clamp(0.0, 1.0);
    }
    true
}
