//! The number of leaves that searches look into: clouds with far strays take little more than even ones.

use std::cell::Cell;

use glam::DVec3;

use super::Neighbors;

thread_local!(static LEAVES: Cell<usize> = const { Cell::new(0) });

/// Counts a leaf that is looked into for some queries.
pub(super) fn count(queries: usize) {
    LEAVES.set(LEAVES.get() + queries);
}

/// The leaves that are looked into, once for each query, for a cloud mirrored in a plane through `center`.
fn leaves_for(points: &[DVec3], center: DVec3) -> usize {
    let index = Neighbors::new(points).expect("there are points");
    let in_order = index.order().iter().map(|&i| points[i as usize]);
    let mirrored: Vec<DVec3> = in_order
        .map(|p| DVec3::new(2.0 * center.x - p.x, p.y, p.z))
        .collect();
    LEAVES.set(0);
    index.nearest_of_each(&mirrored);
    LEAVES.get()
}

/// Points of an ellipsoid, evenly along a spiral.
fn even(count: usize) -> Vec<DVec3> {
    let point = |i: usize| {
        let (z, turn) = ((i as f64 + 0.5) / count as f64, 2.399_963 * i as f64);
        let r = (1.0 - z * z).sqrt();
        DVec3::new(2.5 * r * turn.cos(), 2.5 * r * turn.sin(), 2.0 * z)
    };
    (0..count).map(point).collect()
}

#[test]
fn far_strays_make_no_search_quadratic() {
    for count in [5_000, 20_000] {
        let usual = leaves_for(&even(count), DVec3::new(0.1, 0.0, 0.0));
        for far in [1e13, 1e15, 1e17, 1e20] {
            let mut points = even(count);
            points[7] = DVec3::new(far, far, far);
            points[count / 2] = DVec3::new(far, -far, far);
            for center in [0.1, 2e-4 * far, 0.5 * far] {
                let leaves = leaves_for(&points, DVec3::splat(center));
                assert!(
                    leaves < 10 * usual,
                    "{count} points, {far:e}, {center:e}: {leaves} of {usual}"
                );
            }
        }
    }
}
