//! The terms of planes: what must not change when the world is moved, scaled or mirrored.

use crate::helpers::bodies::{moved, rotation, scattered, view};
use axiscope::geometry::{Plane, Unit, angle_between_directions_rad};
use axiscope::method::{
    CandidateGrid, PlaneTerm, Side, Surface, has_visible_partner, plane_detail, plane_terms, terms_of_planes,
};
use glam::DVec3;
use proptest::prelude::*;

fn surface(points: &[DVec3], normals: &[DVec3]) -> Surface {
    Surface::new(points, normals).expect("a surface")
}

fn grid(u: usize) -> CandidateGrid {
    CandidateGrid::new(u).expect("a grid")
}

fn planes(u: usize, center: DVec3) -> Vec<Plane> {
    let plane = |normal| Plane {
        point: center,
        normal,
    };
    grid(u).candidates().map(|c| plane(c.normal)).collect()
}

fn assert_close(a: &[PlaneTerm], b: &[PlaneTerm], distance_factor: f64) {
    assert_eq!(a.len(), b.len());
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        assert_eq!(a.partners, b.partners, "partners of plane {i}");
        let expected = a.distance_sum_cm * distance_factor;
        assert!(
            (b.distance_sum_cm - expected).abs() <= 1e-8 * (1.0 + expected),
            "ΣD of plane {i}: {a:?} {b:?}"
        );
        assert!(
            (b.angle_sum_rad - a.angle_sum_rad).abs() <= 1e-7 * (1.0 + a.angle_sum_rad),
            "ΣΞ of plane {i}: {a:?} {b:?}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_rigid_motion_of_everything_changes_nothing(seed in 0u64..1000, shift in -50.0..50.0f64) {
        let v = view(seed, 250);
        let before = terms_of_planes(&surface(&v.points, &v.normals), Unit::Centimeter, &planes(5, v.center), DVec3::ZERO, &()).unwrap();
        let (r, t) = (rotation(seed), DVec3::new(shift, -0.5 * shift, 7.0));
        let points: Vec<_> = v.points.iter().map(|&p| r * p + t).collect();
        let normals: Vec<_> = v.normals.iter().map(|&n| r * n).collect();
        let moved: Vec<_> = planes(5, v.center).into_iter().map(|p| moved(p, r, t)).collect();
        let after = terms_of_planes(&surface(&points, &normals), Unit::Centimeter, &moved, t, &()).unwrap();
        assert_close(&before, &after, 1.0);
    }

    #[test]
    fn a_scale_multiplies_distances_and_nothing_else(seed in 0u64..1000, scale in 0.01..100.0f64) {
        let v = view(seed, 250);
        let before = plane_terms(&surface(&v.points, &v.normals), Unit::Centimeter, v.center, DVec3::ZERO, grid(5), &()).unwrap();
        let points: Vec<_> = v.points.iter().map(|&p| scale * p).collect();
        let after = plane_terms(&surface(&points, &v.normals), Unit::Centimeter, scale * v.center, DVec3::ZERO, grid(5), &()).unwrap();
        assert_close(&before.terms, &after.terms, scale);
    }

    #[test]
    fn a_cloud_mirrored_in_a_candidate_plane_scores_zero_there(seed in 0u64..1000, index in 0usize..36) {
        // The camera lies in the plane, and normals lean little, so that every partner is visible.
        let center = DVec3::new(0.3, -0.4, 20.0);
        let plane = Plane { point: center, normal: grid(6).candidate(index).normal };
        let viewpoint = center + 20.0 * plane.normal.any_orthonormal_vector();
        let half = scattered(seed, 150);
        let lean = scattered(seed + 1, 150);
        let mut points: Vec<_> = half.iter().map(|&p| center + 3.0 * p).collect();
        let mut normals: Vec<_> = points.iter().zip(&lean)
            .map(|(&p, &l)| ((viewpoint - p).normalize() + 0.5 * l).normalize())
            .collect();
        points.extend(points.clone().iter().map(|&p| plane.reflect_point(p)));
        normals.extend(normals.clone().iter().map(|&n| plane.reflect_direction(n)));
        let terms = plane_terms(&surface(&points, &normals), Unit::Centimeter, center, viewpoint, grid(6), &()).unwrap();
        let there = terms.terms[index];
        prop_assert_eq!(there.partners, 300);
        prop_assert!(there.distance_sum_cm < 1e-10, "ΣD is {}", there.distance_sum_cm);
        prop_assert!(there.angle_sum_rad < 1e-10, "ΣΞ is {}", there.angle_sum_rad);
        // And nowhere else, so that the zero says something.
        let others = terms.terms.iter().enumerate().filter(|&(i, t)| i != index && t.partners > 100);
        prop_assert!(others.clone().all(|(_, t)| t.distance_sum_cm > 0.05 * t.partners as f64));
    }

    #[test]
    fn one_plane_s_detail_adds_up_to_its_terms(seed in 0u64..1000, index in 0usize..25) {
        let v = view(seed, 300);
        let surface = surface(&v.points, &v.normals);
        let plane = planes(5, v.center)[index];
        let term = plane_terms(&surface, Unit::Meter, v.center, DVec3::ZERO, grid(5), &()).unwrap().terms[index];
        let detail = plane_detail(&surface, Unit::Meter, plane, DVec3::ZERO, &()).unwrap();
        let partners: Vec<_> = detail.points.iter().filter_map(|p| p.partner).collect();
        prop_assert_eq!(partners.len(), term.partners);
        let sum = |f: fn(&axiscope::method::Partner) -> f64| partners.iter().map(f).sum::<f64>();
        prop_assert!((sum(|p| p.distance_cm) - term.distance_sum_cm).abs() <= 1e-9 * (1.0 + term.distance_sum_cm));
        prop_assert!((sum(|p| p.angle_rad) - term.angle_sum_rad).abs() <= 1e-9 * (1.0 + term.angle_sum_rad));
        // Each partner really is the nearest point to the reflection.
        for (i, partner) in detail.points.iter().enumerate().filter_map(|(i, p)| p.partner.map(|q| (i, q))) {
            let reflected = plane.reflect_point(v.points[i]);
            let nearest = v.points.iter().map(|q| q.distance(reflected)).fold(f64::INFINITY, f64::min);
            prop_assert!((partner.distance_cm - 100.0 * nearest).abs() < 1e-9);
        }
        // And everything else is what the equations say of the point alone.
        for (i, point) in detail.points.iter().enumerate() {
            let (p, n) = (surface.points()[i], surface.normals()[i]);
            prop_assert_eq!(point.partner.is_some(), has_visible_partner(&plane, p, n, DVec3::ZERO));
            prop_assert_eq!(point.side == Side::Front, plane.signed_distance(p) >= 0.0);
            if let Some(partner) = point.partner {
                let reflected = plane.reflect_direction(n);
                let angle = angle_between_directions_rad(reflected, surface.normals()[partner.index]);
                prop_assert!((partner.angle_rad - angle).abs() < 1e-14, "{} {angle}", partner.angle_rad);
            }
        }
    }
}

#[test]
fn a_point_has_no_partner_where_its_mirror_image_faces_away() {
    // A sphere seen from the side: under the plane that faces the camera every mirror image is on
    // the far side; under a plane through the camera every one is in view.
    let points: Vec<_> = scattered(3, 400).iter().map(|p| p.normalize()).collect();
    let visible: Vec<_> = points
        .iter()
        .copied()
        .filter(|n| n.dot(DVec3::new(0.0, 0.0, -20.0) - *n) > 0.0)
        .collect();
    let center = DVec3::new(0.0, 0.0, 20.0);
    let at: Vec<_> = visible.iter().map(|&n| n + center).collect();
    let surface = surface(&at, &visible);
    let plane = |normal| Plane {
        point: center,
        normal,
    };
    let [across, along] = [DVec3::Z, DVec3::X]
        .map(|n| terms_of_planes(&surface, Unit::Centimeter, &[plane(n)], DVec3::ZERO, &()).unwrap()[0]);
    assert_eq!(across.partners, 0);
    assert_eq!(along.partners, visible.len());
}

#[test]
fn angles_of_partners_keep_their_digits_from_zero_to_pi() {
    // Points in the mirror plane are their own partners, and a normal that leans by half an angle
    // meets its mirror image at the whole.
    let angles = (0..=400).map(|i| f64::from(i) * std::f64::consts::PI / 400.0);
    let angles: Vec<f64> = [1e-12, 1e-7, 1e-3].into_iter().chain(angles).collect();
    let at = |i: usize| DVec3::new(0.0, 0.01 * i as f64, 20.0 + (0.3 * i as f64).sin());
    let points: Vec<_> = (0..angles.len()).map(at).collect();
    let lean = |&a: &f64| DVec3::new((0.5 * a).sin(), 0.0, -(0.5 * a).cos());
    let normals: Vec<_> = angles.iter().map(lean).collect();
    let plane = Plane {
        point: DVec3::ZERO,
        normal: DVec3::X,
    };
    let surface = surface(&points, &normals);
    let detail = plane_detail(&surface, Unit::Centimeter, plane, DVec3::ZERO, &()).unwrap();
    let mut seen = 0;
    for (point, angle) in detail.points.iter().zip(&angles) {
        if let Some(partner) = point.partner {
            let off = (partner.angle_rad - angle).abs();
            assert!(off <= 4e-16 * (1.0 + angle), "{} {angle}", partner.angle_rad);
            seen += 1;
        }
    }
    assert!(seen >= 400, "{seen}");
}
