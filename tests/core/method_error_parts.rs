//! The parts of an error: never negative, together the error, and what Eq. 16 and the grid make of them.

use std::f64::consts::{FRAC_PI_2, PI};

use axiscope::geometry::{Cloud, Unit, angle_between_lines_rad};
use axiscope::method::{
    Analysis, AxisError, CandidateAxes, CenterMethod, ErrorParts, NormalSource, Params, Preset, analyze,
    lean_rad, symmetry_axis,
};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use proptest::sample::select;

use crate::helpers::bodies::{rotation, view};

/// The analysis of a body's view, turned about the viewpoint.
fn analysis(seed: u64, points: usize, turn: DQuat, change: impl Fn(&mut Params)) -> Analysis {
    let v = view(seed, points);
    let normals = v.normals.iter().map(|&n| (turn * n).as_vec3()).collect();
    let cloud = Cloud::new(v.points.iter().map(|&p| turn * p).collect());
    let mut params = Params {
        normals: NormalSource::File,
        center: CenterMethod::Given(turn * v.center),
        ..Params::new(Preset::AsIntended, Unit::Centimeter)
    };
    change(&mut params);
    analyze(&cloud.with_normals(normals).unwrap(), &params, &()).unwrap()
}

fn direction() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0, 0.0..2.0 * PI).prop_map(|(z, turn): (f64, f64)| {
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * turn.cos(), r * turn.sin(), z)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn parts_are_never_negative_and_add_up_to_the_error(
        seed in 0u64..1000, truth in direction(), u in 5usize..9, fraction in 0.0..0.6f64,
    ) {
        let analysis = analysis(seed, 120, DQuat::IDENTITY, |params| {
            (params.u, params.min_partner_fraction) = (u, fraction);
        });
        let parts = ErrorParts::new(&CandidateAxes::new(&analysis), truth).unwrap();
        let error = angle_between_lines_rad(analysis.axis.as_ref().unwrap().direction, truth);
        let choice = parts.choice_rad().unwrap();
        prop_assert_eq!(parts.error_rad, Some(error));
        prop_assert!(parts.lean_rad >= 0.0 && parts.grid_rad() >= 0.0 && choice >= 0.0, "{parts:?}");
        prop_assert!((parts.lean_rad + parts.grid_rad() + choice - error).abs() < 1e-12, "{parts:?}");

        let errors = (0..u * u).filter_map(|i| analysis.axis_of(i).ok());
        let errors: Vec<f64> = errors.map(|a| angle_between_lines_rad(a.direction, truth)).collect();
        let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
        let nearest = parts.nearest;
        prop_assert!(nearest.error_rad - least < 1e-8, "{nearest:?} against {least}");
        let place = analysis.ranking.order().iter().position(|&i| i == nearest.index);
        prop_assert_eq!(nearest.rank, place.map(|place| place + 1));
        prop_assert_eq!(nearest.candidate, analysis.planes.grid.candidate(nearest.index));
    }

    #[test]
    fn no_plane_s_axis_is_nearer_than_the_lean(
        truth in direction(), normal in direction(), center in direction(), far in 1.0..100.0f64,
    ) {
        let (center, viewpoint) = (far * center, DVec3::new(0.5, -0.2, 0.1));
        let lean = lean_rad(truth, center, viewpoint).unwrap();
        if let Ok(axis) = symmetry_axis(normal, center, viewpoint) {
            prop_assert!(angle_between_lines_rad(axis, truth) >= lean - 1e-12);
        }
        // The plane that holds truth and view ray reaches it.
        let normal = truth.cross(center - viewpoint).normalize();
        let axis = symmetry_axis(normal, center, viewpoint).unwrap();
        prop_assert!((angle_between_lines_rad(axis, truth) - lean).abs() < 1e-12);
    }

    #[test]
    fn a_fruit_across_the_view_ray_has_no_lean_and_one_along_it_nothing_else(
        truth in direction(), center in direction(), turn in 0u64..1000,
    ) {
        let upright = truth.cross(center).normalize();
        prop_assert!(lean_rad(upright, center, DVec3::ZERO).unwrap() < 1e-12);
        prop_assert!((lean_rad(center, center, DVec3::ZERO).unwrap() - FRAC_PI_2).abs() < 1e-12);
        // A turn of the scene about the viewpoint changes nothing.
        let (turn, viewpoint) = (rotation(turn), DVec3::new(1.0, 2.0, 3.0));
        let before = lean_rad(truth, viewpoint + center, viewpoint).unwrap();
        let after = lean_rad(turn * truth, viewpoint + turn * center, viewpoint).unwrap();
        prop_assert!((before - after).abs() < 1e-12);
    }

    /// Half a turn about a coordinate axis brings the grid onto itself.
    #[test]
    fn half_a_turn_about_the_viewpoint_changes_no_part(
        seed in 0u64..1000, truth in direction(), about in select(vec![DVec3::X, DVec3::Y, DVec3::Z]),
    ) {
        let turn = DQuat::from_axis_angle(about, PI);
        let before = analysis(seed, 120, DQuat::IDENTITY, |_| {});
        let after = analysis(seed, 120, turn, |_| {});
        let before = ErrorParts::new(&CandidateAxes::new(&before), truth).unwrap();
        let after = ErrorParts::new(&CandidateAxes::new(&after), turn * truth).unwrap();
        prop_assert!((before.lean_rad - after.lean_rad).abs() < 1e-9);
        prop_assert!((before.grid_rad() - after.grid_rad()).abs() < 1e-8);
        prop_assert!((before.choice_rad().unwrap() - after.choice_rad().unwrap()).abs() < 1e-8);
        prop_assert_eq!(before.nearest.rank, after.nearest.rank);
    }
}

#[test]
fn the_grid_s_part_vanishes_as_the_grid_becomes_fine() {
    for seed in 0..8 {
        let truth = rotation(seed) * DVec3::Y;
        for u in [5, 12, 60] {
            let analysis = analysis(seed, 60, DQuat::IDENTITY, |params| params.u = u);
            let grid = ErrorParts::new(&CandidateAxes::new(&analysis), truth)
                .unwrap()
                .grid_rad();
            assert!(grid <= 0.6 * PI / u as f64, "u = {u}: {}°", grid.to_degrees());
        }
    }
}

#[test]
fn without_a_symmetry_plane_the_chosen_plane_s_part_alone_is_missing() {
    let truth = DVec3::new(0.3, 0.9, 0.2).normalize();
    let all = analysis(3, 120, DQuat::IDENTITY, |_| {});
    let all = ErrorParts::new(&CandidateAxes::new(&all), truth).unwrap();
    let none = analysis(3, 120, DQuat::IDENTITY, |params| {
        params.min_partner_fraction = 1.0
    });
    assert_eq!(none.axis, None, "no plane has a partner for every point");
    let none = ErrorParts::new(&CandidateAxes::new(&none), truth).unwrap();
    assert_eq!(
        (none.error_rad, none.choice_rad(), none.nearest.rank),
        (None, None, None)
    );
    assert!((none.lean_rad, none.grid_rad()) == (all.lean_rad, all.grid_rad()) && all.nearest.rank.is_some());
}

#[test]
fn candidates_with_one_axis_count_as_the_best_ranked_of_them() {
    // Before the middle of the camera α changes nothing in Eq. 16.
    let v = view(5, 120);
    let centered = v
        .points
        .iter()
        .map(|p| p - DVec3::new(v.center.x, v.center.y, 0.0));
    let cloud = Cloud::new(centered.collect());
    let cloud = cloud
        .with_normals(v.normals.iter().map(|n| n.as_vec3()).collect())
        .unwrap();
    let params = Params {
        normals: NormalSource::File,
        center: CenterMethod::Given(DVec3::new(0.0, 0.0, v.center.z)),
        ..Params::new(Preset::AsIntended, Unit::Centimeter)
    };
    let analysis = analyze(&cloud, &params, &()).unwrap();
    let best = analysis.best.unwrap();
    for h in 1..=6 {
        let index = analysis.planes.grid.index_of(3, h).unwrap();
        let truth = analysis.axis_of(index).unwrap().direction;
        let nearest = ErrorParts::new(&CandidateAxes::new(&analysis), truth)
            .unwrap()
            .nearest;
        let of_row = |&&i: &&usize| analysis.planes.grid.candidate(i).h == h;
        let first = analysis.ranking.order().iter().find(of_row);
        assert_eq!(Some(&nearest.index), first);
        assert_eq!(nearest.rank == Some(1), h == best.candidate.h);
    }
}

#[test]
fn a_viewpoint_in_the_center_is_an_error() {
    let center = DVec3::new(1.0, 2.0, 3.0);
    assert_eq!(
        lean_rad(DVec3::Y, center, center),
        Err(AxisError::ViewpointAtCenter)
    );
}
