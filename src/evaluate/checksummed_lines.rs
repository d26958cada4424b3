//! Files of JSON lines that only ever grow, each line behind a checksum.
//!
//! A program may be killed at any moment, and several may append to one file at once: a line is written in a
//! single call, between line breaks of its own, so that it is whole even behind half a line that somebody
//! else left there. A line whose checksum does not fit is skipped.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::fruit::sha256_hex;

/// The size in bytes beyond which a file is deleted instead of read.
const MAX_BYTES: u64 = 256 << 20;

/// Appends one value.
///
/// # Errors
/// Returns an error if the value cannot be serialized, or the file cannot be written.
pub(super) fn append(path: &Path, value: &impl Serialize) -> std::io::Result<()> {
    let text = serde_json::to_string(value)?;
    let mut file = OpenOptions::new().append(true).create(true).open(path)?;
    file.write_all(format!("\n{} {text}\n", checksum(&text)).as_bytes())
}

/// Reads every value whose line is whole, oldest first; none if there is no such file.
pub(super) fn read<T: DeserializeOwned>(path: &Path) -> Vec<T> {
    let Ok(file) = File::open(path) else {
        return Vec::new();
    };
    if file.metadata().is_ok_and(|m| m.len() > MAX_BYTES) {
        // Computing the values again is quicker than reading ever more of them.
        let _ = std::fs::remove_file(path);
        return Vec::new();
    }
    let parse = |line: Vec<u8>| {
        let line = String::from_utf8(line).ok()?;
        let (sum, text) = line.split_once(' ')?;
        (sum == checksum(text)).then(|| serde_json::from_str(text).ok())?
    };
    BufReader::new(file)
        .split(b'\n')
        .map_while(Result::ok)
        .filter_map(parse)
        .collect()
}

fn checksum(text: &str) -> String {
    sha256_hex(text.as_bytes())[..16].to_owned()
}
