//! Progress and cancellation of long work.

/// The work was cancelled before it was done; there is no partial result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// An observer of long work, which reports its progress and asks whether to go on. Called from any thread,
/// at least some dozens of times in a long stage, never once a point.
pub trait Watch: Sync {
    /// Whether to stop. Called between pieces of work of a few milliseconds.
    fn is_cancelled(&self) -> bool {
        false
    }

    /// Returns [`Cancelled`] if the work is to stop.
    ///
    /// # Errors
    /// Returns an error where [`Watch::is_cancelled`] is true.
    fn go_on(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() {
            Err(Cancelled)
        } else {
            Ok(())
        }
    }

    /// Reports that `done` of `total` pieces are finished. Pieces may finish out of order, so a lower number can
    /// follow a higher one.
    fn advanced(&self, _done: usize, _total: usize) {}
}

/// The [`Watch`] of one part of longer work: the part's progress counts as a share of the whole.
pub(crate) struct PartOf<'a> {
    /// The watch of the whole work.
    pub(crate) watch: &'a dyn Watch,
    /// The pieces of the whole that the part comprises.
    pub(crate) pieces: std::ops::Range<usize>,
    /// The number of pieces of the whole.
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

/// No observer: the work runs to its end.
impl Watch for () {}
