//! Directions spread evenly over half a sphere, at which searches for an axis start.

use std::f64::consts::PI;

use glam::DVec3;

/// Returns `count` unit directions, spread about evenly over the half sphere z > 0 (a Fibonacci lattice: each turns by
/// the golden angle from the one before and lies lower by an equal share of the area). An axis has no sign, so they cover
/// all axes: 40 of them leave no axis farther than about 13° away.
pub fn half_sphere(count: usize) -> Vec<DVec3> {
    let golden_turn = PI * (1.0 + 5.0_f64.sqrt());
    let direction = |i: usize| {
        let step = i as f64 + 0.5;
        let z = step / count as f64;
        let (sin, cos) = (golden_turn * step).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z)
    };
    (0..count).map(direction).collect()
}
