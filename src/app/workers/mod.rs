//! Work beside the interface. The program starts threads and waits for them here alone; a browser build replaces it.

mod lane;
mod queue;

pub use lane::{Crashed, Discard, JobId, JobWatch, Lane, Progress, Repaint};
pub use queue::Queue;
