//! A schedule of which every job is done, in the order of submission: for what is written to a disk.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use super::locked;
use super::pool::Pool;
use super::schedule::{Crashed, JobId, Schedule};

/// Jobs that share a state, and of which every one is done.
pub struct Queue<S, A> {
    schedule: Schedule<A>,
    state: Arc<Mutex<S>>,
}

impl<S: Send + 'static, A: Send + 'static> Queue<S, A> {
    /// A queue without a job.
    pub fn new(pool: &Pool, state: S) -> Self {
        Self {
            schedule: Schedule::new(pool, false),
            state: Arc::new(Mutex::new(state)),
        }
    }

    /// Submits a job, which is done after those before it, and returns its number.
    pub fn submit(&self, job: impl FnOnce(&mut S) -> A + Send + 'static) -> JobId {
        let state = self.state.clone();
        self.schedule.submit(move |_| job(&mut locked(&state)))
    }

    /// Takes the next job's number and answer, if the answer is there within that time.
    pub fn take_within(&self, patience: Duration) -> Option<(JobId, Result<A, Crashed>)> {
        self.schedule.take_within(patience)
    }
}

impl<S, A> Queue<S, A> {
    /// Whether an answer is still to come or to be taken.
    pub fn is_busy(&self) -> bool {
        self.schedule.jobs().is_busy()
    }

    /// Waits until every job that was submitted is done.
    pub fn finish(&self) {
        self.schedule.finish();
    }
}

impl<S, A> Drop for Queue<S, A> {
    fn drop(&mut self) {
        self.finish();
    }
}
