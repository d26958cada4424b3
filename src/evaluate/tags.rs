//! Tags and notes that users give clouds: a file in the clouds' folder.
//!
//! An edit reads the file again, changes the part of one cloud, and replaces the file at once. A file that
//! does not parse, or that a newer program wrote, is left as it is.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::Row;
use crate::annotate::{DiskFiles, Files};

/// The file's name in the folder of the clouds.
pub const TAGS_FILE: &str = "axiscope-tags.json";
const SCHEMA: &str = "axiscope.tags/1";
/// The size in bytes beyond which a file is not read.
const MAX_BYTES: u64 = 64 << 20;

/// Tags and note of one cloud.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CloudTags {
    /// Short words, sorted, each once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// Free text.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl CloudTags {
    /// Returns whether there are neither tags nor a note.
    pub fn is_empty(&self) -> bool {
        self.tags.is_empty() && self.note.is_empty()
    }

    /// Returns a copy with the tags of a typed list: commas between, spaces around, in any order.
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

/// The contents of the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TagsFile {
    schema: String,
    clouds: BTreeMap<String, CloudTags>,
}

/// Reads the tags and notes of a folder, by the clouds' file names; none if there is no file.
///
/// # Errors
/// Returns a sentence if the file cannot be used.
pub fn read_tags(folder: &Path) -> Result<BTreeMap<String, CloudTags>, String> {
    let path = folder.join(TAGS_FILE);
    let named = |why: String| {
        format!(
            "{}: the tags are not used, and the file is left as it is: {why}.",
            path.display()
        )
    };
    let bytes = match DiskFiles::default().read(&path, MAX_BYTES) {
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

/// Writes the tags and the note of the cloud called `name` into the file of its folder, and returns once that
/// is on the disk.
///
/// # Errors
/// Returns a sentence if the file cannot be used or written.
pub fn write_tags(folder: &Path, name: &str, tagged: &CloudTags) -> Result<(), String> {
    let path = folder.join(TAGS_FILE);
    // One program at a time. Where folders cannot be locked, the last program wins, for this cloud alone.
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

/// Fills in tags and notes of the rows from those of their folder.
pub fn add_tags(rows: &mut [Row], tags: &BTreeMap<String, CloudTags>) {
    for row in rows {
        if let Some(tagged) = tags.get(&row.file) {
            row.tags = tagged.tags.join(", ");
            row.note.clone_from(&tagged.note);
        }
    }
}
