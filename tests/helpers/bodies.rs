//! Clouds that the tests make for themselves.

use axiscope::geometry::Plane;
use glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A bumpy body seen from the origin: points that face it, with their normals. Centimeters.
pub struct View {
    pub points: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    pub center: DVec3,
}

/// Radius of the body in the direction `v` from its center.
fn radius(v: DVec3) -> f64 {
    3.0 + 0.5 * (2.0 * v.x + 0.3).sin() + 0.4 * v.y - 0.3 * v.y * v.z
}

/// About `count` points of the body that face the origin.
pub fn view(seed: u64, count: usize) -> View {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let center = DVec3::new(1.5, -2.0, 30.0);
    let (mut points, mut normals) = (Vec::new(), Vec::new());
    while points.len() < count {
        let mut coordinate = || random.random_range(-1.0..1.0);
        let Some(v) = DVec3::new(coordinate(), coordinate(), coordinate()).try_normalize() else {
            continue;
        };
        let surface = |v: DVec3| radius(v.normalize()) * v.normalize();
        let (a, b) = v.any_orthonormal_pair();
        let step = 1e-5;
        let (da, db) = (
            surface(v + step * a) - surface(v - step * a),
            surface(v + step * b) - surface(v - step * b),
        );
        let normal = da.cross(db).normalize();
        let normal = normal * normal.dot(v).signum();
        let point = center + surface(v);
        if normal.dot(-point) > 0.0 {
            points.push(point);
            normals.push(normal);
        }
    }
    View {
        points,
        normals,
        center,
    }
}

/// Points within a unit sphere, as many as asked for.
pub fn scattered(seed: u64, count: usize) -> Vec<DVec3> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut coordinate = || random.random_range(-1.0..1.0);
    std::iter::repeat_with(|| DVec3::new(coordinate(), coordinate(), coordinate()))
        .filter(|p| p.length() <= 1.0)
        .take(count)
        .collect()
}

/// A rotation drawn from `seed`.
pub fn rotation(seed: u64) -> DQuat {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut coordinate = || random.random_range(-1.0..1.0);
    DQuat::from_xyzw(coordinate(), coordinate(), coordinate(), coordinate() + 2.0).normalize()
}

/// The plane moved rigidly.
pub fn moved(plane: Plane, rotation: DQuat, translation: DVec3) -> Plane {
    Plane {
        point: rotation * plane.point + translation,
        normal: rotation * plane.normal,
    }
}
