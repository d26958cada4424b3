//! `axiscope analyze` as other programs rely on it: options, fields, exit statuses, streams.

use crate::helpers::command_line::{analyze, fixture, json, keys, run, simulate};
use serde_json::Value;
use tempfile::TempDir;

#[test]
fn the_json_has_the_fields_that_others_rely_on() {
    let report = json(
        &fixture("tapered_m.ply"),
        "--unit m --center -0.01,0.015,0.4 --viewpoint 0.05,0.02,-0.03",
    );
    let mut fields = keys(&report);
    fields.sort_unstable();
    let expected = [
        "axis",
        "best",
        "center",
        "cloud",
        "error_parts",
        "estimates",
        "params",
        "peduncle_disagreement_deg",
        "planes",
        "point",
        "prior",
        "reference",
        "references",
        "schema",
        "timings_ms",
        "warnings",
    ];
    assert_eq!(fields, expected);
    assert_eq!(report["schema"], "axiscope.analysis/1");
    let cloud = &report["cloud"];
    assert_eq!(cloud["unit"], "m");
    assert_eq!(cloud["points"], cloud["used_points"]);
    assert_eq!(cloud["sha256"].as_str().map(str::len), Some(64));
    assert!(
        cloud["file"]
            .as_str()
            .is_some_and(|f| f.ends_with("tapered_m.ply"))
    );
    assert_eq!(report["center"], serde_json::json!([-0.01, 0.015, 0.4]));
    assert_eq!(report["params"]["preset"], "custom");
    assert_eq!(report["params"]["normals"], "file");
    let planes = report["planes"].as_array().expect("planes");
    assert_eq!(planes.len(), 36);
    assert_eq!(
        (&planes[7]["g"], &planes[7]["h"]),
        (&2.into(), &2.into()),
        "g-major"
    );
    let mut fields = keys(&planes[0]);
    fields.sort_unstable();
    let expected = [
        "alpha_rad",
        "angle_sum_rad",
        "beta_rad",
        "distance_sum_cm",
        "g",
        "h",
        "normal",
        "partners",
        "score",
    ];
    assert_eq!(fields, expected);
    // The score is what the sums say, and null below the partner fraction.
    let points = cloud["points"].as_f64().expect("a count");
    for plane in planes {
        let number = |key: &str| plane[key].as_f64().expect("a number");
        match plane["score"].as_f64() {
            Some(score) => {
                let sum = number("distance_sum_cm") + 3.0 / std::f64::consts::PI * number("angle_sum_rad");
                assert!((score - sum / number("partners")).abs() < 1e-12);
            }
            None => assert!(number("partners") < 0.3 * points),
        }
    }
    assert!(planes.iter().any(|p| p["score"].is_null()));
    let best = &report["best"];
    assert!(best["score"].as_f64() < best["runner_up_score"].as_f64());
    assert_eq!(report["axis"]["origin"], report["center"]);
    assert!(
        report["reference"].is_null(),
        "nothing tells where a peduncle would be"
    );
    for stage in ["read", "normals", "center", "plane_terms", "total"] {
        assert!(report["timings_ms"][stage].as_f64().is_some(), "{stage}");
    }
}

#[test]
fn nothing_found_is_null_and_said_in_words() {
    let report = json(&fixture("bumpy_cm.ply"), "--min-partner-fraction 1");
    assert!(report["best"].is_null() && report["axis"].is_null());
    assert!(
        report["planes"]
            .as_array()
            .is_some_and(|p| p.iter().all(|p| p["score"].is_null()))
    );
    assert!(
        report["warnings"]
            .to_string()
            .contains("No candidate plane has a partner for 100 %")
    );
    let text = analyze(&fixture("bumpy_cm.ply"), "--min-partner-fraction 1");
    assert_eq!(text.status, 0);
    assert!(text.out.contains("Symmetry axis   none"), "{}", text.out);
}

#[test]
fn presets_and_single_options_say_what_is_in_force() {
    let params = |options: &str| json(&fixture("bumpy_cm.ply"), options)["params"].clone();
    let printed = params("--preset as-printed");
    assert_eq!(printed["preset"], "as-printed");
    assert_eq!(
        (&printed["center"], &printed["aggregate"]),
        (&"mean-rms".into(), &"sum".into())
    );
    assert_eq!(printed["min_partner_fraction"], 0.0);
    let default = params("");
    assert_eq!(default["preset"], "as-intended");
    assert_eq!(
        (&default["center"], &default["aggregate"]),
        (&"equidistant".into(), &"mean".into())
    );
    assert_eq!(default["min_partner_fraction"], 0.3);
    assert_eq!(
        (&default["u"], &default["k"], &default["unit"]),
        (&6.into(), &30.into(), &"cm".into())
    );
    assert_eq!(params("--aggregate sum")["preset"], "custom");
    assert_eq!(
        params("--aggregate sum")["min_partner_fraction"],
        0.0,
        "the fraction goes with the mean"
    );
    assert_eq!(
        params("--aggregate sum --min-partner-fraction 0.2")["min_partner_fraction"],
        0.2
    );
    assert_eq!(params("--tau 0.5 --u 9 --k 12 --seed 7")["tau"], 0.5);
    assert_eq!(params("--center sphere")["center_samples"], Value::Null);
}

#[test]
fn negative_coordinates_may_follow_a_space() {
    let report = json(
        &fixture("bumpy_cm.ply"),
        "--center -1,-2.5,31 --viewpoint -1,0,-2",
    );
    assert_eq!(report["center"], serde_json::json!([-1.0, -2.5, 31.0]));
    assert_eq!(
        report["params"]["viewpoint"],
        serde_json::json!([-1.0, 0.0, -2.0])
    );
}

#[test]
fn a_run_repeats_to_the_bit_on_any_number_of_threads() {
    let folder = TempDir::new().unwrap();
    let cloud = simulate(&folder, "pepper --seed 3", "pepper.ply");
    let result = |options: &str| {
        let mut report = json(&cloud, options);
        report.as_object_mut().expect("an object").remove("timings_ms");
        for estimate in report["estimates"].as_array_mut().expect("a list") {
            estimate.as_object_mut().expect("an object").remove("ms");
        }
        report.to_string()
    };
    let first = result("--seed 5");
    assert_eq!(first, result("--seed 5"));
    assert_ne!(
        first,
        result("--seed 6"),
        "the seed moves the center's random points"
    );
    if cfg!(feature = "parallel") {
        for threads in [1, 2, 3, 7] {
            assert_eq!(
                first,
                result(&format!("--seed 5 --threads {threads}")),
                "{threads} threads"
            );
        }
    }
}

#[test]
fn wrong_usage_is_2() {
    let good = fixture("bumpy_cm.ply");
    for wrong in [
        "--u 4",
        "--u 4.5",
        "--u 361",
        "--tau -1",
        "--tau nan",
        "--tau inf",
        "--k 2",
        "--k x",
        "--unit km",
        "--center 1,2",
        "--center 1,2,x",
        "--center nan,0,0",
        "--center round",
        "--viewpoint 1,2",
        "--aggregate median",
        "--min-partner-fraction 1.5",
        "--min-partner-fraction -0.1",
        "--format xml",
        "--preset intended",
        "--seed -1",
        "--threads 0",
        "--voxel-cm 0",
        "--outlier-neighbors 0",
        "--outlier-std 1",
        "--peduncle hue=10",
        "--peduncle hue=5..400",
        "--normals none",
        "--no-such-option",
    ] {
        let ran = analyze(&good, wrong);
        assert_eq!(ran.status, 2, "{wrong}: {}", ran.err);
        assert!(ran.out.is_empty() && !ran.err.is_empty(), "{wrong}");
    }
    assert_eq!(run(["analyze"]).status, 2, "no cloud");
    assert_eq!(run(["no-such-command"]).status, 2);
    // Nothing at all opens the window, where there is one.
    if !cfg!(feature = "window") {
        assert_eq!(run([""; 0]).status, 2, "nothing at all");
    }
    assert_eq!(run(["simulate", "pepper", "--leaf-cover", "5"]).status, 2);
    assert_eq!(
        run(["simulate", "pepper", "--count", "3", "-o", "x.ply"]).status,
        2
    );
}

#[test]
fn wrong_input_is_1_and_one_line_that_names_file_and_cause() {
    let good = fixture("bumpy_cm.ply");
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let header = |n: usize| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex {n}\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        )
    };
    let rows = |points: &[[i32; 3]]| {
        points
            .iter()
            .fold(String::new(), |rows, [x, y, z]| rows + &format!("{x} {y} {z}\n"))
    };
    let corners: Vec<[i32; 3]> = (0..8)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| 2 * bit - 1))
        .collect();
    let line: Vec<[i32; 3]> = (0..40).map(|i| [i, i, 9]).collect();
    let wrong = [
        (folder.path().join("absent.ply"), "no such file"),
        (folder.path().to_path_buf(), "folder"),
        (write("empty.ply", ""), "empty"),
        (write("text.ply", "hello\n"), "ply"),
        (write("short.ply", &(header(9) + "1 2 3\n")), "end"),
        (write("word.ply", &(header(1) + "1 2 three\n")), "line 8"),
        (
            write("few.ply", &(header(3) + "0 0 9\n1 0 9\n0 1 9\n")),
            "3 points",
        ),
        (write("equal.ply", &(header(40) + &"1 2 3\n".repeat(40))), "equal"),
        (write("line.ply", &(header(40) + &rows(&line))), "line"),
        (write("inside.ply", &(header(8) + &rows(&corners))), "viewpoint"),
    ];
    for (path, cause) in wrong {
        let ran = analyze(&path, "");
        assert_eq!(ran.status, 1, "{}: {}", path.display(), ran.err);
        assert!(ran.out.is_empty(), "data on standard output: {}", ran.out);
        let name = path.file_name().unwrap().to_str().unwrap();
        assert!(
            ran.err.contains(name) && ran.err.contains(cause),
            "{name}, {cause}: {}",
            ran.err
        );
        assert_eq!(ran.err.trim_end().lines().count(), 1, "{}", ran.err);
    }
    for (options, cause) in [
        ("--peduncle label", "label"),
        ("--peduncle hue=90..150", "color"),
        ("--peduncle absent.ply", "absent.ply"),
    ] {
        let ran = analyze(&good, options);
        assert_eq!(ran.status, 1, "{options}: {}", ran.err);
        assert!(ran.err.contains(cause), "{options}: {}", ran.err);
    }
    let bare = write("bare.ply", &(header(4) + "0 0 9\n1 0 9\n0 1 9\n1 1 9.5\n"));
    assert_eq!(analyze(&bare, "--normals file").status, 1);
    assert_eq!(analyze(&bare, "").status, 0);
}

#[test]
fn the_peduncle_comes_from_labels_a_companion_or_color() {
    let folder = TempDir::new().unwrap();
    let labeled = simulate(&folder, "pepper --seed 3 --color red", "labeled.ply");
    let by_label = json(&labeled, "");
    assert_eq!(by_label["reference"]["kind"], "peduncle");
    let error = by_label["reference"]["error_deg"].as_f64().expect("an error");
    assert!((0.0..=90.0).contains(&error));
    assert!(json(&labeled, "--peduncle none")["reference"].is_null());

    // The same fruit as two files, without labels in either.
    let cloud = axiscope::fruit::read_cloud(&labeled).unwrap().ply.cloud;
    let labels = cloud.labels().unwrap();
    let write = |name: &str, keep: &dyn Fn(i32) -> bool| {
        let kept: Vec<usize> = (0..cloud.len()).filter(|&i| keep(labels[i])).collect();
        let part = axiscope::geometry::Cloud::new(cloud.select(&kept).positions().to_vec());
        let mut bytes = Vec::new();
        axiscope::ply::write(&mut bytes, &part, &axiscope::ply::WriteOptions::default()).unwrap();
        std::fs::write(folder.path().join(name), bytes).unwrap();
        folder.path().join(name)
    };
    let bare = write("bare.ply", &|_| true);
    assert!(json(&bare, "--unit cm")["reference"].is_null());
    let companion = write("bare_peduncle.ply", &|label| label == 1);
    let by_companion = json(&bare, "--unit cm");
    let direction = |report: &Value| {
        report["reference"]["direction"]
            .as_array()
            .map(|d| d.iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>())
    };
    let same = |a: &Value, b: &Value| {
        direction(a)
            .unwrap()
            .iter()
            .zip(direction(b).unwrap())
            .all(|(a, b)| (a - b).abs() < 1e-6)
    };
    assert!(same(&by_label, &by_companion));
    let named = json(&bare, &format!("--unit cm --peduncle {}", companion.display()));
    assert!(same(&by_label, &named));
    let by_hue = json(&labeled, "--peduncle hue=60..160");
    assert!(by_hue["reference"]["error_deg"].is_number());

    // Without the peduncle's points, whichever way they are known.
    let peduncle = labels.iter().filter(|&&l| l == 1).count() as u64;
    let points = cloud.len() as u64;
    for (cloud, options) in [(&labeled, ""), (&bare, "--unit cm")] {
        let report = json(cloud, &format!("{options} --without-peduncle"));
        assert_eq!(report["cloud"]["points"], points);
        let used = report["cloud"]["used_points"].as_u64().unwrap();
        assert!(
            used <= points - peduncle && used + 50 > points - peduncle,
            "{used} of {points} less {peduncle}"
        );
        assert_eq!(report["reference"]["kind"], "peduncle");
    }
}

#[test]
fn filters_thin_the_cloud_that_is_analyzed() {
    let folder = TempDir::new().unwrap();
    let cloud = simulate(&folder, "pepper --seed 3", "pepper.ply");
    let used = |options: &str| json(&cloud, options)["cloud"]["used_points"].as_u64().unwrap();
    let all = used("");
    assert!(used("--voxel-cm 0.3") < all / 2);
    let inliers = used("--outlier-neighbors 30 --outlier-std 2");
    assert!(inliers < all && inliers > all / 2);
}

#[test]
fn a_guessed_unit_is_said_and_a_given_one_is_not() {
    let guessed = json(&fixture("tapered_m.ply"), "--viewpoint 0.05,0.02,-0.03");
    assert_eq!(guessed["cloud"]["unit"], "m");
    assert!(guessed["warnings"].to_string().contains("guessed"));
    let given = json(&fixture("tapered_m.ply"), "--viewpoint 0.05,0.02,-0.03 --unit m");
    assert!(!given["warnings"].to_string().contains("guessed"));
}
