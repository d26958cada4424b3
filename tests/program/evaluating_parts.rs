//! The parts of an error in `analyze` and `evaluate`: the same numbers everywhere, and the center's share as if the
//! true center had been given by hand.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::helpers::command_line::{analyze, fixture, json, run, simulate};

const OPTIONS: &str = "--voxel-cm 0.3 --u 7";

fn peppers(folder: &TempDir) -> PathBuf {
    simulate(
        folder,
        "pepper --seed 5 --count 3 --distance-cm 55,60 --unit cm",
        "set",
    )
}

fn evaluate(set: &Path, out: &Path, options: &str) -> Vec<HashMap<String, String>> {
    let args = ["evaluate", set.to_str().unwrap(), "--out", out.to_str().unwrap()];
    // Pictures are another test's.
    let pictures = if cfg!(feature = "window") {
        "--pictures 0"
    } else {
        ""
    };
    let options = format!("{OPTIONS} {pictures} {options}");
    let ran = run(args.into_iter().chain(options.split_whitespace()));
    assert_eq!(ran.status, 0, "{}", ran.err);
    let mut reader = csv::Reader::from_path(out.join("results.csv")).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn read_json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The three parts of an error.
fn parts_of(parts: &Value) -> [f64; 3] {
    ["lean_part_deg", "grid_part_deg", "choice_part_deg"].map(|name| parts[name].as_f64().unwrap())
}

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

#[test]
fn evaluate_agrees_with_analyze_on_every_part_and_the_parts_with_the_error() {
    let folder = TempDir::new().unwrap();
    let (set, out) = (peppers(&folder), folder.path().join("out"));
    let rows = evaluate(&set, &out, "");
    for row in &rows {
        let parts = &json(&set.join(&row["file"]), OPTIONS)["error_parts"];
        let (nearest, given) = (&parts["nearest_candidate"], &parts["true_center"]);
        let columns = [
            ("error_deg", &parts["error_deg"]),
            ("true_axis_error_deg", &parts["error_deg"]),
            ("lean_deg", &parts["lean_deg"]),
            ("lean_part_deg", &parts["lean_part_deg"]),
            ("grid_part_deg", &parts["grid_part_deg"]),
            ("choice_part_deg", &parts["choice_part_deg"]),
            ("nearest_candidate_g", &nearest["g"]),
            ("nearest_candidate_h", &nearest["h"]),
            ("nearest_candidate_rank", &nearest["rank"]),
            ("nearest_candidate_error_deg", &nearest["error_deg"]),
            ("center_distance_cm", &given["distance_cm"]),
            ("error_true_center_deg", &given["error_deg"]),
        ];
        for (column, value) in columns {
            assert_eq!(row[column].parse::<f64>().ok(), value.as_f64(), "{column}");
            assert!(
                value.is_number() || column == "nearest_candidate_rank",
                "{column}"
            );
        }
        for parts in [parts, given] {
            let error = parts["error_deg"].as_f64().unwrap();
            assert!(is_near(parts_of(parts).iter().sum(), error), "{parts}");
        }
        assert_eq!(row["truth"], parts["truth"].as_str().unwrap());
        let truth = read_json(&set.join(&row["file"]).with_extension("truth.json"));
        assert_eq!(row["coverage"].parse::<f64>().ok(), truth["coverage"].as_f64());
    }
    let mean = |column: &str| {
        rows.iter()
            .map(|r| r[column].parse::<f64>().unwrap())
            .sum::<f64>()
            / 3.0
    };
    let summary = &read_json(&out.join("summary.json"));
    let (means, given) = (&summary["error_parts"], &summary["error_parts"]["true_center"]);
    for (column, value) in [
        ("error_deg", &means["error_deg"]),
        ("error_deg", &summary["mean_deg"]),
        ("lean_deg", &means["lean_deg"]),
        ("lean_part_deg", &means["lean_part_deg"]),
        ("grid_part_deg", &means["grid_part_deg"]),
        ("choice_part_deg", &means["choice_part_deg"]),
        ("error_true_center_deg", &given["error_true_center_deg"]),
        ("center_distance_cm", &given["center_distance_cm"]),
    ] {
        assert!(is_near(mean(column), value.as_f64().unwrap()), "{column}");
    }
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("Where the error comes from") && page.contains("With the true center given"));
    assert!(out.join("error_by_lean.svg").is_file() && out.join("error_by_coverage.svg").is_file());
}

#[test]
fn the_center_s_share_is_that_of_the_true_center_given_by_hand() {
    let folder = TempDir::new().unwrap();
    let cloud = &peppers(&folder).join("pepper_001.ply");
    let truth = read_json(&cloud.with_extension("truth.json"));
    let numbers = |value: &Value| {
        value
            .as_array()
            .unwrap()
            .iter()
            .map(|v| v.as_f64().unwrap())
            .collect()
    };
    let (center, axis): (Vec<f64>, Vec<f64>) =
        (numbers(&truth["center"]), numbers(&truth["axis"]["direction"]));
    let given = format!("{OPTIONS} --center {},{},{}", center[0], center[1], center[2]);
    for choice in ["simulation", "peduncle", "peduncle-direction"] {
        let option = if choice == "simulation" { "truth" } else { choice };
        let report = json(cloud, &format!("{OPTIONS} --truth {option}"));
        let parts = &report["error_parts"];
        let by_hand = json(cloud, &given);
        let references = by_hand["references"].as_array().unwrap();
        let reference = references.iter().find(|r| r["kind"] == choice).unwrap();
        assert_eq!(parts["truth"], choice);
        assert_eq!(parts["true_center"]["error_deg"], reference["error_deg"]);
        let found: Vec<f64> = numbers(&report["center"]);
        let squares = found.iter().zip(&center).map(|(a, b)| (a - b).powi(2));
        let distance = squares.sum::<f64>().sqrt();
        assert!(is_near(
            parts["true_center"]["distance_cm"].as_f64().unwrap(),
            distance
        ));
        if choice == "simulation" {
            // The axis's angle to the view ray from the origin, from 90°.
            let length = center.iter().map(|c| c * c).sum::<f64>().sqrt();
            let cosine: f64 = center.iter().zip(&axis).map(|(c, a)| c * a / length).sum();
            let lean = cosine.abs().asin().to_degrees();
            assert!(is_near(parts["lean_deg"].as_f64().unwrap(), lean));
            assert_eq!(parts["lean_deg"], parts["true_center"]["lean_part_deg"]);
        }
    }
}

#[test]
fn without_a_truth_there_are_no_parts_and_without_the_simulator_s_no_true_center() {
    let bare = json(&fixture("tapered_m.ply"), "--viewpoint 0.05,0.02,-0.03");
    assert!(bare["error_parts"].is_null());
    let text = analyze(&fixture("tapered_m.ply"), "--viewpoint 0.05,0.02,-0.03").out;
    assert!(!text.contains("Error's parts"), "{text}");

    let folder = TempDir::new().unwrap();
    let cloud = &peppers(&folder).join("pepper_001.ply");
    let with_truth = analyze(cloud, OPTIONS).out;
    assert!(
        with_truth.contains("against simulation = ") && with_truth.contains("true center"),
        "{with_truth}"
    );
    std::fs::remove_file(cloud.with_extension("truth.json")).unwrap();
    let report = json(cloud, OPTIONS);
    let parts = &report["error_parts"];
    assert_eq!(parts["truth"], "peduncle");
    assert_eq!(parts["error_deg"], report["reference"]["error_deg"]);
    assert_eq!(
        parts["lean_deg"], parts["lean_part_deg"],
        "seen with the computed center"
    );
    assert!(parts["true_center"].is_null());

    // Without an axis the first two parts remain. Another cloud's truth is as good as any.
    let cloud = folder.path().join("bumpy.ply");
    std::fs::copy(fixture("bumpy_cm.ply"), &cloud).unwrap();
    std::fs::copy(
        folder.path().join("set/pepper_000.truth.json"),
        cloud.with_extension("truth.json"),
    )
    .unwrap();
    let parts = &json(&cloud, "--min-partner-fraction 1")["error_parts"];
    assert!(parts["error_deg"].is_null() && parts["choice_part_deg"].is_null());
    assert!(parts["lean_part_deg"].is_number() && parts["grid_part_deg"].is_number());
    assert!(parts["nearest_candidate"]["rank"].is_null());
}

#[test]
fn coverage_comes_from_the_truth() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    let coverages = |out: &str, told: [Option<f64>; 3]| {
        for (i, coverage) in told.into_iter().enumerate() {
            let path = set.join(format!("pepper_00{i}.truth.json"));
            let mut truth = read_json(&path);
            truth["coverage"] = json!(coverage);
            std::fs::write(&path, truth.to_string()).unwrap();
        }
        let rows = evaluate(&set, &folder.path().join(out), "");
        rows.iter()
            .map(|row| row["coverage"].parse().ok())
            .collect::<Vec<Option<f64>>>()
    };
    let is_drawn = |out: &str| folder.path().join(out).join("error_by_coverage.png").is_file();
    let mean = |out: &str| read_json(&folder.path().join(out).join("summary.json"))["mean_coverage"].as_f64();
    let told = [Some(0.25), None, Some(0.75)];
    assert_eq!(coverages("some", told), told);
    assert_eq!((mean("some"), is_drawn("some")), (Some(0.5), true));
    assert_eq!(coverages("none", [None; 3]), [None; 3]);
    assert_eq!((mean("none"), is_drawn("none")), (None, false));
}
