//! What a store of annotations asks of a disk, and what it has to say of it.

use std::io;
use std::path::{Path, PathBuf};

/// What a store asks of a disk.
pub trait Files: Send {
    /// The whole file; `None` where there is none.
    ///
    /// # Errors
    /// The system's, and where the file is longer than `longest` bytes or no regular file.
    fn read(&mut self, path: &Path, longest: u64) -> io::Result<Option<Vec<u8>>>;
    /// Keeps an existing journal for this program alone, as long as `self` lives.
    ///
    /// # Errors
    /// The system's; [`io::ErrorKind::ResourceBusy`] where another program has it.
    fn claim(&mut self, path: &Path) -> io::Result<()>;
    /// Writes at byte `at` of a journal, dropping what stands behind it, and returns once it is on the
    /// disk. At 0 a journal that was not claimed is made.
    ///
    /// # Errors
    /// The system's; [`io::ErrorKind::AlreadyExists`] where another program made it meanwhile.
    fn append(&mut self, path: &Path, at: u64, bytes: &[u8]) -> io::Result<()>;
    /// Puts a whole file in place at once, and returns once it is on the disk: at any moment there is
    /// either the old one or the new one.
    ///
    /// # Errors
    /// The system's.
    fn replace(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()>;
    /// Removes a file that may be missing.
    ///
    /// # Errors
    /// The system's.
    fn remove(&mut self, path: &Path) -> io::Result<()>;
    /// Nothing, where a file could be put there.
    ///
    /// # Errors
    /// The system's, where it could not.
    fn probe(&mut self, path: &Path) -> io::Result<()>;
}

/// Why an edit is not saved, or a store cannot be opened. One sentence that names the file.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The system failed.
    #[error("{}: {error}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// Another program is annotating.
    #[error("{}: another program is annotating this cloud under this name", path.display())]
    InUse {
        /// The journal.
        path: PathBuf,
    },
    /// Every name is taken by files that must not be touched.
    #[error("{}: this and all further copies are taken by other files", path.display())]
    NoName {
        /// The first.
        path: PathBuf,
    },
}

/// What an annotator ought to know about the files, in one sentence each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Notice {
    /// A file was left alone, and another is written instead.
    KeptBeside {
        /// The file that is not touched.
        kept: PathBuf,
        /// Why.
        reason: String,
        /// What is written instead.
        instead: PathBuf,
    },
    /// The axis file was older than the journal, or gone, and was written again.
    Restored(PathBuf),
    /// The axis file had been changed by another program; that is now the newest edit.
    TakenIn(PathBuf),
    /// The journal ends in a line that was cut short: an edit that was never said to be saved.
    CutShort(PathBuf),
}

impl std::fmt::Display for Notice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::KeptBeside {
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
            Self::TakenIn(path) => write!(
                f,
                "{} was changed by another program: that is now the newest edit.",
                path.display()
            ),
            Self::CutShort(path) => write!(
                f,
                "{} ends in a line that was cut short, an edit that had not been saved.",
                path.display()
            ),
        }
    }
}

/// The system's error, told.
pub(super) fn failed(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    match error.kind() {
        io::ErrorKind::ResourceBusy | io::ErrorKind::AlreadyExists => StoreError::InUse { path },
        _ => StoreError::Io { path, error },
    }
}
