//! The evaluation of the open clouds in the background: on threads of its own, which wait while the current
//! cloud is worked on.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use crate::app::workers::JobWatch;
use crate::evaluate::{Outcome, Reuse, RowStore, Runner, annotation_files};
use crate::fruit::Request;
use crate::method::Observe;
use crate::parallel::{BackgroundPool, Watch};

/// The longest time to wait for the current cloud.
const MAX_WAIT: Duration = Duration::from_secs(20);

/// Everything that the jobs on the open clouds share.
#[derive(Clone)]
pub(super) struct BatchContext {
    pub(super) store: Arc<RowStore>,
    pub(super) pool: Arc<BackgroundPool>,
    /// Whether the current cloud is being worked on.
    pub(super) is_foreground_busy: Arc<AtomicBool>,
}

/// The watch of a job, which also makes the job wait while the current cloud is being worked on.
pub(super) struct YieldingWatch<'a> {
    pub(super) watch: &'a JobWatch,
    pub(super) context: &'a BatchContext,
}

impl Watch for YieldingWatch<'_> {
    fn is_cancelled(&self) -> bool {
        let began = Instant::now();
        while self.context.is_foreground_busy.load(Ordering::Relaxed)
            && !self.watch.is_cancelled()
            && began.elapsed() < MAX_WAIT
        {
            std::thread::sleep(Duration::from_millis(4));
        }
        self.watch.is_cancelled()
    }
}

impl Observe for YieldingWatch<'_> {}

/// The result of one cloud.
#[derive(Debug)]
pub(super) struct BatchResult {
    /// The turn of the job that it comes from.
    pub(super) turn: u64,
    pub(super) path: PathBuf,
    /// `None` if no row is stored and only stored rows were asked for.
    pub(super) outcome: Option<Arc<Outcome>>,
    pub(super) was_stored: bool,
}

/// A job on the open clouds.
pub(super) struct BatchTask {
    pub(super) turn: u64,
    pub(super) clouds: Vec<PathBuf>,
    pub(super) request: Request,
    /// Whether only stored rows are looked up, and nothing is read.
    pub(super) only_stored: bool,
}

/// Evaluates the clouds; each result goes to `results` as soon as it is there.
pub(super) fn evaluate_batch(
    task: &BatchTask,
    context: &BatchContext,
    watch: &JobWatch,
    results: &Sender<BatchResult>,
) {
    let reuse = if task.only_stored {
        Reuse::Only
    } else {
        Reuse::WhereStored
    };
    let runner = Runner::new(&context.store, &task.request, None, reuse);
    let annotations = annotation_files(&task.clouds);
    let next = AtomicUsize::new(0);
    let yielding = YieldingWatch { watch, context };
    let work = || {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(path) = task.clouds.get(place) else {
                return;
            };
            if watch.is_cancelled() || (!task.only_stored && yielding.is_cancelled()) {
                return;
            }
            let annotations = annotations.get(path).map_or(&[][..], Vec::as_slice);
            let Ok(evaluated) = runner.evaluate(&name_of(path), path, annotations, &yielding) else {
                return;
            };
            let was_stored = evaluated.as_ref().is_some_and(|e| e.was_stored);
            // The window may have closed.
            let _ = results.send(BatchResult {
                turn: task.turn,
                path: path.clone(),
                outcome: evaluated.map(|e| e.row.outcome),
                was_stored,
            });
        }
    };
    if task.only_stored {
        work();
    } else {
        context.pool.broadcast(work);
    }
}

pub(super) fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}
