//! Work beside the interface that must all be done, in the order in which it was asked for: what is
//! written to a disk. (In a [`crate::app::workers::Lane`] the newest request wins.)

use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use super::lane::{Crashed, Repaint, message_of};

type Job<S, A> = Box<dyn FnOnce(&mut S) -> A + Send>;

/// A worker with a state of its own, which does every job.
pub struct Queue<S, A> {
    /// `None` once no more jobs are taken.
    jobs: Option<Sender<Job<S, A>>>,
    answers: Receiver<Result<A, Crashed>>,
    thread: Option<JoinHandle<()>>,
    asked: u64,
    answered: u64,
}

impl<S: Send + 'static, A: Send + 'static> Queue<S, A> {
    /// Starts the worker; `repaint` is called after each job.
    ///
    /// # Errors
    /// Where the operating system starts no thread.
    pub fn new(name: &str, mut state: S, repaint: Repaint) -> std::io::Result<Self> {
        let (jobs, to_do) = channel::<Job<S, A>>();
        let (done, answers) = channel();
        let thread = std::thread::Builder::new().name(name.to_owned()).spawn(move || {
            for job in to_do {
                // A fault in one job must not keep the others from being done.
                let answer = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| job(&mut state)));
                // Nobody may be listening any more: the jobs are done all the same.
                let _ = done.send(answer.map_err(|fault| Crashed(message_of(fault.as_ref()))));
                repaint();
            }
        })?;
        Ok(Self {
            jobs: Some(jobs),
            answers,
            thread: Some(thread),
            asked: 0,
            answered: 0,
        })
    }

    /// Asks for a job, which is done after those before it. Its number, from 1.
    pub fn submit(&mut self, job: impl FnOnce(&mut S) -> A + Send + 'static) -> u64 {
        if let Some(jobs) = &self.jobs {
            // The worker lives as long as the sender does.
            let _ = jobs.send(Box::new(job));
            self.asked += 1;
        }
        self.asked
    }

    /// The next answer, if it is there within that time.
    pub fn take_within(&mut self, patience: Duration) -> Option<Result<A, Crashed>> {
        if !self.is_busy() {
            return None;
        }
        let answer = self.answers.recv_timeout(patience).ok()?;
        self.answered += 1;
        Some(answer)
    }

    /// Whether an answer is still to come or to be taken.
    pub fn is_busy(&self) -> bool {
        self.asked > self.answered
    }
}

impl<S, A> Queue<S, A> {
    /// Waits until everything that was asked for is done; nothing more can be asked for.
    pub fn finish(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            // Faults were caught and told.
            let _ = thread.join();
        }
    }
}

impl<S, A> Drop for Queue<S, A> {
    fn drop(&mut self) {
        self.finish();
    }
}
