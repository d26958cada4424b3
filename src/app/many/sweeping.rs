//! The map of the mean error over u and τ, for all clouds of the table or for the current one.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use super::Many;
use super::background::{BatchContext, YieldingWatch};
use super::state::EvaluationProgress;
use crate::app::context::Context;
use crate::app::workers::{JobWatch, Lane, Pool};
use crate::evaluate::{Sweep, SweepSettings, TruthChoice, evaluate_file};
use crate::fruit::Request;
use crate::parallel::Watch;

struct Swept {
    turn: u64,
    errors_deg: Option<Vec<Option<f64>>>,
}

/// The running sweep.
pub(super) struct Sweeper {
    lane: Lane<()>,
    swept: (Sender<Swept>, Receiver<Swept>),
    turn: u64,
    began: Instant,
    of: Option<(Request, TruthChoice)>,
}

impl Sweeper {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            lane: Lane::new(pool),
            swept: channel(),
            turn: 0,
            began: Instant::now(),
            of: None,
        }
    }

    pub(super) fn is_busy(&self) -> bool {
        self.lane.is_busy()
    }
}

impl Many {
    /// Begins a sweep over the chosen ranges.
    pub(super) fn sweep(&mut self, cx: &mut Context) {
        let many = &mut cx.state.many;
        let Some(settings) = many.sweep.ranges.settings() else {
            cx.say(true, "These ranges of u and τ hold no settings to try.");
            return;
        };
        let places: Vec<usize> = if many.sweep.ranges.only_current {
            cx.state.current.into_iter().collect()
        } else {
            many.order.to_vec()
        };
        let path = |&place: &usize| many.rows.get(place)?.path.clone();
        let clouds: Vec<PathBuf> = places.iter().filter_map(path).collect();
        if clouds.is_empty() {
            cx.say(
                true,
                "There is no file to sweep over: samples are swept once they are saved as files.",
            );
            return;
        }
        let sweeper = &mut self.sweeper;
        sweeper.turn += 1;
        sweeper.began = Instant::now();
        sweeper.of = Some((cx.state.settings.request.clone(), many.against));
        many.sweep.map = Some(Arc::new(Sweep::new(settings.clone())));
        many.sweep.clouds = [0, clouds.len()];
        many.sweep.is_stale = false;
        many.sweep.progress = Some(EvaluationProgress {
            done: 0,
            total: clouds.len(),
            left: None,
        });
        let task = Task {
            turn: sweeper.turn,
            clouds,
            settings,
            request: cx.state.settings.request.clone(),
            against: many.against,
        };
        let context = self.context.clone();
        let swept = sweeper.swept.0.clone();
        sweeper
            .lane
            .submit(move |watch| sweep_batch(&task, &context, watch, &swept));
    }

    /// Cancels the sweep; the map keeps the clouds that are done.
    pub(super) fn cancel_sweep(&mut self, cx: &mut Context) {
        self.sweeper.lane.cancel();
        cx.state.many.sweep.progress = None;
    }

    pub(super) fn update_sweep(&mut self, cx: &mut Context) {
        let is_over = self.sweeper.lane.take();
        let sweep = &mut cx.state.many.sweep;
        while let Ok(swept) = self.sweeper.swept.1.try_recv() {
            let (Some(map), Some(progress)) = (&mut sweep.map, &mut sweep.progress) else {
                continue;
            };
            if swept.turn != self.sweeper.turn {
                continue;
            }
            progress.done += 1;
            let each = self.sweeper.began.elapsed().as_secs_f64() / progress.done as f64;
            let left = progress.total.saturating_sub(progress.done);
            progress.left = Some(Duration::from_secs_f64(each * left as f64));
            if let Some(errors_deg) = swept.errors_deg {
                Arc::make_mut(map).add(&errors_deg);
                sweep.clouds[0] += 1;
            }
        }
        let of = self.sweeper.of.as_ref();
        sweep.is_stale = of.is_some_and(|(request, against)| {
            // The sweep replaces u and τ.
            let mut now = cx.state.settings.request.clone();
            now.params.u = request.params.u;
            now.params.tau_cm_per_rad = request.params.tau_cm_per_rad;
            now != *request || cx.state.many.against != *against
        });
        if let Some(result) = is_over {
            sweep.progress = None;
            if let Err(crash) = result {
                cx.say(
                    true,
                    crate::text::sentence(&format!("the sweep broke off by {crash}")),
                );
            }
        }
    }
}

struct Task {
    turn: u64,
    clouds: Vec<PathBuf>,
    settings: SweepSettings,
    request: Request,
    against: TruthChoice,
}

/// Sweeps over several clouds at a time. Their errors are added up in the order in which they come, which
/// changes a mean in its last digit at most.
fn sweep_batch(task: &Task, context: &BatchContext, watch: &JobWatch, swept: &Sender<Swept>) {
    let next = AtomicUsize::new(0);
    let yielding = YieldingWatch { watch, context };
    let sweep = Some((&task.settings, task.against));
    context.pool.broadcast(|| {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(path) = task.clouds.get(place) else {
                return;
            };
            if yielding.is_cancelled() {
                return;
            }
            let row = evaluate_file("", path, &task.request, sweep, &yielding);
            if watch.is_cancelled() {
                return;
            }
            // The window may have closed.
            let _ = swept.send(Swept {
                turn: task.turn,
                errors_deg: row.ok().and_then(|row| row.sweep_deg),
            });
        }
    });
}
