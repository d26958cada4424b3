//! About where the middle of a fruit lies of which one side is seen.

use glam::DVec3;

use crate::geometry::Extent;

/// Directions across the line of sight in which the fruit's width is measured.
const DIRECTIONS: u32 = 12;
/// The share of points on either side that may be strays.
const STRAYS: f64 = 0.003;

/// As far behind the front as the fruit is half as wide, where it is narrowest: of a round body half is
/// seen, and the peduncle does not count. On 30 simulated peppers it lies half a centimeter from the true
/// depth (root mean square); the center of the sphere through the points, 2.8 cm.
///
/// It gives a click its depth and is nothing of the method's, so that blind mode need not hide it.
pub(super) fn middle(points: &[DVec3], extent: &Extent, viewpoint: DVec3) -> DVec3 {
    let center = extent.center();
    let Some(ray) = (center - viewpoint).try_normalize() else {
        return center;
    };
    let Some((front, _)) = span(points, ray) else {
        return center;
    };
    let (a, b) = ray.any_orthonormal_pair();
    let width = (0..DIRECTIONS)
        .filter_map(|i| {
            let (sin, cos) = (f64::from(i) * std::f64::consts::PI / f64::from(DIRECTIONS)).sin_cos();
            span(points, cos * a + sin * b).map(|(low, high)| high - low)
        })
        .fold(f64::INFINITY, f64::min);
    center + (front + 0.5 * width - center.dot(ray)) * ray
}

/// What the points span along a direction, but for strays.
fn span(points: &[DVec3], direction: DVec3) -> Option<(f64, f64)> {
    let mut along: Vec<f64> = points.iter().map(|p| p.dot(direction)).collect();
    along.sort_by(f64::total_cmp);
    // A small share of their number.
    let strays = (STRAYS * along.len() as f64) as usize;
    Some((*along.get(strays)?, *along.get(along.len() - 1 - strays)?))
}
