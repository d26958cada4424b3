//! Fruits of other kinds are what their settings and truths say.

use axiscope::geometry::Cloud;
use axiscope::simulate::{FruitKind, FruitSettings, Settings, SimulateError, Simulated, Surroundings, Truth};
use glam::DVec3;

use super::{exact, labelled, refused};

fn fruit(kind: FruitKind, seed: u64) -> FruitSettings {
    FruitSettings {
        seed,
        ..FruitSettings::new(kind)
    }
}

/// A fruit without noise.
fn clean(kind: FruitKind, seed: u64) -> FruitSettings {
    FruitSettings {
        surroundings: Surroundings {
            camera: exact(),
            ..Surroundings::default()
        },
        ..fruit(kind, seed)
    }
}

fn simulate(settings: &FruitSettings) -> Simulated {
    settings.simulate().expect("a fruit in view")
}

fn settings_of(truth: &Truth) -> &FruitSettings {
    match &truth.settings {
        Settings::Fruit(settings) => settings,
        _ => panic!("not a fruit"),
    }
}

/// Height over the center and distance from the axis of each of the fruit's points.
fn along_and_out(simulated: &Simulated) -> Vec<(f64, f64)> {
    let axis = simulated.truth.axis;
    let points = labelled(simulated, Cloud::FRUIT);
    let of = |p: DVec3| {
        let q = p - axis.origin;
        (
            q.dot(axis.direction),
            q.reject_from_normalized(axis.direction).length(),
        )
    };
    points.into_iter().map(of).collect()
}

#[test]
fn the_truth_makes_the_fruit_again_and_all_kinds_differ() {
    let mut lengths = Vec::new();
    for kind in FruitKind::ALL {
        let mut leafy = fruit(kind, 31);
        leafy.surroundings.leaf_cover = 0.2;
        let simulated = simulate(&leafy);
        let json = serde_json::to_string(&simulated.truth).expect("json");
        let back: Truth = serde_json::from_str(&json).expect("the same truth");
        assert_eq!(back, simulated.truth);
        assert!(simulate(settings_of(&back)) == simulated, "{kind:?}");
        let value: serde_json::Value = serde_json::from_str(&json).expect("json");
        assert_eq!(value["kind"], "fruit");
        assert_eq!(value["settings"]["kind"], kind.name());
        lengths.push(settings_of(&back).length_cm.expect("drawn").to_bits());
        // Another seed, another fruit.
        assert!(simulate(&fruit(kind, 32)).cloud != simulate(&fruit(kind, 33)).cloud);
    }
    lengths.sort_unstable();
    lengths.dedup();
    assert_eq!(lengths.len(), FruitKind::ALL.len());
}

#[test]
fn fruits_are_as_large_as_they_say_and_end_where_they_say() {
    for kind in FruitKind::ALL {
        for seed in 0..6 {
            let simulated = simulate(&clean(kind, seed));
            let s = settings_of(&simulated.truth);
            let (length, width) = (s.length_cm.expect("drawn"), s.width_cm.expect("drawn"));
            // The departures from symmetry reach out a little.
            let room = 1.0 + 4.0 * s.asymmetry.expect("drawn");
            let points = along_and_out(&simulated);
            let highest = points.iter().map(|p| p.0.abs()).fold(0.0, f64::max);
            let widest = points.iter().map(|p| p.1).fold(0.0, f64::max);
            assert!(
                highest <= length / 2.0 * room,
                "{kind:?} {seed}: {highest} of {length}"
            );
            assert!(
                widest <= width / 2.0 * room,
                "{kind:?} {seed}: {widest} of {width}"
            );
            assert!(
                highest > 0.4 * length && widest > 0.4 * width,
                "{kind:?} {seed}: {highest} {widest}"
            );
            let ends = simulated.truth.stem_end.distance(simulated.truth.blossom_end);
            assert!((ends - length).abs() < 1e-9);
        }
    }
}

#[test]
fn a_ball_is_a_sphere_without_a_peduncle() {
    for seed in 0..4 {
        let simulated = simulate(&clean(FruitKind::Ball, seed));
        let truth = &simulated.truth;
        let radius = settings_of(truth).length_cm.expect("drawn") / 2.0;
        for p in labelled(&simulated, Cloud::FRUIT) {
            let off = p.distance(truth.center) - radius;
            assert!(off.abs() < 2e-3, "{off} cm off the sphere");
        }
        assert!(labelled(&simulated, Cloud::PEDUNCLE).is_empty());
        assert_eq!(truth.revolution_axis, None);
        assert!(truth.note.as_deref().is_some_and(|note| note.contains("ball")));
    }
}

#[test]
fn a_pear_is_wide_at_the_blossom_end_and_has_a_stalk_at_the_other() {
    let simulated = simulate(&clean(FruitKind::Pear, 5));
    let length = settings_of(&simulated.truth).length_cm.expect("drawn");
    let points = along_and_out(&simulated);
    let widest_near = |share: f64| {
        let near = points
            .iter()
            .filter(|p| (p.0 - share * length).abs() < 0.03 * length);
        near.map(|p| p.1).fold(0.0, f64::max)
    };
    assert!(widest_near(-0.2) > 1.5 * widest_near(0.3));
    let axis = simulated.truth.axis;
    let stalk = labelled(&simulated, Cloud::PEDUNCLE);
    assert!(stalk.len() > 5);
    assert!(
        stalk
            .iter()
            .all(|p| (*p - axis.origin).dot(axis.direction) > 0.3 * length)
    );
}

/// The chord of an arc is shorter than the arc, and the surface keeps its distance from the arc.
#[test]
fn a_bent_cucumber_keeps_its_thickness_and_its_axis_runs_from_end_to_end() {
    let straight = FruitSettings {
        asymmetry: Some(0.0),
        rib_depth: Some(0.0),
        taper: Some(0.0),
        ..clean(FruitKind::Cucumber, 8)
    };
    let bent = FruitSettings {
        bend_deg: 40.0,
        ..straight.clone()
    };
    let (straight, bent) = (simulate(&straight), simulate(&bent));
    assert_eq!(
        straight.truth.revolution_axis,
        Some(straight.truth.axis.direction)
    );
    assert_eq!(bent.truth.revolution_axis, None);
    assert_eq!(bent.truth.axis.direction, straight.truth.axis.direction);
    let s = settings_of(&bent.truth);
    let (length, width) = (s.length_cm.expect("drawn"), s.width_cm.expect("drawn"));
    let half_rad = 20_f64.to_radians();
    let radius = length / (2.0 * half_rad);
    let ends = bent.truth.stem_end.distance(bent.truth.blossom_end);
    assert!((ends - 2.0 * radius * half_rad.sin()).abs() < 1e-9);
    // The middle of the arc, in the fruit's frame: on the x axis, so that the arc's mean is at the origin.
    let fruit_from_camera = bent.truth.pose.camera_from_fruit().transpose();
    let middle = DVec3::X * (radius * half_rad.sin() / half_rad);
    let mut farthest: f64 = 0.0;
    for p in labelled(&bent, Cloud::FRUIT) {
        let q = fruit_from_camera * (p - bent.truth.center) - middle;
        let from_arc = (q.truncate().length() - radius).hypot(q.z);
        farthest = farthest.max(from_arc);
    }
    assert!((farthest - width / 2.0).abs() < 0.01, "{farthest} of {width}");
}

#[test]
fn fruits_that_make_no_sense_are_refused() {
    type Change = fn(&mut FruitSettings);
    let changes: [(&str, Change); 11] = [
        ("length_cm", |s| s.length_cm = Some(0.0)),
        ("width_cm", |s| s.width_cm = Some(f64::NAN)),
        ("taper", |s| s.taper = Some(-0.9)),
        ("neck", |s| s.neck = Some(0.9)),
        ("dent_cm", |s| s.dent_cm = Some(30.0)),
        ("ribs", |s| s.ribs = Some(13)),
        ("rib_depth", |s| s.rib_depth = Some(0.5)),
        ("bend_deg", |s| s.bend_deg = 61.0),
        ("width_cm", |s| (s.bend_deg, s.width_cm) = (60.0, Some(50.0))),
        ("asymmetry", |s| s.asymmetry = Some(f64::INFINITY)),
        ("leaf_cover", |s| s.surroundings.leaf_cover = 0.95),
    ];
    for (name, change) in changes {
        let mut settings = FruitSettings::new(FruitKind::Eggplant);
        change(&mut settings);
        assert_eq!(refused(settings.simulate()), name);
    }
    let mut away = FruitSettings::new(FruitKind::Apple);
    away.surroundings.center_cm = Some(DVec3::new(100.0, 0.0, 40.0));
    assert_eq!(away.simulate().err(), Some(SimulateError::NothingVisible));
}
