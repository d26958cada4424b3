//! The reader of a cloud's file.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::MeshFormatError;
use crate::parallel::{Cancelled, PartOf, Watch};
use crate::ply::{self, PlyCloud, PlyError, Problem};
use crate::simulate::{MeshError, SimulateError};
use crate::text::one_line;

/// A cloud and its file.
#[derive(Debug, Clone, PartialEq)]
pub struct CloudFile {
    /// The file's path, as it was given.
    pub path: PathBuf,
    /// SHA-256 of its bytes, in 64 lowercase hexadecimal digits.
    pub sha256: String,
    /// The file's content.
    pub ply: PlyCloud,
}

/// A file that gives no cloud. Displayed as one line: the file, then the cause.
#[derive(Debug, thiserror::Error)]
#[error("{}: {kind}", one_line(&.path.display().to_string()))]
pub struct ReadError {
    /// The file's path, as it was given.
    pub path: PathBuf,
    /// The cause.
    pub kind: ReadErrorKind,
}

/// The reason why a file gives no cloud.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadErrorKind {
    /// No file has that name.
    #[error("there is no such file")]
    NotFound,
    /// It is a directory.
    #[error("this is a folder, not a file")]
    Folder,
    /// It is a pipe, a device or the like, whose end is unknown.
    #[error("this is not a regular file")]
    NotRegular,
    /// The operating system forbids it.
    #[error("permission to read the file is denied")]
    PermissionDenied,
    /// It is larger than the available memory.
    #[error("the file has {size} bytes, more than there is memory for")]
    TooLarge {
        /// Its size.
        size: u64,
    },
    /// The operating system failed in another way.
    #[error("the file cannot be read: {0}")]
    Io(io::Error),
    /// It is no PLY file, or a malformed one.
    #[error(transparent)]
    Ply(PlyError),
    /// The simulator gives no cloud with these settings.
    #[error(transparent)]
    Simulation(#[from] SimulateError),
    /// It is no mesh, or a malformed one.
    #[error(transparent)]
    MeshFormat(#[from] MeshFormatError),
    /// Its triangles cannot be used.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Reading was called off.
    #[error("reading was called off")]
    Cancelled,
}

impl From<Cancelled> for ReadErrorKind {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<PlyError> for ReadErrorKind {
    fn from(error: PlyError) -> Self {
        match error.problem {
            Problem::Cancelled => Self::Cancelled,
            _ => Self::Ply(error),
        }
    }
}

impl From<io::Error> for ReadErrorKind {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::NotFound,
            io::ErrorKind::PermissionDenied => Self::PermissionDenied,
            io::ErrorKind::IsADirectory => Self::Folder,
            _ => Self::Io(error),
        }
    }
}

/// Reads a cloud from a PLY file.
///
/// # Errors
/// Returns an error if the file is missing, is not a regular file, cannot be read, or is no well-formed PLY file with
/// vertices.
pub fn read_cloud(path: impl AsRef<Path>) -> Result<CloudFile, ReadError> {
    read_cloud_watched(path, &())
}

/// [`read_cloud`] with its progress reported to `watch`.
///
/// # Errors
/// Returns the errors of [`read_cloud`], and [`ReadErrorKind::Cancelled`] if the watch calls the work off. It is asked
/// every few milliseconds.
pub fn read_cloud_watched(path: impl AsRef<Path>, watch: &dyn Watch) -> Result<CloudFile, ReadError> {
    let path = path.as_ref();
    let part = |from, to| PartOf {
        watch,
        pieces: from..to,
        total: WHOLE,
    };
    let bytes = bytes_of(path, &part(0, FROM_DISK)).map_err(|kind| ReadError {
        path: path.to_owned(),
        kind,
    })?;
    parse_cloud_watched(path, &bytes, &part(FROM_DISK, WHOLE))
}

/// The number of pieces of progress, and the share of them that reading the bytes takes.
const WHOLE: usize = 1000;
const FROM_DISK: usize = 300;

/// Parses the bytes of a PLY file. `path` only names it in the result.
///
/// # Errors
/// Returns an error if the bytes are no well-formed PLY file with vertices.
pub fn parse_cloud(path: impl AsRef<Path>, bytes: &[u8]) -> Result<CloudFile, ReadError> {
    parse_cloud_watched(path, bytes, &())
}

/// [`parse_cloud`] with its progress reported to `watch`.
///
/// # Errors
/// Returns the errors of [`parse_cloud`], and [`ReadErrorKind::Cancelled`] if the watch calls the work off.
pub fn parse_cloud_watched(
    path: impl AsRef<Path>,
    bytes: &[u8],
    watch: &dyn Watch,
) -> Result<CloudFile, ReadError> {
    let path = path.as_ref().to_owned();
    let hash = || digest(bytes, watch);
    let parse = || ply::read_watched(bytes, watch);
    // Each takes about as long as the other.
    #[cfg(feature = "parallel")]
    let (sha256, ply) = rayon::join(hash, parse);
    #[cfg(not(feature = "parallel"))]
    let (sha256, ply) = (hash(), parse());
    match (ply, sha256) {
        (Ok(ply), Ok(sha256)) => Ok(CloudFile { path, sha256, ply }),
        (Err(error), _) => Err(ReadError {
            path,
            kind: error.into(),
        }),
        (_, Err(cancelled)) => Err(ReadError {
            path,
            kind: cancelled.into(),
        }),
    }
}

/// SHA-256 of the file, a megabyte at a time.
fn digest(bytes: &[u8], watch: &dyn Watch) -> Result<String, Cancelled> {
    let mut hasher = Sha256::new();
    for piece in bytes.chunks(1 << 20) {
        if watch.is_cancelled() {
            return Err(Cancelled);
        }
        hasher.update(piece);
    }
    Ok(hex::encode(hasher.finalize()))
}

/// The number of bytes between two questions to the watch: a few milliseconds.
const PIECE: u64 = 4 << 20;

/// Reads a regular file of a size that memory can hold.
pub(super) fn bytes_of(path: &Path, watch: &dyn Watch) -> Result<Vec<u8>, ReadErrorKind> {
    // Before the file is opened: opening a pipe waits for a writer.
    let metadata = std::fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(ReadErrorKind::Folder);
    }
    if !metadata.is_file() {
        return Err(ReadErrorKind::NotRegular);
    }
    let size = metadata.len();
    let mut bytes = Vec::new();
    let reserved = usize::try_from(size).is_ok_and(|size| bytes.try_reserve_exact(size).is_ok());
    if !reserved {
        return Err(ReadErrorKind::TooLarge { size });
    }
    // No more than its size, in case another program appends faster than we read.
    let mut file = File::open(path)?.take(size);
    loop {
        if watch.is_cancelled() {
            return Err(ReadErrorKind::Cancelled);
        }
        if file.by_ref().take(PIECE).read_to_end(&mut bytes)? == 0 {
            return Ok(bytes);
        }
        watch.advanced(bytes.len(), usize::try_from(size).unwrap_or(usize::MAX));
    }
}

/// SHA-256 of some bytes, in 64 lowercase hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    hex::encode(Sha256::digest(bytes))
}
