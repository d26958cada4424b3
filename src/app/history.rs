//! Undo and redo without end: whole values, one a step.

/// What was and what was undone.
#[derive(Debug, Clone)]
pub struct History<T> {
    past: Vec<T>,
    future: Vec<T>,
    /// What the running gesture drags, so that one drag is one step.
    gesture: Option<&'static str>,
}

impl<T> Default for History<T> {
    fn default() -> Self {
        Self {
            past: Vec::new(),
            future: Vec::new(),
            gesture: None,
        }
    }
}

impl<T: PartialEq> History<T> {
    /// Remembers `before`, which is about to change. Changes of one `gesture` (a drag of one control)
    /// are one step, until it ends.
    pub fn remember(&mut self, before: T, gesture: Option<&'static str>) {
        let continues = gesture.is_some() && gesture == self.gesture;
        if !continues {
            self.past.push(before);
        }
        self.future.clear();
        self.gesture = gesture;
    }

    /// The gesture is over: the next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// How many steps could be taken back.
    pub fn depth(&self) -> usize {
        self.past.len()
    }

    /// Takes one step back; `now` is what there is. Hands out what there was.
    pub fn undo(&mut self, now: T) -> Option<T> {
        self.gesture = None;
        let before = self.past.pop()?;
        self.future.push(now);
        Some(before)
    }

    /// Takes back one undo.
    pub fn redo(&mut self, now: T) -> Option<T> {
        self.gesture = None;
        let after = self.future.pop()?;
        self.past.push(now);
        Some(after)
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}
