//! Edits of tags and notes: shown at once, written to disk in the background, and undone in turn with settings.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::background::name_of;
use super::tag_store::TagResult;
use super::{Filter, Many, TableRow};
use crate::app::{App, Step};
use crate::evaluate::CloudTags;

impl App {
    pub(super) fn tag(&mut self, place: usize, tagged: CloudTags) {
        let Some(row) = self.state.many.rows.get(place) else {
            return;
        };
        let Some(path) = row.path.clone() else {
            self.say(false, "A sample cannot be tagged: it is no file of yours.".into());
            return;
        };
        if row.tagged == tagged {
            return;
        }
        let before = row.tagged.clone();
        // What is typed in one cloud's tags, letter by letter, is one step.
        let gesture = format!("tags {}", path.display());
        let step = Step::Tags {
            path: path.clone(),
            tagged: before,
        };
        self.undo.push_of_gesture(step, Some(&gesture));
        self.set_tagged(path, tagged);
    }

    pub(in crate::app) fn set_tagged(&mut self, path: PathBuf, tagged: CloudTags) {
        if let Some(&place) = self.many.places.get(&path) {
            let row = &mut Arc::make_mut(&mut self.state.many.rows)[place];
            row.tagged = tagged.clone();
            row.write_cells(place);
        }
        self.many.edited.insert(path.clone(), tagged.clone());
        self.many.tag_store.write(path, tagged);
        self.gather_tags();
        self.reorder();
    }

    fn gather_tags(&mut self) {
        let rows = self.state.many.rows.iter();
        let tags: BTreeSet<&String> = rows.flat_map(|row| &row.tagged.tags).collect();
        self.state.many.known_tags = Arc::new(tags.into_iter().cloned().collect());
        let is_gone = |tag: &String| !self.state.many.known_tags.contains(tag);
        if self.state.many.filter.tag.as_ref().is_some_and(is_gone) {
            self.state.many.filter = Filter {
                tag: None,
                ..self.state.many.filter.clone()
            };
        }
    }

    /// Takes the results of reading and writing tags.
    pub(super) fn take_tags(&mut self) {
        while let Some(result) = self.many.tag_store.take() {
            match result {
                TagResult::Read(folder, Ok(mut tags)) => {
                    let rows = Arc::make_mut(&mut self.state.many.rows);
                    for (place, row) in rows.iter_mut().enumerate() {
                        let is_there = row.path.as_deref().and_then(Path::parent) == Some(&*folder);
                        // What was said while the file was read is newer.
                        let path = row.path.as_ref();
                        let said = path.is_some_and(|path| self.many.edited.contains_key(path));
                        if !is_there || said {
                            continue;
                        }
                        let name = row.path.as_deref().map(name_of).unwrap_or_default();
                        if let Some(tagged) = tags.remove(&name) {
                            row.tagged = tagged;
                            row.write_cells(place);
                        }
                    }
                    self.gather_tags();
                    self.reorder();
                }
                TagResult::Read(_, Err(problem)) | TagResult::Written(Err(problem)) => {
                    self.say(true, problem)
                }
                TagResult::Written(Ok(())) => {}
            }
        }
    }
}

impl Many {
    /// The tags and the note of a cloud now, which may no longer be in the list.
    pub(in crate::app) fn tagged(&self, rows: &[TableRow], path: &Path) -> CloudTags {
        let row = self.places.get(path).and_then(|&place| rows.get(place));
        let tagged = row.map(|row| &row.tagged).or(self.edited.get(path));
        tagged.cloned().unwrap_or_default()
    }
}
