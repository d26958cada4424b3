//! Work beside the interface. The program starts threads and waits for them here alone; a browser build replaces it.

mod lane;
mod pool;
mod queue;
mod schedule;
mod watch;

use std::sync::{Mutex, MutexGuard, PoisonError};

pub use lane::Lane;
pub use pool::{Pool, Repaint};
pub use queue::Queue;
pub use schedule::{Crashed, JobId};
pub use watch::{JobWatch, Progress};

/// Locks data that a panic never leaves half changed.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
