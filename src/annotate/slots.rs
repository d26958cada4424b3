//! Under which names an annotator's files lie: those that must not be touched are passed over.

use std::io;
use std::path::{Path, PathBuf};

use super::files::failed;
use super::journal::{Journal, JournalError, read_journal};
use super::{Annotation, Author, CloudId, FileError, Files, Notice, StoreError};

/// How many names are tried.
pub(super) const COPIES: u32 = 99;

/// A name that was tried: nothing there, one of ours, or one that must not be touched.
pub(super) enum Slot<T> {
    Free,
    Ours(T),
    Kept(String),
}

/// The axis in a file, if it is this author's of this cloud; else why not.
pub(super) fn axis_of(bytes: &[u8], cloud: &CloudId, author: &Author) -> Result<Annotation, String> {
    let axis = Annotation::from_json(bytes).map_err(|error: FileError| error.to_string())?;
    if axis.cloud.sha256 != cloud.sha256 {
        return Err("it belongs to another cloud".into());
    }
    if !axis.is_by(author) {
        return Err(format!("it is {}'s", axis.annotator));
    }
    Ok(axis)
}

pub(super) fn slot<T>(
    read: io::Result<Option<Vec<u8>>>,
    parse: impl Fn(Vec<u8>) -> Result<T, String>,
) -> Slot<T> {
    match read {
        Ok(None) => Slot::Free,
        Ok(Some(bytes)) => parse(bytes).map_or_else(Slot::Kept, Slot::Ours),
        Err(error) => Slot::Kept(format!("it cannot be read ({error})")),
    }
}

/// The journal of this author for this cloud, claimed and read.
pub(super) fn find_journal(
    files: &mut dyn Files,
    cloud_path: &Path,
    cloud: &CloudId,
    author: &Author,
) -> Result<(PathBuf, Journal, Vec<Notice>), StoreError> {
    let parse = |bytes: Vec<u8>| {
        read_journal(&bytes, &cloud.sha256, author).map_err(|error: JournalError| error.to_string())
    };
    let mut kept = Vec::new();
    let name = |copy| author.journal_path(cloud_path, copy);
    let (path, journal) = choose(name, |path| slot(files.read(path, u64::MAX), parse), &mut kept)?;
    if journal.is_none() {
        return Ok((path, Journal::default(), kept));
    }
    match files.claim(&path) {
        Err(error) if error.kind() == io::ErrorKind::ResourceBusy => return Err(failed(&path, error)),
        // Whether it can be written is told later; it can be read.
        _ => {}
    }
    // Again, now that nobody else writes it.
    let journal = match slot(files.read(&path, u64::MAX), parse) {
        Slot::Ours(journal) => journal,
        Slot::Free => Journal::default(),
        Slot::Kept(reason) => {
            let error = io::Error::other(reason);
            return Err(StoreError::Io { path, error });
        }
    };
    Ok((path, journal, kept))
}

/// The name to write under: the last that is ours already, else the first that is free.
pub(super) fn choose<T>(
    name: impl Fn(u32) -> PathBuf,
    mut look: impl FnMut(&Path) -> Slot<T>,
    notices: &mut Vec<Notice>,
) -> Result<(PathBuf, Option<T>), StoreError> {
    let (mut ours, mut free, mut kept) = (None, None, Vec::new());
    for path in (1..=COPIES).map(&name) {
        match look(&path) {
            Slot::Ours(content) => ours = Some((path, content)),
            Slot::Free => free = free.or(Some(path)),
            Slot::Kept(reason) => kept.push((path, reason)),
        }
    }
    let (path, content) = match ours {
        Some((path, content)) => (path, Some(content)),
        None => (free.ok_or_else(|| StoreError::NoName { path: name(1) })?, None),
    };
    notices.extend(kept.into_iter().map(|(kept, reason)| Notice::KeptBeside {
        kept,
        reason,
        instead: path.clone(),
    }));
    Ok((path, content))
}
