//! The pepper is what its settings and its truth say.

use axiscope::geometry::{Cloud, angle_between_directions_rad};
use axiscope::simulate::{DepthCamera, PepperSettings, SimulateError, Simulated};
use glam::DVec3;

use super::{exact, labelled, pepper, perfect, pixel, refused, settings_of, simulate, whole};

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
            s.tilt_towards_camera_deg = Some(91.0);
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
    assert_eq!(out_of_sight.simulate().err(), Some(SimulateError::NothingVisible));
    let message = PepperSettings {
        taper: Some(2.0),
        ..PepperSettings::default()
    };
    let message = message.simulate().expect_err("refused").to_string();
    assert_eq!(message, "taper is 2; it must be 0 to 0.8");
}

#[test]
fn a_camera_inside_the_fruit_is_refused() {
    let huge = PepperSettings {
        height_cm: Some(50.0),
        width_cm: Some(50.0),
        center_cm: Some(DVec3::new(0.0, 0.0, 22.0)),
        ..PepperSettings::default()
    };
    assert_eq!(huge.simulate().err(), Some(SimulateError::ViewpointInside));
}

/// The ends of what may be set, combined at random: a cloud or a typed refusal, never a panic.
#[test]
fn extreme_shapes_are_simulated_or_refused() {
    let mut simulated = 0;
    for seed in 0..24_u32 {
        let end = |bit: u32, low, high| {
            let mixed = (seed + 1).wrapping_mul(0x9e37_79b1) >> (8 + bit);
            Some(if mixed & 1 == 0 { low } else { high })
        };
        let height_cm = end(0, 1.0, 50.0);
        let settings = PepperSettings {
            height_cm,
            width_cm: end(1, 1.0, 50.0),
            lobes: Some(if seed % 2 == 0 { 1 } else { 12 }),
            lobe_depth: end(2, 0.0, 0.4),
            taper: end(3, 0.0, 0.8),
            dimple_cm: end(4, 0.0, 0.25)
                .zip(height_cm)
                .map(|(share, height)| share * height),
            asymmetry: if seed % 3 == 0 { 0.2 } else { 0.0 },
            peduncle_length_cm: end(5, 0.5, 20.0),
            peduncle_width_cm: end(6, 0.1, 5.0),
            peduncle_bend_deg: end(7, 0.0, 120.0),
            tilt_towards_camera_deg: end(8, -90.0, 90.0),
            distance_cm: [20.0, 150.0],
            leaf_cover: if seed % 4 == 0 { 0.9 } else { 0.0 },
            camera: DepthCamera {
                width_px: 160,
                height_px: 120,
                focal_px: 118.75,
                ..DepthCamera::default()
            },
            ..pepper(seed.into())
        };
        match settings.simulate() {
            Ok(Simulated { cloud, truth }) => {
                assert!(!cloud.is_empty() && truth.axis.direction.is_finite());
                simulated += 1;
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    assert!(simulated >= 12, "only {simulated} of 24");
}
