//! Input that is endless, enormous, or named to mislead: a sentence, in little memory and time.
#![cfg(unix)]

use std::ffi::OsStr;
use std::fmt::Write as _;
use std::io::Write;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::helpers::command_line::{Ran, axiscope, run, simulate};
use axiscope::annotate::exchange::read_table;
use tempfile::TempDir;

/// Runs the program with at most so much memory, in kB of address space.
fn within_kb(kb: u32, args: &[&str]) -> Ran {
    let line = format!(
        "ulimit -v {kb}; exec {} --threads 1 \"$@\"",
        env!("CARGO_BIN_EXE_axiscope")
    );
    let output = Command::new("timeout")
        .args(["60", "bash", "-c", &line, "bash"])
        .args(args)
        .output()
        .expect("bash runs");
    Ran {
        status: output.status.code().unwrap_or(-1),
        out: String::from_utf8_lossy(&output.stdout).into_owned(),
        err: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

fn annotate(cloud: &Path, more: &[&OsStr]) -> Ran {
    let output = axiscope()
        .args([
            "annotate".as_ref(),
            cloud.as_os_str(),
            "--annotator".as_ref(),
            "Ada".as_ref(),
        ])
        .args(more)
        .output()
        .expect("it runs");
    Ran {
        status: output.status.code().expect("no signal ended it"),
        out: String::from_utf8_lossy(&output.stdout).into_owned(),
        err: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

fn words(line: &str) -> Vec<&OsStr> {
    line.split_whitespace().map(OsStr::new).collect()
}

const AXIS: &str = "--base 0,-4,50 --blossom 0,4,50";

#[test]
fn endless_files_are_refused_in_a_sentence() {
    let folder = TempDir::new().unwrap();
    let cloud = simulate(&folder, "ellipsoid --points 50", "cloud.ply");
    let (cloud, set) = (cloud.to_str().unwrap(), folder.path().to_str().unwrap());
    for endless in ["/dev/zero", "/dev/full"] {
        let refused = [
            &["annotate", cloud, "--annotator", "Ada", "--script", endless][..],
            &["annotate", cloud, "--annotator", "Ada", "--import", endless],
            &["annotations", set, "--import", endless],
            &["simulate", "pepper", "--settings", endless],
        ];
        for args in refused {
            let ran = within_kb(2_000_000, args);
            assert_eq!(ran.status, 1, "{args:?}: {}", ran.err);
            assert!(ran.err.contains("longer than"), "{args:?}: {}", ran.err);
        }
    }
    // A pipe that nobody writes to.
    let truth = folder.path().join("cloud.truth.json");
    std::fs::remove_file(&truth).unwrap();
    assert!(Command::new("mkfifo").arg(&truth).status().unwrap().success());
    let ran = run(["analyze", cloud]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.out.contains("not a regular file"), "{}", ran.out);
}

#[test]
fn the_memory_of_an_import_does_not_grow_with_its_rows() {
    let folder = TempDir::new().unwrap();
    let set = folder.path().join("set");
    std::fs::create_dir(&set).unwrap();
    let made = simulate(&folder, "ellipsoid --points 200000", "big.ply");
    std::fs::rename(made, set.join("big.ply")).unwrap();
    let mut table = "file,annotator,peduncle_base_x,peduncle_base_y,peduncle_base_z,blossom_end_x,blossom_end_y,blossom_end_z\n".to_owned();
    for row in 0..160 {
        writeln!(table, "big.ply,Name{row}x,0,-4,25,0,4,25").unwrap();
    }
    let path = folder.path().join("table.csv");
    std::fs::write(&path, table).unwrap();
    let set = set.to_str().unwrap();
    let ran = within_kb(700_000, &["annotations", set, "--import", path.to_str().unwrap()]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.contains("Took 160 axes"), "{}", ran.err);
}

#[test]
fn a_note_that_no_axis_file_can_hold_is_refused_before_it_is_saved() {
    let folder = TempDir::new().unwrap();
    let cloud = simulate(&folder, "ellipsoid --points 50", "cloud.ply");
    let mut child = Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .args(["annotate", "--annotator", "Ada", "--script", "-"])
        .arg(&cloud)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let script = format!("{AXIS}\n--note {}\n--note short\n", "n".repeat(1_100_000));
    std::thread::spawn(move || input.write_all(script.as_bytes()));
    let out = child.wait_with_output().unwrap();
    let said = String::from_utf8(out.stdout).unwrap();
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!((lines[0], lines[2]), ("saved 1", "saved 2"), "{said}");
    assert!(
        lines[1].starts_with("refused: ") && lines[1].contains("the note is too long"),
        "{said}"
    );
    let ran = annotate(&cloud, &[]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""), "it reads what it wrote");
    assert!(ran.out.contains("short"), "{}", ran.out);
}

#[test]
fn a_journal_that_another_program_replaces_gets_no_edit_that_counts_as_saved() {
    for replaced in [true, false] {
        let folder = TempDir::new().unwrap();
        let cloud = simulate(&folder, "ellipsoid --points 50", "cloud.ply");
        let journal = folder.path().join("cloud.Ada.axis.journal");
        let mut child = Command::new(env!("CARGO_BIN_EXE_axiscope"))
            .args(["annotate", "--annotator", "Ada", "--script", "-"])
            .arg(&cloud)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let (mut input, out) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let mut answers = std::io::BufRead::lines(std::io::BufReader::new(out)).map(Result::unwrap);
        input.write_all(format!("{AXIS}\n").as_bytes()).unwrap();
        assert_eq!(answers.next().unwrap(), "saved 1");
        let copy = folder.path().join("copy");
        std::fs::copy(&journal, &copy).unwrap();
        if replaced {
            std::fs::rename(&copy, &journal).unwrap();
        } else {
            std::fs::remove_file(&journal).unwrap();
        }
        for note in 0..2 {
            input.write_all(format!("--note {note}\n").as_bytes()).unwrap();
            let answer = answers.next().unwrap();
            assert!(
                answer.starts_with("not saved: ") && answer.contains("replaced"),
                "{answer}"
            );
        }
        drop(input);
        assert_eq!(child.wait().unwrap().code(), Some(1));
    }
}

/// A copy of a small cloud under another name.
fn named(folder: &TempDir, name: &OsStr) -> PathBuf {
    let set = folder.path().join("set");
    std::fs::create_dir_all(&set).unwrap();
    let made = simulate(folder, "pepper --seed 3", "pepper.ply");
    let path = set.join(name);
    std::fs::copy(made, &path).unwrap();
    path
}

#[test]
fn clouds_whose_names_are_no_text_are_annotated_and_evaluated_like_others() {
    let folder = TempDir::new().unwrap();
    let cloud = named(&folder, OsStr::from_bytes(b"caf\xe9.ply"));
    assert_eq!(annotate(&cloud, &words(AXIS)).status, 0);
    let set = folder.path().join("set");
    let ran = run(["annotations".as_ref(), set.as_os_str()]);
    assert!(
        ran.out.contains("1 clouds, 1 with an axis set by hand"),
        "{}",
        ran.out
    );
    let out = folder.path().join("out");
    let args = [
        "evaluate".as_ref(),
        set.as_os_str(),
        "--truth".as_ref(),
        "manual".as_ref(),
        "-o".as_ref(),
    ];
    let ran = run(args.into_iter().chain([out.as_os_str()]));
    assert!(ran.out.contains("1, 1 with an error"), "{}{}", ran.out, ran.err);
}

#[test]
fn a_name_that_leaves_no_room_for_a_companion_s_is_refused_with_that_reason() {
    let folder = TempDir::new().unwrap();
    let name = format!("{}.ply", "n".repeat(250));
    let cloud = named(&folder, name.as_ref());
    let ran = run(["analyze".as_ref(), cloud.as_os_str()]);
    assert_eq!(ran.status, 0);
    assert!(
        !ran.out.contains("too long"),
        "no companion is missed: {}",
        ran.out
    );
    let ran = annotate(&cloud, &words(AXIS));
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("File name too long"), "{}", ran.err);
}

#[test]
fn fields_that_a_spreadsheet_would_compute_are_texts() {
    let folder = TempDir::new().unwrap();
    let cloud = named(&folder, OsStr::new("=1+1.ply"));
    assert_eq!(annotate(&cloud, &words(AXIS)).status, 0);
    assert_eq!(annotate(&cloud, &words("--note @SUM(A1)")).status, 0);
    let set = folder.path().join("set").display().to_string();
    let (table, out) = (folder.path().join("axes.csv"), folder.path().join("out"));
    let (table, out) = (table.to_str().unwrap(), out.to_str().unwrap());
    assert_eq!(run(["annotations", &set, "--export", table]).status, 0);
    assert_eq!(run(["evaluate", &set, "--voxel-cm", "0.5", "-o", out]).status, 0);
    let is_formula = |field: &str| field.starts_with(['=', '+', '@']);
    for file in [table, &format!("{out}/results.csv")] {
        let mut reader = csv::Reader::from_path(file).unwrap();
        for record in reader.records() {
            let record = record.unwrap();
            assert!(record.iter().all(|field| !is_formula(field)), "{record:?}");
            assert_eq!(record.get(0), Some("'=1+1.ply"));
        }
    }
    // Whoever imports the table gets what was exported.
    let row = &read_table(&std::fs::read(table).unwrap()).unwrap()[0];
    assert_eq!(
        (row.file.as_str(), row.judgment.note.as_str()),
        ("=1+1.ply", "@SUM(A1)")
    );
    assert!(
        run(["annotations", &set, "--import", table])
            .err
            .contains("1 were known")
    );
}

#[test]
fn escapes_in_names_do_not_reach_the_terminal() {
    let folder = TempDir::new().unwrap();
    let cloud = named(&folder, OsStr::new("\u{1b}[2J\u{9b}31m.ply"));
    assert_eq!(annotate(&cloud, &words(AXIS)).status, 0);
    let set = folder.path().join("set").display().to_string();
    let out = folder.path().join("out").display().to_string();
    let missing = folder.path().join("\u{1b}[2Jmissing.ply");
    let shown = [
        run(["analyze".as_ref(), cloud.as_os_str()]),
        run(["analyze".as_ref(), missing.as_os_str()]),
        annotate(&cloud, &[]),
        run(["annotations", &set]),
        run(["evaluate", &set, "--voxel-cm", "0.5", "-o", &out]),
    ];
    for ran in shown {
        let text = ran.out + &ran.err;
        assert!(!text.contains(['\u{1b}', '\u{9b}']), "{text:?}");
    }
}
