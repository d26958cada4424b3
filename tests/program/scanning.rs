//! `axiscope simulate scan`: a mesh from elsewhere becomes a cloud, with a truth where its axis is known.

use crate::helpers::command_line::{json, run, simulate};
use serde_json::Value;
use tempfile::TempDir;

/// A pyramid of 8 cm, in millimeters, its top on the y axis.
const PYRAMID: &str = "v -30 -40 -30\nv 30 -40 -30\nv 30 -40 30\nv -30 -40 30\nv 0 40 0\n\
                       f 1 2 3 4\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

#[test]
fn a_mesh_is_scanned_with_the_truth_that_is_given() {
    let folder = TempDir::new().unwrap();
    let mesh = folder.path().join("pyramid.obj");
    std::fs::write(&mesh, PYRAMID).unwrap();
    let scan =
        |options: &str, name: &str| simulate(&folder, &format!("scan {} {options}", mesh.display()), name);

    let cloud = scan("--views 5 --arc 90 --axis 0,40,0:0,-40,0", "a.ply");
    let again = scan("--views 5 --arc 90 --axis 0,40,0:0,-40,0", "b.ply");
    assert_eq!(std::fs::read(&cloud).unwrap(), std::fs::read(again).unwrap());
    let truth = std::fs::read_to_string(cloud.with_extension("truth.json")).unwrap();
    let truth: Value = serde_json::from_str(&truth).unwrap();
    assert_eq!(truth["kind"], "mesh");
    assert_eq!(truth["unit"], "mm");
    assert_eq!(truth["settings"]["mesh_file"], "pyramid.obj");
    assert_eq!(truth["settings"]["scan"]["views"], 5);
    assert!((0.2..0.9).contains(&truth["coverage"].as_f64().unwrap()));
    let analysis = json(&cloud, "");
    assert_eq!(analysis["cloud"]["unit"], "mm", "stated in the file");
    let kinds: Vec<&Value> = analysis["references"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| &r["kind"])
        .collect();
    assert_eq!(kinds, ["simulation"]);

    let bare = scan("--from 0,0,400 --unit mm", "c.ply");
    assert!(!bare.with_extension("truth.json").exists(), "no axis, no truth");
    // A truth that stays behind would be taken for the new cloud's.
    let mesh = mesh.to_str().unwrap();
    let onto = run(["simulate", "scan", mesh, "-o", cloud.to_str().unwrap()]);
    assert_eq!(onto.status, 1);
    assert!(onto.err.contains("a.truth.json"), "{}", onto.err);

    for wrong in [
        "--axis=0,0,0",
        "--up=w",
        "--from=0,0",
        "--views=0",
        "--axis=1,1,1:1,1,1",
    ] {
        assert_eq!(run(["simulate", "scan", mesh, wrong]).status, 2, "{wrong}");
    }
    let missing = run(["simulate", "scan", "none.stl"]);
    assert_eq!(missing.status, 1);
    assert!(
        missing.err.contains("none.stl: there is no such file"),
        "{}",
        missing.err
    );
}
