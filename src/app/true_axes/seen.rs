//! The clouds of which something computed was shown, by their hashes, kept in a file: after that no axis is set blindly.

use std::collections::HashSet;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::Path;

use crate::files::read_regular;

/// The longest file that is read, in bytes: about a million clouds.
const LONGEST: u64 = 64 << 20;

/// Reads the hashes that were kept; none where there is no file yet. Lines that hold no hash are left out.
pub(super) fn read(path: &Path) -> Result<HashSet<String>, String> {
    match read_regular(path, LONGEST) {
        Ok(bytes) => {
            let text = String::from_utf8_lossy(&bytes);
            let is_hash = |line: &&str| line.len() == 64 && line.bytes().all(|b| b.is_ascii_hexdigit());
            Ok(text.lines().filter(is_hash).map(str::to_owned).collect())
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(HashSet::new()),
        Err(error) => Err(format!(
            "{}: it cannot be read which clouds were shown with results: {error}.",
            path.display()
        )),
    }
}

/// Appends hashes, a line each. A line that was cut off by a crash ends before the first of them.
pub(super) fn append(path: &Path, hashes: &[String]) -> Result<(), String> {
    let write = || {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        let mut file = OpenOptions::new().create(true).append(true).open(path)?;
        // In one call, so that two windows do not mix their lines.
        file.write_all(format!("\n{}\n", hashes.join("\n")).as_bytes())?;
        file.sync_data()
    };
    write().map_err(|error: std::io::Error| {
        format!(
            "{}: it cannot be kept which clouds were shown with results: {error}.",
            path.display()
        )
    })
}
