//! The visibility of a point's partner from the viewpoint (§ 2.5, Eq. 11–14).

use glam::DVec3;

use crate::geometry::Plane;

/// Checks whether the mirror partner of a surface point would be visible from `viewpoint`, which means
/// that the reflected normal faces it from the reflected point (the negation of Eq. 14).
pub fn has_visible_partner(plane: &Plane, point: DVec3, normal: DVec3, viewpoint: DVec3) -> bool {
    plane
        .reflect_direction(normal)
        .dot(viewpoint - plane.reflect_point(point))
        > 0.0
}

/// The share of points that may lie behind the camera, as strays do, before the cloud counts as surrounding
/// it.
const STRAY_SHARE: f64 = 0.01;

/// Checks whether `viewpoint` lies inside the cloud: no direction from there has all points ahead, but for
/// one in a hundred that may be stray. No single camera can have seen such a cloud from there.
pub fn is_viewpoint_inside(points: &[DVec3], viewpoint: DVec3) -> bool {
    if points.is_empty() {
        return false;
    }
    let allowed = (points.len() as f64 * STRAY_SHARE) as usize;
    // Gilbert's algorithm: approach the point of the convex hull of all directions that is nearest to
    // zero. Unless zero lies within the hull, that point is a direction with all points ahead. From a
    // camera outside the cloud the first or second step finds one.
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
