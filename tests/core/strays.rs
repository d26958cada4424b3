//! Points that lie far from the rest of a cloud: found, counted and left out, and never found where there are none.

use std::sync::LazyLock;

use axiscope::estimate::Surface;
use axiscope::fruit::{parse_cloud, unit_guess};
use axiscope::geometry::{Cloud, Extent, Unit, strays};
use axiscope::method::{Analysis, Params, Preset, Warning, analyze, axis_error_rad};
use axiscope::peduncle::Peduncle;
use axiscope::simulate::{DepthCamera, PepperSettings};
use axiscope::view::{Coloring, ShownPoints, Subject, color_points};
use glam::DVec3;
use proptest::prelude::*;

use crate::helpers::bodies::{rotation, scattered, view};

fn pepper(seed: u64) -> Cloud {
    let settings = PepperSettings {
        seed,
        camera: DepthCamera {
            width_px: 640,
            height_px: 480,
            focal_px: 480.0,
            ..DepthCamera::default()
        },
        ..PepperSettings::default()
    };
    settings.simulate().expect("a pepper").cloud
}

static PEPPERS: LazyLock<Vec<(Cloud, Analysis)>> = LazyLock::new(|| {
    let analyzed = |seed| {
        let cloud = pepper(seed);
        let analysis = analysis(&cloud);
        (cloud, analysis)
    };
    (0..4).map(analyzed).collect()
});

fn analysis(cloud: &Cloud) -> Analysis {
    analyze(cloud, &Params::new(Preset::AsIntended, Unit::Centimeter), &()).expect("an analysis")
}

/// The kinds of strays of one cloud.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// On a sphere around the cloud.
    At(f64),
    /// Anywhere in a cube around the cloud of this half edge.
    Within(f64),
    /// At the camera.
    Zero,
}

/// Strays in random places among the points of a cloud.
fn with_strays(cloud: &Cloud, kind: Kind, count: usize, seed: u64) -> Cloud {
    let middle = Extent::of(cloud.positions()).expect("points").center();
    let places = scattered(seed, count).into_iter().map(|v| match kind {
        Kind::At(distance) => middle + distance * v.normalize(),
        // Outside the fruit itself.
        Kind::Within(half) => middle + half * v + 25.0 * v.normalize(),
        Kind::Zero => DVec3::ZERO,
    });
    let mut points = cloud.positions().to_vec();
    for (i, place) in places.enumerate() {
        points.insert(i * 7919 % points.len(), place);
    }
    Cloud::new(points)
}

fn warned(analysis: &Analysis) -> Option<usize> {
    analysis.warnings.iter().find_map(|w| match w {
        Warning::StraysLeftOut { strays, .. } => Some(*strays),
        _ => None,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn strays_leave_the_axis_where_it_is(
        pepper in 0usize..4, share in 0.001f64..0.05, single: bool, seed: u64,
        kind in prop::sample::select(vec![
            Kind::At(100.0), Kind::At(500.0), Kind::At(1e12), Kind::At(1e300), Kind::Within(100.0), Kind::Zero,
        ]),
    ) {
        let (clean, expected) = &PEPPERS[pepper];
        let count = if single { 1 } else { (share * clean.len() as f64) as usize };
        let cloud = with_strays(clean, kind, count, seed);
        let found = analysis(&cloud);
        let (ours, theirs) = (found.axis.as_ref().expect("an axis"), expected.axis.as_ref().expect("an axis"));
        let turned = axis_error_rad(ours, theirs).to_degrees();
        prop_assert!(turned < 2.0, "{count} strays turn the axis by {turned:.1}°");
        prop_assert_eq!(warned(&found), Some(count));
        prop_assert_eq!(found.strays.len(), count);
        // Results are those of the cloud without them.
        prop_assert_eq!(found.center, expected.center);
        let unit = |cloud: &Cloud| unit_guess::resolve(cloud, None).0;
        prop_assert_eq!(unit(&cloud), unit(clean));
        prop_assert_eq!(Extent::robust(cloud.positions()), Extent::robust(clean.positions()));
        let surface = |cloud: &Cloud| Surface::new(cloud.positions(), Unit::Centimeter, DVec3::ZERO, &()).ok();
        prop_assert!(surface(&cloud).is_some() && surface(&cloud) == surface(clean), "other estimators");
        let shown = ShownPoints::new(&cloud, &found);
        prop_assert_eq!(&shown.strays, &*found.strays);
        prop_assert!(shown.local_positions.iter().all(|p| p.is_finite()));
    }

    #[test]
    fn nothing_depends_on_unit_frame_or_order(seed in 0u64..1000, scale in prop::sample::select(vec![1e-100, 1e-3, 1.0, 1e3, 1e100])) {
        let cloud = with_strays(&PEPPERS[0].0, Kind::Within(60.0), 100, seed);
        let turn = rotation(seed);
        let moved: Vec<DVec3> = cloud.positions().iter().map(|&p| scale * p).collect();
        prop_assert_eq!(strays(&moved), strays(cloud.positions()));
        let far: Vec<DVec3> = cloud.positions().iter().map(|&p| turn * (p + DVec3::new(300.0, 0.0, 20.0))).collect();
        prop_assert_eq!(strays(&far).len(), strays(cloud.positions()).len());
        let reversed: Vec<DVec3> = cloud.positions().iter().rev().copied().collect();
        prop_assert_eq!(strays(&reversed).len(), strays(cloud.positions()).len());
    }

    #[test]
    fn clean_clouds_have_none(seed: u64, count in 4usize..3000) {
        prop_assert_eq!(strays(&view(seed, count).points), Vec::<usize>::new());
        prop_assert_eq!(strays(&scattered(seed, count)), Vec::<usize>::new());
        // A line, a disk, and a heap of one place.
        let flat: Vec<DVec3> = scattered(seed, count).iter().map(|p| p * DVec3::new(1.0, 1.0, 0.0)).collect();
        prop_assert_eq!(strays(&flat), Vec::<usize>::new());
        let line: Vec<DVec3> = flat.iter().map(|p| DVec3::X * p.x).collect();
        prop_assert_eq!(strays(&line), Vec::<usize>::new());
        prop_assert_eq!(strays(&vec![DVec3::ONE; count]), Vec::<usize>::new());
    }
}

#[test]
fn simulated_and_stored_clouds_have_none() {
    for seed in 0..150 {
        let camera = DepthCamera {
            width_px: 320,
            height_px: 240,
            focal_px: 240.0,
            ..DepthCamera::default()
        };
        let settings = PepperSettings {
            seed,
            camera,
            ..PepperSettings::default()
        };
        let cloud = settings.simulate().expect("a pepper").cloud;
        assert_eq!(strays(cloud.positions()), Vec::<usize>::new(), "pepper {seed}");
    }
    for file in ["bumpy_cm.ply", "tapered_m.ply"] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/fixtures")
            .join(file);
        let cloud = parse_cloud(file, &std::fs::read(path).unwrap())
            .unwrap()
            .ply
            .cloud;
        assert_eq!(strays(cloud.positions()), Vec::<usize>::new(), "{file}");
    }
}

#[test]
fn strays_are_no_part_of_the_peduncle_whatever_their_label() {
    let clean = &PEPPERS[0].0;
    let expected = Peduncle::by_label(clean).expect("a peduncle");
    let mut points = clean.positions().to_vec();
    let mut labels = clean.labels().expect("labels").to_vec();
    points.extend([DVec3::splat(400.0), DVec3::splat(-1e9)]);
    labels.extend([Cloud::PEDUNCLE; 2]);
    let cloud = Cloud::new(points).with_labels(labels).expect("one each");
    assert_eq!(Peduncle::by_label(&cloud), Ok(expected));
}

#[test]
fn strays_have_a_color_of_their_own() {
    let (clean, _) = &PEPPERS[0];
    let cloud = with_strays(clean, Kind::At(500.0), 7, 1);
    let colored = |keep_strays| {
        let mut params = Params::new(Preset::AsIntended, Unit::Centimeter);
        params.filters.keep_strays = keep_strays;
        let analysis = analyze(&cloud, &params, &()).expect("an analysis");
        let shown = ShownPoints::new(&cloud, &analysis);
        let subject = Subject {
            shown: &shown,
            analysis: &analysis,
            detail: None,
        };
        let colored = color_points(subject, Coloring::Normal).expect("it has normals");
        let swatches = colored.legend.swatches.iter().filter(|s| s.label == "stray");
        let counts: Vec<_> = swatches
            .map(|s| (s.color, s.count.map(|(count, _)| count)))
            .collect();
        (
            counts,
            shown
                .strays
                .iter()
                .map(|&i| colored.colors[i])
                .collect::<Vec<_>>(),
        )
    };
    let (counts, colors) = colored(false);
    assert_eq!(counts, [(colors[0], Some(7))]);
    assert_eq!(colors, [colors[0]; 7]);
    assert!(colored(true).0.is_empty(), "they have normals like any other");
}

#[test]
fn strays_are_kept_where_the_switch_says_so_and_still_said() {
    let (clean, expected) = &PEPPERS[0];
    let cloud = with_strays(clean, Kind::At(500.0), 5, 1);
    let mut params = Params::new(Preset::AsIntended, Unit::Centimeter);
    params.filters.keep_strays = true;
    let found = analyze(&cloud, &params, &()).expect("an analysis");
    assert_eq!(found.surface.len(), clean.len() + 5);
    let kept = |w: &&Warning| matches!(w, Warning::StraysKept { strays: 5, .. });
    assert_eq!(
        found.warnings.iter().filter(kept).count(),
        1,
        "{:?}",
        found.warnings
    );
    let mut unchanged = analyze(clean, &params, &()).expect("an analysis");
    unchanged.params.filters.keep_strays = false;
    assert_eq!(&unchanged, expected);
}
