//! The truth is complete, and follows the cloud in whatever is done with it.

use axiscope::geometry::{Cloud, Unit};
use axiscope::simulate::{EllipsoidSettings, FruitColor, PepperSettings, Truth};
use glam::DVec3;

use super::{labelled, pepper, settings_of, simulate};

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
    assert!(
        simulate(settings_of(&back)) == simulated,
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
