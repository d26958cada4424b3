//! Neighbors, normals, filters and angles against what they must be by definition.

mod common;

use std::num::NonZeroUsize;

use axiscope::geometry::{
    Cloud, Extent, Neighbors, angle_between_directions_rad, angle_between_lines_rad, estimate_normals,
    statistical_inliers, voxel_grid,
};
use common::{rotation, scattered, view};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

fn k(n: usize) -> NonZeroUsize {
    NonZeroUsize::new(n).unwrap()
}

/// Points on a coarse lattice: many equal coordinates and many exact duplicates.
fn quantized(seed: u64, count: usize, steps: f64) -> Vec<DVec3> {
    scattered(seed, count)
        .iter()
        .map(|p| (*p * steps).round() / steps)
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn neighbors_are_the_nearest(seed in 0u64..1000, steps in 1.0..30.0f64, count in 1usize..30) {
        let points = quantized(seed, 200, steps.round());
        let index = Neighbors::new(&points).unwrap();
        for query in scattered(seed + 1, 20) {
            let mut distances: Vec<f64> = points.iter().map(|p| p.distance_squared(query)).collect();
            let nearest = index.nearest(query);
            distances.sort_by(f64::total_cmp);
            prop_assert!((nearest.distance_squared - distances[0]).abs() < 1e-12);
            prop_assert_eq!(points.iter().position(|p| *p == points[nearest.index]), Some(nearest.index), "the lowest of equals");
            // Each place stands for all points that lie there.
            let mut found: Vec<f64> = index.nearest_places(query, k(count)).iter()
                .flat_map(|n| std::iter::repeat_n(n.distance_squared, n.multiplicity)).collect();
            prop_assert!(found.len() >= count.min(points.len()));
            // No place more than it takes.
            let last = index.nearest_places(query, k(count)).pop().unwrap().multiplicity;
            prop_assert!(found.len() - last < count);
            found.truncate(count);
            for (a, b) in found.iter().zip(&distances) {
                prop_assert!((a - b).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn normals_are_those_of_the_surface_and_face_the_viewpoint(seed in 0u64..1000) {
        let v = view(seed, 1500);
        let normals = estimate_normals(&v.points, k(12), DVec3::ZERO, &()).unwrap();
        let mut off: Vec<f64> = normals.iter().zip(&v.normals)
            .map(|(a, b)| angle_between_directions_rad(a.unwrap(), *b).to_degrees()).collect();
        off.sort_by(f64::total_cmp);
        prop_assert!(off[off.len() / 2] < 4.0, "median {}", off[off.len() / 2]);
        prop_assert!(normals.iter().zip(&v.points).all(|(n, p)| n.unwrap().dot(-*p) >= 0.0));
    }

    #[test]
    fn normals_turn_with_the_cloud(seed in 0u64..1000) {
        let v = view(seed, 200);
        let r = rotation(seed);
        let turned: Vec<_> = v.points.iter().map(|&p| r * p).collect();
        let before = estimate_normals(&v.points, k(10), DVec3::ZERO, &()).unwrap();
        let after = estimate_normals(&turned, k(10), DVec3::ZERO, &()).unwrap();
        for (a, b) in before.iter().zip(&after) {
            prop_assert!(angle_between_directions_rad(r * a.unwrap(), b.unwrap()) < 1e-6);
        }
    }

    #[test]
    fn the_robust_extent_is_that_of_sorted_coordinates(seed in 0u64..1000, count in 1usize..400) {
        let points = scattered(seed, count);
        let cut = (points.len() - 1) * 2 / 100;
        let size = Extent::robust(&points).unwrap().size();
        for axis in 0..3 {
            let mut values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
            values.sort_by(f64::total_cmp);
            prop_assert_eq!(size[axis], values[values.len() - 1 - cut] - values[cut]);
        }
    }

    #[test]
    fn angles_keep_their_digits_near_zero(seed in 0u64..1000, exponent in -12.0..0.0f64) {
        let angle = 10f64.powf(exponent);
        let r = rotation(seed);
        let (a, b) = (r * DVec3::X, r * DVec3::new(angle.cos(), angle.sin(), 0.0));
        prop_assert!((angle_between_directions_rad(a, 5.0 * b) - angle).abs() < 1e-3 * angle + 3e-16);
        prop_assert!((angle_between_lines_rad(a, -b) - angle).abs() < 1e-3 * angle + 3e-16);
    }
}

#[test]
fn duplicates_weigh_in_normals_as_often_as_they_occur() {
    // Five points in a plane and a sixth off it: once it hardly tilts the fit, forty times it takes
    // the neighborhood over.
    let plane =
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.5)].map(|(x, y)| DVec3::new(x, y, 5.0));
    let off = DVec3::new(0.5, 0.6, 4.0);
    let normal = |copies: usize, k_: usize| {
        let points: Vec<_> = plane
            .iter()
            .copied()
            .chain(std::iter::repeat_n(off, copies))
            .collect();
        (
            points.len(),
            estimate_normals(&points, k(k_), DVec3::ZERO, &()).unwrap()[5],
        )
    };
    let (_, once) = normal(1, 6);
    assert!(once.is_some());
    let (points, often) = normal(40, 45);
    assert_eq!(points, 45);
    assert_ne!(
        once.map(|n| (n * 100.0).round()),
        often.map(|n| (n * 100.0).round())
    );
    // A neighborhood of forty equal points is one place: no normal.
    assert_eq!(normal(40, 30).1, None);
}

#[test]
fn neighborhoods_on_a_line_have_no_normal() {
    let mut points: Vec<_> = (0..20)
        .map(|i| DVec3::new(f64::from(i) * 0.1, 0.0, 10.0))
        .collect();
    points.extend([
        DVec3::new(50.0, 0.0, 10.0),
        DVec3::new(50.1, 0.0, 10.0),
        DVec3::new(50.0, 0.1, 10.0),
    ]);
    let normals = estimate_normals(&points, k(3), DVec3::ZERO, &()).unwrap();
    assert!(normals[..20].iter().all(Option::is_none));
    assert!(normals[20..].iter().all(Option::is_some));
}

#[test]
fn outliers_are_left_out_and_nothing_else() {
    let mut points = view(2, 800).points;
    points.push(DVec3::new(40.0, 40.0, 60.0));
    points.push(DVec3::new(-30.0, 0.0, 20.0));
    let inliers = statistical_inliers(&points, k(20), 3.0, &()).unwrap();
    assert!(!inliers.contains(&800) && !inliers.contains(&801));
    assert!(inliers.len() > 780, "{}", inliers.len());
    assert!(inliers.is_sorted());
}

#[test]
fn a_voxel_holds_the_mean_of_its_points() {
    let points = vec![
        DVec3::new(0.1, 0.1, 0.1),
        DVec3::new(5.0, 5.0, 5.0),
        DVec3::new(0.3, 0.5, 0.9),
        DVec3::new(-0.1, 0.1, 0.1),
    ];
    let cloud = Cloud::new(points)
        .with_normals(vec![Vec3::X, Vec3::Z, Vec3::Y, Vec3::ZERO])
        .unwrap()
        .with_colors(vec![[0, 100, 0, 255], [9; 4], [255, 101, 0, 255], [7; 4]])
        .unwrap()
        .with_labels(vec![1, 0, 0, 1])
        .unwrap();
    let thin = voxel_grid(&cloud, 1.0);
    assert_eq!(thin.len(), 3, "a cube on the other side of the origin is another");
    assert!(thin.positions()[0].distance(DVec3::new(0.2, 0.3, 0.5)) < 1e-12);
    assert!(thin.normals().unwrap()[0].distance(Vec3::new(1.0, 1.0, 0.0).normalize()) < 1e-6);
    assert_eq!(thin.normals().unwrap()[2], Vec3::ZERO);
    assert_eq!(thin.colors().unwrap()[0], [128, 101, 0, 255]);
    assert_eq!(
        thin.labels().unwrap(),
        [0, 0, 1],
        "the lowest of equally frequent labels"
    );
}

#[test]
fn the_robust_extent_ignores_strays() {
    let mut points = scattered(1, 1000);
    points.push(DVec3::splat(1e6));
    let extent = Extent::robust(&points).unwrap();
    assert!(extent.size().max_element() < 2.0 && extent.size().min_element() > 1.5);
    assert_eq!(Extent::of(&points).unwrap().max, DVec3::splat(1e6));
    assert_eq!(Extent::robust(&[]), None);
    assert_eq!(Extent::robust(&[DVec3::X]).unwrap().size(), DVec3::ZERO);
}

#[test]
fn points_that_are_not_finite_never_enter_a_cloud() {
    let cloud = Cloud::new(vec![
        DVec3::X,
        DVec3::new(f64::NAN, 0.0, 0.0),
        DVec3::new(0.0, f64::INFINITY, 0.0),
    ]);
    assert_eq!(cloud.len(), 1);
    assert!(cloud.with_labels(vec![1, 2]).is_err());
}
