//! The results of evaluated clouds in memory and on disk: found again by the contents of their files and by
//! the parameters, whatever the files are called.
//!
//! The folder holds `stamps.jsonl` (hashes of files) and a `rows-….jsonl` for each set of parameters, both as
//! [`checksummed_lines`]: every program may be killed at any moment, and several may share a folder.

use std::collections::HashMap;
use std::fs::OpenOptions;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use super::checksummed_lines;
use super::file_hashes::{FileHashes, KnownHash, read_hash};
use super::{Outcome, SweepSettings, TruthChoice};
use crate::fruit::{Request, sha256_hex};

/// The number of parameter sets of which a cache keeps the rows on disk.
const MAX_FILES: usize = 24;
/// The number of parameter sets of which the rows stay in memory: users go back and forth between two.
const MAX_IN_MEMORY: usize = 4;
/// The number of thumbnails that a cache keeps on disk.
const MAX_THUMBNAILS: usize = 4000;
/// The folder of the thumbnails, in that of the rows.
pub(super) const THUMBNAILS: &str = "thumbnails";
/// The format of a stored row. It is counted up when rows get a new value, so that rows without it are computed again.
const ROW_FORMAT: u32 = 1;
const HASHES_FILE: &str = "stamps.jsonl";

/// The stored result of one cloud.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoredRow {
    /// The comparison with every reference.
    pub outcome: Arc<Outcome>,
    /// The error in degrees at each setting of a sweep, u-major; `None` without a sweep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep_deg: Option<Vec<Option<f64>>>,
}

/// A stored result with its key, as a line of a file.
#[derive(Serialize, Deserialize)]
struct RowLine {
    key: String,
    row: StoredRow,
}

/// The purpose of a store, which decides how long it keeps rows and what it believes of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StoreKind {
    /// A cache that saves time: a file whose size and modification time are the same counts as unchanged, and
    /// rows of parameters that were not used for long are deleted.
    #[default]
    Cache,
    /// The record of a run: each file is read to know whether it has changed, and every row is kept.
    Record,
}

/// The rows of clouds that were evaluated before. Any number of threads may use it.
#[derive(Debug, Default)]
pub struct RowStore {
    kind: StoreKind,
    inner: Mutex<Inner>,
}

#[derive(Debug, Default)]
struct Inner {
    folder: Option<PathBuf>,
    /// Whether the folder was prepared, which waits for the first use: it takes time.
    is_open: bool,
    hashes: FileHashes,
    /// Rows by parameters, the most recently used last.
    rows: Vec<(String, HashMap<String, StoredRow>)>,
    problem: Option<StoreProblem>,
    reads: usize,
}

/// The reason why nothing more is kept on disk.
#[derive(Debug, thiserror::Error)]
#[error("{}: {error}", path.display())]
pub struct StoreProblem {
    /// The file or folder that could not be written.
    pub path: PathBuf,
    /// The system's error.
    pub error: std::io::Error,
}

impl RowStore {
    /// Creates a store that keeps its rows in `folder`, which is made and read at the first use.
    pub fn in_folder(folder: PathBuf, kind: StoreKind) -> Self {
        let inner = Inner {
            folder: Some(folder),
            ..Inner::default()
        };
        Self {
            kind,
            inner: Mutex::new(inner),
        }
    }

    /// Returns the folder of the store; `None` if rows are kept in memory alone.
    pub fn folder(&self) -> Option<PathBuf> {
        self.lock().folder.clone()
    }

    /// Returns the reason why nothing more is kept on disk, once.
    pub fn take_problem(&self) -> Option<StoreProblem> {
        self.lock().problem.take()
    }

    /// Returns how many files were read to compute their hashes.
    pub fn hash_reads(&self) -> usize {
        self.lock().reads
    }

    /// Returns the hash of a file without reading it, where that is possible.
    pub fn known_hash(&self, path: &Path) -> KnownHash {
        self.open().hashes.get(path)
    }

    /// Returns the SHA-256 of a file, read where it is not known; `None` if there is no readable regular file.
    pub fn hash(&self, path: &Path) -> Option<String> {
        if self.kind == StoreKind::Record {
            return Some(read_hash(path)?.sha256);
        }
        if let KnownHash::Known(hash) = self.known_hash(path) {
            return hash;
        }
        // Unlocked: other threads go on meanwhile.
        let read = read_hash(path)?;
        let mut inner = self.open();
        inner.reads += 1;
        if let Some(entry) = read.entry {
            inner.append(HASHES_FILE, &entry);
            inner.hashes.extend([entry]);
        }
        Some(read.sha256)
    }

    /// Returns the row under the keys of parameters and cloud.
    pub fn get(&self, params_key: &str, cloud_key: &str) -> Option<StoredRow> {
        self.open().rows_of(params_key).get(cloud_key).cloned()
    }

    /// Keeps a row under the keys of parameters and cloud.
    pub fn insert(&self, params_key: &str, cloud_key: String, row: StoredRow) {
        let mut inner = self.open();
        if inner.rows_of(params_key).get(&cloud_key) == Some(&row) {
            return;
        }
        let line = RowLine { key: cloud_key, row };
        inner.append(&rows_file(params_key), &line);
        inner.rows_of(params_key).insert(line.key, line.row);
    }

    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Locks the store, and prepares the folder at the first use.
    fn open(&self) -> MutexGuard<'_, Inner> {
        let mut inner = self.lock();
        if std::mem::replace(&mut inner.is_open, true) {
            return inner;
        }
        let Some(folder) = inner.folder.clone() else {
            return inner;
        };
        match std::fs::create_dir_all(&folder) {
            Err(error) => inner.fail(folder, error),
            Ok(()) if self.kind == StoreKind::Cache => {
                inner
                    .hashes
                    .extend(checksummed_lines::read(&folder.join(HASHES_FILE)));
                keep_newest(&folder, MAX_FILES, |name| name.starts_with("rows-"));
                keep_newest(&folder.join(THUMBNAILS), MAX_THUMBNAILS, |_| true);
            }
            Ok(()) => {}
        }
        inner
    }
}

impl Inner {
    fn rows_of(&mut self, params_key: &str) -> &mut HashMap<String, StoredRow> {
        let place = self.rows.iter().position(|(known, _)| known == params_key);
        let entry = place.map(|place| self.rows.remove(place));
        let entry = entry.unwrap_or_else(|| (params_key.to_owned(), self.read_rows(params_key)));
        if self.rows.len() >= MAX_IN_MEMORY {
            self.rows.remove(0);
        }
        self.rows.push(entry);
        let last = self.rows.len() - 1;
        &mut self.rows[last].1
    }

    fn read_rows(&self, params_key: &str) -> HashMap<String, StoredRow> {
        let Some(folder) = &self.folder else {
            return HashMap::new();
        };
        let path = folder.join(rows_file(params_key));
        // The modification time tells which files were used last.
        if let Ok(file) = OpenOptions::new().append(true).open(&path) {
            let _ = file.set_modified(SystemTime::now());
        }
        let lines = checksummed_lines::read(&path).into_iter();
        lines.map(|RowLine { key, row }| (key, row)).collect()
    }

    fn append(&mut self, file: &str, value: &impl Serialize) {
        let Some(folder) = &self.folder else { return };
        let path = folder.join(file);
        if let Err(error) = checksummed_lines::append(&path, value) {
            self.fail(path, error);
        }
    }

    /// Keeps rows in memory alone from now on.
    fn fail(&mut self, path: PathBuf, error: std::io::Error) {
        self.problem = Some(StoreProblem { path, error });
        self.folder = None;
    }
}

/// Everything that the rows of an evaluation follow from besides the files.
#[derive(Serialize)]
struct ParamsKey<'a> {
    version: &'static str,
    /// [`ROW_FORMAT`].
    format: u32,
    request: &'a Request,
    sweep: Option<(&'a SweepSettings, TruthChoice)>,
}

/// Computes the key of the parameters of an evaluation.
pub(super) fn params_key(request: &Request, sweep: Option<(&SweepSettings, TruthChoice)>) -> String {
    stable_hash(&ParamsKey {
        version: env!("CARGO_PKG_VERSION"),
        format: ROW_FORMAT,
        request,
        sweep,
    })
}

/// Computes a hash that outlives a renaming of types and fields in the program: that of the serialized form.
pub(super) fn stable_hash(value: &impl Serialize) -> String {
    // Plain data, which can always be serialized.
    sha256_hex(&serde_json::to_vec(value).unwrap_or_default())
}

fn rows_file(params_key: &str) -> String {
    format!("rows-{}.jsonl", &params_key[..32.min(params_key.len())])
}

/// Deletes all but the `count` files of a folder that were modified last, among those with such a name.
fn keep_newest(folder: &Path, count: usize, is_candidate: impl Fn(&str) -> bool) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return;
    };
    let mut files: Vec<(SystemTime, PathBuf)> = entries
        .filter_map(|entry| {
            let entry = entry.ok()?;
            let modified = entry.metadata().ok()?.modified().ok()?;
            is_candidate(&entry.file_name().to_string_lossy()).then(|| (modified, entry.path()))
        })
        .collect();
    files.sort();
    let surplus = files.len().saturating_sub(count);
    for (_, path) in files.into_iter().take(surplus) {
        // A file that cannot be deleted now is deleted another time.
        let _ = std::fs::remove_file(path);
    }
}
