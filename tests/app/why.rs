//! Why a point scores as it does: against the method's own numbers, and against geometry by hand.

use axiscope::app::inspector::why::{Unexplained, why, why_lines};
use axiscope::app::{Command, PlaneChoice, Sample};
use axiscope::geometry::Plane;
use axiscope::method::{CenterMethod, Side, plane_detail};
use axiscope::view::Theme;
use glam::DVec3;

use crate::helpers::driving::{act, app};

#[test]
fn every_number_is_the_method_s() {
    let mut app = app();
    act(&mut app, Command::OpenSample(Sample::Pepper));
    act(&mut app, Command::LookAt(PlaneChoice::At { g: 3, h: 5 }));
    let state = app.state();
    let analysis = state.analysis().expect("analyzed").clone();
    let plane = Plane {
        point: analysis.center,
        normal: analysis
            .planes
            .grid
            .candidate(state.plane_index().expect("a plane"))
            .normal,
    };
    let (params, surface) = (&analysis.params, &analysis.surface);
    let detail = plane_detail(surface, params.unit, plane, params.viewpoint, &()).expect("nobody cancels");
    let mut scores: Vec<f64> = detail
        .points
        .iter()
        .filter_map(|p| Some(p.partner?.score_cm(params.tau_cm_per_rad)))
        .collect();
    scores.sort_unstable_by(f64::total_cmp);
    let (mut with, mut without) = (0, 0);
    for shown in (0..state.shown().expect("points").len()).step_by(37) {
        let why = why(state, shown).expect("there is such a point");
        assert_eq!(why.unit, Some(params.unit));
        let Ok(steps) = why.steps else {
            assert_eq!(state.shown().expect("points").in_surface.get(shown), None);
            continue;
        };
        let expected = detail.points[steps.surface_index];
        assert_eq!(why.position, surface.points()[steps.surface_index]);
        assert_eq!(steps.side, expected.side);
        assert_eq!(steps.visibility_cm > 0.0, expected.partner.is_some());
        assert_eq!(steps.partner.is_some(), expected.partner.is_some());
        let Some(partner) = steps.partner else {
            without += 1;
            continue;
        };
        with += 1;
        let expected = expected.partner.expect("seen above");
        assert_eq!(partner.surface_index, expected.index);
        let distance_cm = steps.reflection.distance(partner.position) * params.unit.in_cm();
        assert!((partner.distance_cm - distance_cm).abs() < 1e-9);
        assert!((partner.distance_cm - expected.distance_cm).abs() < 1e-12);
        let angle = steps.reflected_normal.dot(partner.normal).clamp(-1.0, 1.0).acos();
        assert!((partner.angle_rad - angle).abs() < 1e-6);
        let score = distance_cm + params.tau_cm_per_rad * angle;
        assert!((partner.score_cm - score).abs() < 1e-6);
        assert!((partner.distance_cm + partner.weighted_angle_cm - partner.score_cm).abs() < 1e-12);
        let below = scores.partition_point(|&s| s < partner.score_cm) as f64 / scores.len() as f64;
        let share = why.share_below.expect("there is a histogram");
        // To the width of a bin; the fullest of them holds some percent.
        assert!((share - below).abs() < 0.03, "{share} {below}");
    }
    assert!(with > 50 && without > 5, "{with} {without}");
    assert_eq!(why(state, usize::MAX), None);
}

/// Corners of a roof that is symmetric about x = 0, in centimeters, seen from the origin.
const ROOF: &str = "ply\nformat ascii 1.0\ncomment unit cm\nelement vertex 6\n\
    property float x\nproperty float y\nproperty float z\n\
    property float nx\nproperty float ny\nproperty float nz\nend_header\n\
    -3 0 20 -0.6 0 -0.8\n3 0 20 0.6 0 -0.8\n-1 0 19 0 0 -1\n1 0 19 0 0 -1\n\
    2.5 1 20 1 0 0.5\n0 2 22 0 1 0\n";

#[test]
fn geometry_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("roof.ply");
    std::fs::write(&path, ROOF).expect("written");
    let mut app = app();
    let mut request = app.state().settings.request.clone();
    request.unit = Some(axiscope::geometry::Unit::Centimeter);
    request.params.center = CenterMethod::Given(DVec3::new(0.0, 0.0, 21.0));
    // With u odd there is a candidate along x: α = π/2, β = 0.
    request.params.u = 5;
    request.params.tau_cm_per_rad = 2.0;
    request.params.min_partner_fraction = 0.0;
    act(
        &mut app,
        Command::Set {
            request: Box::new(request),
            gesture: None,
        },
    );
    act(&mut app, Command::Open(vec![path]));
    act(&mut app, Command::LookAt(PlaneChoice::At { g: 3, h: 3 }));
    let state = app.state();
    assert!(
        state.analysis().is_some(),
        "{:?}",
        state.unanalyzed.as_ref().map(|u| &u.1)
    );

    // Mirrored onto its very partner.
    let exact = why(state, 0).expect("a point").steps.expect("used");
    assert!(exact.plane.normal.distance(DVec3::X) < 1e-12);
    assert_eq!(exact.side, Side::Back);
    assert!((exact.plane_distance_cm + 3.0).abs() < 1e-6);
    assert!(exact.reflection.distance(DVec3::new(3.0, 0.0, 20.0)) < 1e-6);
    assert!(exact.reflected_normal.distance(DVec3::new(0.6, 0.0, -0.8)) < 1e-6);
    // ⟨(0.6, 0, −0.8), −(3, 0, 20)⟩ = −1.8 + 16.
    assert!((exact.visibility_cm - 14.2).abs() < 1e-5);
    let partner = exact.partner.expect("visible");
    assert!(partner.distance_cm < 1e-6 && partner.angle_rad < 1e-6 && partner.score_cm < 1e-5);

    // Faces away from where the camera is.
    let away = why(state, 4).expect("a point");
    let steps = away.steps.clone().expect("used");
    // ⟨(−1, 0, 0.5)/√1.25, −(−2.5, 1, 20)⟩ = (−2.5 − 10)/√1.25.
    assert!(
        (steps.visibility_cm + 12.5 / 1.25_f64.sqrt()).abs() < 1e-5,
        "{steps:?}"
    );
    assert_eq!(steps.partner, None);

    // In the plane, its own mirror image.
    let on = why(state, 5).expect("a point").steps.expect("used");
    assert_eq!(on.side, Side::Front);
    assert!(on.plane_distance_cm.abs() < 1e-9);

    let lines = why_lines(&why(state, 0).expect("a point"), 10.0, Theme::Dark);
    let has = |from: DVec3, to: DVec3| {
        lines
            .iter()
            .any(|l| l.from_in_world.distance(from) < 1e-6 && l.to_in_world.distance(to) < 1e-6)
    };
    let (point, foot, mirrored) = (
        DVec3::new(-3.0, 0.0, 20.0),
        DVec3::new(0.0, 0.0, 20.0),
        DVec3::new(3.0, 0.0, 20.0),
    );
    assert!(
        has(point, foot) && has(foot, mirrored),
        "through its foot on the plane"
    );
    assert!(
        has(point, point) && has(foot, foot) && has(mirrored, mirrored),
        "discs"
    );
    let lines = why_lines(&away, 10.0, Theme::Light);
    assert!(
        lines
            .iter()
            .all(|l| l.from_in_world.is_finite() && l.to_in_world.is_finite())
    );
}

#[test]
fn points_that_were_left_out_say_so() {
    let mut app = app();
    let mut request = app.state().settings.request.clone();
    request.without_peduncle = true;
    act(
        &mut app,
        Command::Set {
            request: Box::new(request),
            gesture: None,
        },
    );
    act(&mut app, Command::OpenSample(Sample::Pepper));
    let state = app.state();
    let shown = state.shown().expect("points");
    let out = shown
        .in_surface
        .iter()
        .position(|place| place.is_none())
        .expect("the peduncle's");
    let left_out = why(state, out).expect("a point");
    assert_eq!(left_out.steps, Err(Unexplained::LeftOut));
    let lines = why_lines(&left_out, 10.0, Theme::Dark);
    assert_eq!(lines.len(), 1, "where it is, and no more");
}
