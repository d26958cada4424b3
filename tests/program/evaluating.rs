//! `axiscope evaluate`: rows that agree with `analyze`, and survive resuming, sharding and bad files.

use crate::helpers::command_line;
use std::path::Path;

use crate::helpers::command_line::{json, run, simulate};
use axiscope::evaluate::{Row, Summary};
use axiscope::fruit::sha256_hex;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;
use tempfile::TempDir;

/// Three small peppers.
fn peppers(folder: &TempDir) -> std::path::PathBuf {
    simulate(folder, "pepper --seed 5 --count 3 --distance-cm 55,60", "set")
}

fn evaluate(set: &Path, out: &Path, options: &str) -> command_line::Ran {
    let args = ["evaluate", set.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let ran = run(args.into_iter().chain(options.split_whitespace()));
    assert_eq!(ran.status, 0, "{}", ran.err);
    ran
}

/// The rows of results.csv, each a map from column to text.
fn rows(out: &Path) -> Vec<std::collections::HashMap<String, String>> {
    rows_of(out.join("results.csv"))
}

fn rows_of(table: std::path::PathBuf) -> Vec<std::collections::HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(table).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

/// The file of an output folder's stored rows, and its lines.
fn stored_rows(out: &Path) -> (std::path::PathBuf, Vec<String>) {
    let files: Vec<_> = std::fs::read_dir(out.join("rows"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    assert_eq!(files.len(), 1, "{files:?}");
    let text = std::fs::read_to_string(&files[0]).unwrap();
    let lines = text.lines().filter(|line| !line.is_empty());
    (files[0].clone(), lines.map(str::to_owned).collect())
}

#[test]
fn rows_agree_with_analyze_cloud_by_cloud() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    let out = folder.path().join("out");
    evaluate(&set, &out, "--truth peduncle --voxel-cm 0.2 --u 7");
    let rows = rows(&out);
    assert_eq!(rows.len(), 3);
    for row in &rows {
        let report = json(&set.join(&row["file"]), "--voxel-cm 0.2 --u 7");
        let number = |column: &str| row[column].parse::<f64>().unwrap();
        assert_eq!(
            number("error_deg"),
            report["reference"]["error_deg"].as_f64().unwrap()
        );
        assert_eq!(number("score_cm"), report["best"]["score"].as_f64().unwrap());
        assert_eq!(number("axis_y"), report["axis"]["direction"][1].as_f64().unwrap());
        assert_eq!(number("g"), report["best"]["g"].as_f64().unwrap());
        assert_eq!(row["sha256"], report["cloud"]["sha256"].as_str().unwrap());
        assert_eq!(row["truth"], "peduncle");
    }
}

#[test]
fn the_truth_is_the_simulator_s_unless_asked_otherwise() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    let out = folder.path().join("out");
    evaluate(&set, &out, "--voxel-cm 0.3");
    for row in rows(&out) {
        assert_eq!(row["truth"], "simulation");
        assert_eq!(row["error_deg"], row["true_axis_error_deg"]);
        assert_ne!(row["error_deg"], row["peduncle_error_deg"]);
        let truth = std::fs::read_to_string(set.join(row["file"].replace(".ply", ".truth.json"))).unwrap();
        let truth: Value = serde_json::from_str(&truth).unwrap();
        assert_eq!(
            row["truth_y"].parse::<f64>().ok(),
            truth["axis"]["direction"][1].as_f64()
        );
    }
}

#[test]
fn a_resumed_run_and_shards_give_the_unbroken_run_s_bytes() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    let path = |name: &str| folder.path().join(name);
    let read = |name: &str, file: &str| std::fs::read(path(name).join(file)).unwrap();
    evaluate(&set, &path("whole"), "--voxel-cm 0.3");

    // Broken off after the first cloud, in the middle of the second row.
    evaluate(&set, &path("broken"), "--voxel-cm 0.3");
    let (file, lines) = stored_rows(&path("broken"));
    assert_eq!(lines.len(), 3);
    std::fs::write(
        &file,
        format!("{}\n{}", lines[0], &lines[1][..lines[1].len() / 2]),
    )
    .unwrap();
    evaluate(&set, &path("broken"), "--voxel-cm 0.3 --resume");
    for file in ["results.csv", "results.parquet", "summary.json", "report.html"] {
        assert_eq!(read("whole", file), read("broken", file), "{file}");
    }
    assert_eq!(
        stored_rows(&path("broken")).1.len(),
        4,
        "two were added to one and a half"
    );

    // What is kept is used: a row changed by hand shows up, but not for other settings, nor without being asked.
    let (file, lines) = stored_rows(&path("broken"));
    let (_, row) = lines[0].split_once(' ').unwrap();
    let changed = row.replace("\"warnings\":\"", "\"warnings\":\"kept ");
    let sum = &sha256_hex(changed.as_bytes())[..16];
    std::fs::write(
        &file,
        lines.join("\n").replace(&lines[0], &format!("{sum} {changed}")),
    )
    .unwrap();
    let is_kept = || {
        String::from_utf8(read("broken", "results.csv"))
            .unwrap()
            .contains("kept ")
    };
    evaluate(&set, &path("broken"), "--voxel-cm 0.3 --resume");
    assert!(is_kept());
    evaluate(&set, &path("broken"), "--voxel-cm 0.4 --resume");
    assert!(!is_kept());
    evaluate(&set, &path("broken"), "--voxel-cm 0.3");
    assert!(!is_kept());
    evaluate(&set, &path("broken"), "--voxel-cm 0.3 --resume");
    assert!(!is_kept(), "the newest row counts");

    // A file of the same size and time is read all the same.
    let cloud = set.join("pepper_000.ply");
    let time = std::fs::metadata(&cloud).unwrap().modified().unwrap();
    let length = usize::try_from(std::fs::metadata(&cloud).unwrap().len()).unwrap();
    let bytes = std::fs::read(&cloud).unwrap();
    std::fs::write(&cloud, vec![b'x'; length]).unwrap();
    let file = std::fs::File::options().append(true).open(&cloud).unwrap();
    file.set_modified(time).unwrap();
    evaluate(&set, &path("broken"), "--voxel-cm 0.3 --resume");
    let failed = |out: &Path| rows(out).iter().filter(|row| row["failed"] == "1").count();
    assert_eq!(failed(&path("broken")), 1);
    std::fs::write(&cloud, bytes).unwrap();
    evaluate(&set, &path("broken"), "--voxel-cm 0.3 --resume");
    assert_eq!(read("whole", "results.csv"), read("broken", "results.csv"));

    let mut joined = Vec::new();
    for shard in 1..=2 {
        let out = format!("shard{shard}");
        evaluate(&set, &path(&out), &format!("--voxel-cm 0.3 --shard {shard}/2"));
        let text = String::from_utf8(read(&out, &format!("results-{shard}-of-2.csv"))).unwrap();
        joined.extend(text.lines().skip(1).map(str::to_owned));
    }
    joined.sort();
    let whole = String::from_utf8(read("whole", "results.csv")).unwrap();
    assert_eq!(joined, whole.lines().skip(1).collect::<Vec<_>>());
}

#[test]
fn shards_that_run_at_once_into_one_folder_are_joined_by_resuming() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    let path = |name: &str| folder.path().join(name);
    let read = |name: &str| std::fs::read(path(name).join("results.csv")).unwrap();
    evaluate(&set, &path("whole"), "--voxel-cm 0.3");
    std::thread::scope(|scope| {
        for shard in 1..=3 {
            let (set, out) = (&set, path("shared"));
            scope.spawn(move || evaluate(set, &out, &format!("--voxel-cm 0.3 --shard {shard}/3")));
        }
    });
    assert_eq!(stored_rows(&path("shared")).1.len(), 3);
    let of_shard = |shard| rows_of(path("shared").join(format!("results-{shard}-of-3.csv")));
    let joined: Vec<_> = (1..=3).flat_map(of_shard).collect();
    assert_eq!(joined, rows(&path("whole")), "no shard loses another's rows");
    assert!(
        !path("shared").join("results.csv").exists(),
        "nothing passes for the whole"
    );
    evaluate(&set, &path("shared"), "--voxel-cm 0.3 --resume");
    assert_eq!(
        stored_rows(&path("shared")).1.len(),
        3,
        "no cloud was analyzed again"
    );
    assert_eq!(read("whole"), read("shared"));
}

#[test]
fn a_bad_cloud_is_a_row_with_its_reason() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    std::fs::write(set.join("a<b>.ply"), "ply\nformat ascii 1.0\nelement vertex 9\n").unwrap();
    std::fs::write(set.join("note.txt"), "no cloud").unwrap();
    let out = folder.path().join("out");
    let ran = evaluate(&set, &out, "--voxel-cm 0.3");
    let rows = rows(&out);
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[0]["file"], "a<b>.ply");
    assert!(!rows[0]["failure"].is_empty() && rows[0]["error_deg"].is_empty());
    assert!(
        rows[1..]
            .iter()
            .all(|row| row["failure"].is_empty() && !row["error_deg"].is_empty())
    );
    let summary: Value =
        serde_json::from_str(&std::fs::read_to_string(out.join("summary.json")).unwrap()).unwrap();
    assert_eq!((&summary["clouds"], &summary["measured"]), (&4.into(), &3.into()));
    assert!(ran.out.contains("4, 3 with an error"), "{}", ran.out);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let (drawings, scaling) = (page.matches("<svg ").count(), page.matches("viewBox=").count());
    assert!(
        drawings > 0 && drawings == scaling,
        "{drawings} drawings, {scaling} of them scale"
    );
    assert!(page.contains("a&lt;b&gt;.ply") && !page.contains("a<b>"));
    assert!(page.contains("<svg"));
    let sources: Vec<&str> = page.split("src=").skip(1).collect();
    assert!(
        sources
            .iter()
            .all(|source| source.starts_with("\"data:image/png;base64,iVBORw0KGgo")),
        "it stands alone"
    );
    assert!(!page.contains("href=\"http") && !page.contains("url(http"));
    if cfg!(feature = "window") {
        assert_eq!(sources.len(), 3, "a picture of each cloud with an error");
    }
}

#[test]
fn the_parquet_file_holds_the_csv_s_values_and_nulls() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    std::fs::write(set.join("bad.ply"), "ply").unwrap();
    let out = folder.path().join("out");
    evaluate(&set, &out, "--voxel-cm 0.3");
    let file = std::fs::File::open(out.join("results.parquet")).unwrap();
    let parquet: Vec<_> = SerializedFileReader::new(file)
        .unwrap()
        .get_row_iter(None)
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let csv = rows(&out);
    assert_eq!(parquet.len(), csv.len());
    for (parquet, csv) in parquet.iter().zip(&csv) {
        assert_eq!(parquet.get_column_iter().count(), csv.len());
        for (name, field) in parquet.get_column_iter() {
            let text = match field {
                Field::Null => String::new(),
                Field::Str(text) => text.clone(),
                Field::Long(count) => count.to_string(),
                Field::Double(number) => number.to_string(),
                other => panic!("{name} is {other:?}"),
            };
            assert_eq!(text, csv[name], "{name}");
        }
    }
}

#[test]
fn the_sweep_s_cells_are_the_means_of_single_runs() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    let path = |name: &str| folder.path().join(name);
    evaluate(&set, &path("map"), "--voxel-cm 0.3 --sweep u=5..7:2 tau=0..1:0.5");
    let table = std::fs::read_to_string(path("map").join("sweep.csv")).unwrap();
    let cells: Vec<Vec<&str>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(cells.len(), 6);
    assert_eq!(cells[4][..3], ["7", "0.5", "3"]);
    evaluate(&set, &path("single"), "--voxel-cm 0.3 --u 7 --tau 0.5");
    let summary: Value =
        serde_json::from_str(&std::fs::read_to_string(path("single").join("summary.json")).unwrap()).unwrap();
    let mean = summary["mean_deg"].as_f64().unwrap();
    assert!((cells[4][3].parse::<f64>().unwrap() - mean).abs() < 1e-9);
    assert!(path("map").join("sweep.svg").exists());
}

#[test]
fn a_companion_is_no_cloud_of_its_own() {
    let folder = TempDir::new().unwrap();
    let set = peppers(&folder);
    std::fs::copy(set.join("pepper_001.ply"), set.join("pepper_000_peduncle.ply")).unwrap();
    std::fs::copy(set.join("pepper_001.ply"), set.join("alone_peduncle.ply")).unwrap();
    let out = folder.path().join("out");
    evaluate(&set, &out, "--voxel-cm 0.4");
    let files: Vec<_> = rows(&out).into_iter().map(|row| row["file"].clone()).collect();
    assert_eq!(
        files,
        [
            "alone_peduncle.ply",
            "pepper_000.ply",
            "pepper_001.ply",
            "pepper_002.ply"
        ]
    );
}

#[test]
fn wrong_folders_and_options_end_with_their_status() {
    let folder = TempDir::new().unwrap();
    let empty = folder.path().to_str().unwrap();
    let status = |args: &[&str]| run(args.iter().copied()).status;
    assert_eq!(status(&["evaluate", empty]), 1, "no clouds");
    assert_eq!(status(&["evaluate", "no/such/folder"]), 1);
    for wrong in ["0/3", "4/3", "1", "1/0", "a/b"] {
        assert_eq!(status(&["evaluate", empty, "--shard", wrong]), 2, "{wrong}");
    }
    for wrong in ["u=4..6", "u=5.5", "tau=-1..2", "k=1..2", "tau=2..1", "u"] {
        assert_eq!(status(&["evaluate", empty, "--sweep", wrong]), 2, "{wrong}");
    }
    assert_eq!(status(&["evaluate", empty, "--sweep", "u=5..6", "u=7..8"]), 2);
}

#[test]
fn a_summary_is_made_of_the_errors_that_exist() {
    let row = |file: &str, error_deg: Option<f64>| Row {
        error_deg,
        failure: None,
        ..Row::failed(file, String::new())
    };
    let errors = [4.0, 20.0, 9.0, 14.0];
    let mut rows: Vec<Row> = errors
        .iter()
        .enumerate()
        .map(|(i, &e)| row(&i.to_string(), Some(e)))
        .collect();
    rows.push(Row::failed("bad", "torn".into()));
    rows.push(Row::failed("worse", "torn".into()));
    let summary = Summary::of(&rows);
    assert_eq!((summary.clouds, summary.measured), (6, 4));
    assert_eq!((summary.mean_deg, summary.median_deg), (Some(11.75), Some(11.5)));
    assert_eq!(summary.p95_deg, Some(20.0));
    assert_eq!(summary.worst.map(|w| w.file), Some("1".into()));
    let shares = [
        summary.share_under_5_deg,
        summary.share_under_10_deg,
        summary.share_under_15_deg,
    ];
    assert_eq!(shares, [Some(0.25), Some(0.5), Some(0.75)]);
    assert_eq!(summary.failures["torn"], 2);
    let none = Summary::of(&[Row::failed("bad", "torn".into())]);
    assert_eq!(
        (
            none.mean_deg,
            none.median_deg,
            none.p95_deg,
            none.share_under_5_deg
        ),
        (None, None, None, None)
    );
}
