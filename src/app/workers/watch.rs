//! The progress of a job, and its cancellation.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use super::locked;
use crate::method::{Observe, Stage};
use crate::parallel::Watch;

/// The progress of a job.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Progress {
    /// The stage of the analysis, once one has begun.
    pub stage: Option<Stage>,
    /// The share of the stage that is done, 0 to 1.
    pub share: f64,
    /// The time since the job began.
    pub elapsed: Duration,
}

/// A job's view of its caller: it reports its progress here, and learns here that its result is no longer wanted.
#[derive(Debug)]
pub struct JobWatch {
    cancelled: AtomicBool,
    stage: Mutex<Option<Stage>>,
    done: AtomicUsize,
    total: AtomicUsize,
    began: Instant,
}

impl JobWatch {
    pub(super) fn new() -> Self {
        Self {
            cancelled: AtomicBool::new(false),
            stage: Mutex::new(None),
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(0),
            began: Instant::now(),
        }
    }

    /// Calls the job off.
    pub(super) fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    pub(super) fn progress(&self) -> Progress {
        let (done, total) = (
            self.done.load(Ordering::Relaxed),
            self.total.load(Ordering::Relaxed),
        );
        Progress {
            stage: *locked(&self.stage),
            share: if total > 0 {
                (done as f64 / total as f64).min(1.0)
            } else {
                0.0
            },
            elapsed: self.began.elapsed(),
        }
    }
}

impl Watch for JobWatch {
    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    fn advanced(&self, done: usize, total: usize) {
        // Pieces may finish out of order: the bar never goes back.
        self.done.fetch_max(done, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }
}

impl Observe for JobWatch {
    fn entered(&self, stage: Stage) {
        *locked(&self.stage) = Some(stage);
        self.total.store(0, Ordering::Relaxed);
        self.done.store(0, Ordering::Relaxed);
    }
}
