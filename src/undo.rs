//! Undo and redo without end.

/// The steps of a linear history, and how many of them are done.
///
/// A step is what its user needs to go back and forth: the state that it led to ([`History::current`]), or the value
/// that it replaced, which the user exchanges with the present one when the step is undone or redone.
#[derive(Debug, Clone, PartialEq)]
pub struct History<T> {
    steps: Vec<T>,
    done: usize,
    /// The gesture that made the last step, as long as it goes on.
    gesture: Option<String>,
}

impl<T> Default for History<T> {
    fn default() -> Self {
        Self {
            steps: Vec::new(),
            done: 0,
            gesture: None,
        }
    }
}

impl<T> History<T> {
    /// Appends a step. What was undone can no longer be redone.
    pub fn push(&mut self, step: T) {
        self.push_of_gesture(step, None);
    }

    /// Appends a step of a gesture, as a drag of one control. The changes of one gesture are one step, the first, until
    /// [`History::end_gesture`].
    pub fn push_of_gesture(&mut self, step: T, gesture: Option<&str>) {
        self.steps.truncate(self.done);
        if gesture.is_none() || gesture != self.gesture.as_deref() {
            self.steps.push(step);
            self.done += 1;
        }
        self.gesture = gesture.map(str::to_owned);
    }

    /// Ends the gesture: the next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// Goes back by one step, and returns it; `None` if none is done.
    pub fn undo(&mut self) -> Option<&mut T> {
        self.gesture = None;
        self.done = self.done.checked_sub(1)?;
        self.steps.get_mut(self.done)
    }

    /// Goes forward by one step, and returns it; `None` if none was undone.
    pub fn redo(&mut self) -> Option<&mut T> {
        self.gesture = None;
        let step = self.steps.get_mut(self.done)?;
        self.done += 1;
        Some(step)
    }

    /// The last step that is done.
    pub fn current(&self) -> Option<&T> {
        self.steps.get(self.done.checked_sub(1)?)
    }

    /// The number of steps that can be undone.
    pub fn undo_steps(&self) -> usize {
        self.done
    }

    /// The number of steps that can be redone.
    pub fn redo_steps(&self) -> usize {
        self.steps.len() - self.done
    }

    /// Every step that is done or can be redone, the oldest first; the first [`History::undo_steps`] are done.
    pub fn steps(&self) -> &[T] {
        &self.steps
    }

    /// The same history with other steps.
    pub fn map<U>(&self, step: impl Fn(&T) -> U) -> History<U> {
        History {
            steps: self.steps.iter().map(step).collect(),
            done: self.done,
            gesture: self.gesture.clone(),
        }
    }
}
