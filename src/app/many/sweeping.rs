//! The map of the mean error over u and τ, for all clouds of the table or for the current one.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::EvaluationProgress;
use super::background::{BatchContext, YieldingWatch};
use crate::app::App;
use crate::app::workers::{JobWatch, Lane, Pool};
use crate::evaluate::{Sweep, SweepSettings, TruthChoice, evaluate_file};
use crate::fruit::Request;
use crate::method::CandidateGrid;
use crate::parallel::Watch;

/// The largest number of values of τ.
pub const MOST_TAUS: usize = 200;

/// The ranges of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SweepRanges {
    /// The smallest and the largest number of grid steps.
    pub u: [usize; 2],
    /// The step from one u to the next.
    pub u_step: usize,
    /// The smallest and the largest weight of angles, in centimeters per radian.
    pub tau_cm_per_rad: [f64; 2],
    /// The step from one weight to the next, in centimeters per radian.
    pub tau_step_cm_per_rad: f64,
    /// Whether only the current cloud is swept, instead of all that the table shows.
    pub only_current: bool,
}

impl Default for SweepRanges {
    fn default() -> Self {
        Self {
            u: [5, 16],
            u_step: 1,
            tau_cm_per_rad: [0.0, 2.0],
            tau_step_cm_per_rad: 0.25,
            only_current: false,
        }
    }
}

impl SweepRanges {
    /// Returns every setting; `None` if there is none, or if a range is invalid.
    pub fn settings(&self) -> Option<SweepSettings> {
        let [from, to] = self.u;
        let is_u_sound = CandidateGrid::new(from).is_ok() && CandidateGrid::new(to).is_ok() && from <= to;
        let [low, high] = self.tau_cm_per_rad;
        let step = self.tau_step_cm_per_rad;
        let is_tau_sound = low >= 0.0 && low <= high && high.is_finite() && step > 0.0 && step.is_finite();
        if !is_u_sound || !is_tau_sound || self.u_step == 0 {
            return None;
        }
        let count = ((high - low) / step + 1e-9).floor();
        if count >= MOST_TAUS as f64 {
            return None;
        }
        Some(SweepSettings {
            u: (from..=to).step_by(self.u_step).collect(),
            // Bounded just before.
            tau_cm_per_rad: (0..=count as usize)
                .map(|i| rounded(low + step * i as f64))
                .collect(),
        })
    }
}

/// Rounds away the error of added-up steps behind the ninth decimal.
fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

/// The map of a sweep, and its progress.
#[derive(Debug, Clone)]
pub struct SweepState {
    /// The ranges of the next sweep.
    pub ranges: SweepRanges,
    /// The map; of fewer clouds than requested while it grows, or after a cancellation.
    pub map: Option<Arc<Sweep>>,
    /// The numbers of clouds in the map and of requested clouds.
    pub clouds: [usize; 2],
    /// Whether the parameters or the reference have changed since.
    pub is_stale: bool,
    /// The progress of a running sweep.
    pub progress: Option<EvaluationProgress>,
}

impl SweepState {
    pub(super) fn new(ranges: SweepRanges) -> Self {
        Self {
            ranges,
            map: None,
            clouds: [0, 0],
            is_stale: false,
            progress: None,
        }
    }
}

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

impl App {
    /// Begins a sweep over the chosen ranges.
    pub(super) fn sweep(&mut self) {
        let folder = &mut self.state.many;
        let Some(settings) = folder.sweep.ranges.settings() else {
            self.say(true, "These ranges of u and τ hold no settings to try.".into());
            return;
        };
        let places: Vec<usize> = if folder.sweep.ranges.only_current {
            self.state.current.into_iter().collect()
        } else {
            folder.order.to_vec()
        };
        let path = |&place: &usize| folder.rows.get(place)?.path.clone();
        let clouds: Vec<PathBuf> = places.iter().filter_map(path).collect();
        if clouds.is_empty() {
            self.say(
                true,
                "There is no file to sweep over: samples are swept once they are saved as files.".into(),
            );
            return;
        }
        let sweeper = &mut self.many.sweeper;
        sweeper.turn += 1;
        sweeper.began = Instant::now();
        sweeper.of = Some((self.state.settings.request.clone(), folder.against));
        folder.sweep.map = Some(Arc::new(Sweep::new(settings.clone())));
        folder.sweep.clouds = [0, clouds.len()];
        folder.sweep.is_stale = false;
        folder.sweep.progress = Some(EvaluationProgress {
            done: 0,
            total: clouds.len(),
            left: None,
        });
        let task = Task {
            turn: sweeper.turn,
            clouds,
            settings,
            request: self.state.settings.request.clone(),
            against: folder.against,
        };
        let context = self.many.context.clone();
        let swept = sweeper.swept.0.clone();
        sweeper
            .lane
            .submit(move |watch| sweep_batch(&task, &context, watch, &swept));
    }

    /// Cancels the sweep; the map keeps the clouds that are done.
    pub(super) fn cancel_sweep(&mut self) {
        self.many.sweeper.lane.cancel();
        self.state.many.sweep.progress = None;
    }

    pub(super) fn update_sweep(&mut self) {
        let is_over = self.many.sweeper.lane.take();
        let sweep = &mut self.state.many.sweep;
        while let Ok(swept) = self.many.sweeper.swept.1.try_recv() {
            let (Some(map), Some(progress)) = (&mut sweep.map, &mut sweep.progress) else {
                continue;
            };
            if swept.turn != self.many.sweeper.turn {
                continue;
            }
            progress.done += 1;
            let each = self.many.sweeper.began.elapsed().as_secs_f64() / progress.done as f64;
            let left = progress.total.saturating_sub(progress.done);
            progress.left = Some(Duration::from_secs_f64(each * left as f64));
            if let Some(errors_deg) = swept.errors_deg {
                Arc::make_mut(map).add(&errors_deg);
                sweep.clouds[0] += 1;
            }
        }
        let of = self.many.sweeper.of.as_ref();
        sweep.is_stale = of.is_some_and(|(request, against)| {
            // The sweep replaces u and τ.
            let mut now = self.state.settings.request.clone();
            now.params.u = request.params.u;
            now.params.tau_cm_per_rad = request.params.tau_cm_per_rad;
            now != *request || self.state.many.against != *against
        });
        if let Some(result) = is_over {
            sweep.progress = None;
            if let Err(crash) = result {
                self.say(
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
