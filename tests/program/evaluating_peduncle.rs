//! The paper's two experiments on 27 simulated peppers, with and without the peduncle: `evaluate` and
//! `analyze` say the same of every reference, however the work is cut up.

use std::collections::HashMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crate::helpers::command_line::{json, run, simulate};
use axiscope::evaluate::{TruthChoice, examine, reference_of};
use axiscope::fruit::{Fruit, Request};
use axiscope::geometry::Unit;
use axiscope::method::{CenterMethod, Params, Preset, RandomSearch};
use glam::DVec3;
use tempfile::TempDir;

const COUNT: usize = 27;
const OPTIONS: &str = "--voxel-cm 0.45 --center-samples 1000";

/// The peppers, which every test only reads.
static SET: LazyLock<(TempDir, PathBuf)> = LazyLock::new(|| {
    let folder = TempDir::new().unwrap();
    let set = simulate(
        &folder,
        &format!("pepper --seed 7 --count {COUNT} --distance-cm 55,70"),
        "set",
    );
    (folder, set)
});

fn evaluate(out: &Path, options: &str) {
    let args = [
        "evaluate",
        SET.1.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
    ];
    // Pictures are another test's.
    let mut options = format!("{OPTIONS} {options}");
    if cfg!(feature = "window") {
        options += " --pictures 0";
    }
    let ran = run(args.into_iter().chain(options.split_whitespace()));
    assert_eq!(ran.status, 0, "{}", ran.err);
}

fn rows(out: &Path) -> Vec<HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(out.join("results.csv")).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

#[test]
fn evaluate_agrees_with_analyze_on_every_reference_with_and_without_the_peduncle() {
    let out = TempDir::new().unwrap();
    let mut used = Vec::new();
    for options in ["", "--without-peduncle"] {
        evaluate(out.path(), &format!("--truth peduncle-direction {options}"));
        let rows = rows(out.path());
        assert_eq!(rows.len(), COUNT);
        let mut directions = 0;
        for row in &rows {
            let report = json(&SET.1.join(&row["file"]), &format!("{OPTIONS} {options}"));
            let number = |column: &str| row[column].parse::<f64>().ok();
            let reference = |kind: &str| {
                let all = report["references"].as_array().unwrap();
                let found = all.iter().find(|r| r["kind"] == kind);
                found.and_then(|r| r["error_deg"].as_f64())
            };
            assert_eq!(number("peduncle_error_deg"), reference("peduncle"), "{row:?}");
            assert_eq!(
                number("peduncle_error_deg"),
                report["reference"]["error_deg"].as_f64()
            );
            assert_eq!(number("true_axis_error_deg"), reference("simulation"));
            assert_eq!(
                number("peduncle_direction_error_deg"),
                reference("peduncle-direction")
            );
            assert_eq!(number("error_deg"), reference("peduncle-direction"));
            assert_eq!(
                number("peduncle_disagreement_deg"),
                report["peduncle_disagreement_deg"].as_f64()
            );
            assert_eq!(number("used_points"), report["cloud"]["used_points"].as_f64());
            // A cloud without a second reference says why.
            let is_told = row["warnings"].contains("direction");
            assert_eq!(row["error_deg"].is_empty(), is_told, "{}", row["warnings"]);
            directions += usize::from(!row["error_deg"].is_empty());
        }
        assert!(
            directions > COUNT / 2,
            "{directions} have a direction of their own"
        );
        used.push(
            rows.iter()
                .map(|row| row["used_points"].parse::<u64>().unwrap())
                .collect::<Vec<_>>(),
        );
    }
    assert!(
        used[0].iter().zip(&used[1]).all(|(with, without)| with > without),
        "the peduncle is left out of each"
    );
}

#[test]
fn both_experiments_in_one_go_are_the_two_one_by_one() {
    let out = TempDir::new().unwrap();
    let path = |name: &str| out.path().join(name);
    evaluate(&path("both"), "--both");
    for (name, options) in [("with-peduncle", ""), ("without-peduncle", "--without-peduncle")] {
        evaluate(&path(name), options);
        for file in ["results.csv", "summary.json"] {
            let read = |folder: &Path| std::fs::read(folder.join(file)).unwrap();
            assert_eq!(read(&path("both").join(name)), read(&path(name)), "{name} {file}");
        }
    }
    assert_ne!(rows(&path("with-peduncle")), rows(&path("without-peduncle")));
    let refused = run(["evaluate", "x", "--both", "--without-peduncle"]);
    assert_eq!(refused.status, 2, "one of them at a time");
}

#[test]
fn resumed_runs_and_shards_give_the_unbroken_run_s_rows_with_and_without_the_peduncle() {
    for options in ["--truth peduncle", "--truth peduncle --without-peduncle"] {
        let folder = TempDir::new().unwrap();
        let path = |name: &str| folder.path().join(name);
        let read = |name: &str, file: &str| std::fs::read(path(name).join(file)).unwrap();
        evaluate(&path("whole"), options);
        evaluate(&path("broken"), options);
        let file = std::fs::read_dir(path("broken").join("rows"))
            .unwrap()
            .map(|e| e.unwrap().path())
            .next()
            .unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        let lines: Vec<_> = text.lines().filter(|line| !line.is_empty()).collect();
        assert_eq!(lines.len(), COUNT);
        // As if it had been broken off in the middle of a row.
        let whole = lines[..COUNT / 2].join("\n");
        std::fs::write(&file, format!("{whole}\n{}", &lines[COUNT / 2][..300])).unwrap();
        evaluate(&path("broken"), &format!("{options} --resume"));
        for file in ["results.csv", "results.parquet", "summary.json"] {
            assert_eq!(read("whole", file), read("broken", file), "{file} {options}");
        }
        let mut joined = Vec::new();
        for shard in 1..=4 {
            let out = format!("shard{shard}");
            evaluate(&path(&out), &format!("{options} --shard {shard}/4"));
            let text = String::from_utf8(read(&out, &format!("results-{shard}-of-4.csv"))).unwrap();
            joined.extend(text.lines().skip(1).map(str::to_owned));
        }
        joined.sort();
        let whole = String::from_utf8(read("whole", "results.csv")).unwrap();
        assert_eq!(joined, whole.lines().skip(1).collect::<Vec<_>>(), "{options}");
    }
}

#[test]
fn the_reference_runs_from_the_center_through_the_peduncle_s_mean_whatever_finds_the_center() {
    let file = SET.1.join("pepper_000.ply");
    let mut params = Params::new(Preset::AsIntended, Unit::Centimeter);
    params.k = NonZeroUsize::new(20).unwrap();
    params.filters.voxel_cm = Some(0.45);
    let search = RandomSearch {
        count: 500,
        ..RandomSearch::default()
    };
    let mut centers = Vec::new();
    for center in [
        CenterMethod::Equidistant(search),
        CenterMethod::MeanRms(search),
        CenterMethod::Sphere,
        CenterMethod::Given(DVec3::new(1.0, 2.0, 62.0)),
    ] {
        for without_peduncle in [false, true] {
            let request = Request {
                without_peduncle,
                params: Params {
                    center,
                    ..params.clone()
                },
                ..Request::default()
            };
            let fruit = Fruit::read(&file, &request).unwrap();
            let examined = examine(fruit, &request, &()).unwrap();
            let found = examined.fruit.peduncle.as_ref().unwrap();
            // Its mean is that of its own points, with or without them in the analysis.
            let points = examined.fruit.cloud().positions();
            let mean = found.in_cloud.iter().map(|&i| points[i]).sum::<DVec3>() / found.points as f64;
            let reference = reference_of(&examined.references, TruthChoice::Peduncle).unwrap();
            assert_eq!(reference.origin, examined.analysis.center);
            let along = (mean - reference.origin).dot(reference.direction);
            let off = mean - reference.origin - along * reference.direction;
            assert!(along > 0.0 && off.length() < 1e-9, "{center:?}: {off}");
            let own = reference_of(&examined.references, TruthChoice::PeduncleDirection).unwrap();
            assert!(
                own.origin.distance(mean) < 1e-9,
                "its own line runs through the mean"
            );
            assert!(own.direction.dot(mean - reference.origin) > 0.0, "outward");
            centers.push(reference.origin);
        }
    }
    centers.dedup();
    assert!(centers.len() >= 6, "they are different centers: {centers:?}");
}
