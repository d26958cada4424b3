//! The points of a whole scan that a camera would see.

use axiscope::geometry::Cloud;
use axiscope::peduncle::median_spacing;
use axiscope::simulate::seen_points;
use glam::{DMat3, DVec3};
use proptest::prelude::*;

/// A ball of evenly spread points about a place.
fn ball(center: DVec3, radius: f64, count: usize) -> Vec<DVec3> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|i| {
            let y = 1.0 - 2.0 * (i as f64 + 0.5) / count as f64;
            let (sin, cos) = (golden * i as f64).sin_cos();
            let out = (1.0 - y * y).sqrt();
            center + radius * DVec3::new(out * cos, y, out * sin)
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Of a whole ball, the half that faces the camera is seen: all of it but for a rim, and none of the other half.
    #[test]
    fn the_near_half_of_a_ball_is_seen(
        count in 800_usize..6_000,
        towards in prop::array::uniform3(-1.0..1.0_f64),
        distance in 3.0..12.0_f64,
        radius in 0.01..100.0_f64,
    ) {
        let towards = DVec3::from_array(towards).normalize_or(DVec3::Z);
        let points = ball(DVec3::new(1.0, 2.0, 3.0) * radius, radius, count);
        let eye = points.iter().sum::<DVec3>() / count as f64 - towards * distance * radius;
        let right = towards.any_orthonormal_vector();
        let camera = DMat3::from_cols(right, towards.cross(right), towards).transpose();
        let labels: Vec<i32> = (0..).take(count).collect();
        let cloud = Cloud::new(points.clone()).with_labels(labels).expect("a label each");
        let spacing = median_spacing(&points).expect("they are apart");
        let seen = seen_points(&cloud, eye, camera, spacing);
        let center = points.iter().sum::<DVec3>() / count as f64;
        // The cosine between a point's normal and its direction to the camera.
        let facing = |p: DVec3| (p - center).normalize().dot((eye - p).normalize());
        let mut is_seen = vec![false; count];
        for (&i, &p) in seen.labels().expect("they come along").iter().zip(seen.positions()) {
            let i = usize::try_from(i).expect("an index");
            is_seen[i] = true;
            let back = eye + camera.transpose() * p;
            prop_assert!(back.distance(points[i]) < 1e-9 * distance * radius);
            prop_assert!(p.z > 0.0);
        }
        // The squares of points at the rim reach beyond it by some spacings.
        let rim = (10.0 * spacing / radius).min(0.6);
        for (i, &p) in points.iter().enumerate() {
            let cos = facing(p);
            prop_assert!(is_seen[i] || cos < rim, "point {i} faces the camera by {cos}");
            prop_assert!(!is_seen[i] || cos > -rim, "point {i} faces away by {cos}");
        }
    }
}
