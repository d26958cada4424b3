//! The sphere that fits points best, by least squares of their distances to its surface.

use std::cell::Cell;

use glam::DVec3;
use nalgebra::{Matrix4, Vector4};

use crate::geometry::Spread;
use crate::parallel::{Cancelled, Watch};

/// Computes the center and radius of the sphere with the least sum of squared distances between its
/// surface and the points, in their unit; `None` if they lie in a plane or are fewer than four.
///
/// The Gauss–Newton method starts from the algebraic fit, which is linear.
pub fn fit_sphere(points: &[DVec3]) -> Option<(DVec3, f64)> {
    // Without a watch nothing is called off.
    fit_sphere_watched(points, &()).ok()?
}

/// [`fit_sphere`], called off by a watch.
pub(super) fn fit_sphere_watched(
    points: &[DVec3],
    watch: &dyn Watch,
) -> Result<Option<(DVec3, f64)>, Cancelled> {
    let is_cancelled = Cell::new(false);
    let found = fit(points, &|| {
        is_cancelled.set(watch.is_cancelled());
        !is_cancelled.get()
    });
    if is_cancelled.get() {
        Err(Cancelled)
    } else {
        Ok(found)
    }
}

/// Fits the sphere as long as `goes_on` says so; it is asked before each step.
fn fit(points: &[DVec3], goes_on: &dyn Fn() -> bool) -> Option<(DVec3, f64)> {
    let spread = Spread::of_points(points)?;
    if points.len() < 4 || spread.variances[0].sqrt() <= 1e-6 * spread.variances[2].sqrt() {
        return None;
    }
    // Points near the origin and of size one keep the digits of the normal equations.
    let scale = spread.rms_radius();
    let scaled = || points.iter().map(|&p| (p - spread.mean) / scale);

    let (mut center, mut radius) = algebraic_fit(scaled())?;
    for _ in 0..50 {
        if !goes_on() {
            return None;
        }
        let step = gauss_newton_step(scaled(), center, radius)?;
        center += step.truncate();
        radius += step.w;
        if step.length() <= 1e-12 * (1.0 + radius.abs()) {
            break;
        }
    }
    let (center, radius) = (spread.mean + scale * center, scale * radius);
    (center.is_finite() && radius.is_finite() && radius > 0.0).then_some((center, radius))
}

/// Computes the sphere with the least Σ(‖p − c‖² − r²)².
fn algebraic_fit(points: impl Iterator<Item = DVec3>) -> Option<(DVec3, f64)> {
    let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
    for p in points {
        let row = Vector4::new(2.0 * p.x, 2.0 * p.y, 2.0 * p.z, 1.0);
        normal += row * row.transpose();
        right += row * p.length_squared();
    }
    let s = normal.cholesky()?.solve(&right);
    let center = DVec3::new(s[0], s[1], s[2]);
    Some((center, (s[3] + center.length_squared()).sqrt()))
}

/// Computes one step of (center, radius) towards the least Σ(‖p − c‖ − r)².
fn gauss_newton_step(points: impl Iterator<Item = DVec3>, center: DVec3, radius: f64) -> Option<glam::DVec4> {
    let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
    for p in points {
        let offset = p - center;
        let distance = offset.length();
        let toward = if distance > 0.0 {
            offset / distance
        } else {
            DVec3::ZERO
        };
        let row = Vector4::new(toward.x, toward.y, toward.z, 1.0);
        normal += row * row.transpose();
        right += row * (distance - radius);
    }
    let s = normal.cholesky()?.solve(&right);
    Some(glam::DVec4::new(s[0], s[1], s[2], s[3]))
}
