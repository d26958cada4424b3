//! The choice of the files that belong to one annotator and cloud. Foreign files of the same name are never touched:
//! a further copy, `CLOUD.NAME.2.axis.json`, is used instead.

use std::io;
use std::path::{Path, PathBuf};

use super::files::failed;
use super::journal::{Journal, JournalError, read_journal};
use super::{Annotation, Author, CloudId, FileError, Files, LONGEST_FILE, Notice, StoreError};

/// The number of names that are tried.
pub(super) const COPIES: u32 = 99;

/// A name that was tried: free, the annotator's own file with its content, or a foreign file with the reason why it is
/// not theirs.
pub(super) enum Candidate<T> {
    Free,
    Own(T),
    Foreign(String),
    /// The name itself is impossible, and so are those of further copies.
    Impossible(io::Error),
}

/// Reads the axis in a file. Returns the reason, as the end of a sentence, if it is not this author's axis of this cloud.
pub(super) fn axis_of(bytes: &[u8], cloud: &CloudId, author: &Author) -> Result<Annotation, String> {
    let axis = Annotation::from_json(bytes).map_err(|error: FileError| error.to_string())?;
    if axis.to_json().len() as u64 > LONGEST_FILE {
        return Err("it is too long for an axis".into());
    }
    if axis.cloud.sha256 != cloud.sha256 {
        return Err("it belongs to another cloud".into());
    }
    if !axis.is_by(author) {
        return Err(format!("it is {}'s", axis.annotator));
    }
    Ok(axis)
}

pub(super) fn candidate<T>(
    read: io::Result<Option<Vec<u8>>>,
    parse: impl Fn(Vec<u8>) -> Result<T, String>,
) -> Candidate<T> {
    match read {
        Ok(None) => Candidate::Free,
        Ok(Some(bytes)) => parse(bytes).map_or_else(Candidate::Foreign, Candidate::Own),
        Err(error) if error.kind() == io::ErrorKind::InvalidFilename => Candidate::Impossible(error),
        Err(error) => Candidate::Foreign(format!("it cannot be read ({error})")),
    }
}

/// Finds, locks and reads the journal of this author for this cloud. Returns its path, its content and notices.
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
    let (path, journal) = choose_file(
        name,
        |path| candidate(files.read(path, u64::MAX), parse),
        &mut kept,
    )?;
    if journal.is_none() {
        return Ok((path, Journal::default(), kept));
    }
    match files.claim(&path) {
        Err(error) if error.kind() == io::ErrorKind::ResourceBusy => return Err(failed(&path, error)),
        // A journal that cannot be opened for writing can still be read; the error shows when it is written.
        _ => {}
    }
    // Read again under the lock: another program may have appended to it in between.
    let journal = match candidate(files.read(&path, u64::MAX), parse) {
        Candidate::Own(journal) => journal,
        Candidate::Free => Journal::default(),
        Candidate::Foreign(reason) => {
            let error = io::Error::other(reason);
            return Err(StoreError::Io { path, error });
        }
        Candidate::Impossible(error) => return Err(failed(&path, error)),
    };
    Ok((path, journal, kept))
}

/// Chooses the file to write: the annotator's own file with the highest copy number, else the first free name.
/// Returns its path, and its content if it exists.
pub(super) fn choose_file<T>(
    name: impl Fn(u32) -> PathBuf,
    mut look: impl FnMut(&Path) -> Candidate<T>,
    notices: &mut Vec<Notice>,
) -> Result<(PathBuf, Option<T>), StoreError> {
    let (mut ours, mut free, mut kept) = (None, None, Vec::new());
    for path in (1..=COPIES).map(&name) {
        match look(&path) {
            Candidate::Own(content) => ours = Some((path, content)),
            Candidate::Free => free = free.or(Some(path)),
            Candidate::Foreign(reason) => kept.push((path, reason)),
            Candidate::Impossible(error) => return Err(failed(&path, error)),
        }
    }
    let (path, content) = match ours {
        Some((path, content)) => (path, Some(content)),
        None => (free.ok_or_else(|| StoreError::NoName { path: name(1) })?, None),
    };
    notices.extend(kept.into_iter().map(|(kept, reason)| Notice::NotOverwritten {
        kept,
        reason,
        instead: path.clone(),
    }));
    Ok((path, content))
}
