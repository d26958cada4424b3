//! Axes to and from CSV and 3D Slicer, and the command line that sets them.

use std::path::Path;

use crate::helpers::command_line::{run, simulate};
use axiscope::annotate::exchange::{
    Placement, SlicerError, SlicerFrame, place, read_lines, read_table, write_line, write_table,
};
use axiscope::annotate::{Annotation, Confidence, Ends, Method};
use axiscope::geometry::{Extent, Unit};
use glam::DVec3;
use tempfile::TempDir;

fn annotated(cloud: &Path, annotator: &str, edit: &str) -> Annotation {
    let args = [
        "annotate",
        cloud.to_str().unwrap(),
        "--annotator",
        annotator,
        "--format",
        "json",
    ];
    let ran = run(args.into_iter().chain(edit.split_whitespace()));
    assert_eq!(ran.status, 0, "{}", ran.err);
    Annotation::from_json(ran.out.as_bytes()).unwrap()
}

fn pepper(folder: &TempDir) -> std::path::PathBuf {
    simulate(folder, "pepper --seed 5 --distance-cm 55,60", "pepper.ply")
}

#[test]
fn an_export_is_imported_again_as_it_was() {
    let folder = TempDir::new().unwrap();
    let cloud = pepper(&folder);
    let path = |name: &str| folder.path().join(name).display().to_string();
    annotated(
        &cloud,
        "Ada",
        "--base 0.1,-4,55 --blossom 0,4,55.5 --confidence high --blind",
    );
    annotated(&cloud, "Ada", "--note =1+1,\"odd\"");
    annotated(&cloud, "Bob", "--cannot-tell");
    annotated(&cloud, "Eve", "--adjudicate --start computed");
    let set = folder.path().to_str().unwrap();
    let ran = run(["annotations", set, "--export", &path("all.csv")]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let names = ["Ada", "Bob", "adjudicated"].map(|slug| format!("pepper.{slug}.axis.json"));
    let before = names
        .clone()
        .map(|name| std::fs::read(folder.path().join(name)).unwrap());
    assert!(
        run(["annotations", set, "--import", &path("all.csv")])
            .err
            .contains("Took 0 axes"),
        "all are known"
    );

    for name in &names {
        std::fs::remove_file(folder.path().join(name)).unwrap();
        std::fs::remove_file(folder.path().join(name.replace(".json", ".journal"))).unwrap();
    }
    let ran = run(["annotations", set, "--import", &path("all.csv")]);
    assert!(ran.err.contains("Took 3 axes"), "{}", ran.err);
    for (name, before) in names.iter().zip(before) {
        let [before, after] = [before, std::fs::read(folder.path().join(name)).unwrap()]
            .map(|bytes| Annotation::from_json(&bytes).unwrap());
        assert_eq!(before.judgment, after.judgment, "{name}");
        assert_eq!(
            (before.annotator, before.role, before.cloud),
            (after.annotator, after.role, after.cloud)
        );
    }
}

#[test]
fn a_table_of_bare_ends_will_do_and_a_wrong_one_changes_nothing() {
    let folder = TempDir::new().unwrap();
    let cloud = pepper(&folder);
    let set = folder.path().to_str().unwrap();
    let head = "file,annotator,peduncle_base_x,peduncle_base_y,peduncle_base_z,blossom_end_x,blossom_end_y,blossom_end_z,unit";
    let import = |rows: &str| {
        let table = folder.path().join("t.csv");
        std::fs::write(&table, format!("\u{feff}{head}\n{rows}\n")).unwrap();
        run(["annotations", set, "--import", table.to_str().unwrap()])
    };
    let good = "pepper.ply,Ada,0,-40,550,0,40,550,mm";
    let wrong = [
        ("other.ply,Ada,0,0,0,1,1,1,cm", "other.ply"),
        ("../pepper.ply,Ada,0,0,0,1,1,1,cm", "../pepper.ply"),
        ("pepper.ply,12,0,0,0,1,1,1,cm", "a number"),
        ("pepper.ply,Ada,0,0,0,0,0,0,cm", "one point"),
        ("pepper.ply,Ada,0,0,0,1,1,,cm", "an end is missing"),
        ("pepper.ply,Ada,0,0,x,1,1,1,cm", "float"),
        ("pepper.ply,Ada,0,0,NaN,1,1,1,cm", "finite"),
        ("pepper.ply,Ada,0,0,0,1,1,1,inch", "inch"),
        ("pepper.ply,Ada,0,0", "fields"),
    ];
    for (row, reason) in wrong {
        let ran = import(&format!("{good}\n{row}"));
        assert_eq!(ran.status, 1, "{row}");
        assert!(
            ran.err.contains(reason) && ran.err.contains("t.csv"),
            "{row}: {}",
            ran.err
        );
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
        assert!(!folder.path().join("pepper.Ada.axis.json").exists(), "{row}");
    }
    assert_eq!(import(good).status, 0);
    let ada = annotated(&cloud, "Ada", "");
    assert_eq!(ada.judgment.method, Method::Imported);
    let ends = ada.ends().unwrap();
    assert!(
        ends.peduncle_base().distance(DVec3::new(0.0, -4.0, 55.0)) < 1e-9,
        "millimeters into centimeters"
    );
    // The row's hash is another cloud's.
    let table = folder.path().join("h.csv");
    std::fs::write(&table, format!("{head},sha256\n{good},{}\n", "0".repeat(64))).unwrap();
    let ran = run(["annotations", set, "--import", table.to_str().unwrap()]);
    assert!(
        ran.status == 1 && ran.err.contains("not the cloud"),
        "{}",
        ran.err
    );
}

#[test]
fn tables_keep_every_field() {
    let folder = TempDir::new().unwrap();
    let ada = annotated(
        &pepper(&folder),
        "Ada",
        "--base 1e-7,-4,55 --blossom 0,4,55 --confidence 0.3 --blind",
    );
    let rows = read_table(&write_table([("a,b.ply", &ada)]).unwrap()).unwrap();
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0].file, "a,b.ply");
    assert_eq!(rows[0].sha256.as_ref(), Some(&ada.cloud.sha256));
    assert_eq!(rows[0].judgment, ada.judgment);
    assert!(ada.judgment.blind && ada.judgment.confidence == Confidence::new(0.3));
}

fn markup(frame: &str, unit: &str, points: &str) -> String {
    format!(
        r#"{{"@schema": "https://example.org/markups-schema-v1.0.3.json#", "markups": [
        {{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": []}},
        {{"type": "Line", "name": "axis", "coordinateSystem": {frame}, "coordinateUnits": "{unit}",
          "locked": false, "controlPoints": [{points}], "display": {{"opacity": 1.0}}}}]}}"#
    )
}

fn point(x: f64, y: f64, z: f64) -> String {
    format!(r#"{{"id": "1", "label": "L-1", "position": [{x}, {y}, {z}], "positionStatus": "defined"}}"#)
}

#[test]
fn slicer_s_frames_and_millimeters_are_minded() {
    // A fruit of 8 cm, right of and below the view's middle, as a depth camera in meters sees it.
    let extent = Extent {
        min: DVec3::new(0.02, 0.03, 0.5),
        max: DVec3::new(0.10, 0.11, 0.54),
    };
    let ends = Ends::new(DVec3::new(0.06, 0.03, 0.54), DVec3::new(0.05, 0.11, 0.53)).unwrap();
    let read = |frame: &str, sign: f64| {
        let points = [
            point(60.0 * sign, 30.0 * sign, 540.0),
            point(50.0 * sign, 110.0 * sign, 530.0),
        ];
        let lines = read_lines(markup(frame, "mm", &points.join(",")).as_bytes()).unwrap();
        assert_eq!((lines.len(), lines[0].name.as_str()), (1, "axis"));
        lines.into_iter().next().unwrap()
    };
    let close = |a: &Ends| {
        a.peduncle_base().distance(ends.peduncle_base()) + a.blossom_end().distance(ends.blossom_end())
            < 1e-12
    };
    let lps = Placement::default();
    let ras = Placement {
        frame: SlicerFrame::Ras,
        ..lps
    };
    // The file says in which frame its numbers are: the same place, however it is written.
    for line in [
        read("\"LPS\"", 1.0),
        read("\"RAS\"", -1.0),
        read("1", 1.0),
        read("0", -1.0),
    ] {
        assert!(close(&place(&line, Unit::Meter, &extent, lps).unwrap()));
        let wrong = place(&line, Unit::Meter, &extent, ras);
        assert_eq!(wrong, Err(SlicerError::Away { fits: vec![lps] }));
        assert!(wrong.unwrap_err().to_string().contains("loaded as LPS"));
    }
    // A cloud that was loaded in Slicer as RAS lies half a turn away from where the file says.
    assert!(close(
        &place(&read("\"LPS\"", -1.0), Unit::Meter, &extent, ras).unwrap()
    ));

    // Every placement's lines come back, and are not taken for another unit's.
    for frame in [SlicerFrame::Lps, SlicerFrame::Ras] {
        for numbers_as_they_are in [false, true] {
            let placement = Placement {
                frame,
                numbers_as_they_are,
            };
            let text = write_line("a \"name\"", &ends, Unit::Meter, placement);
            let line = read_lines(text.as_bytes()).unwrap().remove(0);
            assert_eq!(line.name, "a \"name\"");
            assert!(close(&place(&line, Unit::Meter, &extent, placement).unwrap()));
            let other = Placement {
                numbers_as_they_are: !numbers_as_they_are,
                ..placement
            };
            assert!(matches!(
                place(&line, Unit::Meter, &extent, other),
                Err(SlicerError::Away { .. })
            ));
        }
    }
    // Around the origin a line that is too small or too large is told all the same.
    let around = Extent {
        min: DVec3::splat(-4.0),
        max: DVec3::splat(4.0),
    };
    let small = Ends::new(DVec3::Y * 4.0, DVec3::Y * -4.0).unwrap();
    let as_is = Placement {
        numbers_as_they_are: true,
        ..lps
    };
    let line = read_lines(write_line("", &small, Unit::Centimeter, as_is).as_bytes())
        .unwrap()
        .remove(0);
    assert!(place(&line, Unit::Centimeter, &around, as_is).is_ok());
    assert!(matches!(
        place(&line, Unit::Centimeter, &around, lps),
        Err(SlicerError::Away { .. })
    ));
}

#[test]
fn other_markup_files_are_told_apart() {
    let two = [point(1.0, 2.0, 3.0), point(4.0, 5.0, 6.0)].join(",");
    let error = |text: &str| read_lines(text.as_bytes()).unwrap_err();
    assert!(matches!(error("{}"), SlicerError::Malformed(_)));
    assert!(matches!(error("not json"), SlicerError::Malformed(_)));
    assert_eq!(
        error(r#"{"markups": [{"type": "Fiducial"}]}"#),
        SlicerError::NoLine
    );
    assert!(matches!(
        error(&markup("\"XYZ\"", "mm", &two)),
        SlicerError::Frame(_)
    ));
    assert!(matches!(error(&markup("7", "mm", &two)), SlicerError::Frame(_)));
    assert!(matches!(
        error(&markup("\"LPS\"", "um", &two)),
        SlicerError::Unit(_)
    ));
    assert!(matches!(
        error(&markup("\"LPS\"", "mm", &point(1.0, 2.0, 3.0))),
        SlicerError::Points { points: 1, .. }
    ));
    let preview = two.replacen("\"defined\"", "\"preview\"", 1);
    assert!(matches!(
        error(&markup("\"LPS\"", "mm", &preview)),
        SlicerError::Points { points: 1, .. }
    ));
}

#[test]
fn a_line_of_slicer_s_becomes_an_edit() {
    let folder = TempDir::new().unwrap();
    let cloud = pepper(&folder);
    let file = folder.path().join("line.mrk.json").display().to_string();
    let started = annotated(&cloud, "Ada", &format!("--start computed --export {file}"));
    assert_eq!(started.judgment.method, Method::FromComputed);
    let imported = annotated(&cloud, "Bob", &format!("--import {file}"));
    assert_eq!(imported.judgment.method, Method::Imported);
    let apart = imported
        .ends()
        .unwrap()
        .middle()
        .distance(started.ends().unwrap().middle());
    assert!(apart < 1e-9 && imported.ends().unwrap().angle_to_deg(started.ends().unwrap()) < 1e-9);
    let wrong = [
        "annotate",
        cloud.to_str().unwrap(),
        "--annotator",
        "Cy",
        "--import",
        &file,
        "--slicer-as-is",
    ];
    let ran = run(wrong);
    assert!(
        ran.status == 1 && ran.err.contains("millimeters converted"),
        "{}",
        ran.err
    );
    assert!(!folder.path().join("pepper.Cy.axis.json").exists());
}

#[test]
fn the_command_line_does_what_the_hand_would() {
    let folder = TempDir::new().unwrap();
    let cloud = pepper(&folder);
    let set = annotated(
        &cloud,
        "Ada",
        "--base 0,-4,55 --blossom 0,4,55 --confidence medium --blind",
    );
    assert!(set.judgment.blind && set.judgment.method == Method::ByHand);
    let leaned = annotated(&cloud, "Ada", "--turn lean=5 --blind");
    let direction = leaned.ends().unwrap().direction();
    assert!(direction.x.abs() < 1e-12 && (direction.z.abs() - 5_f64.to_radians().sin()).abs() < 1e-9);
    assert_eq!(
        leaned.judgment.confidence,
        Confidence::new(0.5),
        "what is not said anew stays"
    );
    let turned = annotated(&cloud, "Ada", "--undo");
    assert_eq!(turned.judgment, set.judgment);
    let turned = annotated(
        &cloud,
        "Ada",
        "--turn picture=-0.1 --hold base --shift 1,0,0 --lengthen -2",
    );
    let ends = turned.ends().unwrap();
    assert!((ends.peduncle_base() - DVec3::new(1.0, -4.0, 55.0)).length() < 1e-9);
    assert!((ends.length() - 6.0).abs() < 1e-9 && !turned.judgment.blind);
    assert!((ends.angle_to_deg(set.ends().unwrap()) - 0.1).abs() < 1e-9);
    let moved = annotated(&cloud, "Ada", "--blossom 1,3,56 --flip");
    assert_eq!(moved.ends().unwrap().peduncle_base(), DVec3::new(1.0, 3.0, 56.0));
    assert_eq!(annotated(&cloud, "Ada", "--cannot-tell").judgment.ends, None);
    let from = annotated(&cloud, "Ada", "--start peduncle --turn lean=1 --blind");
    assert!(from.judgment.method == Method::FromPeduncle && !from.judgment.blind);

    let status = |edit: &str| {
        let args = ["annotate", cloud.to_str().unwrap(), "--annotator", "New"];
        run(args.into_iter().chain(edit.split_whitespace())).status
    };
    for wrong in [
        "--turn 5",
        "--turn x=5",
        "--turn lean=x",
        "--confidence 2",
        "--base 1,2",
        "--undo --flip",
        "--base 0,0,0 --start computed",
        "--cannot-tell --flip",
        "--blind",
        "--script - --undo",
    ] {
        assert_eq!(status(wrong), 2, "{wrong}");
    }
    for unusable in [
        "--undo",
        "--flip",
        "--base 0,0,0",
        "--base 0,0,0 --blossom 0,0,0",
        "--note x",
        "--import none.mrk.json",
        "--export x.mrk.json",
        "--script none",
    ] {
        assert_eq!(status(unusable), 1, "{unusable}");
    }
    assert_eq!(
        run(["annotate", cloud.to_str().unwrap(), "--annotator", "../.."]).status,
        2
    );
    assert_eq!(status(""), 0, "looking is allowed, and leaves nothing behind");
    let left = std::fs::read_dir(folder.path())
        .unwrap()
        .filter(|e| e.as_ref().unwrap().file_name().to_string_lossy().contains("New"));
    assert_eq!(left.count(), 0);
}
