//! Centers, scores, rankings, axes and the errors of degenerate clouds.

use crate::helpers::bodies::{rotation, scattered, view};
use axiscope::geometry::{Cloud, Unit};
use axiscope::method::{
    Aggregation, AnalysisError, AxisError, CandidateGrid, CenterError, CenterMethod, Observe, ParamError,
    Params, PlaneTerm, PlaneTerms, Preset, RandomSearch, Ranking, SurfaceError, TAU_CM_PER_RAD, Warning,
    analyze, distance_deviation, find_center, fit_sphere, is_viewpoint_inside, rms_distance, symmetry_axis,
};
use axiscope::parallel::{Cancelled, Watch};
use glam::DVec3;
use proptest::prelude::*;

/// A cap of a sphere as one camera sees it.
fn cap(seed: u64, center: DVec3, radius: f64) -> Vec<DVec3> {
    let directions = scattered(seed, 900).into_iter().filter_map(DVec3::try_normalize);
    directions
        .map(|v| center + radius * v)
        .filter(|p| (*p - center).dot(-*p) > 0.0)
        .collect()
}

fn params() -> Params {
    Params::new(Preset::AsIntended, Unit::Centimeter)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn eq_3_as_printed_is_least_at_the_mean(seed in 0u64..1000, x in -9.0..9.0f64, y in -9.0..9.0f64) {
        let points = view(seed, 200).points;
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        let p = mean + DVec3::new(x, y, 1.0);
        let [there, least] = [p, mean].map(|p| rms_distance(&points, p).unwrap());
        prop_assert!(least < there);
        let expected = least.powi(2) + p.distance_squared(mean);
        prop_assert!((there.powi(2) - expected).abs() < 1e-9 * expected);
    }

    #[test]
    fn the_mean_rms_search_picks_the_random_point_nearest_to_the_mean(seed in 0u64..1000) {
        let points = view(seed, 200).points;
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        let search = |count| RandomSearch { count, spread: 1.0, seed };
        let found = |count| find_center(&points, &CenterMethod::MeanRms(search(count)), &()).unwrap();
        // More random points of one seed begin with the fewer: they can only come nearer.
        prop_assert!(found(500).distance(mean) <= found(50).distance(mean));
        prop_assert!(found(4000).distance(mean) < 0.35, "{}", found(4000).distance(mean));
    }

    #[test]
    fn the_equidistant_search_finds_a_sphere_s_center(seed in 0u64..1000) {
        let center = DVec3::new(2.0, -3.0, 40.0);
        let points = cap(seed, center, 4.0);
        let method = CenterMethod::Equidistant(RandomSearch { seed, ..RandomSearch::default() });
        let found = find_center(&points, &method, &()).unwrap();
        prop_assert!(found.distance(center) < 0.6, "off by {}", found.distance(center));
        let [there, at_center] = [found, center].map(|p| distance_deviation(&points, p).unwrap());
        prop_assert!(at_center < 1e-6);
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        prop_assert!(there < 0.25 * distance_deviation(&points, mean).unwrap());
    }

    #[test]
    fn a_sphere_is_fitted_exactly_wherever_it_is(seed in 0u64..1000, scale in 0.001..1000.0f64) {
        let center = scale * (rotation(seed) * DVec3::new(2.0, -3.0, 40.0));
        let points = cap(seed, center, 4.0 * scale);
        let (found, radius) = fit_sphere(&points).unwrap();
        prop_assert!(found.distance(center) < 1e-8 * scale);
        prop_assert!((radius - 4.0 * scale).abs() < 1e-8 * scale);
    }

    #[test]
    fn no_sphere_nearby_fits_better(seed in 0u64..1000) {
        // A bumpy body is no sphere: the algebraic fit that the search starts from is another one.
        let points = view(seed, 300).points;
        let misfit = |center: DVec3, radius: f64| points.iter().map(|p| (p.distance(center) - radius).powi(2)).sum::<f64>();
        let (center, radius) = fit_sphere(&points).unwrap();
        let least = misfit(center, radius);
        for step in [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| 1e-3 * axis) {
            prop_assert!(least < misfit(center + step, radius) && least < misfit(center - step, radius));
        }
        prop_assert!(least < misfit(center, radius + 1e-3) && least < misfit(center, radius - 1e-3));
    }

    #[test]
    fn eq_3_as_intended_is_a_standard_deviation(seed in 0u64..1000, count in 1usize..40, x in -9.0..9.0f64) {
        let points = view(seed, count).points;
        let p = DVec3::new(x, 2.0, 25.0);
        let distances: Vec<f64> = points.iter().map(|q| q.distance(p)).collect();
        let mean = distances.iter().sum::<f64>() / distances.len() as f64;
        let variance = distances.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / distances.len() as f64;
        prop_assert!((distance_deviation(&points, p).unwrap() - variance.sqrt()).abs() < 1e-7);
    }

    #[test]
    fn the_axis_lies_in_the_plane_and_across_the_view_ray(seed in 0u64..1000) {
        let [n, c] = [rotation(seed) * DVec3::X, 10.0 * (rotation(seed + 1) * DVec3::Y)];
        let viewpoint = DVec3::new(1.0, 2.0, -30.0);
        let axis = symmetry_axis(n, c, viewpoint).unwrap();
        prop_assert!((axis.length() - 1.0).abs() < 1e-12);
        prop_assert!(axis.dot(n).abs() < 1e-12);
        prop_assert!(axis.dot((viewpoint - c).normalize()).abs() < 1e-12);
    }
}

#[test]
fn a_large_cloud_s_center_is_as_good_as_the_whole_search_s() {
    // Beyond some hundred points a sample picks the random points that are tried in full.
    let center = DVec3::new(2.0, -3.0, 40.0);
    let directions = scattered(5, 30_000).into_iter().filter_map(DVec3::try_normalize);
    let points: Vec<_> = directions
        .map(|v| center + 4.0 * v)
        .filter(|p| (*p - center).dot(-*p) > 0.0)
        .collect();
    assert!(points.len() > 10_000);
    let found = find_center(&points, &CenterMethod::Equidistant(RandomSearch::default()), &()).unwrap();
    assert!(found.distance(center) < 0.5, "off by {}", found.distance(center));
}

#[test]
fn candidates_follow_the_paper_s_equations() {
    let grid = CandidateGrid::new(6).unwrap();
    assert_eq!(grid.plane_count(), 36);
    let c = grid.candidate(7);
    assert_eq!((c.g, c.h), (2, 2));
    assert!((c.alpha_rad.to_degrees() - 45.0).abs() < 1e-12);
    assert!((c.beta_rad.to_degrees() + 45.0).abs() < 1e-12);
    assert!(c.normal.distance(DVec3::new(0.5, -0.5, 0.5_f64.sqrt())) < 1e-12);
    for (i, c) in grid.candidates().enumerate() {
        assert_eq!(grid.index_of(c.g, c.h), Some(i));
        assert!((c.normal.length() - 1.0).abs() < 1e-12);
    }
    assert_eq!(grid.index_of(0, 1), None);
    assert_eq!(grid.index_of(1, 7), None);
    assert_eq!(CandidateGrid::new(4), Err(ParamError::GridSize(4)));
}

fn terms(of: &[(usize, f64, f64)]) -> PlaneTerms {
    let grid = CandidateGrid::new(5).unwrap();
    let mut terms = vec![
        PlaneTerm {
            partners: 80,
            distance_sum_cm: 800.0,
            angle_sum_rad: 800.0
        };
        25
    ];
    for (term, &(partners, distance_sum_cm, angle_sum_rad)) in terms.iter_mut().zip(of) {
        *term = PlaneTerm {
            partners,
            distance_sum_cm,
            angle_sum_rad,
        };
    }
    PlaneTerms {
        grid,
        terms,
        points: 100,
    }
}

#[test]
fn the_sum_is_won_by_a_plane_without_partners_and_the_mean_is_not() {
    let planes = terms(&[(90, 9.0, 4.0), (0, 0.0, 0.0), (29, 0.1, 0.1), (30, 6.0, 0.0)]);
    let sum = Ranking::new(&planes, 1.0, Aggregation::Sum, 0.0);
    assert_eq!(sum.best(), Ok(1));
    assert_eq!(sum.scores_cm()[1], Some(0.0));
    let mean = Ranking::new(&planes, 1.0, Aggregation::Mean, 0.3);
    assert_eq!(mean.best(), Ok(0));
    assert_eq!(
        mean.scores_cm()[..4],
        [Some(13.0 / 90.0), None, None, Some(0.2)],
        "30 % is enough, 29 % is not"
    );
    assert_eq!(mean.runner_up(), Some(3));
    // Without a least fraction the mean of nothing still has no score.
    let any = Ranking::new(&planes, 1.0, Aggregation::Mean, 0.0);
    assert_eq!(any.scores_cm()[1], None);
    assert_eq!(any.best(), Ok(2));
}

#[test]
fn tau_weighs_angles_and_equal_scores_go_by_the_grid_s_order() {
    let planes = terms(&[(100, 1.0, 50.0), (100, 30.0, 1.0), (100, 30.0, 1.0)]);
    let best = |tau| Ranking::new(&planes, tau, Aggregation::Mean, 0.3).order()[..2].to_vec();
    assert_eq!(best(0.0), [0, 1]);
    assert_eq!(best(TAU_CM_PER_RAD), [1, 2]);
}

#[test]
fn no_plane_above_the_fraction_is_an_error_that_says_how_far_it_was() {
    let planes = terms(&[]);
    let ranking = Ranking::new(&planes, 1.0, Aggregation::Mean, 0.9);
    let error = ranking.best().unwrap_err().to_string();
    assert_eq!(
        error,
        "no candidate plane has a partner for 90 % of the points; the most that one has is 80.0 %"
    );
}

#[test]
fn an_axis_along_the_view_ray_does_not_exist() {
    let c = DVec3::new(3.0, 5.0, 25.0);
    assert_eq!(
        symmetry_axis(c.normalize(), c, DVec3::ZERO),
        Err(AxisError::NormalAlongViewRay)
    );
    assert_eq!(symmetry_axis(DVec3::X, c, c), Err(AxisError::ViewpointAtCenter));
}

fn error_of(cloud: &Cloud, params: &Params) -> AnalysisError {
    analyze(cloud, params, &()).expect_err("this cloud cannot be analyzed")
}

#[test]
fn degenerate_clouds_are_typed_errors() {
    let line: Vec<_> = (0..50)
        .map(|i| DVec3::new(1.0, 2.0, 30.0) + f64::from(i) * DVec3::new(0.1, 0.2, 0.3))
        .collect();
    let few = view(1, 3).points;
    let equal = vec![DVec3::new(1.0, 2.0, 3.0); 40];
    assert_eq!(
        error_of(&Cloud::new(few), &params()),
        SurfaceError::TooFewPoints { found: 3 }.into()
    );
    assert_eq!(
        error_of(&Cloud::new(Vec::new()), &params()),
        SurfaceError::TooFewPoints { found: 0 }.into()
    );
    assert_eq!(
        error_of(&Cloud::new(equal), &params()),
        SurfaceError::AllPointsEqual { points: 40 }.into()
    );
    assert_eq!(
        error_of(&Cloud::new(line.clone()), &params()),
        SurfaceError::PointsOnALine { points: 50 }.into()
    );
    let single: Vec<_> = line.iter().map(|p| p.as_vec3().as_dvec3()).collect();
    assert_eq!(
        error_of(&Cloud::new(single), &params()),
        SurfaceError::PointsOnALine { points: 50 }.into(),
        "rounded"
    );
}

#[test]
fn a_flat_cloud_has_no_sphere() {
    let flat: Vec<_> = scattered(1, 100)
        .iter()
        .map(|p| DVec3::new(p.x, p.y, 20.0))
        .collect();
    let sphere = Params {
        center: CenterMethod::Sphere,
        ..params()
    };
    assert_eq!(error_of(&Cloud::new(flat), &sphere), CenterError::NoSphere.into());
}

#[test]
fn the_viewpoint_must_lie_outside_the_cloud() {
    let around: Vec<_> = scattered(1, 300).iter().map(|p| p.normalize()).collect();
    let error = error_of(&Cloud::new(around.clone()), &params());
    assert!(
        matches!(error, AnalysisError::ViewpointInsideCloud { .. }),
        "{error}"
    );
    assert!(is_viewpoint_inside(&around, DVec3::new(0.3, 0.3, -0.5)));
    assert!(!is_viewpoint_inside(&around, DVec3::new(0.9, 0.9, -0.9)));
    // A stray point behind the camera does not put the camera inside.
    let mut seen = view(1, 500).points;
    assert!(!is_viewpoint_inside(&seen, DVec3::ZERO));
    seen.push(DVec3::new(0.0, 0.0, -50.0));
    assert!(!is_viewpoint_inside(&seen, DVec3::ZERO));
}

#[test]
fn params_out_of_range_are_refused() {
    let cloud = Cloud::new(view(1, 100).points);
    let check = |change: fn(&mut Params)| {
        let mut params = params();
        change(&mut params);
        matches!(error_of(&cloud, &params), AnalysisError::Params(_))
    };
    assert!(check(|p| p.u = 4));
    assert!(check(|p| p.tau_cm_per_rad = -0.1));
    assert!(check(|p| p.tau_cm_per_rad = f64::NAN));
    assert!(check(|p| p.min_partner_fraction = 1.1));
    assert!(check(|p| p.viewpoint.x = f64::INFINITY));
    assert!(check(|p| p.center = CenterMethod::Given(DVec3::NAN)));
    assert!(check(|p| p.filters.voxel_cm = Some(0.0)));
    assert!(check(|p| p.tau_cm_per_rad = 1e308));
    assert!(check(|p| p.viewpoint.y = -1e300));
    assert!(check(|p| p.center = CenterMethod::Given(DVec3::splat(1e200))));
    // More random points than memory.
    let endless = RandomSearch {
        count: usize::MAX,
        ..RandomSearch::default()
    };
    let mut params = params();
    params.center = CenterMethod::Equidistant(endless);
    assert_eq!(params.check(), Err(ParamError::TooManyRandomPoints(usize::MAX)));
}

#[test]
fn every_result_names_its_preset() {
    assert_eq!(
        Params::new(Preset::AsPrinted, Unit::Meter).preset_name(),
        "as-printed"
    );
    assert_eq!(params().preset_name(), "as-intended");
    assert_eq!(
        Params { u: 12, ..params() }.preset_name(),
        "as-intended",
        "u is free in either reading"
    );
    assert_eq!(
        Params {
            aggregation: Aggregation::Sum,
            ..params()
        }
        .preset_name(),
        "custom"
    );
    assert_eq!(
        Params {
            center: CenterMethod::Sphere,
            ..params()
        }
        .preset_name(),
        "custom"
    );
    assert_eq!(
        Params {
            min_partner_fraction: 0.2,
            ..params()
        }
        .preset_name(),
        "custom"
    );
}

#[test]
fn the_presets_differ_as_the_lesson_says() {
    let cloud = Cloud::new(view(4, 1200).points);
    let printed = analyze(&cloud, &Params::new(Preset::AsPrinted, Unit::Centimeter), &()).unwrap();
    assert!(
        printed
            .warnings
            .iter()
            .any(|w| matches!(w, Warning::HardlyAnyPartner { .. })),
        "{:?}",
        printed.warnings
    );
    let intended = analyze(&cloud, &params(), &()).unwrap();
    assert!(
        !intended
            .warnings
            .iter()
            .any(|w| matches!(w, Warning::HardlyAnyPartner { .. }))
    );
    // The mean lies in front of the body's center, towards the camera; the equidistant point near it.
    let center = view(4, 1).center;
    assert!(printed.center.z < center.z - 0.8);
    assert!((intended.center.z - center.z).abs() < 0.8, "{}", intended.center);
}

#[test]
fn no_symmetry_plane_is_a_result_and_not_a_failure() {
    let cloud = Cloud::new(view(4, 300).points);
    let all = Params {
        min_partner_fraction: 1.0,
        ..params()
    };
    let analysis = analyze(&cloud, &all, &()).unwrap();
    assert!(analysis.best.is_err() && analysis.axis.is_none());
    assert!(
        matches!(analysis.warnings[..], [Warning::NoSymmetryPlane(_)]),
        "{:?}",
        analysis.warnings
    );
}

/// Calls the work off once the given stage has begun.
struct CallOff(&'static str, std::sync::atomic::AtomicBool);

impl Watch for CallOff {
    fn is_cancelled(&self) -> bool {
        self.1.load(std::sync::atomic::Ordering::Relaxed)
    }
}

impl Observe for CallOff {
    fn entered(&self, stage: axiscope::method::Stage) {
        if format!("{stage:?}") == self.0 {
            self.1.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    }
}

#[test]
fn long_stages_can_be_called_off() {
    let cloud = Cloud::new(view(4, 300).points);
    for stage in ["Normals", "Center", "PlaneTerms"] {
        let error = analyze(&cloud, &params(), &CallOff(stage, false.into())).unwrap_err();
        assert!(error.is_cancelled(), "{stage}: {error}");
    }
    assert_eq!(AnalysisError::from(Cancelled).to_string(), "cancelled");
}
