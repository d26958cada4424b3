//! Files that the program writes: devices, links, full disks, and a standard error that nobody reads.
#![cfg(unix)]

use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output};

use crate::helpers::command_line::{fixture, run, simulate};
use crate::helpers::peppers::write_peppers;
use axiscope::fruit::{parse_cloud, read_cloud};
use tempfile::TempDir;

/// Runs a line of shell in a folder; `axiscope` in it is the program.
fn shell(folder: &Path, line: &str) -> Output {
    let line = format!(
        "axiscope() {{ {} \"$@\"; }}\n{line}",
        env!("CARGO_BIN_EXE_axiscope")
    );
    let mut command = Command::new("bash");
    command.args(["-c", &line]).current_dir(folder);
    command.output().expect("bash runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The names in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

#[test]
fn a_cloud_goes_to_standard_output_and_to_devices_but_never_replaces_one() {
    let folder = TempDir::new().unwrap();
    let file = simulate(&folder, "ellipsoid --points 50", "file.ply");
    let expected = std::fs::read(&file).unwrap();
    for out in ["-", "/dev/stdout", "/proc/self/fd/1"] {
        let ran = shell(
            folder.path(),
            &format!("axiscope simulate ellipsoid --points 50 -o {out}"),
        );
        assert!(ran.status.success(), "{out}: {}", text(&ran.stderr));
        assert!(ran.stdout == expected, "{out}: {}", text(&ran.stdout));
        assert!(parse_cloud("-", &ran.stdout).is_ok());
    }
    // What the shell has written into the file before stays.
    let line = "(echo before; axiscope simulate ellipsoid --points 50 -o /dev/stdout) > both";
    assert!(shell(folder.path(), line).status.success());
    let both = std::fs::read(folder.path().join("both")).unwrap();
    assert_eq!(both, [b"before\n", expected.as_slice()].concat());

    // A pipe stays one and is written to.
    let line = "mkfifo pipe && (cat pipe > got & axiscope simulate ellipsoid --points 50 -o pipe && wait)";
    assert!(shell(folder.path(), line).status.success());
    assert_eq!(std::fs::read(folder.path().join("got")).unwrap(), expected);
    assert!(!folder.path().join("pipe").is_file(), "it is still a pipe");
    let ran = shell(
        folder.path(),
        "axiscope simulate ellipsoid --points 50 -o /dev/full",
    );
    assert_eq!(ran.status.code(), Some(1));
    assert!(
        text(&ran.stderr).contains("/dev/full: No space left"),
        "{}",
        text(&ran.stderr)
    );
    assert_eq!(
        names(folder.path()),
        ["both", "file.ply", "file.truth.json", "got", "pipe"]
    );
    let ran = run(["simulate", "pepper", "--count", "2", "-o", "-"]);
    assert_eq!(ran.status, 2, "{}", ran.err);
}

#[test]
fn a_link_stays_one_and_its_file_keeps_its_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("elsewhere")).unwrap();
    let target = path("elsewhere/cloud.ply");
    std::fs::write(&target, "old").unwrap();
    std::fs::set_permissions(&target, PermissionsExt::from_mode(0o640)).unwrap();
    symlink(&target, path("link.ply")).unwrap();
    simulate(&folder, "ellipsoid --points 50", "link.ply");
    assert!(path("link.ply").is_symlink());
    assert_eq!(read_cloud(&target).unwrap().ply.cloud.len(), 50);
    let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode(&target), 0o640);
    // A new file is as open as any other.
    std::fs::write(path("any"), "").unwrap();
    assert_eq!(mode(&path("link.truth.json")), mode(&path("any")));

    symlink(path("nothing"), path("dangling.ply")).unwrap();
    let ran = shell(
        folder.path(),
        "axiscope simulate ellipsoid --points 50 -o dangling.ply",
    );
    assert_eq!(ran.status.code(), Some(1));
    assert!(text(&ran.stderr).contains("a link to a file that does not exist"));
    // The axis of an annotator who keeps it elsewhere.
    let cloud = simulate(&folder, "pepper --seed 3", "pepper.ply");
    let annotate = |edit: &str| {
        let options = ["annotate", cloud.to_str().unwrap(), "--annotator", "Ada"];
        run(options.into_iter().chain(edit.split_whitespace())).status
    };
    assert_eq!(annotate("--base 0,-4,50 --blossom 0,4,50"), 0);
    let axis = path("pepper.Ada.axis.json");
    std::fs::rename(&axis, path("elsewhere/axis.json")).unwrap();
    symlink(path("elsewhere/axis.json"), &axis).unwrap();
    assert_eq!(annotate("--note moved"), 0);
    assert!(axis.is_symlink());
    assert!(
        std::fs::read_to_string(path("elsewhere/axis.json"))
            .unwrap()
            .contains("moved")
    );
}

#[test]
fn a_disk_that_fills_up_leaves_the_old_results_whole_and_nothing_else() {
    let folder = TempDir::new().unwrap();
    write_peppers(&folder.path().join("set"), 2);
    let evaluate = "axiscope evaluate set --voxel-cm 0.4 -o out";
    assert!(shell(folder.path(), evaluate).status.success());
    let out = folder.path().join("out");
    let contents = || {
        let files = names(&out).into_iter().filter(|name| name != "rows");
        let content = |name: String| (std::fs::read(out.join(&name)).unwrap(), name);
        files.map(content).collect::<Vec<_>>()
    };
    let before = contents();
    assert!(before.len() > 8);
    // The limit of a file's size stands for a full disk: some of the files fit, and others do not.
    let limited = format!("trap '' XFSZ; ulimit -f 12; {evaluate} --u 5");
    let ran = shell(folder.path(), &limited);
    assert_eq!(ran.status.code(), Some(1), "{}", text(&ran.stderr));
    assert!(
        text(&ran.stderr).contains("File too large"),
        "{}",
        text(&ran.stderr)
    );
    assert!(
        contents() == before,
        "another file, or another content: {:?}",
        names(&out)
    );

    let cloud = simulate(&folder, "pepper --seed 3", "pepper.ply");
    let old = std::fs::read(&cloud).unwrap();
    let line = "trap '' XFSZ; ulimit -f 12; axiscope simulate pepper --seed 4 -o pepper.ply";
    assert_eq!(shell(folder.path(), line).status.code(), Some(1));
    assert!(std::fs::read(&cloud).unwrap() == old);
    assert_eq!(
        names(folder.path()),
        ["out", "pepper.ply", "pepper.truth.json", "set"]
    );
}

#[test]
fn a_standard_error_that_fails_ends_nothing() {
    let folder = TempDir::new().unwrap();
    write_peppers(&folder.path().join("set"), 1);
    let cloud = fixture("bumpy_cm.ply").display().to_string();
    let lines = [
        ("axiscope simulate ellipsoid --points 50 -o a.ply", 0),
        ("axiscope evaluate set --voxel-cm 0.5 -o out", 0),
        ("axiscope evaluate set --both --voxel-cm 0.5 -o both", 0),
        (&format!("axiscope analyze {cloud}"), 0),
        ("axiscope analyze missing.ply", 1),
        ("axiscope analyze --nonsense", 2),
        ("axiscope evaluate set --shard 1/1 --sweep u=0", 2),
    ];
    for (line, status) in lines {
        for broken in ["2>/dev/full", "2>&-", "2> >(true)"] {
            let ran = shell(folder.path(), &format!("{line} {broken}"));
            assert_eq!(ran.status.code(), Some(status), "{line} {broken}");
        }
        let ran = shell(folder.path(), &format!("{line} >/dev/full"));
        assert!(matches!(ran.status.code(), Some(0..=2)), "{line}");
        assert!(
            !text(&ran.stderr).contains("panicked"),
            "{line}: {}",
            text(&ran.stderr)
        );
    }
}

#[test]
fn evaluations_into_one_folder_at_once_warn_of_nothing() {
    let folder = TempDir::new().unwrap();
    write_peppers(&folder.path().join("set"), 2);
    let line = "for i in $(seq 8); do axiscope evaluate set --threads 1 --voxel-cm 0.5 -o out >/dev/null & done; wait";
    let ran = shell(folder.path(), line);
    assert!(!text(&ran.stderr).contains("Warning"), "{}", text(&ran.stderr));
    let ran = shell(
        folder.path(),
        "axiscope evaluate set --voxel-cm 0.5 -o out --resume",
    );
    assert!(ran.status.success() && !text(&ran.stderr).contains("Warning"));
}
