//! Edits of tags and notes: shown at once, written to disk in the background, and undone in turn with settings.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Many;
use super::background::name_of;
use super::cloud_rows::{Filter, TableRow};
use super::state::ManyState;
use super::tag_store::TagResult;
use crate::app::context::{Context, Step};
use crate::evaluate::CloudTags;

impl Many {
    pub(super) fn tag(&mut self, place: usize, tagged: CloudTags, cx: &mut Context) {
        let Some(row) = cx.state.many.rows.get(place) else {
            return;
        };
        let Some(path) = row.path.clone() else {
            cx.say(false, "A sample cannot be tagged: it is no file of yours.");
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
        cx.undo.push_of_gesture(step, Some(&gesture));
        self.set_tagged(path, tagged, cx);
    }

    pub(in crate::app) fn set_tagged(&mut self, path: PathBuf, tagged: CloudTags, cx: &mut Context) {
        if let Some(&place) = self.places.get(&path) {
            let row = &mut Arc::make_mut(&mut cx.state.many.rows)[place];
            row.tagged = tagged.clone();
            row.write_cells(place);
        }
        self.edited.insert(path.clone(), tagged.clone());
        self.tag_store.write(path, tagged);
        cx.state.many.gather_tags();
        cx.state.many.reorder();
    }

    /// Takes the results of reading and writing tags.
    pub(super) fn take_tags(&mut self, cx: &mut Context) {
        while let Some(result) = self.tag_store.take() {
            match result {
                TagResult::Read(folder, Ok(mut tags)) => {
                    let rows = Arc::make_mut(&mut cx.state.many.rows);
                    for (place, row) in rows.iter_mut().enumerate() {
                        let is_there = row.path.as_deref().and_then(Path::parent) == Some(&*folder);
                        // What was said while the file was read is newer.
                        let path = row.path.as_ref();
                        let said = path.is_some_and(|path| self.edited.contains_key(path));
                        if !is_there || said {
                            continue;
                        }
                        let name = row.path.as_deref().map(name_of).unwrap_or_default();
                        if let Some(tagged) = tags.remove(&name) {
                            row.tagged = tagged;
                            row.write_cells(place);
                        }
                    }
                    cx.state.many.gather_tags();
                    cx.state.many.reorder();
                }
                TagResult::Read(_, Err(problem)) | TagResult::Written(Err(problem)) => cx.say(true, problem),
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

impl ManyState {
    fn gather_tags(&mut self) {
        let rows = self.rows.iter();
        let tags: BTreeSet<&String> = rows.flat_map(|row| &row.tagged.tags).collect();
        self.known_tags = Arc::new(tags.into_iter().cloned().collect());
        let is_gone = |tag: &String| !self.known_tags.contains(tag);
        if self.filter.tag.as_ref().is_some_and(is_gone) {
            self.filter = Filter {
                tag: None,
                ..self.filter.clone()
            };
        }
    }
}
