//! Simulated clouds: what is known about them is true, and the same seed gives the same cloud.

use std::collections::HashSet;

use axiscope::geometry::{Cloud, Unit, angle_between_directions_rad};
use axiscope::simulate::{
    DepthCamera, EllipsoidSettings, FruitColor, PepperSettings, Settings, SimulateError, Simulated, Truth,
    seeds,
};
use glam::{DVec2, DVec3};

fn pepper(seed: u64) -> PepperSettings {
    PepperSettings {
        seed,
        ..PepperSettings::default()
    }
}

/// A camera without errors.
fn exact() -> DepthCamera {
    DepthCamera {
        noise_cm: 0.0,
        step_cm: 0.0,
        grazing_deg: 90.0,
        dropout: 0.0,
        ..DepthCamera::default()
    }
}

/// An upright pepper straight ahead that is its own mirror image, before a camera without errors.
fn perfect(seed: u64) -> PepperSettings {
    PepperSettings {
        asymmetry: 0.0,
        tilt_towards_camera_deg: Some(0.0),
        tilt_sideways_deg: Some(0.0),
        center_cm: Some(DVec3::new(0.0, 0.0, 40.0)),
        camera: exact(),
        ..pepper(seed)
    }
}

fn simulate(settings: &PepperSettings) -> Simulated {
    settings.simulate().expect("a pepper in view")
}

fn labelled(simulated: &Simulated, label: i32) -> Vec<DVec3> {
    let labels = simulated.cloud.labels().expect("labels");
    let rows = labels.iter().zip(simulated.cloud.positions());
    rows.filter(|(l, _)| **l == label).map(|(_, p)| *p).collect()
}

fn settings_of(truth: &Truth) -> &PepperSettings {
    match &truth.settings {
        Settings::Pepper(settings) => settings,
        Settings::Ellipsoid(_) => panic!("not a pepper"),
    }
}

/// Where the camera of these settings sees a point, in pixels.
fn pixel(camera: &DepthCamera, p: DVec3) -> DVec2 {
    let middle = DVec2::new(f64::from(camera.width_px - 1), f64::from(camera.height_px - 1)) / 2.0;
    p.truncate() / p.z * camera.focal_px + middle
}

fn whole(pixel: DVec2) -> (i64, i64) {
    (pixel.x.round() as i64, pixel.y.round() as i64)
}

#[test]
fn the_same_seed_gives_the_same_cloud_to_the_bit() {
    let bits = |s: &Simulated| -> Vec<[u64; 3]> {
        let positions = s.cloud.positions().iter();
        positions.map(|p| p.to_array().map(f64::to_bits)).collect()
    };
    let leafy = PepperSettings {
        leaf_cover: 0.2,
        ..pepper(5)
    };
    for settings in [pepper(5), leafy] {
        let (a, b) = (simulate(&settings), simulate(&settings));
        assert_eq!(bits(&a), bits(&b));
        assert_eq!(a, b);
    }
    let a = EllipsoidSettings::default().simulate().expect("visible");
    let b = EllipsoidSettings::default().simulate().expect("visible");
    assert_eq!(bits(&a), bits(&b));
    assert_eq!(a, b);
}

#[test]
fn different_seeds_give_different_clouds() {
    assert_ne!(simulate(&pepper(1)).cloud, simulate(&pepper(2)).cloud);
    assert_ne!(simulate(&pepper(1)).truth.axis, simulate(&pepper(2)).truth.axis);
    let ellipsoid = |seed| EllipsoidSettings {
        seed,
        ..EllipsoidSettings::default()
    };
    let (a, b) = (ellipsoid(1).simulate(), ellipsoid(2).simulate());
    assert_ne!(a.expect("visible").cloud, b.expect("visible").cloud);
}

#[test]
fn a_data_set_keeps_its_first_clouds_when_it_grows() {
    let many = seeds(42, 500);
    assert_eq!(many[0], 42);
    assert_eq!(many[..10], seeds(42, 10));
    assert!(many.iter().all(|&s| s < 1 << 53), "JSON readers keep 53 bits");
    let mut all: Vec<u64> = (0..20).flat_map(|seed| seeds(seed, 500)).collect();
    all.sort_unstable();
    all.dedup();
    assert_eq!(all.len(), 20 * 500, "no two clouds share a seed");
}

#[test]
fn the_ellipsoid_is_the_papers() {
    let simulated = EllipsoidSettings::default().simulate().expect("visible");
    let (cloud, truth) = (&simulated.cloud, &simulated.truth);
    assert_eq!(cloud.len(), 3000);
    let (half_axes, center) = (DVec3::new(2.5, 2.5, 2.0), DVec3::new(3.0, 5.0, 25.0));
    assert_eq!(truth.center, center);
    let normals = cloud.normals().expect("analytic normals");
    for (p, n) in cloud.positions().iter().zip(normals) {
        let on_sphere = (*p - center) / half_axes;
        assert!((on_sphere.length_squared() - 1.0).abs() < 1e-12, "Eq. 1 at {p}");
        assert!((n.length() - 1.0).abs() < 1e-6);
        let gradient = (on_sphere / half_axes).normalize();
        assert!((gradient - n.as_dvec3()).length() < 1e-6);
        assert!(gradient.dot(-*p) > 0.0, "{p} faces away");
    }
    assert_eq!(truth.axis.direction, DVec3::NEG_Y);
    assert_eq!(truth.revolution_axis, Some(DVec3::Z));
    let note = truth.note.as_deref().expect("a note");
    assert!(
        note.contains("not unique") && note.contains("depth axis"),
        "{note}"
    );
}

#[test]
fn the_ellipsoid_is_seen_wherever_the_series_puts_it() {
    for depth in 25..=70 {
        let settings = EllipsoidSettings {
            center_cm: DVec3::new(3.0, 5.0, depth.into()),
            points: 200,
            ..EllipsoidSettings::default()
        };
        assert_eq!(settings.simulate().expect("visible").cloud.len(), 200);
    }
}

/// On a sphere, zones of equal height have equal area; the visible part is a cap. On any ellipsoid
/// the points then must be as dense in area: checked against areas summed over small patches.
#[test]
fn ellipsoid_points_are_spread_evenly_over_the_area() {
    let center = DVec3::new(0.0, 0.0, 30.0);
    let points = 20_000;
    for half_axes in [DVec3::splat(3.0), DVec3::new(5.0, 1.5, 2.5)] {
        let settings = EllipsoidSettings {
            half_axes_cm: half_axes,
            center_cm: center,
            points,
            ..EllipsoidSettings::default()
        };
        let simulated = settings.simulate().expect("visible");
        // Patches by the direction on the unit sphere: 8 sectors around z by 5 zones.
        let patch = |v: DVec3| {
            let zone = ((v.z + 1.0) * 5.0).floor().clamp(0.0, 4.0) as usize;
            let around = (v.y.atan2(v.x) / std::f64::consts::TAU + 0.5) * 8.0;
            zone * 8 + around.floor().clamp(0.0, 7.0) as usize
        };
        let mut expected = [0.0; 40];
        let (rows, columns) = (1000, 400);
        for i in 0..rows {
            for j in 0..columns {
                let z = -1.0 + 2.0 * (f64::from(i) + 0.5) / f64::from(rows);
                let a = std::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(columns);
                let r = (1.0 - z * z).sqrt();
                let v = DVec3::new(r * a.cos(), r * a.sin(), z);
                let gradient = v / half_axes;
                if gradient.dot(-(v * half_axes + center)) > 0.0 {
                    expected[patch(v)] += gradient.length();
                }
            }
        }
        let total: f64 = expected.iter().sum();
        let mut found = [0.0; 40];
        for p in simulated.cloud.positions() {
            found[patch((*p - center) / half_axes)] += 1.0;
        }
        let mut chi_square = 0.0;
        let mut patches = 0.0;
        for (e, f) in expected.iter().zip(&found) {
            let e = e / total * f64::from(points as u32);
            if e > 20.0 {
                chi_square += (f - e) * (f - e) / e;
                patches += 1.0;
            }
        }
        // Mean k, standard deviation √(2k); five of them would be chance once in a million.
        let most = patches + 5.0 * (2.0_f64 * patches).sqrt();
        assert!(
            patches > 25.0 && chi_square < most,
            "{half_axes}: {chi_square} of {patches}"
        );
    }
}

#[test]
fn ellipsoid_noise_grows_with_distance() {
    let spread_at = |depth: f64| {
        let settings = EllipsoidSettings {
            center_cm: DVec3::new(0.0, 0.0, depth),
            noise_cm: 0.05,
            ..EllipsoidSettings::default()
        };
        let exact = EllipsoidSettings {
            noise_cm: 0.0,
            ..settings.clone()
        };
        let (noisy, exact) = (settings.simulate().expect("ok"), exact.simulate().expect("ok"));
        rms(noisy.cloud.positions(), exact.cloud.positions())
    };
    let ratio = spread_at(80.0) / spread_at(40.0);
    assert!(
        (3.7..4.3).contains(&ratio),
        "twice as far is four times as noisy, not {ratio}"
    );
    let at_40 = spread_at(40.0);
    assert!((0.042..0.052).contains(&at_40), "{at_40}");
}

/// The root mean square difference of depths.
fn rms(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    let sum: f64 = a.iter().zip(b).map(|(p, q)| (p.z - q.z).powi(2)).sum();
    (sum / a.len() as f64).sqrt()
}

#[test]
fn pepper_points_are_in_range_and_one_a_pixel() {
    for seed in 0..6 {
        let simulated = simulate(&pepper(seed));
        let camera = DepthCamera::default();
        let mut pixels = HashSet::new();
        for p in simulated.cloud.positions() {
            assert!((camera.near_cm..=camera.far_cm).contains(&p.z));
            let at = pixel(&camera, *p);
            assert!((at - at.round()).length() < 1e-6, "on the ray of a pixel");
            let (x, y) = whole(at);
            assert!((0..640).contains(&x) && (0..480).contains(&y), "{x} {y}");
            assert!(pixels.insert((x, y)), "two points along one ray");
            let steps = p.z / camera.step_cm;
            assert!((steps - steps.round()).abs() < 1e-6, "whole depth steps");
        }
        let fruit = labelled(&simulated, Cloud::FRUIT).len();
        assert!((2_000..25_000).contains(&fruit), "seed {seed}: {fruit} points");
        let columns = &simulated.cloud;
        assert!(columns.colors().is_some() && columns.normals().is_none());
    }
}

#[test]
fn drawn_peppers_are_wholly_in_the_image() {
    for seed in 0..40 {
        let camera = DepthCamera {
            // A coarse camera with the same view: only the outline matters here.
            width_px: 160,
            height_px: 120,
            focal_px: 118.75,
            ..exact()
        };
        let simulated = simulate(&PepperSettings {
            camera: camera.clone(),
            ..pepper(seed)
        });
        for p in labelled(&simulated, Cloud::FRUIT) {
            let (x, y) = whole(pixel(&camera, p));
            assert!(
                (1..159).contains(&x) && (1..119).contains(&y),
                "seed {seed}: {x} {y}"
            );
        }
    }
}

#[test]
fn the_truth_is_where_the_points_say() {
    for seed in 0..12 {
        let simulated = simulate(&pepper(seed));
        let truth = &simulated.truth;
        let axis = truth.axis;
        assert!((axis.direction.length() - 1.0).abs() < 1e-12);
        assert_eq!(axis.origin, truth.center);
        let settings = settings_of(truth);
        let (height, width) = (settings.height_cm.expect("set"), settings.width_cm.expect("set"));
        let middle = truth.stem_end.midpoint(truth.blossom_end);
        assert!((middle - truth.center).length() < 1e-9);
        let along = truth.stem_end - truth.blossom_end;
        assert!((along.length() - height).abs() < 1e-9);
        assert!(angle_between_directions_rad(along, axis.direction) < 1e-9);

        let peduncle = labelled(&simulated, Cloud::PEDUNCLE);
        assert!(
            peduncle.len() > 10,
            "seed {seed}: {} peduncle points",
            peduncle.len()
        );
        let above = |p: &DVec3| (*p - truth.center).dot(axis.direction);
        let mean = peduncle.iter().map(above).sum::<f64>() / peduncle.len() as f64;
        assert!(mean > 0.45 * height, "seed {seed}: the peduncle is {mean} cm up");

        // Asymmetry and noise may add a little to the body's measures.
        for p in labelled(&simulated, Cloud::FRUIT) {
            let up = above(&p);
            let out = (p - truth.center).reject_from_normalized(axis.direction).length();
            assert!(up.abs() < 0.55 * height + 0.4, "seed {seed}: {up} up of {height}");
            assert!(
                out < 0.56 * width + 0.4,
                "seed {seed}: {out} from the axis of {width}"
            );
        }
    }
}

#[test]
fn an_upright_pepper_points_up_and_is_as_large_as_it_says() {
    let simulated = simulate(&PepperSettings {
        height_cm: Some(9.0),
        width_cm: Some(7.0),
        lobes: Some(4),
        spin_deg: Some(0.0),
        ..perfect(3)
    });
    let truth = &simulated.truth;
    assert!((truth.axis.direction - DVec3::NEG_Y).length() < 1e-12);
    let fruit = labelled(&simulated, Cloud::FRUIT);
    let (low, high) = fruit.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| {
        (low.min(*p), high.max(*p))
    });
    let (size, middle) = (high - low, low.midpoint(high));
    assert!((size.x - 7.0).abs() < 0.2, "{size}");
    // The front of a body of 9 cm is seen a little lower and higher than it is long.
    assert!((size.y - 9.0).abs() < 0.3, "{size}");
    assert!(middle.truncate().length() < 0.15, "{middle}");
    assert!((low.z - 36.5).abs() < 0.1, "{low}");
}

/// With four lobes and no spin the image plane's vertical middle is a mirror: of the points, too.
#[test]
fn a_perfect_pepper_is_its_own_mirror_image() {
    for lobes in [3, 4] {
        let simulated = simulate(&PepperSettings {
            lobes: Some(lobes),
            // A lobe towards the camera: the first is at the fruit's x axis.
            spin_deg: Some(-90.0),
            ..perfect(8)
        });
        let camera = exact();
        let depth: std::collections::HashMap<_, _> = labelled(&simulated, Cloud::FRUIT)
            .into_iter()
            .map(|p| (whole(pixel(&camera, p)), p.z))
            .collect();
        let mirrored = depth.iter().filter(|((x, y), z)| {
            depth
                .get(&(639 - x, *y))
                .is_some_and(|other| (other - *z).abs() < 1e-2)
        });
        let share = mirrored.count() as f64 / depth.len() as f64;
        assert!(share > 0.97, "{lobes} lobes: {share} of the pixels have a twin");
    }
}

#[test]
fn tilts_are_what_the_settings_say() {
    let direction = |towards, sideways| {
        let settings = PepperSettings {
            tilt_towards_camera_deg: Some(towards),
            tilt_sideways_deg: Some(sideways),
            ..perfect(4)
        };
        simulate(&settings).truth.axis.direction
    };
    let towards = direction(30.0, 0.0);
    assert!((towards - DVec3::new(0.0, -(30_f64.to_radians().cos()), -0.5)).length() < 1e-12);
    let right = direction(0.0, 30.0);
    assert!((right - DVec3::new(0.5, -(30_f64.to_radians().cos()), 0.0)).length() < 1e-12);
    for seed in 0..50 {
        let drawn = PepperSettings {
            camera: DepthCamera {
                width_px: 64,
                height_px: 48,
                focal_px: 47.5,
                ..exact()
            },
            ..pepper(seed)
        };
        let axis = simulate(&drawn).truth.axis.direction;
        assert!(axis.z.abs() <= 25_f64.to_radians().sin());
        assert!((axis.x / -axis.y).atan().abs() <= 25_f64.to_radians());
    }
}

#[test]
fn the_pose_carries_the_fruit_to_the_camera() {
    let truth = simulate(&pepper(9)).truth;
    let rotation = truth.pose.camera_from_fruit();
    assert!(
        (rotation.determinant() - 1.0).abs() < 1e-12,
        "a rotation, no mirror"
    );
    assert!((rotation * DVec3::Y - truth.axis.direction).length() < 1e-12);
    let rows = truth.pose.rotation;
    let first = DVec3::from_array(rows[0]);
    assert!(
        (first.dot(DVec3::Y) - truth.axis.direction.x).abs() < 1e-12,
        "rows, not columns"
    );
}

#[test]
fn a_leaf_hides_the_share_that_was_asked_for() {
    for (seed, cover) in [(1, 0.1), (2, 0.3), (3, 0.5), (4, 0.85)] {
        let bare = PepperSettings {
            camera: exact(),
            ..pepper(seed)
        };
        let leafy = PepperSettings {
            leaf_cover: cover,
            ..bare.clone()
        };
        let (bare, leafy) = (simulate(&bare), simulate(&leafy));
        let of_fruit = |s: &Simulated| labelled(s, Cloud::FRUIT).len() + labelled(s, Cloud::PEDUNCLE).len();
        let hidden = 1.0 - of_fruit(&leafy) as f64 / of_fruit(&bare) as f64;
        assert!((hidden - cover).abs() < 0.03, "seed {seed}: {hidden} of {cover}");
        let stated = leafy.truth.hidden_by_leaf.expect("there is a leaf");
        assert!((hidden - stated).abs() < 1e-9, "{hidden} is not {stated}");
        assert_eq!(bare.truth.hidden_by_leaf, None);
        assert!(!labelled(&leafy, Cloud::LEAF).is_empty());
        assert!(labelled(&bare, Cloud::LEAF).is_empty());
        assert_eq!(leafy.truth.axis, bare.truth.axis, "the fruit is the same");
    }
}

#[test]
fn pepper_noise_grows_with_distance() {
    let spread_at = |depth: f64| {
        let settings = |noise_cm| PepperSettings {
            center_cm: Some(DVec3::new(0.0, 0.0, depth)),
            camera: DepthCamera { noise_cm, ..exact() },
            ..perfect(2)
        };
        let (noisy, exact) = (simulate(&settings(0.05)), simulate(&settings(0.0)));
        rms(noisy.cloud.positions(), exact.cloud.positions())
    };
    let ratio = spread_at(80.0) / spread_at(40.0);
    assert!(
        (3.4..4.6).contains(&ratio),
        "twice as far is four times as noisy, not {ratio}"
    );
}

#[test]
fn holes_are_where_the_surface_turns_away() {
    let with = |camera: DepthCamera| {
        let settings = PepperSettings { camera, ..perfect(6) };
        labelled(&simulate(&settings), Cloud::FRUIT)
    };
    let all = with(exact());
    let grazing = with(DepthCamera {
        grazing_deg: 60.0,
        ..exact()
    });
    let dropped = with(DepthCamera {
        dropout: 0.3,
        ..exact()
    });
    let share = 1.0 - dropped.len() as f64 / all.len() as f64;
    assert!((share - 0.3).abs() < 0.03, "{share}");
    assert!(grazing.len() < all.len());
    let deep = |points: &[DVec3]| points.iter().map(|p| p.z).sum::<f64>() / points.len() as f64;
    assert!(deep(&grazing) < deep(&all), "the rim is lost, not the front");
    let near = |points: &[DVec3]| points.iter().filter(|p| p.truncate().length() < 1.5).count();
    assert_eq!(near(&grazing), near(&all), "nothing is lost straight ahead");
}

#[test]
fn the_truth_survives_json_and_makes_the_cloud_again() {
    let leafy = PepperSettings {
        leaf_cover: 0.25,
        color: Some(FruitColor::Yellow),
        ..pepper(11)
    };
    let simulated = simulate(&leafy);
    let json = serde_json::to_string_pretty(&simulated.truth).expect("json");
    let back: Truth = serde_json::from_str(&json).expect("the same truth");
    assert_eq!(back, simulated.truth);
    assert_eq!(
        simulate(settings_of(&back)),
        simulated,
        "nothing was left to chance"
    );

    let value: serde_json::Value = serde_json::from_str(&json).expect("json");
    assert_eq!(value["schema"], "axiscope.truth/1");
    assert_eq!(value["kind"], "pepper");
    assert_eq!(value["unit"], "cm");
    assert_eq!(value["settings"]["color"], "yellow");
    let settings = value["settings"].as_object().expect("an object");
    assert!(
        settings.values().all(|v| !v.is_null()),
        "every setting is resolved"
    );

    let ellipsoid = EllipsoidSettings::default().simulate().expect("visible").truth;
    let json = serde_json::to_string(&ellipsoid).expect("json");
    assert_eq!(
        serde_json::from_str::<Truth>(&json).expect("the same truth"),
        ellipsoid
    );
}

#[test]
fn setting_one_thing_leaves_the_rest_to_the_seed() {
    let free = simulate(&pepper(21)).truth;
    let fixed = PepperSettings {
        width_cm: Some(6.5),
        spin_deg: Some(10.0),
        color: Some(FruitColor::Red),
        ..pepper(21)
    };
    let fixed = simulate(&fixed).truth;
    let (a, b) = (settings_of(&free), settings_of(&fixed));
    assert_eq!(a.height_cm, b.height_cm);
    assert_eq!(a.lobes, b.lobes);
    assert_eq!(a.peduncle_bend_deg, b.peduncle_bend_deg);
    assert_eq!(a.tilt_sideways_deg, b.tilt_sideways_deg);
    assert_eq!(free.axis.direction, fixed.axis.direction);
    assert_eq!(b.width_cm, Some(6.5));
}

#[test]
fn other_units_scale_points_and_truth_alike() {
    let in_cm = simulate(&pepper(13));
    let in_m = in_cm.clone().in_unit(Unit::Meter);
    assert_eq!(in_m.truth.unit, Unit::Meter);
    assert_eq!(in_m.cloud.labels(), in_cm.cloud.labels());
    assert_eq!(in_m.cloud.colors(), in_cm.cloud.colors());
    assert_eq!(in_m.truth.axis.direction, in_cm.truth.axis.direction);
    assert_eq!(
        in_m.truth.settings, in_cm.truth.settings,
        "settings stay in centimeters"
    );
    let same = |m: DVec3, cm: DVec3| assert!((m * 100.0 - cm).length() < 1e-9, "{m} is not {cm}");
    for (m, cm) in in_m.cloud.positions().iter().zip(in_cm.cloud.positions()) {
        same(*m, *cm);
    }
    let (m, cm) = (&in_m.truth, &in_cm.truth);
    same(m.center, cm.center);
    same(m.axis.origin, cm.axis.origin);
    same(m.stem_end, cm.stem_end);
    same(m.blossom_end, cm.blossom_end);
    same(m.pose.translation, cm.pose.translation);
    let in_mm = in_cm.clone().in_unit(Unit::Millimeter);
    assert!((in_mm.truth.center / 10.0 - cm.center).length() < 1e-9);
    let normals = EllipsoidSettings::default().simulate().expect("visible");
    let scaled = normals.clone().in_unit(Unit::Meter);
    assert_eq!(scaled.cloud.normals(), normals.cloud.normals());
}

#[test]
fn the_peduncle_can_be_taken_away() {
    let whole = simulate(&pepper(14));
    let bare = whole.without_peduncle();
    assert!(labelled(&bare, Cloud::PEDUNCLE).is_empty());
    assert_eq!(labelled(&bare, Cloud::FRUIT), labelled(&whole, Cloud::FRUIT));
    assert_eq!(bare.cloud.len(), bare.cloud.colors().expect("colors").len());
    assert!(bare.truth.without_peduncle && !whole.truth.without_peduncle);
    let put_back = Truth {
        without_peduncle: false,
        ..bare.truth
    };
    assert_eq!(put_back, whole.truth);
}

/// The name of the setting that was refused.
fn refused<T: std::fmt::Debug>(result: Result<T, SimulateError>) -> &'static str {
    match result {
        Err(SimulateError::Setting { name, .. }) => name,
        other => panic!("not refused: {other:?}"),
    }
}

#[test]
fn ellipsoids_that_make_no_sense_are_refused() {
    type Change = fn(&mut EllipsoidSettings);
    let changes: [(&str, Change); 9] = [
        ("half_axes_cm", |s| s.half_axes_cm.y = 0.0),
        ("half_axes_cm", |s| s.half_axes_cm.z = -2.0),
        ("half_axes_cm", |s| s.half_axes_cm.x = f64::NAN),
        ("half_axes_cm", |s| s.half_axes_cm.x = f64::INFINITY),
        ("center_cm", |s| s.center_cm.x = f64::NAN),
        ("center_cm.z", |s| s.center_cm.z = 12.0),
        ("center_cm.z", |s| s.center_cm.z = f64::NAN),
        ("points", |s| s.points = 0),
        ("noise_cm", |s| s.noise_cm = -0.1),
    ];
    for (name, change) in changes {
        let mut settings = EllipsoidSettings::default();
        change(&mut settings);
        assert_eq!(refused(settings.simulate()), name);
    }
    let around_us = EllipsoidSettings {
        half_axes_cm: DVec3::splat(40.0),
        ..EllipsoidSettings::default()
    };
    assert_eq!(around_us.simulate(), Err(SimulateError::ViewpointInside));
    let nearly_around_us = EllipsoidSettings {
        half_axes_cm: DVec3::splat(24.999_999),
        center_cm: DVec3::new(0.0, 0.0, 25.0),
        points: 100,
        ..EllipsoidSettings::default()
    };
    let too_little = nearly_around_us.simulate();
    assert!(
        matches!(too_little, Err(SimulateError::TooLittleVisible { .. })),
        "{too_little:?}"
    );
}

#[test]
fn peppers_that_make_no_sense_are_refused() {
    type Change = fn(&mut PepperSettings);
    let changes: [(&str, Change); 24] = [
        ("height_cm", |s| s.height_cm = Some(0.0)),
        ("height_cm", |s| s.height_cm = Some(f64::NAN)),
        ("width_cm", |s| s.width_cm = Some(-1.0)),
        ("lobes", |s| s.lobes = Some(0)),
        ("lobe_depth", |s| s.lobe_depth = Some(0.9)),
        ("taper", |s| s.taper = Some(f64::NAN)),
        ("dimple_cm", |s| s.dimple_cm = Some(8.0)),
        ("dimple_cm", |s| s.dimple_cm = Some(f64::NAN)),
        ("asymmetry", |s| s.asymmetry = f64::NAN),
        ("peduncle_length_cm", |s| s.peduncle_length_cm = Some(0.0)),
        ("peduncle_width_cm", |s| s.peduncle_width_cm = Some(f64::INFINITY)),
        ("peduncle_bend_deg", |s| s.peduncle_bend_deg = Some(-1.0)),
        ("max_tilt_sideways_deg", |s| s.max_tilt_sideways_deg = f64::NAN),
        ("tilt_towards_camera_deg", |s| {
            s.tilt_towards_camera_deg = Some(91.0)
        }),
        ("spin_deg", |s| s.spin_deg = Some(f64::NAN)),
        ("distance_cm[0]", |s| s.distance_cm = [10.0, 60.0]),
        ("distance_cm[1]", |s| s.distance_cm = [60.0, 30.0]),
        ("distance_cm[1]", |s| s.distance_cm = [30.0, f64::NAN]),
        ("center_cm", |s| s.center_cm = Some(DVec3::NAN)),
        ("center_cm.z", |s| s.center_cm = Some(DVec3::new(0.0, 0.0, 200.0))),
        ("leaf_cover", |s| s.leaf_cover = 1.0),
        ("focal_px", |s| s.camera.focal_px = 0.0),
        ("far_cm", |s| s.camera.far_cm = 5.0),
        ("dropout", |s| s.camera.dropout = f64::NAN),
    ];
    for (name, change) in changes {
        let mut settings = PepperSettings::default();
        change(&mut settings);
        assert_eq!(refused(settings.simulate()), name);
    }
    let out_of_sight = PepperSettings {
        center_cm: Some(DVec3::new(100.0, 0.0, 40.0)),
        ..PepperSettings::default()
    };
    assert_eq!(out_of_sight.simulate(), Err(SimulateError::NothingVisible));
    let message = PepperSettings {
        taper: Some(2.0),
        ..PepperSettings::default()
    };
    let message = message.simulate().expect_err("refused").to_string();
    assert_eq!(message, "taper is 2; it must be 0 to 0.8");
}
