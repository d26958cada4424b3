//! The plane without the grid, superquadrics and surfaces of revolution: exact bodies are found, the axis goes with the
//! points, and what has no axis is said to have none.

use axiscope::estimate::{Estimate, EstimateError, Estimator, Prior, Surface, estimate, half_sphere};
use axiscope::geometry::{Cloud, Unit, angle_between_lines_rad, voxel_edge_for, voxel_grid};
use axiscope::method::{Analysis, Params, Preset, analyze};
use axiscope::parallel::{Cancelled, Watch};
use axiscope::simulate::{FruitKind, FruitSettings, PepperSettings, Simulated, Surroundings};
use glam::{DMat3, DVec3};

const FITTED: [Estimator; 2] = [Estimator::Superquadric, Estimator::Revolution];
const ALL: [Estimator; 3] = [Estimator::Plane, Estimator::Superquadric, Estimator::Revolution];

fn analysis_of(points: &[DVec3], unit: Unit) -> Analysis {
    let params = Params {
        u: 5,
        ..Params::new(Preset::AsIntended, unit)
    };
    analyze(&Cloud::new(points.to_vec()), &params, &()).expect("an analysis")
}

fn run(estimator: Estimator, points: &[DVec3], unit: Unit) -> Estimate {
    let surface = Surface::new(points, unit, DVec3::ZERO, &());
    let analysis = analysis_of(points, unit);
    estimate(estimator, &analysis, &surface, Prior::None, &()).expect("not cancelled")
}

fn error_deg(estimate: &Estimate, truth: DVec3) -> f64 {
    let axis = estimate.axis.as_ref().expect("an axis");
    angle_between_lines_rad(axis.direction, truth).to_degrees()
}

/// Points all over the body that `on_surface` gives for a polar angle and a turn, posed before the camera, with its axis.
fn posed(seed: usize, on_surface: impl Fn(f64, f64) -> DVec3) -> (Vec<DVec3>, DVec3) {
    let axis = half_sphere(7)[seed % 7];
    let (x, y) = axis.any_orthonormal_pair();
    let rotation = DMat3::from_cols(x, y, axis) * DMat3::from_rotation_z(seed as f64);
    let at = DVec3::new(seed as f64 - 3.0, 2.0, 50.0 - 2.0 * seed as f64);
    let directions = half_sphere(700);
    let both = directions.iter().flat_map(|&d| [d, -d]);
    let points = both.map(|d| {
        let (polar, turn) = (d.z.acos(), d.y.atan2(d.x));
        at + rotation * on_surface(polar, turn)
    });
    (points.collect(), axis)
}

/// The points of a simulated fruit, thinned to about 2000.
fn seen(simulated: &Simulated) -> Vec<DVec3> {
    let labels = simulated.cloud.labels().expect("labels");
    let fruit: Vec<usize> = (0..labels.len()).filter(|&i| labels[i] == Cloud::FRUIT).collect();
    let cloud = simulated.cloud.select(&fruit);
    let edge = voxel_edge_for(cloud.positions(), 2000, &()).expect("not cancelled");
    let thinned = edge.map_or(cloud.clone(), |edge| voxel_grid(&cloud, edge));
    thinned.positions().to_vec()
}

fn fruit(kind: FruitKind, seed: u64) -> Simulated {
    let settings = FruitSettings {
        seed,
        ..FruitSettings::new(kind)
    };
    settings.simulate().expect("a fruit in view")
}

#[test]
fn an_exact_superquadric_is_found_in_any_pose() {
    let power = |v: f64, e: f64| v.abs().powf(e).copysign(v);
    for seed in 0..4 {
        let (points, axis) = posed(seed, |polar, turn| {
            let across = power(polar.sin(), 0.8);
            let z = 4.6 * power(polar.cos(), 0.8);
            let width = 1.0 + 0.2 * z / 4.6;
            let (x, y) = (power(turn.cos(), 0.9), power(turn.sin(), 0.9));
            DVec3::new(3.0 * across * x * width, 3.1 * across * y * width, z)
        });
        let found = run(Estimator::Superquadric, &points, Unit::Centimeter);
        assert!(
            error_deg(&found, axis) < 1.0,
            "{seed}: {}",
            error_deg(&found, axis)
        );
        assert!(!found.ambiguous, "{found:?}");
    }
}

/// ρ² is a polynomial of third order in t, as the series can be.
#[test]
fn an_exact_surface_of_revolution_is_found_in_any_pose() {
    for seed in 0..4 {
        let (points, axis) = posed(seed, |polar, turn| {
            let s = polar.cos();
            let radius = 2.8 * ((1.0 - s * s) * (1.0 + 0.45 * s)).max(0.0).sqrt();
            DVec3::new(radius * turn.cos(), radius * turn.sin(), 4.2 * s)
        });
        let found = run(Estimator::Revolution, &points, Unit::Centimeter);
        assert!(
            error_deg(&found, axis) < 0.5,
            "{seed}: {}",
            error_deg(&found, axis)
        );
        assert!(!found.ambiguous, "{found:?}");
    }
}

/// A pepper that is its own mirror image, and upright to the camera: Eq. 16 holds.
#[test]
fn the_plane_of_a_mirror_image_is_found_and_leans_are_missed() {
    let with_lean = |lean_deg: f64| {
        let settings = PepperSettings {
            seed: 3,
            lobes: Some(4),
            asymmetry: 0.0,
            spin_deg: Some(-90.0),
            tilt_sideways_deg: Some(12.0),
            tilt_towards_camera_deg: Some(lean_deg),
            center_cm: Some(DVec3::new(0.0, 0.0, 40.0)),
            ..PepperSettings::default()
        };
        let simulated = settings.simulate().expect("a pepper");
        let found = run(Estimator::Plane, &seen(&simulated), Unit::Centimeter);
        error_deg(&found, simulated.truth.axis.direction)
    };
    let upright = with_lean(0.0);
    assert!(upright < 2.0, "{upright}");
    let leaning = with_lean(20.0);
    // Perpendicular to the ray through the plane's own center, which is a degree or two beside that through the fruit's.
    assert!((17.0..24.0).contains(&leaning), "{leaning}");
}

/// Turned about the camera, the points have the same axis, turned.
#[test]
fn the_axis_turns_with_the_points() {
    let points = seen(&fruit(FruitKind::Pear, 11));
    let turn = DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_z(1.1);
    let turned: Vec<DVec3> = points.iter().map(|&p| turn * p).collect();
    for estimator in FITTED {
        let before = run(estimator, &points, Unit::Centimeter);
        let after = run(estimator, &turned, Unit::Centimeter);
        let expected = turn * before.axis.as_ref().expect("an axis").direction;
        let off = error_deg(&after, expected);
        assert!(off < 2.0, "{estimator:?}: {off}°");
    }
}

#[test]
fn the_unit_does_not_matter() {
    let points = seen(&fruit(FruitKind::Apple, 12));
    let in_mm: Vec<DVec3> = points.iter().map(|&p| p * 10.0).collect();
    for estimator in ALL {
        let (cm, mm) = (
            run(estimator, &points, Unit::Centimeter),
            run(estimator, &in_mm, Unit::Millimeter),
        );
        let off = error_deg(&mm, cm.axis.as_ref().expect("an axis").direction);
        // Rounding moves single points to other cells of the samples.
        assert!(off < 0.2, "{estimator:?}: {off}°");
        let apart = mm.center.expect("a center") / 10.0 - cm.center.expect("a center");
        assert!(apart.length() < 0.02, "{estimator:?}: {apart}");
    }
}

#[cfg(feature = "parallel")]
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let points = seen(&fruit(FruitKind::Eggplant, 13));
    let on = |threads: usize, estimator: Estimator| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| run(estimator, &points, Unit::Centimeter))
    };
    for estimator in ALL {
        assert!(on(1, estimator) == on(2, estimator), "{estimator:?}");
    }
}

#[test]
fn what_has_no_axis_is_said_to_have_none() {
    for seed in 0..3 {
        let ball = seen(&fruit(FruitKind::Ball, 100 + seed));
        for estimator in ALL {
            let found = run(estimator, &ball, Unit::Centimeter);
            assert!(found.ambiguous, "{estimator:?} {seed}: {found:?}");
        }
    }
}

#[test]
fn too_few_points_and_flat_ones_get_a_sentence() {
    let few: Vec<DVec3> = seen(&fruit(FruitKind::Apple, 14))
        .into_iter()
        .step_by(40)
        .collect();
    let grid = |i: usize| DVec3::new((i % 20) as f64 * 0.4, (i / 20) as f64 * 0.4, 40.0);
    let flat: Vec<DVec3> = (0..400).map(grid).collect();
    for (points, word) in [(few, "too few"), (flat, "plane")] {
        for estimator in ALL {
            let found = run(estimator, &points, Unit::Centimeter);
            assert!(found.axis.is_none() && found.ambiguous);
            assert!(found.warnings[0].contains(word), "{:?}", found.warnings);
        }
    }
    let line: Vec<DVec3> = (0..400)
        .map(|i| DVec3::new(f64::from(i) * 0.01, 1.0, 40.0))
        .collect();
    let surface = Surface::new(&line, Unit::Centimeter, DVec3::ZERO, &());
    assert!(matches!(
        surface,
        Err(EstimateError::Line | EstimateError::TooFewPoints { .. })
    ));
}

/// Two peppers side by side, as one cloud: no profile of one fruit has such a waist.
#[test]
fn two_fruits_are_no_surface_of_revolution() {
    for seed in 0..2 {
        let at = |seed: u64, center: DVec3| {
            let settings = PepperSettings {
                seed,
                center_cm: Some(center),
                ..PepperSettings::default()
            };
            seen(&settings.simulate().expect("a pepper"))
        };
        let mut points = at(40 + seed, DVec3::new(-4.5, 0.0, 45.0));
        points.extend(at(60 + seed, DVec3::new(4.5, 1.0, 47.0)));
        let found = run(Estimator::Revolution, &points, Unit::Centimeter);
        assert!(found.ambiguous && !found.warnings.is_empty(), "{seed}: {found:?}");
    }
}

#[test]
fn a_cancelled_estimate_ends() {
    struct Cancel;
    impl Watch for Cancel {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let points = seen(&fruit(FruitKind::Tomato, 15));
    let surface = Surface::new(&points, Unit::Centimeter, DVec3::ZERO, &());
    let analysis = analysis_of(&points, Unit::Centimeter);
    for estimator in ALL {
        let result = estimate(estimator, &analysis, &surface, Prior::None, &Cancel);
        assert_eq!(result, Err(Cancelled), "{estimator:?}");
    }
}

/// A leaf, an upright prior and a lean prior: each is an assumption that is asked for, and none breaks an estimate.
#[test]
fn priors_and_leaves_leave_an_axis() {
    let settings = PepperSettings {
        seed: 21,
        ..PepperSettings::default()
    };
    let leafy = settings.clone().with_surroundings(Surroundings {
        leaf_cover: 0.3,
        ..settings.surroundings()
    });
    let points = seen(&leafy.simulate().expect("a pepper"));
    let surface = Surface::new(&points, Unit::Centimeter, DVec3::ZERO, &());
    let analysis = analysis_of(&points, Unit::Centimeter);
    let lean = Prior::Lean {
        free_deg: 30.0,
        sd_deg: 8.0,
    };
    for estimator in FITTED {
        for prior in [Prior::Up, lean] {
            let found = estimate(estimator, &analysis, &surface, prior, &()).expect("not cancelled");
            let axis = found.axis.expect("an axis");
            assert!(axis.direction.is_finite() && axis.origin.is_finite());
        }
    }
}
