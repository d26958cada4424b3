//! Rows that were worked out before, on disk and in memory.
//!
//! Two kinds of files, both of lines that are only ever appended, each with a checksum in front, so that
//! two programs may write at once and half a line is no line:
//!
//! - `stamps.jsonl`: size and time of a file, and the SHA-256 of its bytes, so that what has not changed need
//!   not be read again;
//! - `rows-….jsonl`, a file for each set of parameters: what came of clouds with those bytes.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::evaluate::Outcome;
use crate::fruit::Request;
use crate::fruit::sha256_hex;

/// Sets of parameters whose rows stay on disk.
const KEPT_FILES: usize = 24;
/// A file that has grown beyond this begins anew.
const LARGEST: u64 = 256 << 20;
/// A file that changed so shortly before it was read may change again without its time telling so.
const SETTLED: Duration = Duration::from_secs(2);

/// What tells that a file has not changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct Stamp {
    bytes: u64,
    /// Nanoseconds since 1970.
    modified_ns: u64,
}

impl Stamp {
    /// The file's; `None` where there is no regular file, and reading a pipe would wait for a writer.
    fn of(path: &Path) -> Option<(Self, SystemTime)> {
        let metadata = std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file)?;
        let modified = metadata.modified().ok()?;
        let since = modified.duration_since(SystemTime::UNIX_EPOCH).ok()?;
        let stamp = Self {
            bytes: metadata.len(),
            modified_ns: u64::try_from(since.as_nanos()).ok()?,
        };
        Some((stamp, modified))
    }
}

#[derive(Serialize, Deserialize)]
struct StampLine {
    path: PathBuf,
    stamp: Stamp,
    sha256: String,
}

#[derive(Serialize, Deserialize)]
struct RowLine {
    key: String,
    outcome: Arc<Outcome>,
}

/// Whether a file's hash is known, and what it is; `None` in it where there is no such file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Hash {
    Known(Option<String>),
    /// It would have to be read.
    Unread,
}

/// What is known of files and of their rows.
#[derive(Debug, Default)]
pub(super) struct Cache {
    folder: Option<PathBuf>,
    /// Loaded from the disk at the first question.
    is_loaded: bool,
    stamps: HashMap<PathBuf, (Stamp, String)>,
    /// By parameters, the newest last.
    rows: Vec<(String, HashMap<String, Arc<Outcome>>)>,
    /// Why nothing is kept on disk, said once.
    problem: Option<String>,
    /// Files whose bytes were read to know their hash.
    reads: usize,
}

impl Cache {
    /// What was kept in `folder` counts from now on, and what comes is kept there.
    pub(super) fn keep_in(&mut self, folder: PathBuf) {
        *self = Self {
            folder: Some(folder),
            ..Self::default()
        };
    }

    /// Where things are kept on disk.
    pub(super) fn folder(&self) -> Option<PathBuf> {
        self.folder.clone()
    }

    /// Why nothing is kept on disk, the first time that is asked.
    pub(super) fn take_problem(&mut self) -> Option<String> {
        self.problem.take()
    }

    /// Files that were read for their hash since the program began.
    pub(super) fn reads(&self) -> usize {
        self.reads
    }

    /// The hash of a file as far as it is known without reading it.
    pub(super) fn known_hash(&mut self, path: &Path) -> Hash {
        self.load();
        let Some((stamp, _)) = Stamp::of(path) else {
            return Hash::Known(None);
        };
        match self.stamps.get(path) {
            Some((known, sha256)) if *known == stamp => Hash::Known(Some(sha256.clone())),
            _ => Hash::Unread,
        }
    }

    /// Keeps what was read: the stamp before reading, and the hash.
    pub(super) fn learn(&mut self, path: &Path, read: &ReadFile) {
        self.reads += 1;
        if !read.is_settled {
            return;
        }
        let line = StampLine {
            path: path.to_owned(),
            stamp: read.stamp,
            sha256: read.sha256.clone(),
        };
        self.append("stamps.jsonl", &line);
        self.stamps.insert(line.path, (line.stamp, line.sha256));
    }

    /// What came of a cloud before, under the parameters' hash and the cloud's key.
    pub(super) fn row(&mut self, params: &str, key: &str) -> Option<Arc<Outcome>> {
        self.rows_of(params).get(key).cloned()
    }

    /// Keeps what came of a cloud.
    pub(super) fn keep(&mut self, params: &str, key: &str, outcome: &Arc<Outcome>) {
        let line = RowLine {
            key: key.to_owned(),
            outcome: outcome.clone(),
        };
        self.append(&rows_file(params), &line);
        self.rows_of(params).insert(line.key, line.outcome);
    }

    fn rows_of(&mut self, params: &str) -> &mut HashMap<String, Arc<Outcome>> {
        let place = self.rows.iter().position(|(known, _)| known == params);
        let entry = place.map(|place| self.rows.remove(place));
        let entry = entry.unwrap_or_else(|| (params.to_owned(), self.read_rows(params)));
        // Two sets of parameters are gone to and fro between; more need no memory.
        if self.rows.len() > 3 {
            self.rows.remove(0);
        }
        self.rows.push(entry);
        let last = self.rows.len() - 1;
        &mut self.rows[last].1
    }

    fn read_rows(&self, params: &str) -> HashMap<String, Arc<Outcome>> {
        let Some(folder) = &self.folder else {
            return HashMap::new();
        };
        let path = folder.join(rows_file(params));
        // Used just now: it is not among those that go.
        if let Ok(file) = OpenOptions::new().append(true).open(&path) {
            let _ = file.set_modified(SystemTime::now());
        }
        let lines = lines(&path).into_iter();
        lines.map(|RowLine { key, outcome }| (key, outcome)).collect()
    }

    fn load(&mut self) {
        if std::mem::replace(&mut self.is_loaded, true) {
            return;
        }
        let Some(folder) = &self.folder else { return };
        if let Err(error) = std::fs::create_dir_all(folder) {
            self.problem = Some(format!(
                "{}: rows cannot be kept for the next time: {error}.",
                folder.display()
            ));
            self.folder = None;
            return;
        }
        for StampLine { path, stamp, sha256 } in lines(&folder.join("stamps.jsonl")) {
            self.stamps.insert(path, (stamp, sha256));
        }
        prune(folder);
        super::thumbnails::prune(folder);
    }

    fn append(&mut self, name: &str, line: &impl Serialize) {
        let Some(folder) = &self.folder else { return };
        let path = folder.join(name);
        let write = || {
            let text = serde_json::to_string(line)?;
            let mut file = OpenOptions::new().append(true).create(true).open(&path)?;
            // All in one call, between line ends of its own: behind another program's half a line it
            // is still a line.
            file.write_all(format!("\n{} {text}\n", checksum(&text)).as_bytes())
        };
        if let Err(error) = write() {
            self.problem = Some(format!(
                "{}: rows cannot be kept for the next time: {error}.",
                path.display()
            ));
            self.folder = None;
        }
    }
}

/// A file that was read for its hash.
pub(super) struct ReadFile {
    stamp: Stamp,
    is_settled: bool,
    pub(super) sha256: String,
}

/// Reads a file for its hash; `None` where it cannot be read.
pub(super) fn read_hash(path: &Path) -> Option<ReadFile> {
    let (stamp, modified) = Stamp::of(path)?;
    let bytes = std::fs::read(path).ok()?;
    let age = SystemTime::now().duration_since(modified);
    Some(ReadFile {
        stamp,
        is_settled: age.is_ok_and(|age| age >= SETTLED),
        sha256: sha256_hex(&bytes),
    })
}

/// What tells one set of parameters from another.
pub(super) fn params_hash(request: &Request) -> String {
    // The names that serde writes, not those of the program's own: a row outlives a renaming.
    let text = serde_json::to_string(request).unwrap_or_default();
    sha256_hex(format!("{} {text}", env!("CARGO_PKG_VERSION")).as_bytes())
}

/// What tells a cloud's files from others with the same names.
pub(super) fn row_key(hashes: &[Option<String>]) -> String {
    let parts: Vec<&str> = hashes.iter().map(|h| h.as_deref().unwrap_or("none")).collect();
    sha256_hex(parts.join(" ").as_bytes())
}

fn rows_file(params: &str) -> String {
    format!("rows-{}.jsonl", &params[..32.min(params.len())])
}

fn checksum(text: &str) -> String {
    sha256_hex(text.as_bytes())[..16].to_owned()
}

/// The lines of a file that are whole; what else is in it is passed over.
fn lines<T: DeserializeOwned>(path: &Path) -> Vec<T> {
    let Ok(file) = File::open(path) else {
        return Vec::new();
    };
    if file.metadata().is_ok_and(|m| m.len() > LARGEST) {
        // Better worked out again than read for ever.
        let _ = std::fs::remove_file(path);
        return Vec::new();
    }
    let whole = |line: Vec<u8>| {
        let line = String::from_utf8(line).ok()?;
        let (sum, text) = line.split_once(' ')?;
        (sum == checksum(text)).then(|| serde_json::from_str(text).ok())?
    };
    BufReader::new(file)
        .split(b'\n')
        .map_while(Result::ok)
        .filter_map(whole)
        .collect()
}

/// Lets go of the sets of parameters that were used longest ago.
fn prune(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return;
    };
    let mut files: Vec<(SystemTime, PathBuf)> = entries
        .filter_map(|entry| {
            let entry = entry.ok()?;
            let name = entry.file_name();
            let is_rows = name.to_string_lossy().starts_with("rows-");
            let modified = entry.metadata().ok()?.modified().ok()?;
            is_rows.then(|| (modified, entry.path()))
        })
        .collect();
    files.sort();
    let surplus = files.len().saturating_sub(KEPT_FILES);
    for (_, path) in files.into_iter().take(surplus) {
        let _ = std::fs::remove_file(path);
    }
}
