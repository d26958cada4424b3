//! Watching long work: how far it is, and whether its result is still wanted.

/// The work was called off before it was done; there is no partial result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// What long work tells, and asks, whoever waits for it. Called from any thread, at least some
/// dozens of times in a long stage, never once a point.
pub trait Watch: Sync {
    /// Whether to stop. Asked between pieces of work of a few milliseconds.
    fn is_cancelled(&self) -> bool {
        false
    }

    /// `done` of `total` pieces are finished. Pieces may finish out of order, so a lower number can
    /// follow a higher one.
    fn advanced(&self, _done: usize, _total: usize) {}
}

/// One part of longer work as a [`Watch`] of its own: its progress counts as a share of the whole.
pub(crate) struct PartOf<'a> {
    /// Who watches the whole.
    pub(crate) watch: &'a dyn Watch,
    /// Which of the whole's pieces the part is.
    pub(crate) pieces: std::ops::Range<usize>,
    /// How many the whole has.
    pub(crate) total: usize,
}

impl Watch for PartOf<'_> {
    fn is_cancelled(&self) -> bool {
        self.watch.is_cancelled()
    }

    fn advanced(&self, done: usize, total: usize) {
        let share = done as f64 / total.max(1) as f64;
        let done = self.pieces.start as f64 + share * self.pieces.len() as f64;
        self.watch.advanced(done as usize, self.total);
    }
}

/// Nobody watches: work runs to its end.
impl Watch for () {}
