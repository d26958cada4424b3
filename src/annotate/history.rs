//! Undo and redo without end.

use super::Annotation;

/// Every state that an annotation has had, and where among them it is. Before the first there was none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History {
    /// All that there ever were, in the order of their making.
    ever: Vec<Annotation>,
    /// Those within reach of undo and redo, as indices.
    path: Vec<usize>,
    /// How many of these are done.
    done: usize,
}

impl History {
    /// What holds now; `None` where nothing has been said yet, or all of it was undone.
    pub fn current(&self) -> Option<&Annotation> {
        let last = self.done.checked_sub(1)?;
        Some(&self.ever[self.path[last]])
    }

    /// How many edits can be undone.
    pub fn undo_steps(&self) -> usize {
        self.done
    }

    /// How many edits can be done again.
    pub fn redo_steps(&self) -> usize {
        self.path.len() - self.done
    }

    /// Every state within reach of undo and redo, oldest first; the first [`History::undo_steps`] are done.
    pub fn within_reach(&self) -> impl Iterator<Item = &Annotation> {
        self.path.iter().map(|&i| &self.ever[i])
    }

    /// Every state that there ever was, oldest first; those out of reach of redo as well.
    pub fn ever(&self) -> &[Annotation] {
        &self.ever
    }

    /// A new state; what was undone can no longer be done again.
    pub(super) fn push(&mut self, state: Annotation) {
        self.path.truncate(self.done);
        self.path.push(self.ever.len());
        self.ever.push(state);
        self.done += 1;
    }

    /// Back by one. Whether there was a way.
    pub(super) fn undo(&mut self) -> bool {
        let can = self.done > 0;
        self.done -= usize::from(can);
        can
    }

    /// Forward by one. Whether there was a way.
    pub(super) fn redo(&mut self) -> bool {
        let can = self.done < self.path.len();
        self.done += usize::from(can);
        can
    }
}
