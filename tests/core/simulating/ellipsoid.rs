//! The paper's ellipsoid: on its surface, facing the camera, spread evenly.

use axiscope::simulate::{EllipsoidSettings, SimulateError};
use glam::DVec3;

use super::{refused, rms};

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
    assert_eq!(around_us.simulate().err(), Some(SimulateError::ViewpointInside));
    let nearly_around_us = EllipsoidSettings {
        half_axes_cm: DVec3::splat(24.999_999),
        center_cm: DVec3::new(0.0, 0.0, 25.0),
        points: 100,
        ..EllipsoidSettings::default()
    };
    let too_little = nearly_around_us.simulate().err();
    assert!(
        matches!(too_little, Some(SimulateError::TooLittleVisible { .. })),
        "{too_little:?}"
    );
}
