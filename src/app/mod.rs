//! The program behind the window: its state, the commands that change it, and the workers that do
//! what takes time.
//!
//! ```text
//! command ─▶ App::apply ─▶ settings ─▶ analysis worker ─▶ stages ─▶ look worker ─▶ scene ─▶ what is drawn
//! ```
//!
//! It knows no window toolkit: whatever draws it calls [`App::update`] once a frame, reads [`State`],
//! and hands in [`Command`]s.

mod apply;
mod files;
pub mod inspector;
pub mod many;
pub mod peduncle;
mod samples;
mod session;
mod state;
pub mod true_axes;
pub mod workers;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use glam::DVec2;

use crate::evaluate::CloudTags;
use crate::geometry::Extent;
use crate::method::{AxisEstimate, PlaneDetail};
use crate::parallel::Cancelled;
use crate::render::{Camera, Viewport};
use crate::text::sentence;
use crate::undo::History;
use crate::view::{ShownPoints, Style};

use inspector::details::Details;
use inspector::look::Look;
use inspector::stages::{AnalyzeError, FruitStages};
use many::{Many, ManyState};
use workers::{Lane, Pool, Repaint};

pub use inspector::command_line::{command_line, quoted};
pub use inspector::image::page;
pub use inspector::navigate::{default_camera, dragged};
pub use inspector::stages::{AnalyzedFruit, Source};
pub use peduncle::{PeduncleCommand, PeduncleState};
pub use samples::Sample;
pub use session::{Session, SessionError};
pub use state::{Command, Entry, Message, PlaneChoice, Settings, State, Tool, TruthChoice};
pub use true_axes::{TrueAxesCommand, TrueAxesState};

/// A small cloud's results are waited for, so that they are in the frame that asked for them.
const PATIENCE: Duration = Duration::from_millis(7);

/// Planes that are played through in a second.
const PLANES_PER_SECOND: f64 = 6.0;

type Arrival = (Source, Arc<crate::fruit::Fruit>, Arc<ShownPoints>);

type AnalysisResult = (FruitStages, Result<AnalyzedFruit, AnalyzeError>);

/// A step that undo takes back: the value that it replaced, or, once it is undone, the value that it made.
#[derive(Debug, Clone)]
enum Step {
    Settings(Box<Settings>),
    /// The tags and the note of a cloud.
    Tags {
        path: PathBuf,
        tagged: CloudTags,
    },
}

/// What was last asked of the analysis worker.
#[derive(Debug, Clone, PartialEq)]
struct Asked {
    source: Source,
    settings: Box<crate::fruit::Request>,
    /// Counts reloads.
    turn: u64,
}

/// What was last asked of the look worker.
#[derive(Debug, Clone, PartialEq)]
struct Seen {
    /// Of the analysis, or of the points alone.
    shown_generation: u64,
    plane: Option<usize>,
    style: Style,
    pixels_per_point: f32,
    brush_cm: Option<std::ops::RangeInclusive<f64>>,
    reference: Option<AxisEstimate>,
}

/// What a click or a hovering cursor asks.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PickQuestion {
    pixel: DVec2,
    is_click: bool,
}

/// The program.
pub struct App {
    state: State,
    undo: History<Step>,
    stages: FruitStages,
    details: Details,
    analysis: Lane<AnalysisResult>,
    looks: Lane<Result<Look, Cancelled>>,
    picks: Lane<(PickQuestion, Option<usize>)>,
    images: Lane<Result<String, String>>,
    pool: Pool,
    peduncle: peduncle::Work,
    asked: Option<Asked>,
    seen: Option<Seen>,
    shown_generation: u64,
    turn: u64,
    next_message: u64,
    /// Where playing is between two planes, in planes.
    play_phase: f64,
    /// Whether the next cloud is to be framed.
    needs_framing: bool,
    /// The extent of the cloud that the camera was set for.
    framed: Option<Extent>,
    /// Points that were read, before they are analyzed.
    arrivals: (Sender<Arrival>, Receiver<Arrival>),
    repaint: Repaint,
    /// The last click that was not answered yet.
    pending_click: Option<PickQuestion>,
    many: Many,
    annotator: true_axes::Annotator,
}

impl App {
    /// A program with nothing open. `repaint` is called from other threads whenever there is something
    /// new to show.
    ///
    /// # Errors
    /// Where the operating system starts no thread.
    pub fn new(session: Session, repaint: &Repaint) -> std::io::Result<Self> {
        let pool = &Pool::new(repaint)?;
        let mut state = State::new(session.settings, session.style.into());
        state.true_axes = TrueAxesState::new(session.true_axes);
        state.recent = session.recent;
        state.interface_scale = session.interface_scale.clamp(0.5, 3.0);
        state.many = ManyState::new(session.many);
        Ok(Self {
            state,
            undo: History::default(),
            stages: FruitStages::default(),
            details: Details::default(),
            analysis: Lane::new(pool),
            looks: Lane::new(pool),
            picks: Lane::new(pool),
            images: Lane::new(pool),
            pool: pool.clone(),
            peduncle: peduncle::Work::new(pool),
            asked: None,
            seen: None,
            shown_generation: 0,
            turn: 0,
            next_message: 0,
            play_phase: 0.0,
            needs_framing: true,
            framed: None,
            arrivals: channel(),
            repaint: repaint.clone(),
            pending_click: None,
            many: Many::new(pool),
            annotator: true_axes::Annotator::new(pool),
        })
    }

    /// Everything that there is to show.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Tells the size of the view in logical pixels, and whether the processor draws it.
    pub fn set_view(&mut self, viewport: Viewport, pixels_per_point: f32, is_software: bool) {
        self.state.viewport = viewport;
        self.state.pixels_per_point = pixels_per_point;
        self.state.is_software = is_software;
    }

    /// Whether the workers have anything to do, or to hand out.
    pub fn is_busy(&self) -> bool {
        self.is_current_busy() || self.many.is_busy()
    }

    /// Whether somebody waits for what they are doing: not for what is done for all clouds in the background.
    pub fn is_current_busy(&self) -> bool {
        self.analysis.is_busy()
            || self.looks.is_busy()
            || self.picks.is_busy()
            || self.images.is_busy()
            || self.peduncle.is_busy()
            || self.annotator.is_busy()
    }

    /// What is to be done once a frame: takes what the workers have made, and asks for what is wanted
    /// now. `elapsed` is the time since the last call.
    pub fn update(&mut self, elapsed: Duration) {
        self.play(elapsed);
        self.take_arrivals();
        self.take_analysis(None);
        self.update_folder(elapsed);
        self.stand_aside(true);
        self.ask_for_analysis();
        self.update_annotating();
        self.ask_for_look();
        self.update_peduncle();
        self.stand_aside(self.analysis.is_busy() || self.looks.is_busy());
        self.update_edit_scenes();
        self.ask_for_pick();
        if let Some(result) = self.images.take() {
            let (is_error, text) = match result {
                Ok(Ok(done)) => (false, done),
                Ok(Err(problem)) => (true, problem),
                Err(crash) => (true, sentence(&crash.to_string())),
            };
            self.say(is_error, text);
        }
        self.state.progress = self.analysis.progress();
        self.state.can_undo = self.undo.undo_steps() > 0;
        self.state.can_redo = self.undo.redo_steps() > 0;
    }

    fn say(&mut self, is_error: bool, text: String) {
        // Said once, whoever says it again.
        self.state.messages.retain(|message| message.text != text);
        self.next_message += 1;
        self.state.messages.push(Message {
            id: self.next_message,
            is_error,
            text,
        });
    }

    /// Keeps `detail` within reach: for tests of the bound.
    #[doc(hidden)]
    pub fn kept_details(&self) -> Vec<Arc<PlaneDetail>> {
        self.details.all()
    }

    /// The camera, which tests set instead of dragging.
    pub fn set_camera(&mut self, camera: Camera) {
        self.state.camera = camera;
    }
}

/// An error's text that begins with a file's name, as a sentence: names keep their letters.
fn sentence_of_file(text: &str) -> String {
    format!("{text}.")
}
