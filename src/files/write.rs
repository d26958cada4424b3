//! The writing of files that are never seen half, alone or as a set.
//!
//! A file is written under another name in the same folder and renamed once it is complete, so that a full disk or a
//! killed program leaves the old one as it was. A symbolic link stays one: the file that it names is replaced. A device or
//! a pipe, `/dev/stdout` for instance, cannot be replaced and is written to.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// The error of a file that was not written: a clause that names it.
#[derive(Debug, thiserror::Error)]
#[error("{}: {error}", path.display())]
pub struct WriteError {
    /// The file, as the caller named it.
    pub path: PathBuf,
    /// The system's error.
    pub error: io::Error,
}

/// Writes one file, whole or not at all.
///
/// # Errors
/// Returns an error if it cannot be written; a file that was there before is then still there.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_all(&[(path, bytes)])
}

/// Writes several files that belong together. All of them are complete before the first gets its name.
///
/// # Errors
/// Returns an error if one of them cannot be written; those that were there before are then still there, and none of the
/// new ones, unless the disk fails while they get their names.
pub fn write_all<P: AsRef<Path>, B: AsRef<[u8]>>(files: &[(P, B)]) -> Result<(), WriteError> {
    let of = |path: &P| {
        let path = path.as_ref().to_owned();
        move |error| WriteError { path, error }
    };
    let mut pending = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        let target = Target::of(path.as_ref()).map_err(of(path))?;
        pending.push(target.prepare(bytes.as_ref()).map_err(of(path))?);
    }
    for (pending, (path, bytes)) in pending.into_iter().zip(files) {
        pending.finish(bytes.as_ref()).map_err(of(path))?;
    }
    Ok(())
}

/// Whether a path names a regular file, there or yet to be written, rather than a device, a pipe or a folder.
pub fn is_replaceable(path: &Path) -> bool {
    matches!(Target::of(path), Ok(Target::File(_)))
}

/// The place that a path names.
enum Target {
    /// A regular file, or none yet.
    File(PathBuf),
    /// Something that bytes are sent to.
    Stream(PathBuf),
}

/// A file that is complete but for its name, or a stream that nothing was sent to yet.
enum Pending {
    File(NamedTempFile, PathBuf),
    Stream(File),
}

impl Target {
    fn of(path: &Path) -> io::Result<Self> {
        // An open file may stand behind these names, to which the shell has others write as well.
        let is_handle = path.starts_with("/dev") || path.starts_with("/proc");
        match std::fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(io::Error::other("this is a folder, not a file")),
            Ok(found) if found.is_file() && !is_handle => Ok(Self::File(path.canonicalize()?)),
            Ok(_) => Ok(Self::Stream(path.to_owned())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                if path.is_symlink() {
                    return Err(io::Error::other("this is a link to a file that does not exist"));
                }
                if path.file_name().is_none() {
                    return Err(error);
                }
                Ok(Self::File(path.to_owned()))
            }
            Err(error) => Err(error),
        }
    }

    fn prepare(self, bytes: &[u8]) -> io::Result<Pending> {
        match self {
            // Opening a pipe waits for its reader, and what a device is sent cannot be taken back.
            Self::Stream(path) => Ok(Pending::Stream(OpenOptions::new().append(true).open(path)?)),
            Self::File(path) => {
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
                let mut file = empty_file_in(folder.unwrap_or(Path::new(".")))?;
                if let Ok(before) = std::fs::metadata(&path) {
                    if before.permissions().readonly() {
                        return Err(io::ErrorKind::PermissionDenied.into());
                    }
                    file.as_file().set_permissions(before.permissions())?;
                }
                file.write_all(bytes)?;
                // Some disks say only now that they are full.
                file.as_file().sync_all()?;
                Ok(Pending::File(file, path))
            }
        }
    }
}

impl Pending {
    fn finish(self, bytes: &[u8]) -> io::Result<()> {
        match self {
            Self::File(file, path) => file.persist(path).map(drop).map_err(|failed| failed.error),
            Self::Stream(mut stream) => stream.write_all(bytes),
        }
    }
}

/// Returns the error in plain words: `tempfile` adds the name of a file that nobody asked for.
fn without_its_name(error: io::Error) -> io::Error {
    use io::ErrorKind::{
        InvalidFilename, NotADirectory, NotFound, PermissionDenied, QuotaExceeded, ReadOnlyFilesystem,
        StorageFull,
    };
    match error.kind() {
        NotFound => io::Error::new(NotFound, "there is no such folder"),
        kind @ (InvalidFilename | NotADirectory | PermissionDenied | QuotaExceeded | ReadOnlyFilesystem
        | StorageFull) => kind.into(),
        _ => error,
    }
}

/// Creates an empty file that is deleted unless it gets a name. Its own is short, since the final one may be as long as
/// names can be; and its permissions are those of any new file, not those of a secret one.
fn empty_file_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".axiscope-");
    #[cfg(unix)]
    let everyone = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(everyone);
    builder.tempfile_in(folder).map_err(without_its_name)
}
