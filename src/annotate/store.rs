//! One annotator's axis of one cloud, kept so that nothing is lost that was said to be saved.
//!
//! An edit goes to the end of the journal first, then into the axis file, which is written aside and
//! renamed. Only then is it saved. What cannot be written stays here and is tried again with the next
//! edit. Everything that touches a disk is behind [`Files`].

use std::path::{Path, PathBuf};

use super::files::failed;
use super::journal::{Deed, deed_line, head_line};
use super::slots::{COPIES, axis_of, choose, find_journal, slot};
use super::{Annotation, Author, CloudId, Files, Judgment, LONGEST_FILE, Method, Notice, StoreError};
use crate::geometry::Unit;
use crate::undo::History;

/// One annotator's axis of one cloud, with its history and its files.
pub struct Store {
    files: Box<dyn Files>,
    cloud_path: PathBuf,
    cloud: CloudId,
    unit: Unit,
    author: Author,
    history: History<Annotation>,
    /// Every annotation that there ever was, the oldest first.
    ever: Vec<Annotation>,
    deeds: u64,
    journal: PathBuf,
    /// Bytes of the journal that are on the disk.
    journal_length: u64,
    /// Lines that are not.
    pending: Vec<u8>,
    axis: PathBuf,
    /// What the axis file held when it was last looked at.
    axis_bytes: Option<Vec<u8>>,
    notices: Vec<Notice>,
}

impl Store {
    /// Opens the annotator's files beside a cloud. Nothing is written for an annotator who has said
    /// nothing. `unit` is what the cloud's coordinates are taken for.
    ///
    /// Where the files cannot be written, the store opens all the same, and `Err` is the second value:
    /// to be told at once. Its edits then wait for [`Store::save`].
    ///
    /// # Errors
    /// Where another program has the journal, or no name is free.
    pub fn open(
        mut files: Box<dyn Files>,
        cloud_path: &Path,
        cloud: CloudId,
        unit: Unit,
        author: Author,
    ) -> Result<(Self, Result<(), StoreError>), StoreError> {
        let (journal, read, mut kept) = find_journal(&mut *files, cloud_path, &cloud, &author)?;
        let is_axis = |bytes: Vec<u8>| axis_of(&bytes, &cloud, &author).map(|axis| (axis, bytes));
        let (axis, found) = choose(
            |copy| author.axis_path(cloud_path, copy),
            |path| slot(files.read(path, LONGEST_FILE), is_axis),
            &mut kept,
        )?;
        let mut notices = kept;
        if read.is_cut_short {
            notices.push(Notice::CutShort(journal.clone()));
        }
        let mut store = Self {
            files,
            cloud_path: cloud_path.into(),
            cloud,
            unit,
            author,
            history: read.history,
            ever: read.ever,
            deeds: read.deeds,
            journal,
            journal_length: read.length,
            pending: Vec::new(),
            axis,
            axis_bytes: None,
            notices,
        };
        if let Some((found, bytes)) = found {
            store.axis_bytes = Some(bytes);
            store.take_in(found);
        }
        let writable = store.make_good();
        Ok((store, writable))
    }

    /// The cloud.
    pub fn cloud(&self) -> &CloudId {
        &self.cloud
    }

    /// Whose axis it is.
    pub fn author(&self) -> &Author {
        &self.author
    }

    /// What holds now, saved or not; `None` where nothing has been said, or all was undone.
    pub fn current(&self) -> Option<&Annotation> {
        self.history.current()
    }

    /// What can be undone and done again.
    pub fn history(&self) -> &History<Annotation> {
        &self.history
    }

    /// The number of edits, undos and redos so far, from the first one on: each that is saved has its
    /// own, for good.
    pub fn deeds(&self) -> u64 {
        self.deeds
    }

    /// Whether all of it is on the disk.
    pub fn is_saved(&self) -> bool {
        self.pending.is_empty() && self.axis_bytes == self.wanted()
    }

    /// The axis file.
    pub fn axis_path(&self) -> &Path {
        &self.axis
    }

    /// The journal.
    pub fn journal_path(&self) -> &Path {
        &self.journal
    }

    /// What the annotator ought to know about the files.
    pub fn notices(&self) -> &[Notice] {
        &self.notices
    }

    /// A new state. `now` is the time (RFC 3339, as [`super::now`] gives it). `Ok` says that it is on
    /// the disk.
    ///
    /// # Errors
    /// Where it is not: the edit holds all the same, and is saved with the next one or by [`Store::save`].
    pub fn edit(&mut self, mut judgment: Judgment, now: &str) -> Result<(), StoreError> {
        self.look_again();
        // What was seen once cannot be unseen: undone edits count.
        let mut before = self.ever.iter();
        judgment.blind &= judgment.method == Method::ByHand && before.all(|state| state.judgment.blind);
        let created = self.ever.first().map(|first| first.created.clone());
        let state = Annotation {
            cloud: self.cloud.clone(),
            unit: self.unit,
            annotator: self.author.name().into(),
            role: self.author.role(),
            judgment,
            created: created.unwrap_or_else(|| now.into()),
            modified: now.into(),
            program: concat!("axiscope ", env!("CARGO_PKG_VERSION")).into(),
        };
        self.push(state, now);
        self.save()
    }

    /// Back by one edit. Whether there was one.
    ///
    /// # Errors
    /// Where that is not on the disk, as for [`Store::edit`].
    pub fn undo(&mut self, now: &str) -> Result<bool, StoreError> {
        self.look_again();
        let could = self.history.undo().is_some();
        if could {
            self.journal_deed(Deed::Undo, now);
        }
        self.save().map(|()| could)
    }

    /// Forward by one edit. Whether there was one.
    ///
    /// # Errors
    /// Where that is not on the disk, as for [`Store::edit`].
    pub fn redo(&mut self, now: &str) -> Result<bool, StoreError> {
        self.look_again();
        let could = self.history.redo().is_some();
        if could {
            self.journal_deed(Deed::Redo, now);
        }
        self.save().map(|()| could)
    }

    /// Writes what is not yet on the disk, if anything.
    ///
    /// # Errors
    /// Where it cannot be written; nothing is lost as long as the store lives.
    pub fn save(&mut self) -> Result<(), StoreError> {
        if !self.pending.is_empty() {
            let mut bytes = if self.journal_length == 0 {
                head_line(&self.cloud.sha256, &self.author)
            } else {
                Vec::new()
            };
            bytes.extend_from_slice(&self.pending);
            let appended = self.files.append(&self.journal, self.journal_length, &bytes);
            appended.map_err(|error| failed(&self.journal, error))?;
            self.journal_length += bytes.len() as u64;
            self.pending.clear();
        }
        let wanted = self.wanted();
        if self.axis_bytes != wanted {
            let written = match &wanted {
                Some(bytes) => self.files.replace(&self.axis, bytes),
                None => self.files.remove(&self.axis),
            };
            written.map_err(|error| failed(&self.axis, error))?;
            self.axis_bytes = wanted;
        }
        Ok(())
    }

    /// What the axis file ought to hold.
    fn wanted(&self) -> Option<Vec<u8>> {
        self.history.current().map(|state| state.to_json().into_bytes())
    }

    fn push(&mut self, state: Annotation, now: &str) {
        self.ever.push(state.clone());
        self.history.push(state.clone());
        self.journal_deed(Deed::Edit(Box::new(state)), now);
    }

    fn journal_deed(&mut self, deed: Deed, now: &str) {
        self.deeds += 1;
        self.pending.extend(deed_line(self.deeds, now, deed));
    }

    /// Another program's state of the axis file becomes the newest edit, unless it was ours once: then
    /// the program died before it had replaced the file.
    fn take_in(&mut self, found: Annotation) {
        if !self.ever.contains(&found) {
            let when = found.modified.clone();
            self.push(found, &when);
            self.notices.push(Notice::TakenIn(self.axis.clone()));
        }
    }

    /// After opening: the axis file as the journal has it.
    fn make_good(&mut self) -> Result<(), StoreError> {
        let is_behind = self.pending.is_empty() && self.axis_bytes != self.wanted();
        self.files
            .probe(&self.axis)
            .map_err(|error| failed(&self.axis, error))?;
        self.save()?;
        if is_behind {
            self.notices.push(Notice::Restored(self.axis.clone()));
        }
        Ok(())
    }

    /// Before the axis file is written: somebody else may have. What cannot be told now shows when the
    /// file is written.
    fn look_again(&mut self) {
        let Ok(bytes) = self.files.read(&self.axis, LONGEST_FILE) else {
            return;
        };
        if bytes == self.axis_bytes {
            return;
        }
        let Some(bytes) = bytes else {
            self.axis_bytes = None;
            return;
        };
        match axis_of(&bytes, &self.cloud, &self.author) {
            Ok(found) => {
                self.axis_bytes = Some(bytes);
                self.take_in(found);
            }
            Err(reason) => {
                let kept = self.axis.clone();
                let free = (2..=COPIES)
                    .map(|copy| self.author.axis_path(&self.cloud_path, copy))
                    .find(|path| matches!(self.files.read(path, LONGEST_FILE), Ok(None)));
                // With no name free the file must still not be touched: an empty name is refused.
                self.axis = free.unwrap_or_default();
                self.axis_bytes = None;
                let instead = self.axis.clone();
                self.notices.push(Notice::KeptBeside {
                    kept,
                    reason,
                    instead,
                });
            }
        }
    }
}
