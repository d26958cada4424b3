//! Numbers at the ends of what a computer can hold: a sentence or a right result, never a null, NaN or infinite one.

use crate::helpers::command_line::{analyze, json, simulate};
use serde_json::Value;
use tempfile::TempDir;

/// A cloud with each coordinate multiplied, as doubles, and more rows of coordinates.
fn scaled(folder: &TempDir, by: f64, more: &[&str]) -> std::path::PathBuf {
    let made = simulate(folder, "ellipsoid --points 400 --encoding ascii", "made.ply");
    let text = std::fs::read_to_string(made).unwrap();
    let (header, rows) = text.split_once("end_header\n").unwrap();
    let rows: Vec<String> = rows
        .lines()
        .map(|row| {
            let xyz = row.split_whitespace().take(3).map(|x| x.parse::<f64>().unwrap());
            xyz.map(|x| format!("{:e}", by * x)).collect::<Vec<_>>().join(" ")
        })
        .chain(more.iter().map(|&row| row.to_owned()))
        .collect();
    assert!(header.contains("float"));
    let header = format!(
        "ply\nformat ascii 1.0\ncomment unit cm\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
        rows.len()
    );
    let path = folder.path().join("scaled.ply");
    std::fs::write(&path, format!("{header}end_header\n{}\n", rows.join("\n"))).unwrap();
    path
}

/// Asserts that there is a best plane with a score and an axis of unit length.
fn assert_sound(report: &Value, what: &str) {
    assert!(report["best"]["score"].is_f64(), "{what}: {}", report["best"]);
    let axis: Vec<f64> = report["axis"]["direction"]
        .as_array()
        .unwrap_or_else(|| panic!("{what}"))
        .iter()
        .map(|c| c.as_f64().unwrap())
        .collect();
    let length = axis.iter().map(|c| c * c).sum::<f64>().sqrt();
    assert!((length - 1.0).abs() < 1e-9, "{what}");
}

#[test]
fn options_at_the_ends_of_their_range_give_a_sentence_or_a_sound_result() {
    let folder = TempDir::new().unwrap();
    let cloud = simulate(&folder, "ellipsoid --points 400", "cloud.ply");
    let used = |options: &str| json(&cloud, options)["cloud"]["used_points"].as_u64();
    let mut refused = 0;
    for options in [
        "--tau 1e308",
        "--tau 1e100",
        "--tau 1e-320",
        "--center-spread 1e300",
        "--center-spread 1e-300",
        "--viewpoint 1e300,0,0",
        "--viewpoint=-1e300,1e300,1e300",
        "--center 1e300,0,0",
        "--center 1e200,0,0",
        "--voxel-cm 1e-300",
        "--voxel-cm 1e-310 --unit m",
        "--voxel-cm 1e-18",
        "--voxel-cm 1e6",
        "--voxel-cm 1e300",
        "--k 18446744073709551615",
        "--outlier-neighbors 18446744073709551615",
        "--outlier-neighbors 5 --outlier-std 1e308",
        "--max-points 18446744073709551615",
    ] {
        for options in [options.to_owned(), format!("{options} --preset as-printed")] {
            let ran = analyze(&cloud, &options);
            let text = ran.out.clone() + &ran.err;
            assert!(
                !text.contains("NaN") && !text.contains(" inf"),
                "{options}: {text}"
            );
            if ran.status == 1 {
                assert_eq!(ran.err.lines().count(), 1, "{options}: {}", ran.err);
                refused += 1;
            } else {
                assert_eq!(ran.status, 0, "{options}: {}", ran.err);
                assert_sound(&json(&cloud, &options), &options);
            }
        }
    }
    assert!(refused >= 16, "{refused}");
    // No point is lost unsaid.
    assert_eq!(used("--voxel-cm 1e-12"), Some(400));
    for (options, reason) in [
        ("--voxel-cm 1e-18", "finer than its coordinates"),
        ("--voxel-cm 1e-300", "finer than its coordinates"),
        ("--voxel-cm 1e6", "leave 1 of its 400 points"),
        ("--tau 1e308", "must be at most 1e100"),
    ] {
        let ran = analyze(&cloud, options);
        assert!(ran.err.contains(reason), "{options}: {}", ran.err);
    }
}

#[test]
fn clouds_of_any_size_give_a_sentence_or_the_same_axis() {
    let folder = TempDir::new().unwrap();
    let axis = |by: f64, options: &str| json(&scaled(&folder, by, &[]), options)["axis"]["direction"].clone();
    // Without the angle's part, which has a size of its own, nothing depends on the size.
    let expected = axis(1.0, "--tau 0");
    for power in [-60, -8, 8, 30, 64] {
        assert_eq!(axis(f64::from(power).exp2(), "--tau 0"), expected, "2^{power}");
    }
    for by in [1e-300, 1e-120, 1e110, 1e300] {
        let ran = analyze(&scaled(&folder, by, &[]), "");
        assert_eq!(ran.status, 1, "{by:e}");
        assert!(ran.err.contains("can be computed with"), "{by:e}: {}", ran.err);
    }
    // Two of them among many others are strays.
    let cloud = scaled(&folder, 1.0, &["1e300 -1e300 1e308", "1e20 1e20 1e20"]);
    let report = json(&cloud, "--tau 0");
    assert_eq!(report["axis"]["direction"], expected);
    assert!(
        report["warnings"].to_string().contains("2 of 402 points"),
        "{}",
        report["warnings"]
    );
    for options in [
        "--keep-strays",
        "--keep-strays --voxel-cm 1",
        "--keep-strays --max-points 200",
    ] {
        let ran = analyze(&cloud, options);
        assert!(
            matches!(ran.status, 0 | 1) && !ran.out.contains("NaN"),
            "{options}: {}{}",
            ran.out,
            ran.err
        );
    }
}
