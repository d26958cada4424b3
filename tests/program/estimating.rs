//! `--estimator` and `--prior`: the JSON's estimates, and the columns of a folder's table.

use crate::helpers::command_line::{analyze, fixture, json, keys, run, simulate};
use tempfile::TempDir;

#[test]
fn the_estimates_stand_beside_the_paper_s_in_the_json() {
    let folder = TempDir::new().unwrap();
    let pepper = simulate(&folder, "pepper --seed 8", "pepper.ply");
    let report = json(&pepper, "");
    assert_eq!(report["prior"], "lean=30,8");
    let estimates = report["estimates"].as_array().expect("a list");
    let names: Vec<_> = estimates.iter().map(|e| e["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["paper", "body"]);
    let mut fields = keys(&estimates[1]);
    fields.sort_unstable();
    let expected = [
        "alternatives",
        "ambiguous",
        "axis",
        "center",
        "confidence",
        "error_deg",
        "lead",
        "ms",
        "name",
        "occlusion",
        "seen_share",
        "warnings",
    ];
    assert_eq!(fields, expected);
    assert_eq!(estimates[0]["axis"], report["axis"]);
    assert_eq!(estimates[0]["center"], report["center"]);
    assert!(estimates[0]["confidence"].is_null(), "the paper states none");
    let confidence = estimates[1]["confidence"].as_f64().expect("a number");
    assert!((0.0..=1.0).contains(&confidence));
    let cost = |e: &serde_json::Value| e["cost"].as_f64().expect("a cost");
    let alternatives = estimates[1]["alternatives"].as_array().expect("a list");
    assert!(
        alternatives
            .windows(2)
            .all(|pair| cost(&pair[0]) <= cost(&pair[1]))
    );
    let text = analyze(&pepper, "");
    assert!(text.out.contains("By body"), "{}", text.out);
}

#[test]
fn estimators_and_prior_are_chosen_by_name() {
    let report = json(&fixture("bumpy_cm.ply"), "--estimator body --prior none");
    assert_eq!(report["prior"], "none");
    let estimates = report["estimates"].as_array().expect("a list");
    assert_eq!(estimates.len(), 1);
    assert_eq!(estimates[0]["name"], "body");
    assert_eq!(
        json(&fixture("bumpy_cm.ply"), "--prior lean=20,5 --estimator paper")["prior"],
        "lean=20,5"
    );
    for (options, reason) in [
        ("--estimator paper,none", "expected all, or some of paper"),
        ("--prior lean=3", "expected none, up, or lean=FREE,SD"),
        ("--prior lean=20,0", "expected none, up, or lean=FREE,SD"),
    ] {
        let ran = analyze(&fixture("bumpy_cm.ply"), options);
        assert_eq!(ran.status, 2, "{options}");
        assert!(ran.err.contains(reason), "{}", ran.err);
    }
}

#[test]
fn too_few_points_give_a_sentence_instead_of_an_axis() {
    let folder = TempDir::new().unwrap();
    let cloud = simulate(&folder, "ellipsoid --points 60", "few.ply");
    let report = json(&cloud, "");
    let body = &report["estimates"][1];
    assert!(body["axis"].is_null() && body["confidence"].is_null() && body["center"].is_null());
    assert_eq!(body["ambiguous"], true);
    let warning = body["warnings"][0].as_str().expect("a sentence");
    assert!(
        warning.ends_with("are too few to fit a body to: at least 100 are needed."),
        "{warning}"
    );
}

#[test]
fn a_table_has_columns_of_the_estimators_that_were_asked_for() {
    let folder = TempDir::new().unwrap();
    let set = simulate(&folder, "pepper --seed 5 --count 2 --distance-cm 55,60", "set");
    let out = folder.path().join("out");
    let evaluate = |options: &[&str]| {
        let args = ["evaluate", set.to_str().unwrap(), "--out", out.to_str().unwrap()];
        let ran = run(args.into_iter().chain(options.iter().copied()));
        assert_eq!(ran.status, 0, "{}", ran.err);
        let mut reader = csv::Reader::from_path(out.join("results.csv")).unwrap();
        let rows: Result<Vec<std::collections::HashMap<String, String>>, _> = reader.deserialize().collect();
        rows.unwrap()
    };
    assert!(!evaluate(&[])[0].contains_key("body_error_deg"));
    // Rows of other estimators are other rows.
    let rows = evaluate(&["--estimator", "paper,body", "--resume"]);
    for row in &rows {
        let report = json(&set.join(&row["file"]), "");
        assert_eq!(row["paper_error_deg"], row["error_deg"]);
        let body = &report["estimates"][1];
        assert_eq!(
            row["body_error_deg"].parse::<f64>().unwrap(),
            body["error_deg"].as_f64().unwrap()
        );
        assert_eq!(
            row["body_confidence"].parse::<f64>().unwrap(),
            body["confidence"].as_f64().unwrap()
        );
        assert_eq!(row["body_ambiguous"] == "1", body["ambiguous"].as_bool().unwrap());
        assert_eq!(row["body_occlusion"], body["occlusion"].as_str().unwrap());
        assert!(
            ["1", "2", "3", "4"].contains(&row["priority"].as_str()),
            "{}",
            row["priority"]
        );
    }
    assert_eq!(
        rows,
        evaluate(&["--estimator", "paper,body", "--resume"]),
        "as stored"
    );
}
