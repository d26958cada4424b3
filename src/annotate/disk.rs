//! An annotator's files on a disk. Every write is synced before it counts as done.

use std::fs::{File, Metadata, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::{Annotation, Files, LONGEST_FILE};

/// The files of one [`crate::annotate::Store`].
#[derive(Debug, Default)]
pub struct DiskFiles {
    /// The journal, opened and locked.
    journal: Option<(PathBuf, File)>,
}

impl DiskFiles {
    /// Returns the open journal if this is its path.
    fn open_journal(&mut self, path: &Path) -> Option<&mut File> {
        self.journal
            .as_mut()
            .filter(|(open, _)| open == path)
            .map(|(_, file)| file)
    }

    fn hold(&mut self, path: &Path, file: File) -> io::Result<()> {
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(io::ErrorKind::ResourceBusy.into()),
            // Some network drives have no locks: annotating without a lock is better than not at all.
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(error),
        }
        self.journal = Some((path.to_owned(), file));
        Ok(())
    }
}

impl Files for DiskFiles {
    fn read(&mut self, path: &Path, longest: u64) -> io::Result<Option<Vec<u8>>> {
        let mut bytes = Vec::new();
        // On Windows a lock keeps all other handles from reading, our own second one too.
        if let Some(journal) = self.open_journal(path) {
            journal.seek(SeekFrom::Start(0))?;
            journal.read_to_end(&mut bytes)?;
            return Ok(Some(bytes));
        }
        // Checked before the file is opened, as opening a named pipe blocks until another program writes to it.
        let metadata = match std::fs::metadata(path) {
            Ok(metadata) => metadata,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error),
        };
        if !metadata.is_file() {
            return Err(io::Error::other("it is not a regular file"));
        }
        if metadata.len() > longest {
            return Err(io::Error::other("it is too long for an axis"));
        }
        File::open(path)?.take(longest).read_to_end(&mut bytes)?;
        Ok(Some(bytes))
    }

    fn claim(&mut self, path: &Path) -> io::Result<()> {
        let file = OpenOptions::new().read(true).write(true).open(path)?;
        self.hold(path, file)
    }

    fn append(&mut self, path: &Path, at: u64, bytes: &[u8]) -> io::Result<()> {
        if self.open_journal(path).is_none() {
            let file = OpenOptions::new()
                .read(true)
                .write(true)
                .create_new(at == 0)
                .open(path)?;
            self.hold(path, file)?;
        }
        let Some(file) = self.open_journal(path) else {
            return Err(io::ErrorKind::NotFound.into());
        };
        let open = file.metadata()?;
        if open.len() < at {
            return Err(io::Error::other("it has become shorter"));
        }
        if !is_at(&open, path) {
            return Err(io::Error::other(
                "another program has removed or replaced it; open the cloud again",
            ));
        }
        file.set_len(at)?;
        file.seek(SeekFrom::Start(at))?;
        file.write_all(bytes)?;
        file.sync_data()?;
        if at == 0 { sync_folder_of(path) } else { Ok(()) }
    }

    fn replace(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        // A link stays one: the file that it names is replaced.
        let target = if path.is_symlink() {
            path.canonicalize()?
        } else {
            path.to_owned()
        };
        let aside = beside(&target, ".tmp");
        // One that a killed program has left; or a link that would lead elsewhere.
        match std::fs::remove_file(&aside) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        let mut file = OpenOptions::new().write(true).create_new(true).open(&aside)?;
        let written = file.write_all(bytes).and_then(|()| file.sync_all());
        drop(file);
        let done = written.and_then(|()| std::fs::rename(&aside, &target));
        if done.is_err() {
            // The first error is the one to report.
            let _ = std::fs::remove_file(&aside);
        }
        done?;
        sync_folder_of(&target)
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        match std::fs::remove_file(path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => sync_folder_of(path),
        }
    }

    fn probe(&mut self, path: &Path) -> io::Result<()> {
        let aside = beside(path, ".probe");
        drop(File::create(&aside)?);
        std::fs::remove_file(aside)
    }
}

/// Reads an axis file, whoever's and of whatever cloud it is.
///
/// # Errors
/// Returns the reason, as the end of a sentence, if the file cannot be read or is not an axis file.
pub fn read_annotation(path: &Path) -> Result<Annotation, String> {
    let bytes = DiskFiles::default().read(path, LONGEST_FILE);
    let bytes = bytes.map_err(|error| error.to_string())?.unwrap_or_default();
    Annotation::from_json(&bytes).map_err(|error| error.to_string())
}

/// Returns the path of a temporary file in the same folder. The name is fixed, so that a program that is killed again and
/// again leaves one such file at most; no other program writes it, as the journal is locked. (The crates `tempfile` and
/// `atomic-write-file` choose random names, and the former creates the file readable by its owner alone.)
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(ending);
    path.with_file_name(name)
}

/// Whether an open file is still the one of that name, so that what is written to it can be found again.
#[cfg(unix)]
fn is_at(open: &Metadata, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata(path).is_ok_and(|there| (there.dev(), there.ino()) == (open.dev(), open.ino()))
}

/// Whether there is still a file of that name: elsewhere an open file cannot be replaced.
#[cfg(not(unix))]
fn is_at(_: &Metadata, path: &Path) -> bool {
    path.exists()
}

/// Syncs the folder of a path: a new name is on the disk only once its folder is.
#[cfg(unix)]
fn sync_folder_of(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    File::open(folder.unwrap_or(Path::new(".")))?.sync_all()
}

/// Does nothing on systems where a folder cannot be opened as a file; they write names through.
#[cfg(not(unix))]
fn sync_folder_of(_: &Path) -> io::Result<()> {
    Ok(())
}
