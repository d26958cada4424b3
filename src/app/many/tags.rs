//! Tags and notes of clouds: a file in their folder.
//!
//! An edit is shown at once and written behind it: the file is read again, only the edited cloud's part is
//! changed, and the whole goes aside, onto the disk, and into place. A file that does not parse, or is newer
//! than this program, is left as it is.

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::annotate::DiskFiles;
use crate::annotate::Files;
use crate::app::workers::{Pool, Queue};
use crate::text::sentence;

/// The file's name in the folder of the clouds.
pub const TAGS_FILE: &str = "axiscope-tags.json";
const SCHEMA: &str = "axiscope.tags/1";
/// No file of tags is longer.
const LONGEST: u64 = 64 << 20;

/// What somebody says of a cloud.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tagged {
    /// Short words, sorted, each once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// Anything.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl Tagged {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.tags.is_empty() && self.note.is_empty()
    }

    /// With these tags, as somebody types them: commas between, spaces around, in any order.
    #[must_use]
    pub fn with_tags(&self, typed: &str) -> Self {
        let mut tags: Vec<String> = typed
            .split(',')
            .map(|tag| tag.split_whitespace().collect::<Vec<_>>().join(" "))
            .filter(|tag| !tag.is_empty())
            .collect();
        tags.sort();
        tags.dedup();
        Self {
            tags,
            note: self.note.clone(),
        }
    }
}

/// The file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TagsFile {
    schema: String,
    clouds: BTreeMap<String, Tagged>,
}

/// The tags and notes in a folder, by the clouds' file names; none where there is no file.
///
/// # Errors
/// A sentence where the file cannot be used.
pub fn read_tags(folder: &Path) -> Result<BTreeMap<String, Tagged>, String> {
    let path = folder.join(TAGS_FILE);
    let named = |why: String| {
        format!(
            "{}: the tags are not used, and the file is left as it is: {why}.",
            path.display()
        )
    };
    let bytes = match DiskFiles::default().read(&path, LONGEST) {
        Ok(None) => return Ok(BTreeMap::new()),
        Ok(Some(bytes)) => bytes,
        Err(error) => return Err(named(error.to_string())),
    };
    // Its schema first: of a newer file nothing else can be expected to be understood.
    let schema = serde_json::from_slice::<serde_json::Value>(&bytes)
        .map_err(|error| named(error.to_string()))?
        .get("schema")
        .and_then(|s| s.as_str().map(str::to_owned));
    if schema.as_deref() != Some(SCHEMA) {
        let is = schema.map_or_else(|| "it names no schema".into(), |s| format!("its schema is {s:?}"));
        return Err(named(format!("{is}, and this program knows {SCHEMA:?}")));
    }
    let file: TagsFile = serde_json::from_slice(&bytes).map_err(|error| named(error.to_string()))?;
    Ok(file.clouds)
}

/// Changes what is said of one cloud in its folder's file, and returns once that is on the disk.
fn write_tags(folder: &Path, name: &str, tagged: &Tagged) -> Result<(), String> {
    let path = folder.join(TAGS_FILE);
    // One program at a time; where folders cannot be locked, the last one wins for this cloud alone.
    let lock = File::open(folder).ok();
    let _is_locked = lock.as_ref().is_some_and(|lock| lock.lock().is_ok());
    let mut clouds = read_tags(folder)?;
    if tagged.is_empty() {
        clouds.remove(name);
    } else {
        clouds.insert(name.to_owned(), tagged.clone());
    }
    let file = TagsFile {
        schema: SCHEMA.into(),
        clouds,
    };
    let mut text = serde_json::to_string_pretty(&file).map_err(|error| error.to_string())?;
    text.push('\n');
    DiskFiles::default()
        .replace(&path, text.as_bytes())
        .map_err(|error| {
            format!(
                "{}: the tags could not be saved, and are kept until the program ends: {error}.",
                path.display()
            )
        })
}

/// What came of a job.
#[derive(Debug)]
pub(super) enum Answer {
    /// The folder's tags, by the clouds' names, or what is wrong with them.
    Read(PathBuf, Result<BTreeMap<String, Tagged>, String>),
    /// One edit is on the disk, or why it is not.
    Written(Result<(), String>),
}

/// The reader and writer of tags, which does everything in the order in which it is asked, and what was asked before
/// the window closes too.
pub(super) struct TagStore {
    queue: Queue<(), Answer>,
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
            Answer::Read(folder, tags)
        });
    }

    pub(super) fn write(&mut self, path: PathBuf, tagged: Tagged) {
        self.edits += 1;
        let (newest, edit) = (self.newest.clone(), self.edits);
        let mut of_clouds = newest.lock().unwrap_or_else(PoisonError::into_inner);
        of_clouds.insert(path.clone(), edit);
        drop(of_clouds);
        self.queue.submit(move |()| {
            // Of what is typed, letter by letter, only the newest need go to the disk.
            let newest = newest.lock().unwrap_or_else(PoisonError::into_inner).get(&path).copied();
            if newest != Some(edit) {
                return Answer::Written(Ok(()));
            }
            let folder = path.parent().unwrap_or(Path::new(""));
            Answer::Written(write_tags(folder, &super::run::name_of(&path), &tagged))
        });
    }

    pub(super) fn take(&self) -> Option<Answer> {
        let (_, answer) = self.queue.take_within(Duration::ZERO)?;
        Some(answer.unwrap_or_else(|crash| Answer::Written(Err(sentence(&crash.to_string())))))
    }

    pub(super) fn is_busy(&self) -> bool {
        self.queue.is_busy()
    }
}
