//! What the depth camera sees of a pepper, and the errors it makes.

use std::collections::HashSet;

use axiscope::geometry::Cloud;
use axiscope::simulate::{DepthCamera, PepperSettings, Simulated};
use glam::DVec3;

use super::{exact, labelled, pepper, perfect, pixel, rms, simulate, whole};

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
