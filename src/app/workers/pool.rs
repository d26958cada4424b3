//! The threads that work beside the interface.
//!
//! A thread is started when a task comes and every other thread is at work, and ends when it has had no task for a
//! while. A task may therefore wait for a disk, a graphics driver or other threads without holding up the next one,
//! and a window that rests has no threads. A [`Lane`](super::Lane) or [`Queue`](super::Queue) has at most one task
//! here at a time, so there are never more threads than lanes and queues.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use super::locked;

/// The time that a thread waits for a task before it ends.
const IDLE: Duration = Duration::from_secs(5);

type Task = Box<dyn FnOnce() + Send>;

#[derive(Default)]
struct Threads {
    tasks: VecDeque<Task>,
    running: usize,
    /// The number of the running threads that wait for a task.
    idle: usize,
}

#[derive(Default)]
struct Shared {
    threads: Mutex<Threads>,
    has_task: Condvar,
}

/// A function that tells the interface to draw again, because a result has come.
pub type Repaint = Arc<dyn Fn() + Send + Sync>;

/// A handle of the threads; its copies share them.
#[derive(Clone)]
pub struct Pool {
    shared: Arc<Shared>,
    repaint: Repaint,
}

impl Pool {
    /// Starts the first thread, so that a machine that starts none is known at once. `repaint` is called after each
    /// job of a lane or queue.
    ///
    /// # Errors
    /// Returns an error if the operating system starts no thread.
    pub fn new(repaint: &Repaint) -> std::io::Result<Self> {
        let pool = Self {
            shared: Arc::default(),
            repaint: repaint.clone(),
        };
        pool.start_thread(&mut locked(&pool.shared.threads))?;
        Ok(pool)
    }

    /// Runs a task on one of the threads.
    pub fn spawn(&self, task: impl FnOnce() + Send + 'static) {
        let mut threads = locked(&self.shared.threads);
        threads.tasks.push_back(Box::new(task));
        // Without another thread, the task waits for one of those that run; without any, it runs here.
        if threads.tasks.len() > threads.idle
            && self.start_thread(&mut threads).is_err()
            && threads.running == 0
            && let Some(task) = threads.tasks.pop_back()
        {
            drop(threads);
            task();
        } else {
            self.shared.has_task.notify_one();
        }
    }

    /// Frees a value on one of the threads: to give a large cloud's memory back takes a tenth of a second.
    pub fn discard(&self, value: Option<impl Send + 'static>) {
        if let Some(value) = value {
            self.spawn(move || drop(value));
        }
    }

    /// The function that tells the interface to draw again.
    pub fn repaint(&self) -> &Repaint {
        &self.repaint
    }

    /// The number of threads that run now.
    pub fn thread_count(&self) -> usize {
        locked(&self.shared.threads).running
    }

    fn start_thread(&self, threads: &mut Threads) -> std::io::Result<()> {
        let shared = self.shared.clone();
        let thread = std::thread::Builder::new().name("worker".into());
        thread.spawn(move || work(&shared))?;
        threads.running += 1;
        Ok(())
    }
}

fn work(shared: &Shared) {
    let mut threads = locked(&shared.threads);
    loop {
        if let Some(task) = threads.tasks.pop_front() {
            drop(threads);
            // A job catches its own fault, to tell it; this is for the others, as dropping a value.
            let _ = catch_unwind(AssertUnwindSafe(task));
            threads = locked(&shared.threads);
            continue;
        }
        threads.idle += 1;
        let waited = shared
            .has_task
            .wait_timeout_while(threads, IDLE, |threads| threads.tasks.is_empty());
        (threads, _) = waited.unwrap_or_else(PoisonError::into_inner);
        threads.idle -= 1;
        if threads.tasks.is_empty() {
            threads.running -= 1;
            return;
        }
    }
}
