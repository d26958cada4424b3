//! The file operations that a store of annotations needs, its errors and its notices.

use std::io;
use std::path::{Path, PathBuf};

/// The file operations of a store. Tests replace the disk by one in memory that fails or dies at any operation.
pub trait Files: Send {
    /// Reads a whole file; `None` if it does not exist.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read, is longer than `longest` bytes, or is not a regular file.
    fn read(&mut self, path: &Path, longest: u64) -> io::Result<Option<Vec<u8>>>;
    /// Locks an existing journal for this program, as long as `self` lives.
    ///
    /// # Errors
    /// Returns [`io::ErrorKind::ResourceBusy`] if another program holds the lock, and any error of opening the file.
    fn claim(&mut self, path: &Path) -> io::Result<()>;
    /// Writes `bytes` at byte `at` of a journal, truncates the file there first, and returns once the bytes are on the
    /// disk. With `at` 0, a journal that is not locked yet is created and locked.
    ///
    /// # Errors
    /// Returns [`io::ErrorKind::AlreadyExists`] if another program has created the journal meanwhile, and any error of
    /// writing.
    fn append(&mut self, path: &Path, at: u64, bytes: &[u8]) -> io::Result<()>;
    /// Replaces a file atomically, and returns once the new content is on the disk: at any moment the path holds
    /// either the old content or the new.
    ///
    /// # Errors
    /// Returns any error of writing or renaming; the old content is then still in place.
    fn replace(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()>;
    /// Removes a file, which need not exist.
    ///
    /// # Errors
    /// Returns an error if the file exists and cannot be removed.
    fn remove(&mut self, path: &Path) -> io::Result<()>;
    /// Checks that a file can be created beside `path`.
    ///
    /// # Errors
    /// Returns an error if it cannot.
    fn probe(&mut self, path: &Path) -> io::Result<()>;
}

/// The reason why an edit is not saved or a store cannot be opened: one sentence that names the file.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// A file operation failed.
    #[error("{}: {error}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's error.
        error: io::Error,
    },
    /// The annotation is longer than an axis file may be. Nothing was changed.
    #[error("{}: the note is too long: an axis file has at most {} bytes", path.display(), super::LONGEST_FILE)]
    TooLong {
        /// The axis file.
        path: PathBuf,
    },
    /// Another program holds the journal.
    #[error("{}: another program is annotating this cloud under this name", path.display())]
    InUse {
        /// The journal.
        path: PathBuf,
    },
    /// Every name is taken by a foreign file.
    #[error("{}: this and all further copies are taken by other files", path.display())]
    NoName {
        /// The first of the names.
        path: PathBuf,
    },
}

/// A notice about a store's files that the annotator should see: one sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Notice {
    /// A foreign file was left as it is, and another file is written instead.
    NotOverwritten {
        /// The foreign file.
        kept: PathBuf,
        /// The reason why it is foreign, as the end of a sentence.
        reason: String,
        /// The file that is written instead.
        instead: PathBuf,
    },
    /// The axis file was missing or older than the journal, and was written again.
    Restored(PathBuf),
    /// Another program had changed the axis file; its content is now the newest edit.
    EditedElsewhere(PathBuf),
    /// The journal ended in a truncated line, which was never reported as saved.
    TruncatedJournal(PathBuf),
}

impl std::fmt::Display for Notice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NotOverwritten {
                kept,
                reason,
                instead,
            } => write!(
                f,
                "{} is left as it is, since {reason}; {} is written instead.",
                kept.display(),
                instead.file_name().unwrap_or_default().display()
            ),
            Self::Restored(path) => write!(f, "{} was written again from its journal.", path.display()),
            Self::EditedElsewhere(path) => write!(
                f,
                "{} was changed by another program: that is now the newest edit.",
                path.display()
            ),
            Self::TruncatedJournal(path) => write!(
                f,
                "{} ends in a line that was cut short, an edit that had not been saved.",
                path.display()
            ),
        }
    }
}

/// Converts the system's error into one that names the file.
pub(super) fn failed(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    match error.kind() {
        io::ErrorKind::ResourceBusy | io::ErrorKind::AlreadyExists => StoreError::InUse { path },
        _ => StoreError::Io { path, error },
    }
}
