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

/// Nobody watches: work runs to its end.
impl Watch for () {}
