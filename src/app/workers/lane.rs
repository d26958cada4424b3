//! A schedule of which only the newest job counts: it cancels the jobs before it.

use std::time::Duration;

use super::pool::Pool;
use super::schedule::{Crashed, Schedule};
use super::watch::{JobWatch, Progress};

/// Jobs of one kind, of which only the newest counts.
pub struct Lane<T>(Schedule<T>);

impl<T: Send + 'static> Lane<T> {
    /// A lane without a job.
    pub fn new(pool: &Pool) -> Self {
        Self(Schedule::new(pool, true))
    }

    /// Submits a job. The jobs before it are cancelled.
    pub fn submit(&self, job: impl FnOnce(&JobWatch) -> T + Send + 'static) {
        self.0.submit(job);
    }

    /// Takes the newest job's result, if it is there within that time. A small cloud's result then comes in the
    /// frame that asked for it.
    pub fn take_within(&self, patience: Duration) -> Option<Result<T, Crashed>> {
        self.0.take_within(patience).map(|(_, result)| result)
    }
}

impl<T> Lane<T> {
    /// Cancels every job that was submitted.
    pub fn cancel(&self) {
        let mut jobs = self.0.jobs();
        jobs.call_off();
        jobs.next_id();
    }

    /// Takes the newest job's result, if it is there.
    pub fn take(&self) -> Option<Result<T, Crashed>> {
        self.0.jobs().take().map(|(_, result)| result)
    }

    /// The progress of the newest job, if one is under way.
    pub fn progress(&self) -> Option<Progress> {
        self.0.jobs().progress()
    }

    /// Whether a result is still to come or to be taken.
    pub fn is_busy(&self) -> bool {
        self.0.jobs().is_busy()
    }
}

impl<T> Drop for Lane<T> {
    fn drop(&mut self) {
        self.cancel();
    }
}
