//! Running the program as a user does.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

pub fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/fixtures")
        .join(name)
}

pub fn axiscope() -> Command {
    let mut command = Command::cargo_bin("axiscope").expect("the binary is built");
    command.timeout(std::time::Duration::from_mins(1));
    command
}

pub struct Ran {
    pub status: i32,
    pub out: String,
    pub err: String,
}

pub fn run<S: AsRef<std::ffi::OsStr>>(args: impl IntoIterator<Item = S>) -> Ran {
    let output = axiscope().args(args).output().expect("it runs");
    Ran {
        status: output.status.code().expect("no signal ended it"),
        out: String::from_utf8(output.stdout).expect("UTF-8"),
        err: String::from_utf8(output.stderr).expect("UTF-8"),
    }
}

pub fn analyze(cloud: &Path, options: &str) -> Ran {
    let cloud = cloud.to_str().expect("UTF-8");
    run(["analyze", cloud].into_iter().chain(options.split_whitespace()))
}

pub fn json(cloud: &Path, options: &str) -> Value {
    let ran = analyze(cloud, &format!("{options} --format json"));
    assert_eq!(ran.status, 0, "{}", ran.err);
    serde_json::from_str(&ran.out).expect("one JSON object")
}

pub fn simulate(folder: &TempDir, options: &str, name: &str) -> PathBuf {
    let path = folder.path().join(name);
    let out = path.to_str().expect("UTF-8");
    let ran = run(["simulate"]
        .into_iter()
        .chain(options.split_whitespace())
        .chain(["-o", out]));
    assert_eq!(ran.status, 0, "{}", ran.err);
    path
}

pub fn keys(value: &Value) -> Vec<&str> {
    value
        .as_object()
        .expect("an object")
        .keys()
        .map(String::as_str)
        .collect()
}
