//! `axiscope analyze --point` and `--points`: the steps of single points.

use std::path::Path;

use crate::helpers::command_line::{analyze, fixture, json, simulate};
use parquet::file::reader::{FileReader, SerializedFileReader};
use tempfile::TempDir;

const BEST: &str = "--unit m --center -0.01,0.015,0.4 --viewpoint 0.05,0.02,-0.03";

fn table(path: &Path) -> Vec<csv::StringRecord> {
    let mut reader = csv::Reader::from_path(path).expect("it was written");
    reader.records().collect::<Result<_, _>>().expect("CSV")
}

#[test]
fn the_points_of_a_plane_add_up_to_its_sums() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("points.csv");
    let options = format!("{BEST} --plane 4,2 --points {}", path.display());
    let report = json(&fixture("tapered_m.ply"), &options);
    let plane = &report["planes"][3 * 6 + 1];
    assert_eq!((&plane["g"], &plane["h"]), (&4.into(), &2.into()));
    let mut reader = csv::Reader::from_path(&path).expect("it was written");
    let headers = reader.headers().expect("a header").clone();
    let column = |name: &str| headers.iter().position(|h| h == name).expect("a column");
    let rows = table(&path);
    assert_eq!(report["cloud"]["used_points"], rows.len());
    let sum = |name: &str| -> f64 {
        let at = column(name);
        rows.iter().filter_map(|row| row[at].parse::<f64>().ok()).sum()
    };
    let with_partner = rows
        .iter()
        .filter(|row| !row[column("score_cm")].is_empty())
        .count();
    assert_eq!(plane["partners"], with_partner);
    let tau = report["params"]["tau"].as_f64().expect("a number");
    let [distances, angles] =
        ["distance_sum_cm", "angle_sum_rad"].map(|key| plane[key].as_f64().expect("a number"));
    let is_close = |a: f64, b: f64| (a - b).abs() < 1e-9 * b.abs().max(1.0);
    assert!(is_close(sum("d_cm"), distances));
    assert!(is_close(sum("xi_rad"), angles));
    assert!(is_close(sum("score_cm"), distances + tau * angles));
    let sides = ["front", "back"].map(|side| rows.iter().filter(|row| &row[column("side")] == side).count());
    assert_eq!(sides[0] + sides[1], rows.len());
    assert!(sides.iter().all(|&count| count > 0));
}

#[test]
fn one_point_s_steps_are_those_of_its_row() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("points.csv");
    let options = format!("{BEST} --point 17 --points {}", path.display());
    let report = json(&fixture("tapered_m.ply"), &options);
    let point = &report["point"];
    assert_eq!(
        (&point["g"], &point["h"]),
        (&report["best"]["g"], &report["best"]["h"])
    );
    assert_eq!(point["index"], 17);
    let rows = table(&path);
    let row = rows
        .iter()
        .find(|row| &row[0] == "17")
        .expect("the point is used");
    for axis in 0..3 {
        let position: f64 = row[1 + axis].parse().expect("a number");
        assert_eq!(point["position"][axis], position);
    }
    let position = point["position"].as_array().expect("three numbers");
    let place: Vec<String> = position.iter().map(ToString::to_string).collect();
    let by_place = json(
        &fixture("tapered_m.ply"),
        &format!("{BEST} --point {}", place.join(",")),
    );
    assert_eq!(&by_place["point"], point, "named by its place");
    let text = analyze(&fixture("tapered_m.ply"), &format!("{BEST} --point 17")).out;
    for step in ["17 of the file", "Eq. 12", "Eq. 13", "Eq. 14"] {
        assert!(text.contains(step), "{step}: {text}");
    }
}

#[test]
fn the_points_go_to_parquet_and_to_a_cloud_with_scalar_fields() {
    let folder = TempDir::new().expect("a folder");
    for name in ["points.parquet", "points.ply"] {
        let path = folder.path().join(name);
        let ran = analyze(
            &fixture("tapered_m.ply"),
            &format!("{BEST} --points {}", path.display()),
        );
        assert_eq!(ran.status, 0, "{}", ran.err);
    }
    let used = json(&fixture("tapered_m.ply"), BEST)["cloud"]["used_points"].clone();
    let file = std::fs::File::open(folder.path().join("points.parquet")).expect("it was written");
    let parquet = SerializedFileReader::new(file).expect("Parquet");
    assert_eq!(used, parquet.metadata().file_metadata().num_rows());
    let bytes = std::fs::read(folder.path().join("points.ply")).expect("it was written");
    let end = bytes
        .windows(10)
        .position(|w| w == b"end_header")
        .expect("a header");
    let header = String::from_utf8_lossy(&bytes[..end]);
    for name in ["is_front", "has_partner", "d_cm", "xi_rad", "score_cm"] {
        assert!(header.contains(&format!("property float {name}\n")), "{header}");
    }
    let again = json(&folder.path().join("points.ply"), "");
    assert_eq!(again["cloud"]["points"], used, "the cloud is read again");
}

#[test]
fn a_point_that_cannot_be_shown_is_one_sentence() {
    let folder = TempDir::new().expect("a folder");
    let cloud = simulate(&folder, "pepper --seed 3", "pepper.ply");
    for (options, reason) in [
        ("--point 1000000", "there is no point 1000000"),
        (
            "--point 1,2",
            "expected the index of a point, or three numbers X,Y,Z",
        ),
        ("--point 3 --plane 9,9", "there is no plane g 9, h 9"),
        ("--points table.txt", ".csv, .parquet or .ply"),
    ] {
        let ran = analyze(&cloud, options);
        assert_ne!(ran.status, 0);
        assert!(ran.err.contains(reason), "{options}: {}", ran.err);
    }
}

#[test]
fn the_points_are_not_written_over_their_cloud() {
    let folder = TempDir::new().expect("a folder");
    let cloud = simulate(&folder, "pepper --seed 3", "pepper.ply");
    let before = std::fs::read(&cloud).expect("a cloud");
    let ran = analyze(&cloud, &format!("--points {}", cloud.display()));
    assert_ne!(ran.status, 0);
    assert!(ran.err.contains("write over the cloud itself"), "{}", ran.err);
    assert_eq!(std::fs::read(&cloud).expect("still there"), before);
}

#[test]
fn the_text_names_every_reference_with_its_error() {
    let folder = TempDir::new().expect("a folder");
    let cloud = simulate(&folder, "pepper --seed 3", "pepper.ply");
    let report = json(&cloud, "");
    let references = report["references"].as_array().expect("a list");
    let text = analyze(&cloud, "").out;
    assert_eq!(text.matches("\nError  ").count(), references.len(), "{text}");
    assert!(text.contains("True axis"), "{text}");
    for reference in references {
        let error = format!("{:.2}°", reference["error_deg"].as_f64().expect("an error"));
        assert!(text.contains(&error), "{error}: {text}");
    }
}
