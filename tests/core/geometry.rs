//! Neighbors, normals, filters and angles against what they must be by definition.

use std::num::NonZeroUsize;

use crate::helpers::bodies::{rotation, scattered, view};
use axiscope::geometry::{
    Cloud, Extent, Spread, angle_between_directions_rad, angle_between_lines_rad, estimate_normals,
    statistical_inliers, voxel_grid,
};
use axiscope::neighbors::Neighbors;
use glam::{DVec3, Vec3};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
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

/// Clouds that trees stumble over, moved far from the origin or not.
fn awkward(kind: usize, seed: u64, count: usize, offset: f64) -> Vec<DVec3> {
    let even = scattered(seed, count);
    let shape = |p: DVec3| match kind {
        // A few strays far away from a cloud that is small beside that; small clumps far apart.
        8 if p.x > 0.9 => p * 1e6,
        // Strays whose squares leave single precision's range.
        15 if p.x > 0.95 => p * 1e20,
        0 | 8 | 15 => p,
        1 => (p * 3.0).round() / 3.0,
        2 => DVec3::new(p.x, p.x, -p.x),
        3 => DVec3::new(p.x, p.y, 0.0),
        4 => DVec3::new(1.0, p.y, 0.5 * p.x + p.y),
        5 => p.round() + 1e-6 * p,
        6 => p.normalize(),
        9 => p.signum() + 1e-4 * p,
        10 => p.signum() + 1e-8 * p,
        11 => (p * 3.0).round() + 1e-7 * p,
        // A tiny clump with strays all around.
        12 if p.x > 0.8 => p,
        12 => 1e-5 * p,
        // Clumps of many sizes; shells in shells.
        13 => (p * 1.5).round() + 1e-7 * p,
        14 => p * 10f64.powi((8.0 * p.x) as i32),
        // All points' squares leave single precision's range.
        16 => p * 1e30,
        _ => {
            if p.x < 0.5 {
                DVec3::splat(0.25)
            } else {
                p
            }
        }
    };
    even.iter().map(|&p| shape(p) + offset).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn the_nearest_is_exactly_the_nearest_on_awkward_clouds(
        kind in 0usize..17, seed in 0u64..1000, count in 1usize..1200,
        offset in prop::sample::select(vec![0.0, 1e6]), reach in prop::sample::select(vec![0.1, 1.0, 3.0, 1e4, 1e12]),
    ) {
        let points = awkward(kind, seed, count, offset);
        let index = Neighbors::new(&points).unwrap();
        let mut queries: Vec<DVec3> = scattered(seed + 1, 40).iter().map(|&p| p * reach + offset).collect();
        // Where the points are, and mirrored as the method does, in an order in which they are close.
        queries.extend(index.order().iter().take(100).map(|&i| points[i as usize]));
        queries.extend(index.order().iter().take(100).map(|&i| (points[i as usize] - offset) * DVec3::new(1.0, -1.0, 1.0) + offset));
        let together = index.nearest_of_each(&queries);
        prop_assert_eq!(together.len(), queries.len());
        for (&query, &found) in queries.iter().zip(&together) {
            let (mut best, mut lowest) = (f64::INFINITY, 0);
            for (i, p) in points.iter().enumerate() {
                let d = p.distance_squared(query);
                if d < best {
                    (best, lowest) = (d, i);
                }
            }
            prop_assert_eq!(found.distance_squared, best);
            prop_assert_eq!(found.index, lowest, "the lowest index of those as near");
            prop_assert_eq!(found.multiplicity, points.iter().filter(|p| **p == points[lowest]).count());
            prop_assert_eq!(index.nearest(query), found);
        }
        let mut order = index.order().to_vec();
        order.sort_unstable();
        prop_assert!(order.iter().enumerate().all(|(i, &o)| i == o as usize), "each point once");
    }

    #[test]
    fn the_nearest_places_are_exactly_those_on_awkward_clouds(
        kind in 0usize..17, seed in 0u64..1000, count in 1usize..600, wanted in 1usize..50,
        offset in prop::sample::select(vec![0.0, 1e6]), reach in prop::sample::select(vec![1.0, 1e4]),
    ) {
        let points = awkward(kind, seed, count, offset);
        let index = Neighbors::new(&points).unwrap();
        let queries = scattered(seed + 1, 10).into_iter().map(|p| p * reach + offset);
        for query in queries.chain(points.iter().copied().take(10)) {
            let mut expected: Vec<(f64, usize)> = Vec::new();
            for (i, p) in points.iter().enumerate() {
                if points.iter().position(|q| q == p) == Some(i) {
                    expected.push((p.distance_squared(query), i));
                }
            }
            expected.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let found = index.nearest_places(query, k(wanted));
            prop_assert!(found.iter().zip(&expected).all(|(f, e)| (f.distance_squared, f.index) == *e));
            let held = |n: usize| found[..n].iter().map(|f| f.multiplicity).sum::<usize>();
            prop_assert!(held(found.len() - 1) < wanted, "no more places than it takes");
            prop_assert!(held(found.len()) >= wanted || found.len() == expected.len());
        }
    }

    #[test]
    fn spreads_are_those_of_another_solver(kind in 0usize..8, seed in 0u64..1000, count in 1usize..60) {
        let points = awkward(kind, seed, count, 0.0);
        let spread = Spread::of_points(&points).unwrap();
        let mut covariance = nalgebra::Matrix3::zeros();
        for p in &points {
            let q = *p - spread.mean;
            let v = nalgebra::Vector3::new(q.x, q.y, q.z);
            covariance += v * v.transpose() / count as f64;
        }
        let mut values: Vec<f64> = covariance.symmetric_eigen().eigenvalues.iter().copied().collect();
        values.sort_by(f64::total_cmp);
        for ((&variance, axis), value) in spread.variances.iter().zip(spread.axes).zip(values) {
            prop_assert!((variance - value.max(0.0)).abs() < 1e-14);
            let a = nalgebra::Vector3::new(axis.x, axis.y, axis.z);
            prop_assert!((covariance * a - a * variance).norm() < 1e-14, "an eigenvector");
            prop_assert!((axis.length() - 1.0).abs() < 1e-14);
        }
        let [a, b, c] = spread.axes;
        prop_assert!(a.dot(b).abs() + a.dot(c).abs() + b.dot(c).abs() < 1e-14, "at right angles");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn points_mirrored_together_find_exactly_the_nearest(
        kind in 0usize..17, seed in 0u64..1000, count in 500usize..1500, offset in prop::sample::select(vec![0.0, 1e4]),
        away in prop::sample::select(vec![0.0, 0.5, 5.0]),
    ) {
        let points = awkward(kind, seed, count, offset);
        let index = Neighbors::new(&points).unwrap();
        let random = scattered(seed + 1, 2);
        let (normal, through) = (random[0].normalize(), random[1] * away + offset);
        let queries: Vec<DVec3> = (index.order().iter())
            .map(|&i| points[i as usize])
            .map(|p| p - 2.0 * (p - through).dot(normal) * normal)
            .collect();
        for (query, found) in queries.iter().zip(index.nearest_of_each(&queries)) {
            let nearest = points.iter().map(|p| p.distance_squared(*query)).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(found.distance_squared, nearest);
            prop_assert_eq!(points[found.index].distance_squared(*query), nearest);
        }
    }

    #[test]
    fn kiddo_finds_the_same_neighbors(
        kind in 0usize..15, seed in 0u64..1000, count in 100usize..1500, wanted in 1usize..50,
        offset in prop::sample::select(vec![0.0, 1e4]),
    ) {
        let points = awkward(kind, seed, count, offset);
        let index = Neighbors::new(&points).unwrap();
        let mut places = points.clone();
        places.sort_by(|a, b| a.to_array().partial_cmp(&b.to_array()).unwrap());
        places.dedup();
        let places: Vec<[f64; 3]> = places.iter().map(DVec3::to_array).collect();
        let kiddo = ImmutableKdTree::new_from_slice(&places).unwrap();
        let mirrored = index.order().iter().map(|&i| points[i as usize] * DVec3::new(1.0, -1.0, 1.0));
        let queries: Vec<DVec3> = mirrored.chain(scattered(seed + 1, 20)).collect();
        let close = |ours: f64, theirs: f64| (ours - theirs).abs() <= 1e-12 * theirs;
        for (query, found) in queries.iter().zip(index.nearest_of_each(&queries)) {
            let nearest = kiddo.query(&query.to_array()).nearest_one::<SquaredEuclidean<f64>>().execute();
            prop_assert!(close(found.distance_squared, nearest.distance));
        }
        for query in queries.iter().step_by(queries.len() / 20) {
            let ours = index.nearest_places(*query, k(wanted));
            let theirs = kiddo.query(&query.to_array()).nearest_n::<SquaredEuclidean<f64>>(k(ours.len())).execute();
            prop_assert_eq!(ours.len(), theirs.len());
            prop_assert!(ours.iter().zip(&theirs).all(|(a, b)| close(a.distance_squared, b.distance)));
        }
    }

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
    fn normals_on_awkward_clouds_are_those_of_the_nearest(
        kind in prop::sample::select(vec![0, 5, 6, 9, 12, 13]), seed in 0u64..1000, count in 30usize..600,
    ) {
        let points = awkward(kind, seed, count, 0.0);
        let normals = estimate_normals(&points, k(8), DVec3::ZERO, &()).unwrap();
        for (&point, normal) in points.iter().zip(normals).step_by(7) {
            let mut near = points.clone();
            near.sort_by(|a, b| a.distance_squared(point).total_cmp(&b.distance_squared(point)));
            let spread = Spread::of_points(&near[..8]).unwrap();
            prop_assert_eq!(normal.is_none(), spread.is_line());
            // Where two directions are alike, the normal could be either.
            if !spread.is_line() && spread.variances[1] > 1.01 * spread.variances[0] {
                let cos = normal.unwrap().dot(spread.axes[0]).abs();
                prop_assert!(cos > 1.0 - 1e-9, "{} at {}", cos, point);
            }
        }
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
fn the_outlier_filter_takes_the_sample_s_standard_deviation() {
    // Distances to the nearest other point of 1, 1, 1, 1 and 3: their mean is 1.4, and their standard deviation
    // is 0.894 with n − 1, 0.8 with n.
    let points = [0.0, 1.0, 2.0, 3.0, 6.0].map(|x| DVec3::new(x, 0.0, 0.0));
    let kept = |ratio| statistical_inliers(&points, k(1), ratio, &()).unwrap().len();
    assert_eq!(
        kept(1.9),
        5,
        "3 is less than 1.4 + 1.9 · 0.894, and more than 1.4 + 1.9 · 0.8"
    );
    assert_eq!(kept(1.7), 4);
    assert_eq!(statistical_inliers(&points[..1], k(1), 1.0, &()).unwrap(), [0]);
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

#[test]
fn queries_with_most_points_in_reach_find_the_nearest() {
    // From about the center of a sphere everything is about as far; from all around, everything may be near.
    // From far around a tiny one both is so.
    for (radius, spread) in [(1.0, 0.01), (1.0, 1.0), (1.0, 3.0), (1e-6, 1.0), (1e-9, 1.0)] {
        let mut points: Vec<DVec3> = scattered(1, 6000)
            .iter()
            .map(|p| radius * p.normalize())
            .collect();
        points.push(DVec3::splat(3.0));
        let index = Neighbors::new(&points).unwrap();
        let queries: Vec<DVec3> = scattered(2, 64).iter().map(|q| q * spread).collect();
        for (query, found) in queries.iter().zip(index.nearest_of_each(&queries)) {
            let nearest = points
                .iter()
                .map(|p| p.distance_squared(*query))
                .fold(f64::INFINITY, f64::min);
            assert_eq!(found.distance_squared, nearest);
        }
    }
}
