//! The unit of a cloud, stated or guessed.

use axiscope::fruit::unit_guess::{UnitSource, resolve};
use axiscope::geometry::{Cloud, Unit};
use glam::DVec3;

/// Points on a grid along x, of which the middle 96 % span `extent`.
fn spanning(extent: f64) -> Cloud {
    Cloud::new(
        (0..=100)
            .map(|i| DVec3::new(f64::from(i) / 96.0 * extent, 0.0, 400.0))
            .collect(),
    )
}

#[test]
fn a_stated_unit_is_not_guessed() {
    for unit in Unit::ALL {
        let expected = (unit, UnitSource::Stated, None);
        assert_eq!(resolve(&spanning(8.0 / unit.in_cm()), Some(unit)), expected);
    }
}

#[test]
fn a_guess_is_told() {
    let (unit, source, warning) = resolve(&spanning(8.1), None);
    assert_eq!(unit, Unit::Centimeter);
    assert!(matches!(source, UnitSource::Guessed { extent } if (extent - 8.1).abs() < 1e-9));
    let expected = "The unit was guessed: centimeters, since the points span 8.1. Use --unit to state it.";
    assert_eq!(warning.as_deref(), Some(expected));
}

#[test]
fn the_guess_is_what_makes_a_fruit_of_some_centimeters() {
    let cases = [
        (0.08, Unit::Meter),
        (0.79, Unit::Meter),
        (0.81, Unit::Centimeter),
        (25.0, Unit::Centimeter),
        (25.5, Unit::Millimeter),
        (80.0, Unit::Millimeter),
    ];
    for (extent, unit) in cases {
        assert_eq!(resolve(&spanning(extent), None).0, unit, "{extent}");
    }
}

#[test]
fn an_unlikely_size_is_told_whoever_stated_the_unit() {
    let (_, _, warning) = resolve(&spanning(80.0), Some(Unit::Centimeter));
    assert_eq!(
        warning.as_deref(),
        Some("In cm the points span 80 cm, which is unlikely for a fruit.")
    );
    let (unit, _, warning) = resolve(&spanning(0.7), None);
    let expected = "The unit was guessed: meters, since the points span 0.7. Use --unit to state it. \
                    In m the points span 70 cm, which is unlikely for a fruit.";
    assert_eq!((unit, warning.as_deref()), (Unit::Meter, Some(expected)));
    assert!(resolve(&spanning(0.9), Some(Unit::Centimeter)).2.is_some());
}

#[test]
fn stray_points_do_not_change_the_guess() {
    let mut points = spanning(8.0).positions().to_vec();
    points.push(DVec3::splat(1e6));
    points.push(DVec3::splat(-1e6));
    assert_eq!(resolve(&Cloud::new(points), None).0, Unit::Centimeter);
}

#[test]
fn no_points_are_of_some_unit_too() {
    assert!(resolve(&Cloud::new(vec![]), None).2.is_some());
}
