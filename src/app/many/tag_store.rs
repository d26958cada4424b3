//! The order in which tags are read and written, behind what is shown.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crate::app::workers::{Pool, Queue};
use crate::evaluate::{CloudTags, read_tags, write_tags};
use crate::text::sentence;

/// The result of a job.
#[derive(Debug)]
pub(super) enum TagResult {
    /// The tags of a folder by the clouds' names, or a sentence about the file.
    Read(PathBuf, Result<BTreeMap<String, CloudTags>, String>),
    /// One edit is on the disk, or a sentence says why not.
    Written(Result<(), String>),
}

/// The reader and writer of tags. It does every job in the order in which it was submitted, including those
/// that are left when the window closes.
pub(super) struct TagStore {
    queue: Queue<(), TagResult>,
    /// The newest edit of each cloud that is still to be written, by its number.
    newest: Arc<Mutex<HashMap<PathBuf, u64>>>,
    edits: u64,
}

impl TagStore {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            queue: Queue::new(pool, ()),
            newest: Arc::default(),
            edits: 0,
        }
    }

    pub(super) fn read(&self, folder: PathBuf) {
        self.queue.submit(|()| {
            let tags = read_tags(&folder);
            TagResult::Read(folder, tags)
        });
    }

    pub(super) fn write(&mut self, path: PathBuf, tagged: CloudTags) {
        self.edits += 1;
        let (newest, edit) = (self.newest.clone(), self.edits);
        let mut of_clouds = newest.lock().unwrap_or_else(PoisonError::into_inner);
        of_clouds.insert(path.clone(), edit);
        drop(of_clouds);
        self.queue.submit(move |()| {
            // While somebody types, only the newest text has to go to the disk.
            let newest = newest
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .get(&path)
                .copied();
            if newest != Some(edit) {
                return TagResult::Written(Ok(()));
            }
            let folder = path.parent().unwrap_or(Path::new(""));
            TagResult::Written(write_tags(folder, &super::background::name_of(&path), &tagged))
        });
    }

    pub(super) fn take(&self) -> Option<TagResult> {
        let (_, result) = self.queue.take_within(Duration::ZERO)?;
        Some(result.unwrap_or_else(|crash| TagResult::Written(Err(sentence(&crash.to_string())))))
    }

    pub(super) fn is_busy(&self) -> bool {
        self.queue.is_busy()
    }
}
