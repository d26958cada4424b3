//! Tags and notes as somebody changes them: shown at once, written behind it, and undone in turn with settings.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::background::name_of;
use super::tag_writer::TagResult;
use super::{Filter, TagEdit};
use crate::app::App;
use crate::evaluate::Tagged;

impl App {
    pub(super) fn tag(&mut self, place: usize, tagged: Tagged) {
        let Some(row) = self.state.folder.rows.get(place) else {
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
        self.folder.undone.clear();
        let depth = self.history.depth();
        let continues = self.folder.is_typing;
        match self.folder.done.last_mut() {
            Some(last) if continues && last.path == path && last.depth == depth => {
                last.after = tagged.clone();
            }
            _ => self.folder.done.push(TagEdit {
                path: path.clone(),
                before,
                after: tagged.clone(),
                depth,
            }),
        }
        self.folder.is_typing = true;
        self.set_tagged(path, tagged);
    }

    fn set_tagged(&mut self, path: PathBuf, tagged: Tagged) {
        if let Some(&place) = self.folder.places.get(&path) {
            let row = &mut Arc::make_mut(&mut self.state.folder.rows)[place];
            row.tagged = tagged.clone();
            row.write_cells(place);
        }
        self.folder.tag_writer.write(path, tagged);
        self.gather_tags();
        self.reorder();
    }

    fn gather_tags(&mut self) {
        let rows = self.state.folder.rows.iter();
        let tags: BTreeSet<&String> = rows.flat_map(|row| &row.tagged.tags).collect();
        self.state.folder.known_tags = Arc::new(tags.into_iter().cloned().collect());
        let is_gone = |tag: &String| !self.state.folder.known_tags.contains(tag);
        if self.state.folder.filter.tag.as_ref().is_some_and(is_gone) {
            self.state.folder.filter = Filter {
                tag: None,
                ..self.state.folder.filter.clone()
            };
        }
    }

    /// The next change of tags is a step of its own.
    pub(in crate::app) fn end_typing(&mut self) {
        self.folder.is_typing = false;
    }

    /// Whether the last thing that was done is a change of tags, which undo takes back first.
    pub(in crate::app) fn undo_tag(&mut self) -> bool {
        self.folder.is_typing = false;
        let depth = self.history.depth();
        let Some(edit) = self.folder.done.pop_if(|edit| edit.depth >= depth) else {
            return false;
        };
        self.set_tagged(edit.path.clone(), edit.before.clone());
        self.folder.undone.push(edit);
        true
    }

    /// Whether the next thing to be done again is a change of tags.
    pub(in crate::app) fn redo_tag(&mut self) -> bool {
        let depth = self.history.depth();
        let Some(edit) = self.folder.undone.pop_if(|edit| edit.depth <= depth) else {
            return false;
        };
        self.set_tagged(edit.path.clone(), edit.after.clone());
        self.folder.done.push(edit);
        true
    }

    pub(in crate::app) fn can_undo_tag(&self) -> bool {
        !self.folder.done.is_empty()
    }

    pub(in crate::app) fn can_redo_tag(&self) -> bool {
        let depth = self.history.depth();
        self.folder.undone.last().is_some_and(|edit| edit.depth <= depth)
    }

    /// What the thread that reads and writes tags has to tell.
    pub(super) fn take_tags(&mut self) {
        while let Some(result) = self.folder.tag_writer.take() {
            match result {
                TagResult::Read(folder, Ok(mut tags)) => {
                    let rows = Arc::make_mut(&mut self.state.folder.rows);
                    for (place, row) in rows.iter_mut().enumerate() {
                        let is_there = row.path.as_deref().and_then(Path::parent) == Some(&*folder);
                        // What was said while the file was read is newer.
                        let said = self
                            .folder
                            .done
                            .iter()
                            .any(|edit| Some(&edit.path) == row.path.as_ref());
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
                TagResult::Read(_, Err(problem)) | TagResult::Written(Err(problem)) => self.say(true, problem),
                TagResult::Written(Ok(())) => {}
            }
        }
    }
}
