//! Work beside the interface: on a thread of its own, where the newest request wins.
//!
//! Here and in `queue.rs` alone the program starts threads and waits for them; a browser build replaces both.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::method::{Observe, Stage};
use crate::parallel::Watch;

/// Tells the interface that something has come.
pub type Repaint = Arc<dyn Fn() + Send + Sync>;

/// Which request a result belongs to; later requests have higher numbers.
pub type JobId = u64;

/// How far a job is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The stage of the analysis, once one has begun.
    pub stage: Option<Stage>,
    /// The share of the stage that is done, 0 to 1.
    pub share: f64,
    /// How long the job has been running.
    pub elapsed: Duration,
}

/// What a job tells, and what it asks.
#[derive(Debug)]
pub struct JobWatch {
    cancelled: AtomicBool,
    stage: Mutex<Option<Stage>>,
    done: AtomicUsize,
    total: AtomicUsize,
    began: Instant,
}

impl JobWatch {
    fn new() -> Self {
        Self {
            cancelled: AtomicBool::new(false),
            stage: Mutex::new(None),
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(0),
            began: Instant::now(),
        }
    }

    fn progress(&self) -> Progress {
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

/// Frees what is no longer needed beside the interface: a large cloud's memory takes a tenth of a second
/// to give back.
pub struct Discard {
    to: Sender<Box<dyn Send>>,
}

impl Discard {
    /// Starts its thread, which ends with it.
    ///
    /// # Errors
    /// Where the operating system starts no thread.
    pub fn new() -> std::io::Result<Self> {
        let (to, from) = channel::<Box<dyn Send>>();
        std::thread::Builder::new()
            .name("discard".into())
            .spawn(move || from.into_iter().for_each(drop))?;
        Ok(Self { to })
    }

    /// Frees it soon, if nobody else holds it.
    pub fn take(&self, what: impl Send + 'static) {
        // Where the thread is gone it is freed here.
        let _ = self.to.send(Box::new(what));
    }
}

/// A job broke off by a fault of the program; the message is the fault's own.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("a fault of the program: {0}")]
pub struct Crashed(pub String);

type Job<T> = Box<dyn FnOnce(&JobWatch) -> T + Send>;

struct Slot<T> {
    waiting: Option<(JobId, Job<T>)>,
    running: Option<Arc<JobWatch>>,
    finished: Option<(JobId, Result<T, Crashed>)>,
    newest: JobId,
    is_closed: bool,
}

struct Shared<T> {
    slot: Mutex<Slot<T>>,
    changed: Condvar,
}

/// One worker. A new job cancels the one before it, and only the newest one's result is handed out.
pub struct Lane<T> {
    shared: Arc<Shared<T>>,
}

impl<T: Send + 'static> Lane<T> {
    /// Starts a worker; `repaint` is called whenever a result is there.
    ///
    /// # Errors
    /// Where the operating system starts no thread.
    pub fn new(name: &str, repaint: Repaint) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            slot: Mutex::new(Slot {
                waiting: None,
                running: None,
                finished: None,
                newest: 0,
                is_closed: false,
            }),
            changed: Condvar::new(),
        });
        let theirs = shared.clone();
        std::thread::Builder::new()
            .name(name.to_owned())
            .spawn(move || work(&theirs, &repaint))?;
        Ok(Self { shared })
    }

    /// Asks for a job. Whatever was asked for before is called off.
    pub fn submit(&self, job: impl FnOnce(&JobWatch) -> T + Send + 'static) -> JobId {
        let mut slot = locked(&self.shared.slot);
        slot.newest += 1;
        let id = slot.newest;
        slot.waiting = Some((id, Box::new(job)));
        slot.finished = None;
        if let Some(running) = &slot.running {
            running.cancelled.store(true, Ordering::Relaxed);
        }
        self.shared.changed.notify_all();
        id
    }

    /// Calls everything off that was asked for.
    pub fn cancel(&self) {
        let mut slot = locked(&self.shared.slot);
        slot.newest += 1;
        slot.waiting = None;
        slot.finished = None;
        if let Some(running) = &slot.running {
            running.cancelled.store(true, Ordering::Relaxed);
        }
    }

    /// The newest job's result, once it is there.
    pub fn take(&self) -> Option<(JobId, Result<T, Crashed>)> {
        locked(&self.shared.slot).finished.take()
    }

    /// As [`Lane::take`], but waits a moment for a job that is about to end: a small cloud's result
    /// then comes in the very frame that asked for it.
    pub fn take_within(&self, patience: Duration) -> Option<(JobId, Result<T, Crashed>)> {
        let slot = locked(&self.shared.slot);
        let is_pending = |slot: &mut Slot<T>| slot.finished.is_none() && slot.is_wanted();
        let (mut slot, _) = self
            .shared
            .changed
            .wait_timeout_while(slot, patience, is_pending)
            .unwrap_or_else(PoisonError::into_inner);
        slot.finished.take()
    }

    /// How far the newest job is; `None` where there is none under way.
    pub fn progress(&self) -> Option<Progress> {
        let slot = locked(&self.shared.slot);
        if !slot.is_wanted() {
            return None;
        }
        Some(match (&slot.waiting, &slot.running) {
            (None, Some(running)) => running.progress(),
            _ => Progress {
                stage: None,
                share: 0.0,
                elapsed: Duration::ZERO,
            },
        })
    }

    /// Whether a result is still to come or to be taken.
    pub fn is_busy(&self) -> bool {
        let slot = locked(&self.shared.slot);
        slot.is_wanted() || slot.finished.is_some()
    }
}

impl<T> Slot<T> {
    /// Whether a job is under way whose result somebody wants.
    fn is_wanted(&self) -> bool {
        let runs = self.running.as_ref().is_some_and(|watch| !watch.is_cancelled());
        self.waiting.is_some() || runs
    }
}

impl<T> Drop for Lane<T> {
    fn drop(&mut self) {
        let mut slot = locked(&self.shared.slot);
        slot.is_closed = true;
        slot.waiting = None;
        if let Some(running) = &slot.running {
            running.cancelled.store(true, Ordering::Relaxed);
        }
        self.shared.changed.notify_all();
    }
}

fn work<T>(shared: &Shared<T>, repaint: &Repaint) {
    let mut slot = locked(&shared.slot);
    loop {
        if slot.is_closed {
            return;
        }
        let Some((id, job)) = slot.waiting.take() else {
            slot = shared.changed.wait(slot).unwrap_or_else(PoisonError::into_inner);
            continue;
        };
        let watch = Arc::new(JobWatch::new());
        slot.running = Some(watch.clone());
        drop(slot);
        // A fault in one job must not end the window.
        let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| job(&watch)));
        slot = locked(&shared.slot);
        slot.running = None;
        if slot.newest == id {
            slot.finished = Some((id, result.map_err(|fault| Crashed(message_of(fault.as_ref())))));
        }
        shared.changed.notify_all();
        repaint();
    }
}

pub(super) fn message_of(fault: &(dyn std::any::Any + Send)) -> String {
    let text = fault.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| fault.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "without a message".into())
}

/// Nothing that is locked here is left half done by a panic.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
