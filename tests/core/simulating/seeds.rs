//! One seed, one cloud.

use axiscope::simulate::{EllipsoidSettings, FruitColor, PepperSettings, Simulated, seeds};

use glam::DVec3;

use super::{pepper, settings_of, simulate};

#[test]
fn the_same_seed_gives_the_same_cloud_to_the_bit() {
    let bits = |s: &Simulated| -> Vec<[u64; 3]> {
        let positions = s.cloud.positions().iter();
        positions.map(|p| p.to_array().map(f64::to_bits)).collect()
    };
    let leafy = PepperSettings {
        leaf_cover: 0.2,
        ..pepper(5)
    };
    for settings in [pepper(5), leafy] {
        let (a, b) = (simulate(&settings), simulate(&settings));
        assert_eq!(bits(&a), bits(&b));
        assert!(a == b, "columns and truth, too");
    }
    let a = EllipsoidSettings::default().simulate().expect("visible");
    let b = EllipsoidSettings::default().simulate().expect("visible");
    assert_eq!(bits(&a), bits(&b));
    assert!(a == b, "columns and truth, too");
}

#[test]
fn different_seeds_give_different_clouds() {
    assert!(simulate(&pepper(1)).cloud != simulate(&pepper(2)).cloud);
    assert_ne!(simulate(&pepper(1)).truth.axis, simulate(&pepper(2)).truth.axis);
    let ellipsoid = |seed| EllipsoidSettings {
        seed,
        ..EllipsoidSettings::default()
    };
    let (a, b) = (ellipsoid(1).simulate(), ellipsoid(2).simulate());
    assert!(a.expect("visible").cloud != b.expect("visible").cloud);
}

#[test]
fn a_data_set_keeps_its_first_clouds_when_it_grows() {
    let many = seeds(42, 500);
    assert_eq!(many[0], 42);
    assert_eq!(many[..10], seeds(42, 10));
    assert!(many.iter().all(|&s| s < 1 << 53), "JSON readers keep 53 bits");
    let mut all: Vec<u64> = (0..20).flat_map(|seed| seeds(seed, 500)).collect();
    all.sort_unstable();
    all.dedup();
    assert_eq!(all.len(), 20 * 500, "no two clouds share a seed");
}

#[test]
fn setting_one_thing_leaves_the_rest_to_the_seed() {
    let free = simulate(&pepper(21)).truth;
    let fixed = PepperSettings {
        width_cm: Some(6.5),
        spin_deg: Some(10.0),
        color: Some(FruitColor::Red),
        ..pepper(21)
    };
    let fixed = simulate(&fixed).truth;
    let (a, b) = (settings_of(&free), settings_of(&fixed));
    assert_eq!(a.height_cm, b.height_cm);
    assert_eq!(a.lobes, b.lobes);
    assert_eq!(a.peduncle_bend_deg, b.peduncle_bend_deg);
    assert_eq!(a.tilt_sideways_deg, b.tilt_sideways_deg);
    assert_eq!(free.axis.direction, fixed.axis.direction);
    assert_eq!(b.width_cm, Some(6.5));
}

/// Clouds are named by their seeds, in papers too: what a seed gives must not change unnoticed. Only
/// exact arithmetic is behind these numbers, so they are the same on every platform.
#[test]
fn seeds_keep_their_meaning() {
    assert_eq!(seeds(1, 3), [1, 8_232_782_446_381_918, 6_644_604_159_053_408]);
    let ellipsoid = EllipsoidSettings::default().simulate().expect("visible");
    assert_eq!(
        ellipsoid.cloud.positions()[0],
        DVec3::new(
            2.766_130_950_555_932_6,
            6.688_033_298_141_934,
            23.536_667_069_553_63
        )
    );
    let truth = simulate(&pepper(0)).truth;
    assert_eq!(settings_of(&truth).height_cm, Some(10.022_124_066_748_184));
    assert_eq!(settings_of(&truth).lobes, Some(4));
}
