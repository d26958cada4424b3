//! Work beside the interface. The program starts threads and waits for them here alone; a browser build replaces it.

mod lane;
mod pool;
mod queue;
mod schedule;
mod watch;

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

pub use lane::Lane;
pub use pool::{Pool, Repaint};
pub use queue::Queue;
pub use schedule::{Crashed, JobId};
pub use watch::{JobWatch, Progress};

/// The time for which a frame waits for a small job, so that a small cloud's results are in the frame that asked for them.
pub const PATIENCE: Duration = Duration::from_millis(7);

/// Locks data that a panic never leaves half changed.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
