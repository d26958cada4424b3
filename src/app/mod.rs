//! The program behind the window: its state, the commands that change it, and the jobs that take time.
//!
//! ```text
//! command ─▶ App::apply ─▶ a part's apply ─▶ settings and state
//! frame ───▶ App::update ─▶ each part's update ─▶ jobs of analyses and looks ─▶ scene ─▶ what is drawn
//! ```
//!
//! The parts are rooms of their own: the [`inspector`] of one cloud, its axes by other [`estimators`], its [`peduncle`],
//! its [`true_axes`], and the [`many`] open clouds together. Each has commands, jobs, and a part of the [`State`]; [`App`]
//! lends them what they share, in turn.
//!
//! It knows no window toolkit: whatever draws it calls [`App::update`] once a frame, reads [`State`], and hands in
//! [`Command`]s.

mod clouds;
mod command;
mod context;
pub mod estimators;
pub mod inspector;
pub mod many;
pub mod peduncle;
mod samples;
mod scan_from_here;
mod session;
mod simulator;
mod source;
mod state;
mod tool;
pub mod true_axes;
pub mod workers;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use crate::method::PlaneDetail;
use crate::render::{Camera, Viewport};
use crate::undo::History;

use context::{Context, Step};
use estimators::Estimators;
use inspector::Inspector;
use many::{Many, ManyState};
use peduncle::PeduncleTools;
use true_axes::TrueAxes;
use workers::{Pool, Queue, Repaint};

pub use command::Command;
pub use estimators::{EstimatorsCommand, EstimatorsState};
pub use inspector::command_line::{command_line, quoted};
pub use inspector::image::page;
pub use inspector::navigate::{default_camera, dragged};
pub use inspector::stages::AnalyzedFruit;
pub use peduncle::{PeduncleCommand, PeduncleState};
pub use samples::Sample;
pub use scan_from_here::ScanFromHere;
pub use session::{Session, SessionError};
pub use simulator::{SimulatedPepper, SimulatorCommand, SimulatorState, Slider, SliderGroup, Trail};
pub use source::Source;
pub use state::{Entry, Message, PlaneChoice, Settings, State, TruthChoice};
pub use tool::Tool;
pub use true_axes::{TrueAxesCommand, TrueAxesState};

/// The program.
pub struct App {
    context: Context,
    inspector: Inspector,
    estimators: Estimators,
    peduncle: PeduncleTools,
    true_axes: TrueAxes,
    many: Many,
    saves: Queue<(), Result<String, String>>,
}

impl App {
    /// A program with nothing open. `repaint` is called from other threads whenever there is something
    /// new to show.
    ///
    /// # Errors
    /// Returns an error if the operating system starts no thread.
    pub fn new(session: Session, repaint: &Repaint) -> std::io::Result<Self> {
        let pool = &Pool::new(repaint)?;
        let mut state = State::new(session.settings, session.style.into());
        state.true_axes = TrueAxesState::new(session.true_axes);
        state.recent = session.recent;
        state.interface_scale = session.interface_scale.clamp(0.5, 3.0);
        state.many = ManyState::new(session.many);
        Ok(Self {
            context: Context::new(state, pool),
            inspector: Inspector::new(pool),
            estimators: Estimators::new(pool),
            peduncle: PeduncleTools::new(pool),
            true_axes: TrueAxes::new(pool),
            many: Many::new(pool),
            saves: Queue::new(pool, ()),
        })
    }

    /// Everything that there is to show.
    pub fn state(&self) -> &State {
        &self.context.state
    }

    /// Sets the size of the view in logical pixels, and whether the processor draws it.
    pub fn set_view(&mut self, viewport: Viewport, pixels_per_point: f32, is_software: bool) {
        let state = &mut self.context.state;
        state.viewport = viewport;
        state.pixels_per_point = pixels_per_point;
        state.is_software = is_software;
    }

    /// Does what a panel asks for, and what follows from it.
    pub fn apply(&mut self, command: Command) {
        let cx = &mut self.context;
        if cx.state.true_axes.is_blind && command.reveals() {
            cx.say(false, "Blind mode hides what is computed.");
            return;
        }
        match command {
            Command::Open(paths) => self.open(&paths),
            Command::OpenSample(sample) => self.open_sample(sample),
            Command::Show(place) => self.show(place),
            Command::Go(by) => {
                if let Some(place) = cx.state.neighbor(by) {
                    self.show(place);
                }
            }
            Command::Close => self.close(),
            Command::Simulate(command) => self.simulate(&command),
            Command::ScanFromHere => self.scan_from_here(),
            Command::SaveCloud(path) => self.save_cloud(path),

            Command::EndGesture => cx.undo.end_gesture(),
            Command::Undo => self.travel(History::undo),
            Command::Redo => self.travel(History::redo),
            Command::Scale(scale) => cx.state.interface_scale = scale.clamp(0.5, 3.0),
            Command::Dismiss(id) => cx.state.messages.retain(|message| message.id != id),
            Command::Say { is_error, text } => cx.say(is_error, text),

            Command::Estimators(command) => self.estimators.apply(command, cx),
            Command::Peduncle(command) => self.peduncle.apply(command, cx),
            Command::Many(command) => self.many.apply(command, cx),
            Command::TrueAxes(command) => self.true_axes.apply(command, cx),
            Command::Use(tool) => {
                // One thing at a time has the left button.
                if tool != Tool::Navigate && cx.state.true_axes.is_editing {
                    self.true_axes.apply(TrueAxesCommand::Edit(false), cx);
                }
                self.inspector.apply(Command::Use(tool), cx);
            }
            command => self.inspector.apply(command, cx),
        }
        self.follow_up();
    }

    /// Takes what the jobs have made, and asks for what is wanted now: to be called once a frame. `elapsed` is the time
    /// since the last call.
    pub fn update(&mut self, elapsed: Duration) {
        self.many.update(elapsed, &mut self.context);
        // The background waits while a frame may wait for the current cloud.
        self.many.set_yielding(true);
        while let Some((_, result)) = self.saves.take_within(Duration::ZERO) {
            self.context.say_result(result);
        }
        self.update_simulated();
        let cx = &mut self.context;
        self.inspector.update(elapsed, cx);
        self.estimators.update(cx);
        self.true_axes.update(cx);
        self.inspector.update_view(cx);
        self.peduncle.update(cx);
        self.many.set_yielding(self.inspector.is_computing());
        self.true_axes.update_view(&mut cx.state);
        cx.state.can_undo = cx.undo.undo_steps() > 0;
        cx.state.can_redo = cx.undo.redo_steps() > 0;
        self.follow_up();
    }

    /// Whether a result is still to come or to be taken.
    pub fn is_busy(&self) -> bool {
        self.is_current_busy() || self.many.is_busy()
    }

    /// Whether somebody waits for a result: the background's work on all clouds does not count.
    pub fn is_current_busy(&self) -> bool {
        self.inspector.is_busy()
            || self.estimators.is_busy()
            || self.peduncle.is_busy()
            || self.true_axes.is_busy()
            || self.saves.is_busy()
    }

    /// Waits until every edit of an axis is written.
    pub fn finish(&mut self) {
        self.true_axes.finish(&mut self.context);
    }

    /// Keeps rows in a folder, so that they need not be worked out again the next time.
    pub fn keep_rows_in(&mut self, folder: PathBuf) {
        self.many.keep_rows_in(folder, &self.context);
    }

    /// Keeps in a file which clouds were shown with something computed, over all sessions: an axis of one of them is not
    /// set blindly.
    pub fn keep_seen_in(&mut self, path: PathBuf) {
        self.true_axes.keep_seen_in(path, &mut self.context);
    }

    /// The number of files that were read in the background to know their hash: for tests of the cache.
    #[doc(hidden)]
    pub fn background_reads(&self) -> usize {
        self.many.background_reads()
    }

    /// The details of planes that are kept in memory: for tests of their bound.
    #[doc(hidden)]
    pub fn kept_details(&self) -> Vec<Arc<PlaneDetail>> {
        self.inspector.kept_details()
    }

    /// Sets the camera: tests do so instead of dragging.
    pub fn set_camera(&mut self, camera: Camera) {
        self.context.state.camera = camera;
    }

    /// Carries out what the parts asked of one another.
    fn follow_up(&mut self) {
        for command in std::mem::take(&mut self.context.follow_ups) {
            self.apply(command);
        }
    }

    /// Undoes or redoes a step: its value and the present one change places.
    fn travel(&mut self, way: fn(&mut History<Step>) -> Option<&mut Step>) {
        let cx = &mut self.context;
        match way(&mut cx.undo) {
            Some(Step::Settings(settings)) => {
                std::mem::swap(&mut **settings, &mut cx.state.settings);
                cx.state.previewed = None;
            }
            Some(Step::Simulated(settings)) => {
                if let Some(present) = &mut cx.state.simulator.settings {
                    std::mem::swap(settings, present);
                }
            }
            Some(Step::Tags { path, tagged }) => {
                let now = self.many.tagged(&cx.state.many.rows, path);
                let (path, tagged) = (path.clone(), std::mem::replace(tagged, now));
                self.many.set_tagged(path, tagged, cx);
            }
            None => {}
        }
    }
}
