//! The map of the mean error over u and τ, of all clouds of the table or of the current one.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::EvaluationProgress;
use super::run::{Background, Polite};
use crate::app::App;
use crate::app::workers::{JobWatch, Lane, Pool};
use crate::evaluate::{Outcome, Sweep, SweepSettings, TruthChoice, sweep_cloud};
use crate::fruit::Request;
use crate::method::CandidateGrid;
use crate::parallel::{Crew, Watch};

/// The most settings of τ that are tried.
pub const MOST_TAUS: usize = 200;

/// What is to be swept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SweepWish {
    /// The least and the most grid steps.
    pub u: [usize; 2],
    /// From one u to the next.
    pub u_step: usize,
    /// The least and the most weight of angles, in centimeters per radian.
    pub tau_cm_per_rad: [f64; 2],
    /// From one weight to the next.
    pub tau_step_cm_per_rad: f64,
    /// Only the current cloud, not all that the table shows.
    pub only_current: bool,
}

impl Default for SweepWish {
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

impl SweepWish {
    /// Every setting; `None` where there is none, or where it makes no sense.
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

/// Without what adding up steps leaves behind the ninth decimal.
fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

/// A map, and of what it is.
#[derive(Debug, Clone)]
pub struct SweepState {
    /// What is to be swept next.
    pub wish: SweepWish,
    /// The map; with fewer clouds than asked for while it grows, or where it was called off.
    pub map: Option<Arc<Sweep>>,
    /// Clouds in it, and clouds that were asked for.
    pub clouds: [usize; 2],
    /// Whether it is of other parameters, or against another reference, than those in force.
    pub is_stale: bool,
    /// How far it is; `None` where none is under way.
    pub progress: Option<EvaluationProgress>,
}

impl SweepState {
    pub(super) fn new(wish: SweepWish) -> Self {
        Self {
            wish,
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

/// What sweeps.
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
    /// Begins the sweep that was wished for.
    pub(super) fn sweep(&mut self) {
        let folder = &mut self.state.many;
        let Some(settings) = folder.sweep.wish.settings() else {
            self.say(true, "These ranges of u and τ hold no settings to try.".into());
            return;
        };
        let places: Vec<usize> = if folder.sweep.wish.only_current {
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
        let (background, crew) = (self.many.background.clone(), self.many.crew.clone());
        let swept = sweeper.swept.0.clone();
        sweeper
            .lane
            .submit(move |watch| run(&task, &background, &crew, watch, &swept));
    }

    /// Calls the sweep off; the map stays as far as it came.
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
            // u and τ are what is swept.
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

/// Several clouds at a time; what they say is added up in the order in which it comes, which changes a mean in
/// its last digit at most.
fn run(task: &Task, background: &Background, crew: &Crew, watch: &JobWatch, swept: &Sender<Swept>) {
    let next = AtomicUsize::new(0);
    let polite = Polite { watch, background };
    crew.each(|| {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(path) = task.clouds.get(place) else {
                return;
            };
            if polite.is_cancelled() {
                return;
            }
            let worked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
                let (_, examined) = Outcome::of_file("", path, &task.request, &polite).ok()?;
                sweep_cloud(&examined?, task.against, &task.settings, &polite).ok()
            }));
            if watch.is_cancelled() {
                return;
            }
            // Nobody listens any more where the window has closed.
            let _ = swept.send(Swept {
                turn: task.turn,
                errors_deg: worked.ok().flatten(),
            });
        }
    });
}
