//! The store of one annotator's axis of one cloud: no edit that was reported as saved is ever lost.
//!
//! An edit is appended to the journal first. Then the axis file is replaced: written under another name and renamed.
//! Only after that is the edit saved. Edits that cannot be written stay in memory and are tried again with the next
//! edit. All access to the disk goes through [`Files`].

use std::path::{Path, PathBuf};

use super::files::failed;
use super::journal::{Operation, head_line, operation_line};
use super::own_files::{COPIES, axis_of, candidate, choose_file, find_journal};
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
    /// All annotations ever made, those out of reach of redo included, oldest first.
    ever: Vec<Annotation>,
    operations: u64,
    journal: PathBuf,
    /// The number of bytes of the journal that are on the disk.
    journal_length: u64,
    /// The lines of the journal that are not on the disk yet.
    pending: Vec<u8>,
    axis: PathBuf,
    /// The content of the axis file when it was last read or written.
    axis_bytes: Option<Vec<u8>>,
    notices: Vec<Notice>,
}

impl Store {
    /// Opens the annotator's files beside a cloud. No file is created before the first edit. `unit` is the unit of
    /// the cloud's coordinates.
    ///
    /// If the files cannot be written, the store opens all the same and the second value is the error, so that the
    /// annotator can be warned before the first edit. Edits are then kept until [`Store::save`] succeeds.
    ///
    /// # Errors
    /// Returns an error if another program holds the journal, or if no file name is free.
    pub fn open(
        mut files: Box<dyn Files>,
        cloud_path: &Path,
        cloud: CloudId,
        unit: Unit,
        author: Author,
    ) -> Result<(Self, Result<(), StoreError>), StoreError> {
        let (journal, read, mut kept) = find_journal(&mut *files, cloud_path, &cloud, &author)?;
        let is_axis = |bytes: Vec<u8>| axis_of(&bytes, &cloud, &author).map(|axis| (axis, bytes));
        let (axis, found) = choose_file(
            |copy| author.axis_path(cloud_path, copy),
            |path| candidate(files.read(path, LONGEST_FILE), is_axis),
            &mut kept,
        )?;
        let mut notices = kept;
        if read.is_truncated {
            notices.push(Notice::TruncatedJournal(journal.clone()));
        }
        let mut store = Self {
            files,
            cloud_path: cloud_path.into(),
            cloud,
            unit,
            author,
            history: read.history,
            ever: read.ever,
            operations: read.operations,
            journal,
            journal_length: read.length,
            pending: Vec::new(),
            axis,
            axis_bytes: None,
            notices,
        };
        if let Some((found, bytes)) = found {
            store.axis_bytes = Some(bytes);
            store.adopt(found);
        }
        let writable = store.reconcile();
        Ok((store, writable))
    }

    /// The cloud.
    pub fn cloud(&self) -> &CloudId {
        &self.cloud
    }

    /// The author of the axis.
    pub fn author(&self) -> &Author {
        &self.author
    }

    /// The current annotation, saved or not; `None` before the first edit, or if all edits were undone.
    pub fn current(&self) -> Option<&Annotation> {
        self.history.current()
    }

    /// The history of undo and redo.
    pub fn history(&self) -> &History<Annotation> {
        &self.history
    }

    /// The number of operations so far: edits, undos and redos. It is the permanent number of the newest one in the
    /// journal.
    pub fn operations(&self) -> u64 {
        self.operations
    }

    /// Returns whether every operation is on the disk.
    pub fn is_saved(&self) -> bool {
        self.pending.is_empty() && self.axis_bytes == self.expected_bytes()
    }

    /// The path of the axis file.
    pub fn axis_path(&self) -> &Path {
        &self.axis
    }

    /// The path of the journal.
    pub fn journal_path(&self) -> &Path {
        &self.journal
    }

    /// Notices about the files that the annotator should see.
    pub fn notices(&self) -> &[Notice] {
        &self.notices
    }

    /// Makes a new annotation the current one and saves it. `now` is the time in RFC 3339, see [`super::now`].
    ///
    /// # Errors
    /// Returns [`StoreError::TooLong`] if no axis file can hold the edit, which is then refused. Returns any other error if
    /// the edit is not on the disk; it is kept all the same, and saved with the next one or by [`Store::save`].
    pub fn edit(&mut self, mut judgment: Judgment, now: &str) -> Result<(), StoreError> {
        self.notice_foreign_edit();
        // A computed axis that was seen once cannot be unseen, so undone edits count too.
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
        if state.to_json().len() as u64 > LONGEST_FILE {
            let path = self.axis.clone();
            return Err(StoreError::TooLong { path });
        }
        self.push(state, now);
        self.save()
    }

    /// Undoes the last edit. Returns whether there was one.
    ///
    /// # Errors
    /// Returns an error if the operation is not on the disk, as [`Store::edit`] does.
    pub fn undo(&mut self, now: &str) -> Result<bool, StoreError> {
        self.notice_foreign_edit();
        let could = self.history.undo().is_some();
        if could {
            self.journal_operation(Operation::Undo, now);
        }
        self.save().map(|()| could)
    }

    /// Redoes the next edit. Returns whether there was one.
    ///
    /// # Errors
    /// Returns an error if the operation is not on the disk, as [`Store::edit`] does.
    pub fn redo(&mut self, now: &str) -> Result<bool, StoreError> {
        self.notice_foreign_edit();
        let could = self.history.redo().is_some();
        if could {
            self.journal_operation(Operation::Redo, now);
        }
        self.save().map(|()| could)
    }

    /// Writes all operations that are not on the disk yet.
    ///
    /// # Errors
    /// Returns an error if they cannot be written. They are kept as long as the store lives.
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
        let wanted = self.expected_bytes();
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

    /// The content that the axis file should have; `None` if there should be no file.
    fn expected_bytes(&self) -> Option<Vec<u8>> {
        self.history.current().map(|state| state.to_json().into_bytes())
    }

    fn push(&mut self, state: Annotation, now: &str) {
        self.ever.push(state.clone());
        self.history.push(state.clone());
        self.journal_operation(Operation::Edit(Box::new(state)), now);
    }

    fn journal_operation(&mut self, operation: Operation, now: &str) {
        self.operations += 1;
        self.pending
            .extend(operation_line(self.operations, now, operation));
    }

    /// Makes an annotation found in the axis file the newest edit, since another program wrote it. An annotation that
    /// this store wrote once is ignored: the program died after journaling a later operation, before it replaced the file.
    fn adopt(&mut self, found: Annotation) {
        if !self.ever.contains(&found) {
            let when = found.modified.clone();
            self.push(found, &when);
            self.notices.push(Notice::EditedElsewhere(self.axis.clone()));
        }
    }

    /// Brings the axis file up to the journal, after opening.
    fn reconcile(&mut self) -> Result<(), StoreError> {
        let is_behind = self.pending.is_empty() && self.axis_bytes != self.expected_bytes();
        self.files
            .probe(&self.axis)
            .map_err(|error| failed(&self.axis, error))?;
        self.save()?;
        if is_behind {
            self.notices.push(Notice::Restored(self.axis.clone()));
        }
        Ok(())
    }

    /// Reads the axis file before it is replaced, in case another program has written it. A failure to read is ignored
    /// here: writing fails then too.
    fn notice_foreign_edit(&mut self) {
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
                self.adopt(found);
            }
            Err(reason) => {
                let kept = self.axis.clone();
                let free = (2..=COPIES)
                    .map(|copy| self.author.axis_path(&self.cloud_path, copy))
                    .find(|path| matches!(self.files.read(path, LONGEST_FILE), Ok(None)));
                // If no name is free, the file must still not be touched: writing to an empty path fails.
                self.axis = free.unwrap_or_default();
                self.axis_bytes = None;
                let instead = self.axis.clone();
                self.notices.push(Notice::NotOverwritten {
                    kept,
                    reason,
                    instead,
                });
            }
        }
    }
}
