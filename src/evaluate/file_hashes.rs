//! SHA-256 hashes of files, remembered together with size and modification time, so that an unchanged file
//! need not be read again.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use serde::{Deserialize, Serialize};

use crate::fruit::sha256_hex;

/// The age from which a file's modification time identifies its contents: a younger file may change again
/// within the resolution of the clock.
const SETTLED_AGE: Duration = Duration::from_secs(2);

/// Size and modification time of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct Stamp {
    bytes: u64,
    /// Nanoseconds since 1970.
    modified_ns: u64,
}

impl Stamp {
    /// Returns the stamp and the modification time of a regular file. Anything else has none: reading a
    /// pipe would wait for a writer.
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

/// One remembered file, as it is stored.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct FileHash {
    path: PathBuf,
    stamp: Stamp,
    sha256: String,
}

/// The hash of a file, as far as it is known without reading it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum KnownHash {
    /// The hash, or `None` if there is no such regular file.
    Known(Option<String>),
    /// The file would have to be read.
    Unread,
}

/// The remembered hashes.
#[derive(Debug, Default)]
pub(super) struct FileHashes {
    by_path: HashMap<PathBuf, (Stamp, String)>,
}

impl FileHashes {
    /// Remembers hashes that were stored before.
    pub(super) fn extend(&mut self, stored: impl IntoIterator<Item = FileHash>) {
        let entries = stored.into_iter();
        self.by_path
            .extend(entries.map(|FileHash { path, stamp, sha256 }| (path, (stamp, sha256))));
    }

    /// Returns the hash of a file that has the size and the modification time of the remembered one.
    pub(super) fn get(&self, path: &Path) -> KnownHash {
        let Some((stamp, _)) = Stamp::of(path) else {
            return KnownHash::Known(None);
        };
        match self.by_path.get(path) {
            Some((known, sha256)) if *known == stamp => KnownHash::Known(Some(sha256.clone())),
            _ => KnownHash::Unread,
        }
    }
}

/// A file's hash, just read.
#[derive(Debug)]
pub(super) struct ReadHash {
    pub(super) sha256: String,
    /// The entry to remember; `None` for a file that has changed too recently.
    pub(super) entry: Option<FileHash>,
}

/// Reads a file and computes its hash; `None` if it cannot be read or is no regular file.
pub(super) fn read_hash(path: &Path) -> Option<ReadHash> {
    // Before the contents: a change in between then counts as one.
    let (stamp, modified) = Stamp::of(path)?;
    let sha256 = sha256_hex(&std::fs::read(path).ok()?);
    let is_settled = SystemTime::now()
        .duration_since(modified)
        .is_ok_and(|age| age >= SETTLED_AGE);
    let entry = is_settled.then(|| FileHash {
        path: path.to_owned(),
        stamp,
        sha256: sha256.clone(),
    });
    Some(ReadHash { sha256, entry })
}
