//! Clouds of more points than are analyzed: the sample that stands for them.

use crate::helpers::bodies::{scattered, view};
use axiscope::geometry::{Cloud, Unit, voxel_edge_for, voxel_grid};
use axiscope::method::{Analysis, CenterMethod, Filters, Params, Preset, Warning, analyze};
use axiscope::parallel::Watch;
use axiscope::view::ShownPoints;
use glam::DVec3;
use proptest::prelude::*;

fn params(max_points: usize) -> Params {
    let mut params = Params::new(Preset::AsIntended, Unit::Centimeter);
    params.filters.max_points = max_points;
    params
}

fn warning(analysis: &Analysis) -> Option<&Warning> {
    analysis
        .warnings
        .iter()
        .find(|w| matches!(w, Warning::Sampled { .. }))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_edge_leaves_no_more_than_allowed_and_not_many_fewer(
        seed in 0u64..1000, most in 100usize..1500, kind in 0usize..4, scale in prop::sample::select(vec![1e-6, 1.0, 1e6]),
    ) {
        let even = scattered(seed, 4000);
        let shape = |p: &DVec3| scale * match kind {
            0 => *p,
            1 => p.normalize(),
            2 => DVec3::new(p.x, p.y, 0.0),
            // Most points in a heap, and a few far away.
            _ => if p.x < 0.9 { *p } else { 300.0 * *p },
        };
        let points: Vec<DVec3> = even.iter().map(shape).collect();
        let edge = voxel_edge_for(&points, most, &()).unwrap().expect("there are more");
        let left = voxel_grid(&Cloud::new(points), edge).len();
        prop_assert!(left <= most, "{left} of {most}");
        prop_assert!(left as f64 > 0.7 * most as f64, "{left} of {most}");
    }

    #[test]
    fn a_voxel_grid_is_the_same_however_its_cells_are_counted(seed in 0u64..1000, count in 1usize..200) {
        // A stray so far away that cells no longer fit in one number changes nothing for the others.
        let points = scattered(seed, count);
        let alone = voxel_grid(&Cloud::new(points.clone()), 0.3);
        let mut with_stray = points;
        with_stray.push(DVec3::splat(1e7));
        let both = voxel_grid(&Cloud::new(with_stray), 0.3);
        prop_assert_eq!(alone.positions(), &both.positions()[..both.len() - 1]);
    }
}

#[test]
fn clouds_that_are_small_enough_need_no_edge_and_nothing_is_enough_for_equal_points() {
    let points = scattered(1, 100);
    assert_eq!(voxel_edge_for(&points, 100, &()), Ok(None));
    assert_eq!(voxel_edge_for(&vec![DVec3::ONE; 300], 100, &()), Ok(None));
    // Few places, however many points: any fine grid keeps them all.
    let places: Vec<DVec3> = points.iter().flat_map(|&p| [p; 5]).collect();
    let edge = voxel_edge_for(&places, 200, &()).unwrap().unwrap();
    assert_eq!(voxel_grid(&Cloud::new(places), edge).len(), 100);
}

#[test]
fn a_sample_is_said_to_be_one_and_finds_nearly_the_same_axis() {
    let v = view(5, 6000);
    let cloud = Cloud::new(v.points.clone());
    let whole = analyze(&cloud, &params(Filters::MOST), &()).unwrap();
    assert_eq!((warning(&whole), whole.sample_edge), (None, None));
    assert_eq!(whole.surface.len(), 6000);
    let sampled = analyze(&cloud, &params(1500), &()).unwrap();
    let edge = sampled.sample_edge.unwrap();
    let Some(&Warning::Sampled {
        sampled: used,
        points,
        most,
        edge_cm,
    }) = warning(&sampled)
    else {
        panic!("{:?}", sampled.warnings);
    };
    assert_eq!((points, most, edge_cm), (6000, 1500, edge));
    assert_eq!(used, sampled.surface.len());
    assert!((1000..=1500).contains(&used), "{used}");
    assert!(
        sampled.center.distance(whole.center) < 0.3,
        "{} {}",
        sampled.center,
        whole.center
    );
    let text = warning(&sampled).unwrap().to_string();
    assert!(
        text.starts_with(&format!("{used} of 6000 points are analyzed")),
        "{text}"
    );
}

#[test]
fn a_sample_of_hardly_any_points_is_refused() {
    let cloud = Cloud::new(view(5, 300).points);
    let error = analyze(&cloud, &params(99), &()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a sample must be allowed at least 100 points, not 99"
    );
}

#[test]
fn looking_for_the_edge_can_be_called_off() {
    struct Never;
    impl Watch for Never {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    assert!(voxel_edge_for(&scattered(1, 500), 100, &Never).is_err());
}

#[test]
fn every_point_of_a_sampled_cloud_is_shown_as_the_used_point_nearest_to_it() {
    let v = view(7, 5000);
    let mut points = v.points.clone();
    // A stray that the outlier filter takes away belongs to no used point.
    points.push(v.center + DVec3::new(0.0, 30.0, 0.0));
    let cloud = Cloud::new(points);
    let mut params = params(1200);
    params.center = CenterMethod::Given(v.center);
    params.filters.outliers = Some(axiscope::method::OutlierFilter {
        neighbors: std::num::NonZeroUsize::new(10).unwrap(),
        std_ratio: 8.0,
    });
    let analysis = analyze(&cloud, &params, &()).unwrap();
    let edge = analysis.sample_edge.unwrap();
    let shown = ShownPoints::new(&cloud, &analysis);
    assert_eq!(*shown.positions, cloud.positions());
    let used = analysis.surface.points();
    for (p, found) in shown.positions.iter().zip(shown.in_surface.iter()) {
        let nearest = used.iter().map(|q| q.distance(*p)).fold(f64::INFINITY, f64::min);
        match found {
            Some(i) => assert_eq!(used[i].distance(*p), nearest),
            None => assert!(nearest > 1.73 * edge, "{nearest} {edge}"),
        }
    }
    assert_eq!(shown.in_surface.iter().last(), Some(None));
    let without = shown.in_surface.iter().filter(Option::is_none).count();
    assert!(without < 50, "{without}");
}

#[test]
fn the_mean_of_the_largest_numbers_is_a_point_like_any_other() {
    // Their sum is infinite; a point that is left out would leave its label behind.
    let points = vec![DVec3::splat(1.7e308); 3];
    let cloud = Cloud::new(points).with_labels(vec![1; 3]).unwrap();
    let thinned = voxel_grid(&cloud, 1e308);
    assert_eq!((thinned.len(), thinned.labels()), (1, Some(&[1][..])));
}
