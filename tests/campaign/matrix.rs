//! The matrix of strays and scales: random clouds, clean and with strays of every kind, at every size.

use axiscope::geometry::{Cloud, Unit, strays};
use axiscope::method::{CenterMethod, Params, Preset, RandomSearch, analyze, axis_error_rad};
use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::helpers::bodies::{scattered, view};
use crate::helpers::campaign::campaign;
use crate::targets;

fn params() -> Params {
    let mut params = Params::new(Preset::AsIntended, Unit::Centimeter);
    params.center = CenterMethod::Equidistant(RandomSearch {
        count: 300,
        ..RandomSearch::default()
    });
    // The angle's part has a size of its own, which a scaled cloud does not share.
    params.tau_cm_per_rad = 0.0;
    params
}

/// Some strays around a cloud of about 8 cm, 30 cm away: at a distance, in a haze, in a heap, or at the camera.
fn with_strays(points: &[DVec3], random: &mut ChaCha8Rng) -> (Vec<DVec3>, usize) {
    let count = 1 + points.len() * random.random_range(0..50) / 1000;
    let reach = 10_f64.powf(random.random_range(2.0..14.0));
    let kind = random.random_range(0..4);
    let heap = points[0] + reach * scattered(random.random(), 1)[0].normalize_or(DVec3::X);
    let far = scattered(random.random(), count).into_iter().map(|v| match kind {
        0 => points[0] + reach * v.normalize_or(DVec3::X),
        1 => points[0] + reach * v + 40.0 * v.normalize_or(DVec3::X),
        2 => heap + v,
        _ => DVec3::ZERO,
    });
    let mut all = points.to_vec();
    for stray in far {
        all.insert(random.random_range(0..=all.len()), stray);
    }
    (all, count)
}

#[test]
fn strays_of_every_kind() {
    campaign("strays_of_every_kind", |random| {
        let body = view(random.random(), random.random_range(300..900));
        assert!(strays(&body.points).is_empty());
        let (all, count) = with_strays(&body.points, random);
        assert_eq!(strays(&all).len(), count);
        let of = |points: Vec<DVec3>| analyze(&Cloud::new(points), &params(), &()).expect("an analysis");
        let (clean, found) = (of(body.points), of(all));
        assert_eq!((clean.center, &clean.best), (found.center, &found.best));
        if let (Some(a), Some(b)) = (&clean.axis, &found.axis) {
            assert!(axis_error_rad(a, b) == 0.0);
        }
    });
}

#[test]
fn clouds_of_every_scale() {
    campaign("clouds_of_every_scale", |random| {
        let body = view(random.random(), random.random_range(100..400));
        let scale = f64::from(random.random_range(-300..=300)).exp2();
        let scaled = Cloud::new(body.points.iter().map(|p| scale * p).collect());
        let of = |cloud: &Cloud| analyze(cloud, &params(), &());
        let here = of(&Cloud::new(body.points)).expect("an analysis");
        let there = of(&scaled).expect("an analysis");
        // A power of two changes no digit.
        assert_eq!(
            here.axis.map(|a| a.direction),
            there.axis.map(|a| a.direction),
            "{scale:e}"
        );
        targets::analyzed(&scaled, random.random());
    });
}

#[test]
fn coordinates_of_any_bits() {
    campaign("coordinates_of_any_bits", |random| {
        let mut bits = ChaCha8Rng::seed_from_u64(random.random());
        let mut coordinate = || f64::from_bits(bits.random());
        let points =
            (0..random.random_range(0..60)).map(|_| DVec3::new(coordinate(), coordinate(), coordinate()));
        targets::analyzed(&Cloud::new(points.collect()), random.random());
    });
}
