//! The program behind the window: its state, the commands that change it, and the workers that do
//! what takes time.
//!
//! ```text
//! command ─▶ App::apply ─▶ settings ─▶ analysis worker ─▶ stages ─▶ look worker ─▶ scene ─▶ what is drawn
//! ```
//!
//! It knows no window toolkit: whatever draws it calls [`App::update`] once a frame, reads [`State`],
//! and hands in [`Command`]s.

pub mod annotating;
mod apply;
mod caption;
mod command_line;
mod details;
#[cfg(feature = "window")]
mod drawing;
mod files;
pub mod folder;
mod history;
mod image;
pub mod look;
mod navigate;
pub mod peduncle;
pub mod queue;
mod samples;
mod session;
mod stages;
mod state;
pub mod why;
pub mod worker;
mod written;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use glam::DVec2;

use crate::evaluate::{compared, sentence};
use crate::geometry::{Cancelled, Extent};
use crate::method::{AxisEstimate, PlaneDetail};
use crate::render::{Camera, Viewport};
use crate::view::{ShownPoints, pick_point};

use details::Details;
use folder::{Folder, FolderState};
use history::History;
use look::{Look, Question, Style, look};
use navigate::framed_camera;
use stages::{Stages, WalkError};
use worker::{Crashed, Discard, Lane, Repaint};

pub use annotating::{AnnotateCommand, Annotating};
pub use caption::{caption, lead_in_words};
pub use command_line::{analysis_options, command_line, quoted};
#[cfg(feature = "window")]
pub use drawing::{Drawing, DrawingError, draw as draw_cloud};
pub use history::History as UndoHistory;
pub use navigate::{default_camera, dragged};
pub use peduncle::{PeduncleCommand, PeduncleState};
pub use samples::Sample;
pub use session::{Session, SessionError};
pub use stages::{Source, Walked};
pub use state::{Command, Entry, Message, PlaneChoice, Settings, State, Tool, TruthChoice};
pub use written::Written;

/// A small cloud's results are waited for, so that they are in the frame that asked for them.
const PATIENCE: Duration = Duration::from_millis(7);

/// Planes that are played through in a second.
const PLANES_PER_SECOND: f64 = 6.0;

type Arrival = (Source, Arc<crate::io::Fruit>, Arc<ShownPoints>);

type WalkResult = (Stages, Result<Walked, WalkError>);

/// What was last asked of the analysis worker.
#[derive(Debug, Clone, PartialEq)]
struct Asked {
    source: Source,
    settings: Box<crate::evaluate::Request>,
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
    history: History<Settings>,
    stages: Stages,
    details: Details,
    analysis: Lane<WalkResult>,
    looks: Lane<Result<Look, Cancelled>>,
    picks: Lane<(PickQuestion, Option<usize>)>,
    images: Lane<Result<String, String>>,
    discard: Discard,
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
    folder: Folder,
    annotator: annotating::Annotator,
}

impl App {
    /// A program with nothing open. `repaint` is called from other threads whenever there is something
    /// new to show.
    ///
    /// # Errors
    /// Where the operating system starts no thread.
    pub fn new(session: Session, repaint: &Repaint) -> std::io::Result<Self> {
        let mut state = State::new(session.settings, session.style.into());
        state.annotating = annotating::Annotating::new(session.annotating);
        state.recent = session.recent;
        state.interface_scale = session.interface_scale.clamp(0.5, 3.0);
        state.folder = FolderState::new(session.folder);
        Ok(Self {
            state,
            history: History::default(),
            stages: Stages::default(),
            details: Details::default(),
            analysis: Lane::new("analysis", repaint.clone())?,
            looks: Lane::new("look", repaint.clone())?,
            picks: Lane::new("pick", repaint.clone())?,
            images: Lane::new("image", repaint.clone())?,
            discard: Discard::new()?,
            peduncle: peduncle::Work::new(repaint)?,
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
            folder: Folder::new(repaint)?,
            annotator: annotating::Annotator::new(repaint)?,
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
        self.is_current_busy() || self.folder.is_busy()
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
        if let Some((_, result)) = self.images.take() {
            let (is_error, text) = match result {
                Ok(Ok(done)) => (false, done),
                Ok(Err(problem)) => (true, problem),
                Err(crash) => (true, sentence(&crash.to_string())),
            };
            self.say(is_error, text);
        }
        self.state.progress = self.analysis.progress();
        self.state.can_undo = self.history.can_undo() || self.can_undo_tag();
        self.state.can_redo = self.history.can_redo() || self.can_redo_tag();
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

    fn play(&mut self, elapsed: Duration) {
        if !self.state.is_playing {
            return;
        }
        // Not faster than the planes can be drawn.
        if !self.looks.is_busy() {
            self.play_phase += PLANES_PER_SECOND * elapsed.as_secs_f64().min(0.5);
        }
        let steps = self.play_phase.floor();
        self.play_phase -= steps;
        if steps > 0.0 {
            // At most three.
            self.step(steps as isize);
        }
    }

    fn ask_for_analysis(&mut self) {
        let Some(source) = self.state.source().cloned() else {
            return;
        };
        let wanted = Asked {
            source,
            settings: Box::new(self.state.settings.request.clone()),
            turn: self.turn,
        };
        if self.asked.as_ref() == Some(&wanted) {
            return;
        }
        self.asked = Some(wanted.clone());
        self.state.was_cancelled = false;
        if let Some(walked) = self.stages.at_once(&wanted.source, &wanted.settings) {
            self.analysis.cancel();
            self.accept(Ok(walked));
            return;
        }
        self.state.is_stale = self.state.walked.is_some();
        let mut stages = self.stages.clone();
        let (arrivals, repaint) = (self.arrivals.0.clone(), self.repaint.clone());
        // What another request was to show comes too late.
        while self.arrivals.1.try_recv().is_ok() {}
        self.analysis.submit(move |watch| {
            let arrived = |fruit: &Arc<crate::io::Fruit>, shown| {
                // Nobody listens any more where the window has closed.
                let _ = arrivals.send((wanted.source.clone(), fruit.clone(), shown));
                repaint();
            };
            let result = stages.walk(&wanted.source, &wanted.settings, watch, &arrived);
            (stages, result)
        });
        self.take_analysis(Some(PATIENCE));
    }

    fn take_arrivals(&mut self) {
        while let Ok((source, fruit, shown)) = self.arrivals.1.try_recv() {
            let is_current = self.state.source() == Some(&source);
            if is_current && self.analysis.progress().is_some() {
                self.shown_generation += 1;
                self.forget_analysis();
                // Its axis can be set by hand meanwhile.
                self.set_subject(&fruit, &shown);
                self.state.unanalyzed = Some((shown, None));
                self.frame_if_new();
            }
        }
    }

    fn frame_if_new(&mut self) {
        if self.needs_framing && self.state.shown().is_some() {
            self.needs_framing = false;
            self.frame_new_cloud();
        }
    }

    fn take_analysis(&mut self, patience: Option<Duration>) {
        let taken = match patience {
            Some(patience) => self.analysis.take_within(patience),
            None => self.analysis.take(),
        };
        match taken {
            None => {}
            Some((_, Ok((stages, result)))) => {
                self.discard.take(std::mem::replace(&mut self.stages, stages));
                self.accept(result);
            }
            Some((_, Err(Crashed(fault)))) => {
                self.say(
                    true,
                    format!("The analysis broke off by a fault of the program: {fault}"),
                );
                self.state.was_cancelled = true;
            }
        }
    }

    fn accept(&mut self, result: Result<Walked, WalkError>) {
        self.shown_generation += 1;
        let current = self.state.current;
        let mut set_problem = |problem: Option<String>| {
            if let Some(entry) = current.and_then(|i| self.state.entries.get_mut(i)) {
                entry.problem = problem;
            }
        };
        match result {
            Ok(walked) => {
                set_problem(None);
                self.set_subject(&walked.fruit, &walked.shown);
                let walked = self.with_annotations(walked);
                let request = &self.state.settings.request;
                let (references, warnings) = compared(&walked.fruit, request, &walked.analysis);
                let before = self.state.walked.as_ref();
                if before.is_none_or(|b| !Arc::ptr_eq(&b.shown, &walked.shown)) {
                    self.state.picked = None;
                    self.state.pointed_at = None;
                    self.state.brush_cm = None;
                }
                let same_planes =
                    before.is_some_and(|b| Arc::ptr_eq(&b.analysis.planes, &walked.analysis.planes));
                if !same_planes {
                    self.details.clear();
                    self.keep_direction(&walked);
                    self.state.previewed = None;
                }
                (self.state.references, self.state.warnings) = (references, warnings);
                self.discard.take(self.state.walked.replace(Arc::new(walked)));
                self.discard.take(self.state.unanalyzed.take());
                self.state.is_stale = false;
                self.take_current_row();
            }
            Err(WalkError::Analysis { fruit, shown, error }) => {
                set_problem(Some(sentence(&error.to_string())));
                self.state.warnings.clone_from(&fruit.warnings);
                self.forget_analysis();
                self.set_subject(&fruit, &shown);
                let why = sentence(&format!("{}: {error}", self.name_of_current()));
                self.state.unanalyzed = Some((shown, Some(why)));
            }
            Err(WalkError::Fruit(error)) => {
                set_problem(Some(sentence(&error.reason())));
                self.forget_analysis();
                self.leave_subject();
                self.say(true, sentence_of_file(&error.to_string()));
            }
            Err(WalkError::Cancelled) => self.state.was_cancelled = true,
        }
        self.frame_if_new();
    }

    fn forget_analysis(&mut self) {
        self.details.clear();
        self.discard
            .take((self.state.walked.take(), self.state.unanalyzed.take()));
        self.state.references.clear();
        self.state.is_stale = false;
        self.state.previewed = None;
        self.state.picked = None;
        self.state.brush_cm = None;
    }

    fn name_of_current(&self) -> String {
        self.state.source().map(Source::name).unwrap_or_default()
    }

    fn ask_for_look(&mut self) {
        if let Some((_, result)) = self.looks.take() {
            self.accept_look(result);
        }
        let Some(shown) = self.state.shown().cloned() else {
            self.discard.take(self.state.look.take());
            self.seen = None;
            return;
        };
        let is_blind = self.state.annotating.is_blind;
        let wanted = Seen {
            shown_generation: self.shown_generation,
            plane: self.state.plane_index().filter(|_| !is_blind),
            style: self.state.shown_style(),
            pixels_per_point: self.state.pixels_per_point,
            brush_cm: self.state.brush_cm.clone(),
            reference: self.state.reference().cloned().filter(|_| !is_blind),
        };
        if self.seen.as_ref() != Some(&wanted) {
            let question = Question {
                shown,
                analysis: self.state.analysis().cloned(),
                plane: wanted.plane,
                reference: wanted.reference.clone(),
                references: self.state.references.clone(),
                style: wanted.style.clone(),
                pixels_per_point: wanted.pixels_per_point,
                brush_cm: wanted.brush_cm.clone(),
                fruit: self.state.walked.as_ref().map(|walked| walked.fruit.clone()),
                detail: wanted.plane.and_then(|index| self.details.get(index)),
            };
            let before = self.state.look.clone();
            self.looks
                .submit(move |watch| look(question, before.as_deref(), watch));
            self.seen = Some(wanted);
            self.state.is_look_pending = true;
            if let Some((_, result)) = self.looks.take_within(PATIENCE) {
                self.accept_look(result);
            }
        }
    }

    fn accept_look(&mut self, result: Result<Result<Look, Cancelled>, Crashed>) {
        match result {
            Ok(Ok(look)) => {
                let planes_of = |analysis: &Arc<crate::method::Analysis>| analysis.planes.clone();
                let (of_look, newest) = (look.analysis.as_ref(), self.state.analysis());
                let is_newest = of_look
                    .map(planes_of)
                    .zip(newest.map(planes_of))
                    .is_some_and(|(a, b)| Arc::ptr_eq(&a, &b));
                if let (Some(index), Some(detail), true) = (look.plane_index, &look.detail, is_newest) {
                    self.details.keep(index, detail.clone());
                }
                self.discard.take(self.state.look.replace(Arc::new(look)));
            }
            Ok(Err(Cancelled)) => return,
            Err(crash) => self.say(true, sentence(&format!("the view broke off by {crash}"))),
        }
        self.state.is_look_pending = false;
    }

    fn ask_for_pick(&mut self) {
        if let Some(question) = self.pending_click.take() {
            self.pick(question);
        }
        if let Some((_, Ok((question, found)))) = self.picks.take_within(PATIENCE) {
            self.state.pointed_at = found;
            if question.is_click {
                self.state.picked = found;
            }
        }
    }

    fn pick(&mut self, question: PickQuestion) {
        let Some(shown) = self.state.look.as_ref().map(|look| look.shown.clone()) else {
            return;
        };
        let (camera, viewport) = (self.state.camera, self.state.viewport);
        let radius_px = self.state.look.as_ref().map_or(1.0, |look| {
            let size = look.scene.points.first().map_or(2.0, |p| p.size_px);
            f64::from(0.5 * size / self.state.pixels_per_point)
        });
        self.picks.submit(move |_| {
            let found = pick_point(&shown, &camera, viewport, question.pixel, radius_px, 6.0);
            (question, found)
        });
    }

    /// The first cloud is framed; another one is seen from where the last one was, relative to it.
    fn frame_new_cloud(&mut self) {
        let Some(shown) = self.state.shown() else {
            return;
        };
        let extent = shown.extent;
        self.state.camera = match self.framed {
            Some(last) => {
                let ratio = extent.size().length() / last.size().length();
                let moved = extent.center() - last.center();
                self.state.camera.eye_in_world += moved;
                self.state.camera.pivot_in_world += moved;
                if (0.5..2.0).contains(&ratio) {
                    self.state.camera
                } else {
                    framed_camera(&self.state)
                }
            }
            None => default_camera(&self.state),
        };
        self.framed = Some(extent);
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
