//! The commands beside `analyze`: simulated clouds, the paper's experiments, help.

use std::path::Path;

use crate::helpers::command_line::{json, run, simulate};
use serde_json::Value;
use tempfile::TempDir;

#[test]
fn simulated_clouds_repeat_byte_by_byte_and_know_their_truth() {
    let folder = TempDir::new().unwrap();
    let first = simulate(&folder, "pepper --seed 9 --count 3", "a");
    let again = simulate(&folder, "pepper --seed 9 --count 2", "b");
    for name in ["pepper_000.ply", "pepper_001.ply", "pepper_001.truth.json"] {
        assert_eq!(
            std::fs::read(first.join(name)).unwrap(),
            std::fs::read(again.join(name)).unwrap(),
            "{name}"
        );
    }
    let read = |name: &str| std::fs::read_to_string(first.join(name)).unwrap();
    let truth: Value = serde_json::from_str(&read("pepper_001.truth.json")).unwrap();
    assert_eq!(truth["schema"], "axiscope.truth/1");
    let bare = simulate(&folder, "pepper --seed 9 --count 2 --without-peduncle", "c");
    let labels = |folder: &Path| {
        axiscope::fruit::read_cloud(folder.join("pepper_001.ply"))
            .unwrap()
            .ply
            .cloud
            .labels()
            .unwrap()
            .to_vec()
    };
    assert!(labels(&first).contains(&1) && !labels(&bare).contains(&1));

    // A truth's settings make the same cloud again.
    let settings = first.join("pepper_001.truth.json");
    let seed = truth["seed"].as_u64().unwrap();
    let remade = simulate(
        &folder,
        &format!("pepper --seed {seed} --settings {}", settings.display()),
        "again.ply",
    );
    assert_eq!(
        std::fs::read(remade).unwrap(),
        std::fs::read(first.join("pepper_001.ply")).unwrap()
    );

    let depths = simulate(&folder, "ellipsoid --z0 25..70:15 --points 300", "depths");
    let mut names: Vec<_> = std::fs::read_dir(depths)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 8, "{names:?}");
    assert_eq!(names[0], "ellipsoid_z025.0_000.ply");
}

#[test]
fn views_from_several_places_are_fused_and_repeat() {
    let folder = TempDir::new().unwrap();
    let options = "pepper --seed 4 --views 5 --arc 120 --arc-up 40 --pose-noise 0.3,0.1 --voxel-cm 0.3";
    let first = simulate(&folder, options, "a.ply");
    let again = simulate(&folder, options, "b.ply");
    assert_eq!(std::fs::read(&first).unwrap(), std::fs::read(again).unwrap());
    let truth = std::fs::read_to_string(first.with_extension("truth.json")).unwrap();
    let truth: Value = serde_json::from_str(&truth).unwrap();
    assert_eq!(truth["settings"]["scan"]["views"], 5);
    assert_eq!(truth["settings"]["scan"]["pose_noise_deg"], 0.3);
    assert!(
        truth["coverage"].as_f64().unwrap() > 0.45,
        "{}",
        truth["coverage"]
    );
    let cloud = axiscope::fruit::read_cloud(&first).unwrap().ply.cloud;
    assert!(cloud.normals().is_some());

    // A trajectory: the camera stands still, then a hand's breadth to the right.
    let poses = folder.path().join("poses.txt");
    std::fs::write(&poses, "# time and pose\n0 1 2 3 0 0 0 1\n0.5 1.1 2 3 0 0 0 1\n").unwrap();
    let from_poses = format!("pepper --seed 4 --poses {}", poses.display());
    let taken = simulate(&folder, &from_poses, "c.ply");
    let truth = std::fs::read_to_string(taken.with_extension("truth.json")).unwrap();
    let truth: Value = serde_json::from_str(&truth).unwrap();
    assert_eq!(truth["settings"]["scan"]["poses"].as_array().unwrap().len(), 2);

    std::fs::write(&poses, "0 1 2 3 0 0 0 1\n0 1 2 3 0 0 nan 1\n").unwrap();
    let ran = run(["simulate", "pepper", "--poses", poses.to_str().unwrap()]);
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("poses.txt: line 2 is not a pose"), "{}", ran.err);
    assert_eq!(run(["simulate", "pepper", "--views", "0"]).status, 2);
    assert_eq!(
        run(["simulate", "pepper", "--arc", "90"]).status,
        2,
        "of one view"
    );
    assert_eq!(
        run(["simulate", "pepper", "--views", "3", "--poses", "x"]).status,
        2
    );
}

#[test]
fn a_simulated_cloud_in_meters_gives_the_same_sums_in_centimeters() {
    let folder = TempDir::new().unwrap();
    let sums = |unit: &str| {
        let cloud = simulate(
            &folder,
            &format!("ellipsoid --points 500 --unit {unit}"),
            &format!("{unit}.ply"),
        );
        let report = json(&cloud, "--center sphere");
        assert_eq!(report["cloud"]["unit"], unit, "stated in the file");
        assert!(!report["warnings"].to_string().contains("guessed"));
        report["planes"]
            .as_array()
            .unwrap()
            .iter()
            .map(|p| p["distance_sum_cm"].as_f64().unwrap())
            .collect::<Vec<_>>()
    };
    for (cm, m) in sums("cm").iter().zip(sums("m")) {
        assert!((cm - m).abs() < 1e-3 * (1.0 + cm), "{cm} {m}");
    }
}

#[test]
fn reproduce_writes_its_report_tables_and_figures() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("report");
    let args = [
        "reproduce",
        "--runs",
        "1",
        "--z0",
        "25..70:45",
        "--points",
        "300",
        "--peppers",
        "1",
        "-o",
        out.to_str().unwrap(),
    ];
    let ran = run(args);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.out.contains("6.47") && ran.out.contains("could not be reproduced"));
    for name in [
        "report.md",
        "ellipsoids.csv",
        "peppers.csv",
        "fig8.svg",
        "fig8.png",
        "fig12.png",
        "fig13.svg",
    ] {
        assert!(out.join(name).metadata().is_ok_and(|m| m.len() > 100), "{name}");
    }
    let rows = std::fs::read_to_string(out.join("ellipsoids.csv"))
        .unwrap()
        .lines()
        .count();
    assert_eq!(rows, 1 + 2 * 8);
}

#[test]
fn help_completions_and_the_manual_name_every_command() {
    let help = run(["--help"]);
    assert_eq!(help.status, 0);
    for shell in ["bash", "zsh", "fish"] {
        let script = run(["completions", shell]);
        assert_eq!(script.status, 0);
        assert!(script.out.contains("min-partner-fraction"), "{shell}");
    }
    let manual = run(["man"]);
    assert_eq!(manual.status, 0);
    for command in ["analyze", "simulate", "reproduce"] {
        assert!(
            help.out.contains(command) && manual.out.contains(command),
            "{command}"
        );
    }
    assert!(manual.out.contains("partner"), "with each command's options");
}

#[test]
fn simulated_fruits_of_a_kind_are_made_again_from_their_truth() {
    let folder = TempDir::new().unwrap();
    let set = simulate(&folder, "fruit --kind apple --seed 4 --count 2", "set");
    let truth_file = set.join("apple_001.truth.json");
    let truth: Value = serde_json::from_str(&std::fs::read_to_string(&truth_file).unwrap()).unwrap();
    assert_eq!(truth["settings"]["kind"], "apple");
    let again = format!(
        "fruit --seed {} --settings {}",
        truth["seed"],
        truth_file.display()
    );
    let again = simulate(&folder, &again, "again.ply");
    let read = |path: &Path| std::fs::read(path).unwrap();
    assert_eq!(read(&again), read(&set.join("apple_001.ply")));
    assert_eq!(
        read(&again.with_extension("truth.json")),
        read(&truth_file),
        "the truth, too"
    );

    assert_eq!(run(["simulate", "fruit"]).status, 2, "a kind is needed");
    let other = run(["simulate", "pepper", "--settings", truth_file.to_str().unwrap()]);
    assert_eq!(other.status, 1);
    assert!(other.err.contains("not those of a pepper"), "{}", other.err);
}
