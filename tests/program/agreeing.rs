//! Annotators compared, references set by hand, and the peduncle as what one of two clouds lacks.

use std::path::{Path, PathBuf};

use crate::helpers::command_line::{json, run, simulate};
use axiscope::annotate::{
    Annotation, CloudAgreement, CloudId, Ends, Judgment, Role, SetAgreement, mean_axis,
};
use axiscope::geometry::{Cloud, Unit};
use axiscope::peduncle::{Peduncle, PeduncleError};
use glam::{DQuat, DVec3};
use serde_json::Value;
use tempfile::TempDir;

/// An axis through (1, 2, 3) that leans from up by `degrees` about z.
fn leaning(degrees: f64) -> Ends {
    let half = DQuat::from_rotation_z(degrees.to_radians()) * DVec3::NEG_Y;
    let middle = DVec3::new(1.0, 2.0, 3.0);
    Ends::new(middle + half, middle - half).unwrap()
}

fn annotation(annotator: &str, role: Role, ends: Option<Ends>) -> Annotation {
    Annotation {
        cloud: CloudId {
            file: String::new(),
            sha256: String::new(),
        },
        unit: Unit::Centimeter,
        annotator: annotator.into(),
        role,
        judgment: Judgment {
            ends,
            ..Judgment::cannot_tell()
        },
        created: String::new(),
        modified: String::new(),
        program: String::new(),
    }
}

fn by(name: &str, degrees: f64) -> Annotation {
    annotation(name, Role::Annotator, Some(leaning(degrees)))
}

#[test]
fn the_mean_is_of_lines_and_points_to_the_peduncle() {
    let mean = mean_axis(&[leaning(-4.0), leaning(10.0)]).unwrap();
    assert!(mean.direction.distance(leaning(3.0).direction()) < 1e-12);
    assert!((mean.spread_deg - 7.0).abs() < 1e-9);
    assert!(mean.origin.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-12);
    // One of three holds it upside down: the line is the same, the sense that of the others.
    let flipped = mean_axis(&[leaning(-4.0).flipped(), leaning(3.0), leaning(10.0)]).unwrap();
    assert!(flipped.direction.distance(leaning(3.0).direction()) < 1e-12);
    assert!(
        mean_axis(&[leaning(0.0), leaning(90.0)]).is_none(),
        "no direction stands out"
    );
    assert!(mean_axis(&[]).is_none());
    let tie = mean_axis(&[leaning(0.0).flipped(), leaning(0.0)]).unwrap();
    assert!(
        tie.direction.dot(leaning(0.0).direction()) < 0.0,
        "a tie goes to the first"
    );
}

#[test]
fn whoever_is_far_from_most_is_far_off() {
    let flat = |names: &[String]| names.join(" ");
    let of = |annotations: &[Annotation]| CloudAgreement::of("a.ply", annotations, 10.0);
    let three = of(&[by("Cy", 30.0), by("Ada", 0.0), by("Bob", 2.0)]);
    assert_eq!(
        (flat(&three.annotators), flat(&three.far_off)),
        ("Ada Bob Cy".into(), "Cy".into())
    );
    let angles: Vec<f64> = three.pairs.iter().map(|p| p.angle_deg.round()).collect();
    assert_eq!(angles, [2.0, 30.0, 28.0]);
    assert_eq!(three.largest_deg.map(f64::round), Some(30.0));
    assert_eq!(
        flat(&of(&[by("Ada", 0.0), by("Bob", 20.0)]).far_off),
        "Ada Bob",
        "nobody can say who"
    );
    assert_eq!(flat(&of(&[by("Ada", 0.0), by("Bob", 9.0)]).far_off), "");
    assert_eq!(flat(&of(&[by("Ada", 0.0)]).far_off), "");
    // Angles are those of lines, but ends that were exchanged are told.
    let flipped = annotation("Bob", Role::Annotator, Some(leaning(2.0).flipped()));
    let exchanged = of(&[by("Ada", 0.0), flipped]);
    assert_eq!(exchanged.pairs[0].angle_deg.round(), 2.0);
    assert!(exchanged.pairs[0].is_opposite && !three.pairs[0].is_opposite);
}

#[test]
fn a_set_s_sums_are_over_its_clouds() {
    let silent = annotation("Ada", Role::Annotator, None);
    let decided = annotation("Eve", Role::Adjudicator, Some(leaning(1.0)));
    let clouds = vec![
        CloudAgreement::of("a.ply", &[by("Ada", 0.0), by("Bob", 4.0), decided], 10.0),
        CloudAgreement::of("b.ply", &[by("Ada", 0.0), by("Bob", 16.0)], 10.0),
        CloudAgreement::of("c.ply", &[silent, by("Bob", 4.0)], 10.0),
    ];
    let set = SetAgreement::of(clouds, 10.0);
    let [ada, bob] = &set.annotators[..] else {
        panic!("{set:?}")
    };
    assert_eq!((ada.clouds, ada.cannot_tell, ada.far_off), (2, 1, 1));
    assert_eq!((bob.clouds, bob.cannot_tell, bob.far_off), (3, 0, 1));
    assert_eq!(ada.mean_deg.map(f64::round), Some(10.0));
    assert_eq!(ada.to_adjudicated_deg.map(f64::round), Some(1.0));
    assert_eq!(bob.to_adjudicated_deg.map(f64::round), Some(3.0));
    let [pair] = &set.pairs[..] else { panic!("{set:?}") };
    assert_eq!(
        (pair.clouds, pair.mean_deg.round(), pair.largest_deg.round()),
        (2, 10.0, 16.0)
    );
}

fn annotate(cloud: &Path, annotator: &str, edit: &str) {
    let args = ["annotate", cloud.to_str().unwrap(), "--annotator", annotator];
    let ran = run(args.into_iter().chain(edit.split_whitespace()));
    assert_eq!(ran.status, 0, "{}", ran.err);
}

/// One cloud's row for this truth.
fn row(set: &Path, options: &str) -> std::collections::HashMap<String, String> {
    let out = set.parent().unwrap().join("out");
    let args = [
        "evaluate",
        set.to_str().unwrap(),
        "--voxel-cm",
        "0.4",
        "--out",
        out.to_str().unwrap(),
    ];
    let ran = run(args.into_iter().chain(options.split_whitespace()));
    assert_eq!(ran.status, 0, "{}", ran.err);
    let mut reader = csv::Reader::from_path(out.join("results.csv")).unwrap();
    let rows: Vec<std::collections::HashMap<_, _>> = reader.deserialize().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 1);
    rows.into_iter().next().unwrap()
}

fn one_pepper(folder: &TempDir) -> (PathBuf, PathBuf) {
    let set = folder.path().join("set");
    std::fs::create_dir(&set).unwrap();
    let cloud = simulate(folder, "pepper --seed 5 --distance-cm 55,60", "set/pepper.ply");
    (set, cloud)
}

#[test]
fn evaluate_takes_the_axis_set_by_hand() {
    let folder = TempDir::new().unwrap();
    let (set, cloud) = one_pepper(&folder);
    assert_eq!(
        row(&set, "--truth manual")["failure"],
        "there is no reference axis"
    );
    annotate(&cloud, "Ada", "--base 0,-4,55 --blossom 0,4,55");
    let one = row(&set, "--truth manual");
    assert_eq!(
        (one["truth"].as_str(), one["truth_y"].as_str()),
        ("annotators:1", "-1")
    );
    annotate(&cloud, "Bob", "--base 1,-4,55 --blossom -1,4,55");
    // A resumed run takes notice of what was said since.
    let two = row(&set, "--truth manual --resume");
    assert_eq!(two["truth"], "annotators:2");
    let [a, b] = [DVec3::NEG_Y, DVec3::new(1.0, -4.0, 0.0).normalize()];
    let mean = (a + b).normalize();
    assert!((two["truth_x"].parse::<f64>().unwrap() - mean.x).abs() < 1e-9);
    assert_ne!(one["error_deg"], two["error_deg"]);

    assert_eq!(row(&set, "--truth auto")["truth"], "simulation");
    std::fs::remove_file(set.join("pepper.truth.json")).unwrap();
    assert_eq!(row(&set, "--truth auto")["truth"], "annotators:2");
    assert_eq!(row(&set, "--truth peduncle")["truth"], "peduncle");
    annotate(&cloud, "Eve", "--adjudicate --base 0,0,50 --blossom 0,0,60");
    let decided = row(&set, "--truth manual");
    assert_eq!(
        (decided["truth"].as_str(), decided["truth_z"].as_str()),
        ("adjudicated", "-1")
    );
    annotate(&cloud, "Eve", "--adjudicate --cannot-tell");
    let hopeless = row(&set, "--truth manual");
    assert_eq!(hopeless["failure"], "there is no reference axis");
    assert!(
        hopeless["warnings"].contains("cannot be told"),
        "{}",
        hopeless["warnings"]
    );

    std::fs::write(set.join("pepper.Zoe.axis.json"), "{}").unwrap();
    let warned = row(&set, "--truth peduncle");
    assert!(warned["warnings"].contains("pepper.Zoe.axis.json") && warned["failure"].is_empty());
}

#[test]
fn annotations_lists_who_agrees() {
    let folder = TempDir::new().unwrap();
    let (set, cloud) = one_pepper(&folder);
    annotate(&cloud, "Ada", "--base 0,-4,55 --blossom 0,4,55");
    annotate(&cloud, "Bob B", "--start peduncle --confidence low");
    annotate(&cloud, "Cy", "--cannot-tell");
    let ran = run([
        "annotations",
        set.to_str().unwrap(),
        "--format",
        "json",
        "--far-off",
        "0.001",
    ]);
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(report["schema"], "axiscope.agreement/1");
    let peduncle = json(&cloud, "")["reference"]["direction"].clone();
    let component = |i: usize| peduncle[i].as_f64().unwrap();
    let angle = (-component(1)).clamp(-1.0, 1.0).acos().to_degrees();
    let found = report["clouds"][0]["pairs"][0]["angle_deg"].as_f64().unwrap();
    assert!((found - angle).abs() < 1e-6, "{found} {angle}");
    assert_eq!(
        report["clouds"][0]["far_off"],
        serde_json::json!(["Ada", "Bob B"])
    );
    assert_eq!(report["clouds"][0]["cannot_tell"], serde_json::json!(["Cy"]));
    let text = run(["annotations", set.to_str().unwrap()]).out;
    assert!(
        text.contains("Ada and Bob B") && text.contains("1 clouds, 1 with an axis"),
        "{text}"
    );
    assert_eq!(run(["annotations", "no/such/folder"]).status, 1);
}

#[test]
fn the_peduncle_is_what_the_other_cloud_lacks() {
    let folder = TempDir::new().unwrap();
    let set = simulate(&folder, "pepper --seed 5 --count 2 --distance-cm 55,60", "full");
    let bare = simulate(
        &folder,
        "pepper --seed 5 --count 2 --distance-cm 55,60 --without-peduncle",
        "bare",
    );
    let removed = format!("--removed {}", bare.display());
    for name in ["pepper_000.ply", "pepper_001.ply"] {
        let (by_label, by_removal) = (json(&set.join(name), ""), json(&set.join(name), &removed));
        assert_eq!(by_label["reference"], by_removal["reference"]);
        assert_eq!(
            by_removal["params"]["peduncle"],
            format!("removed={}", bare.display())
        );
        let without = json(&set.join(name), &format!("{removed} --without-peduncle"));
        let points = json(&bare.join(name), "--peduncle none")["cloud"]["points"].clone();
        assert_eq!(without["cloud"]["used_points"], points);
    }
    let out = folder.path().join("out");
    std::fs::remove_file(bare.join("pepper_001.ply")).unwrap();
    let args = [
        "evaluate",
        set.to_str().unwrap(),
        "--truth",
        "peduncle",
        "--voxel-cm",
        "0.4",
        "--out",
        out.to_str().unwrap(),
    ];
    let ran = run(args.into_iter().chain(removed.split(' ')));
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(
        ran.out.contains("2, 1 with an error") && ran.out.contains("there is no such file"),
        "{}",
        ran.out
    );
    assert_eq!(
        run(["analyze", "x.ply", "--removed", "y", "--peduncle", "label"]).status,
        2
    );
}

#[test]
fn clouds_that_are_no_pair_are_told() {
    let points: Vec<DVec3> = (0..100)
        .map(|i| DVec3::new(f64::from(i), f64::from(i % 7), 50.0))
        .collect();
    let cloud = |range: std::ops::Range<usize>| Cloud::new(points[range].to_vec());
    let full = cloud(0..100);
    let peduncle = Peduncle::by_removal(&full, &cloud(10..100)).unwrap();
    assert_eq!((peduncle.points, peduncle.in_cloud), (10, (0..10).collect()));
    assert_eq!(
        Peduncle::by_removal(&full, &full),
        Err(PeduncleError::NoneRemoved)
    );
    assert_eq!(
        Peduncle::by_removal(&full, &cloud(0..0)),
        Err(PeduncleError::EmptyBody)
    );
    let other = PeduncleError::OtherBody {
        missing: 50,
        points: 100,
        strange: 0,
        body: 50,
    };
    assert_eq!(Peduncle::by_removal(&full, &cloud(50..100)), Err(other));
    let shifted = Cloud::new(
        points
            .iter()
            .enumerate()
            .map(|(i, &p)| if i < 50 { p } else { p + DVec3::Y * 0.3 })
            .collect(),
    );
    assert!(matches!(
        Peduncle::by_removal(&full, &shifted),
        Err(PeduncleError::OtherBody {
            missing: 50,
            strange: 50,
            ..
        })
    ));
}
