//! Scans from several places, fused to one cloud.

use axiscope::simulate::{DepthCamera, PepperSettings, ScanSettings, Simulated, Truth};
use sha2::{Digest, Sha256};

use super::{exact, pepper, simulate};

/// The hash of all columns of a cloud, to the bit.
fn sha256(simulated: &Simulated) -> String {
    let cloud = &simulated.cloud;
    let mut hash = Sha256::new();
    for p in cloud.positions() {
        for x in p.to_array() {
            hash.update(x.to_le_bytes());
        }
    }
    for normal in cloud.normals().into_iter().flatten() {
        for x in normal.to_array() {
            hash.update(x.to_le_bytes());
        }
    }
    for color in cloud.colors().into_iter().flatten() {
        hash.update(color);
    }
    for label in cloud.labels().into_iter().flatten() {
        hash.update(label.to_le_bytes());
    }
    hex::encode(hash.finalize())
}

/// Clouds are named by their seeds: those of a single view are the ones that they were before there were
/// several.
#[test]
fn a_single_view_is_what_it_always_was() {
    let leafy = PepperSettings {
        leaf_cover: 0.2,
        ..pepper(5)
    };
    let hashes = [pepper(0), leafy].map(|settings| sha256(&simulate(&settings)));
    let before = [
        "10d5c2007a2fc586e9812479097e627a2e0ba5911da8562dd0eeef253233f5e9",
        "90a87ea36745f7427b736b18fecc5ed1d032b0d1e49463f1033c11a76e9c6717",
    ];
    assert_eq!(hashes, before);
}

fn fused(views: u32, arc_deg: f64) -> ScanSettings {
    ScanSettings {
        views,
        arc_deg,
        ..ScanSettings::default()
    }
}

/// Peppers before cameras whose poses are known exactly.
fn exactly_fused(seed: u64, views: u32, arc_deg: f64) -> PepperSettings {
    PepperSettings {
        scan: ScanSettings {
            pose_noise_deg: 0.0,
            pose_noise_cm: 0.0,
            ..fused(views, arc_deg)
        },
        camera: exact(),
        ..pepper(seed)
    }
}

#[test]
fn two_exact_views_from_one_place_are_the_one_view() {
    let mut settings = exactly_fused(3, 2, 0.0);
    settings.scan.voxel_cm = 0.001;
    let twice = simulate(&settings);
    settings.scan = ScanSettings::default();
    let once = simulate(&settings);
    assert_eq!(twice.cloud.positions(), once.cloud.positions());
    assert_eq!(twice.cloud.labels(), once.cloud.labels());
    assert_eq!(twice.truth.coverage, once.truth.coverage);
    assert_eq!(twice.truth.axis, once.truth.axis);
}

#[test]
fn coverage_grows_with_the_arc() {
    for seed in 0..3 {
        let coverage = |arc_deg: f64| {
            let settings = PepperSettings {
                camera: DepthCamera::default(),
                ..exactly_fused(seed, 13, arc_deg)
            };
            simulate(&settings).truth.coverage.expect("measured")
        };
        let single = simulate(&pepper(seed)).truth.coverage.expect("measured");
        let mut before = single;
        assert!((0.2..0.45).contains(&single), "{single}");
        assert!((coverage(0.0) - single).abs() < 1e-12, "no way, no more");
        for arc_deg in [60.0, 120.0, 180.0, 270.0] {
            let now = coverage(arc_deg);
            assert!(
                now > before + 0.02,
                "seed {seed}: {before} then {now} at {arc_deg}"
            );
            before = now;
        }
        let around = coverage(360.0);
        assert!((0.75..1.0).contains(&around), "all but both ends: {around}");
    }
}

#[test]
fn normals_face_the_cameras_that_saw_their_points() {
    let around = simulate(&exactly_fused(2, 12, 360.0));
    let center = around.truth.center;
    let normals = around.cloud.normals().expect("fused clouds have normals");
    let outward = normals.iter().zip(around.cloud.positions());
    let outward = outward
        .filter(|(n, p)| n.as_dvec3().dot(**p - center) > 0.0)
        .count();
    let share = outward as f64 / normals.len() as f64;
    assert!(share > 0.97, "{share}");
    let behind = around.cloud.positions().iter().filter(|p| p.z > center.z).count();
    assert!(behind * 3 > around.cloud.len(), "the far side was seen, too");
}

#[test]
fn settings_of_before_there_were_scans_are_read() {
    let mut value = serde_json::to_value(pepper(4)).expect("JSON");
    value.as_object_mut().expect("an object").remove("scan");
    let old: PepperSettings = serde_json::from_value(value).expect("settings");
    assert_eq!(old, pepper(4));
    let mut truth = serde_json::to_value(simulate(&pepper(4)).truth).expect("JSON");
    truth.as_object_mut().expect("an object").remove("coverage");
    let old: Truth = serde_json::from_value(truth).expect("a truth");
    assert_eq!(old.coverage, None);
}
