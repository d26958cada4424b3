//! Jobs that run one after the other on a [`Pool`], and their results. A lane and a queue are schedules that differ in
//! what a new job does to the ones before it.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::locked;
use super::pool::{Pool, Repaint};
use super::watch::{JobWatch, Progress};
use crate::parallel::Watch as _;

/// A job's number, from 1: later jobs have higher ones.
pub type JobId = u64;

/// The message of a job's panic, which is a fault of the program.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("a fault of the program: {0}")]
pub struct Crashed(pub String);

/// A job's result, with its number.
pub(super) type Finished<T> = (JobId, Result<T, Crashed>);

type Job<T> = Box<dyn FnOnce(&JobWatch) -> T + Send>;

/// The jobs of a schedule, by how far they are.
pub(super) struct Jobs<T> {
    waiting: VecDeque<(JobId, Job<T>)>,
    running: Option<Arc<JobWatch>>,
    finished: VecDeque<Finished<T>>,
    /// The number of the newest job, or of the cancellation after it.
    newest: JobId,
    /// Whether a task on the pool works through the jobs.
    is_scheduled: bool,
}

impl<T> Jobs<T> {
    /// Calls off every job that was submitted before.
    pub(super) fn call_off(&mut self) {
        self.waiting.clear();
        self.finished.clear();
        if let Some(running) = &self.running {
            running.cancel();
        }
    }

    /// Whether a job is waiting or running whose result is still wanted.
    pub(super) fn is_under_way(&self) -> bool {
        let runs = self.running.as_ref().is_some_and(|watch| !watch.is_cancelled());
        !self.waiting.is_empty() || runs
    }

    pub(super) fn is_busy(&self) -> bool {
        self.is_under_way() || !self.finished.is_empty()
    }

    /// The progress of the job under way, if there is one.
    pub(super) fn progress(&self) -> Option<Progress> {
        self.is_under_way().then(|| match &self.running {
            Some(running) if self.waiting.is_empty() => running.progress(),
            _ => Progress::default(),
        })
    }

    pub(super) fn take(&mut self) -> Option<Finished<T>> {
        self.finished.pop_front()
    }

    /// Takes a number of its own, so that no result of the jobs before counts as the newest.
    pub(super) fn next_id(&mut self) -> JobId {
        self.newest += 1;
        self.newest
    }
}

struct Shared<T> {
    jobs: Mutex<Jobs<T>>,
    changed: Condvar,
    repaint: Repaint,
    /// Whether a result is dropped when a newer job has been submitted meanwhile.
    only_newest: bool,
}

/// Jobs that run one after the other.
pub(super) struct Schedule<T> {
    pool: Pool,
    shared: Arc<Shared<T>>,
}

impl<T: Send + 'static> Schedule<T> {
    pub(super) fn new(pool: &Pool, only_newest: bool) -> Self {
        let jobs = Jobs {
            waiting: VecDeque::new(),
            running: None,
            finished: VecDeque::new(),
            newest: 0,
            is_scheduled: false,
        };
        Self {
            pool: pool.clone(),
            shared: Arc::new(Shared {
                jobs: Mutex::new(jobs),
                changed: Condvar::new(),
                repaint: pool.repaint().clone(),
                only_newest,
            }),
        }
    }

    /// Appends a job, and returns its number.
    pub(super) fn submit(&self, job: impl FnOnce(&JobWatch) -> T + Send + 'static) -> JobId {
        let mut jobs = self.jobs();
        if self.shared.only_newest {
            jobs.call_off();
        }
        let id = jobs.next_id();
        jobs.waiting.push_back((id, Box::new(job)));
        if !std::mem::replace(&mut jobs.is_scheduled, true) {
            drop(jobs);
            let shared = self.shared.clone();
            self.pool.spawn(move || run(&shared));
        }
        id
    }

    /// The next result, if it comes within that time.
    pub(super) fn take_within(&self, patience: Duration) -> Option<Finished<T>> {
        let is_to_come = |jobs: &mut Jobs<T>| jobs.finished.is_empty() && jobs.is_under_way();
        let waited = self
            .shared
            .changed
            .wait_timeout_while(self.jobs(), patience, is_to_come);
        waited.unwrap_or_else(PoisonError::into_inner).0.take()
    }
}

impl<T> Schedule<T> {
    pub(super) fn jobs(&self) -> MutexGuard<'_, Jobs<T>> {
        locked(&self.shared.jobs)
    }

    /// Waits until no job is left.
    pub(super) fn finish(&self) {
        let waited = self
            .shared
            .changed
            .wait_while(self.jobs(), |jobs| jobs.is_scheduled);
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }
}

/// Runs the jobs until none waits.
fn run<T>(shared: &Shared<T>) {
    let mut jobs = locked(&shared.jobs);
    while let Some((id, job)) = jobs.waiting.pop_front() {
        let watch = Arc::new(JobWatch::new());
        jobs.running = Some(watch.clone());
        drop(jobs);
        // A fault in one job must neither end the window nor keep the other jobs from being done.
        let result = catch_unwind(AssertUnwindSafe(|| job(&watch)));
        let result = result.map_err(|fault| Crashed(message_of(fault.as_ref())));
        jobs = locked(&shared.jobs);
        jobs.running = None;
        if !shared.only_newest || jobs.newest == id {
            jobs.finished.push_back((id, result));
        }
        drop(jobs);
        shared.changed.notify_all();
        (shared.repaint)();
        jobs = locked(&shared.jobs);
    }
    jobs.is_scheduled = false;
    shared.changed.notify_all();
}

fn message_of(fault: &(dyn std::any::Any + Send)) -> String {
    let text = fault.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| fault.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "without a message".into())
}
