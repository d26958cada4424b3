//! The commands beside `analyze`: simulated clouds, the paper's experiments, help.

use std::path::Path;

use crate::helpers::command_line::{Ran, json, run, simulate};
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

/// Runs the paper's experiments on few clouds, with more arguments.
fn reproduce(out: &Path, more: &[&str]) -> Ran {
    let few = [
        "--runs",
        "1",
        "--z0",
        "25..70:45",
        "--points",
        "300",
        "--peppers",
        "1",
    ];
    let grids = ["--u", "5,6", "--arc", "0,30", "--lean", "8", "-o"];
    let out = [out.to_str().unwrap()];
    let args = ["reproduce"]
        .iter()
        .chain(&few)
        .chain(&grids)
        .chain(&out)
        .chain(more);
    let ran = run(args.copied().collect::<Vec<_>>());
    assert_eq!(ran.status, 0, "{}", ran.err);
    ran
}

#[test]
fn reproduce_writes_its_report_tables_and_figures() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("report");
    let ran = reproduce(&out, &["--sets", "3"]);
    for said in [
        "6.47",
        "What is reproduced",
        "7.37",
        "6.93",
        "--figure fig8",
        "11.3° falling to 4.1°",
    ] {
        assert!(ran.out.contains(said), "{said} is not in\n{}", ran.out);
    }
    let figures = [
        "fig3", "fig5", "fig7", "fig8", "fig9", "fig10", "fig11", "fig12", "fig13", "map_u5", "map_u6",
    ];
    for name in figures {
        for file in [format!("{name}.svg"), format!("{name}.png")] {
            assert!(out.join(&file).metadata().is_ok_and(|m| m.len() > 100), "{file}");
        }
        assert!(
            ran.out.contains(&format!("({name}.svg)")),
            "{name} is in the report"
        );
    }
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let page = read("report.html");
    assert!(page.matches("<svg").count() >= figures.len() && page.contains("<table>"));
    assert!(!page.contains("<img"), "the page needs no other file");
    let rows = |name: &str| read(name).lines().count() - 1;
    let (grids, readings, depths) = (2, 9, 2);
    assert_eq!(rows("ellipsoids.csv"), grids * depths * readings);
    // Two scans, two other sets and seven changes, with and without the peduncle.
    assert_eq!(rows("peppers.csv"), (2 + 2 + 7) * 2 * grids * readings);
    the_sets_are_summed_up(&read("report.md"), &read("peppers.csv"));
}

/// Compares the report's row of other sets for u = 5 with the table of single peppers.
fn the_sets_are_summed_up(report: &str, peppers: &str) {
    let mut table = csv::Reader::from_reader(peppers.as_bytes());
    let head = table.headers().unwrap().clone();
    let column =
        |row: &csv::StringRecord, name: &str| row[head.iter().position(|c| c == name).unwrap()].to_owned();
    let of_main_scan = |row: &csv::StringRecord| {
        let change = column(row, "change");
        let is_set = change == "other peppers" || change.is_empty();
        is_set
            && column(row, "arc_deg") == "30.0"
            && column(row, "u") == "5"
            && column(row, "peduncle") == "with"
    };
    let rows: Vec<_> = table.records().map(Result::unwrap).filter(of_main_scan).collect();
    let reading = |row: &csv::StringRecord| column(row, "reading");
    let intended = reading(&rows[1]);
    let errors: Vec<f64> = (rows.iter().filter(|row| reading(row) == intended))
        .map(|row| column(row, "error_deg").parse().unwrap())
        .collect();
    let seeds: Vec<String> = (rows.iter().filter(|row| reading(row) == intended))
        .map(|row| column(row, "set_seed"))
        .collect();
    assert_eq!(seeds, ["0", "1", "2"]);
    // A set has one pepper here.
    let mean = errors.iter().sum::<f64>() / 3.0;
    let std = (errors.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / 3.0).sqrt();
    let below = errors.iter().filter(|&&e| e < 6.9343).count();
    let section = report.split("## § 3.2 on other sets").nth(1).unwrap();
    let expected = format!("| u = 5 | {mean:.1} ± {std:.1} |");
    let row = section.lines().find(|line| line.starts_with(&expected));
    let row = row.unwrap_or_else(|| panic!("{expected} is not in\n{section}"));
    assert_eq!(row.split(" | ").nth(3), Some(format!("{below} of 3").as_str()));
}

#[test]
fn reproduce_on_one_set_says_nothing_of_others() {
    let folder = TempDir::new().unwrap();
    let ran = reproduce(folder.path(), &["--sets", "1"]);
    assert!(!ran.out.contains("## § 3.2 on other sets"), "{}", ran.out);
    assert!(ran.out.contains("for 0 other sets of them and 7 changes"));
}

#[test]
fn reproduce_draws_single_figures() {
    let folder = TempDir::new().unwrap();
    let ran = reproduce(folder.path(), &["--figure", "fig3,fig12"]);
    assert!(ran.out.is_empty());
    let mut files: Vec<_> = (std::fs::read_dir(folder.path()).unwrap())
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    // The upper of Fig. 12's figures is for the paper's u, and a lower one may be for another.
    files.retain(|file| !file.starts_with("fig12_"));
    assert_eq!(files, ["fig12.png", "fig12.svg", "fig3.png", "fig3.svg"]);
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
