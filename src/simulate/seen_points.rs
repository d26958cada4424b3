//! The points of a cloud that a camera would see: a scan of a scan.
//!
//! A cloud without faces has gaps between its points, through which the far side shows. So each point is drawn as a square of
//! some spacings into a coarse depth image, and is seen unless another lies in front of it there.

use glam::{DMat3, DVec3, IVec2};

use crate::geometry::Cloud;

/// The half width of a point's square, in spacings. Squares of neighbors overlap even where some are missing.
const HALF_WIDTH: f64 = 1.5;
/// The depth in spacings within which points are of one surface.
const SAME_SURFACE: f64 = 6.0;
/// The most pixels along a side of the depth image.
const MOST_PX: f64 = 1500.0;

/// The points of a cloud that a camera at `eye` sees, in the camera's frame: x to the right, y down, z ahead, and the
/// camera at the origin. `camera_from_cloud` is the rotation to that frame, and `spacing` the median distance between
/// neighboring points. Colors and labels come along, normals are turned. Points behind the camera are not seen.
pub fn seen_points(cloud: &Cloud, eye: DVec3, camera_from_cloud: DMat3, spacing: f64) -> Cloud {
    let placed: Vec<DVec3> = (cloud.positions().iter())
        .map(|&p| camera_from_cloud * (p - eye))
        .collect();
    let seen = unhidden(&placed, spacing);
    let chosen = cloud.select(&seen);
    let mut made = Cloud::new(seen.iter().map(|&i| placed[i]).collect());
    // The columns are of the same points, so that none is refused.
    if let Some(normals) = chosen.normals() {
        let turn = camera_from_cloud.as_mat3();
        made = with(made, |c| {
            c.with_normals(normals.iter().map(|&n| turn * n).collect())
        });
    }
    if let Some(colors) = chosen.colors() {
        made = with(made, |c| c.with_colors(colors.to_vec()));
    }
    if let Some(labels) = chosen.labels() {
        made = with(made, |c| c.with_labels(labels.to_vec()));
    }
    made
}

/// Adds a column, or leaves the cloud as it is if that is refused.
fn with<E>(cloud: Cloud, add: impl FnOnce(Cloud) -> Result<Cloud, E>) -> Cloud {
    let bare = cloud.clone();
    add(cloud).unwrap_or(bare)
}

/// The indices, ascending, of the points that no other one hides.
fn unhidden(points: &[DVec3], spacing: f64) -> Vec<usize> {
    // Relative to the nearest depth that counts, so that no unit is assumed.
    let ahead = |p: &DVec3| p.z > spacing;
    let mut depths: Vec<f64> = points.iter().filter(|p| ahead(p)).map(|p| p.z).collect();
    if depths.is_empty() || spacing <= 0.0 {
        return (0..points.len()).filter(|&i| ahead(&points[i])).collect();
    }
    let middle = depths.len() / 2;
    let depth = *depths.select_nth_unstable_by(middle, f64::total_cmp).1;
    let slope = |p: DVec3| p.truncate() / p.z;
    let widest = (points.iter().filter(|p| ahead(p)))
        .map(|&p| slope(p).abs().max_element())
        .fold(0.0, f64::max);
    // A pixel is as wide as the spacing at the middle depth, or wider where the image would be too large.
    let pixels_per_slope = (depth / spacing).min(0.5 * MOST_PX / widest.max(1e-9));
    // At most MOST_PX / 2.
    let half = (pixels_per_slope * widest).ceil() as i32 + 1;
    let side = 2 * half + 1;
    let pixel = |p: DVec3| (slope(p) * pixels_per_slope).round().as_ivec2() + IVec2::splat(half);
    let mut nearest = vec![f64::INFINITY; (side * side) as usize];
    for &p in points.iter().filter(|p| ahead(p)) {
        // A near point's square is larger. Clamped to the image before it becomes whole.
        let reach = (HALF_WIDTH * spacing / p.z * pixels_per_slope)
            .clamp(1.0, MOST_PX)
            .round() as i32;
        let at = pixel(p);
        let (low, high) = (
            (at - reach).max(IVec2::ZERO),
            (at + reach).min(IVec2::splat(side - 1)),
        );
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                let depth = &mut nearest[(y * side + x) as usize];
                *depth = depth.min(p.z);
            }
        }
    }
    let is_seen = |&i: &usize| {
        let p = points[i];
        ahead(&p) && {
            let at = pixel(p);
            p.z <= nearest[(at.y * side + at.x) as usize] + SAME_SURFACE * spacing
        }
    };
    (0..points.len()).filter(is_seen).collect()
}
