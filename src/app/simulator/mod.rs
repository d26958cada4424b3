//! A simulated pepper whose settings are changed while its analysis follows.
//!
//! A slider changes the settings at once; the cloud in the view follows as fast as it is simulated and analyzed. While
//! one is on its way, only the newest of the settings that were wanted meanwhile is kept for the next.

mod sliders;
mod trail;

use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use sha2::{Digest, Sha256};

use super::App;
use super::context::{Context, Step};
use super::inspector::stages::Source;
use super::state::{PlaneChoice, State};
use super::workers::{Pool, Queue};
use crate::files::write_all;
use crate::fruit::{CloudFile, ReadError, simulated_files};
use crate::geometry::{Unit, angle_between_lines_rad};
use crate::ply::{Encoding, PlyCloud};
use crate::simulate::PepperSettings;
use crate::text::sentence;

pub use sliders::{Slider, SliderGroup};
pub use trail::Trail;

/// The settings of a simulated pepper as the source of a cloud. Two are the same if their settings are.
#[derive(Debug, Clone)]
pub struct SimulatedPepper {
    settings: Arc<PepperSettings>,
    /// The settings as text, which can be compared and hashed.
    text: Arc<str>,
}

impl SimulatedPepper {
    fn new(settings: &PepperSettings) -> Self {
        Self {
            settings: Arc::new(settings.clone()),
            // Without a failure: settings are plain numbers.
            text: serde_json::to_string(settings).unwrap_or_default().into(),
        }
    }

    /// Its settings.
    pub fn settings(&self) -> &PepperSettings {
        &self.settings
    }

    /// Simulates it: the cloud as a file at `path` would hold it, and its truth as text.
    ///
    /// # Errors
    /// Returns an error if the camera sees nothing of the fruit.
    pub(super) fn read(&self, path: &Path) -> Result<(CloudFile, Option<Arc<str>>), ReadError> {
        let simulated = self.settings.simulate().map_err(|error| ReadError {
            path: path.to_owned(),
            kind: error.into(),
        })?;
        // Without a failure: a truth is plain numbers.
        let truth = serde_json::to_string(&simulated.truth).ok().map(Into::into);
        let file = CloudFile {
            path: path.to_owned(),
            // The settings make the bytes that a file would have.
            sha256: hex::encode(Sha256::digest(self.text.as_bytes())),
            ply: PlyCloud {
                cloud: simulated.cloud,
                dropped_not_finite: 0,
                stated_unit: Some(Unit::Centimeter),
                notes: Vec::new(),
            },
        };
        Ok((file, truth))
    }
}

impl PartialEq for SimulatedPepper {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Eq for SimulatedPepper {}

impl Hash for SimulatedPepper {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.text.hash(state);
    }
}

/// The state of the simulator.
#[derive(Debug, Clone, Default)]
pub struct SimulatorState {
    /// The settings that the sliders show, nothing of them left to chance; `None` until the simulator is first used.
    pub settings: Option<Arc<PepperSettings>>,
    /// The errors over the slider that was moved last.
    pub trail: Trail,
}

/// Something that is asked of the simulator.
#[derive(Debug, Clone, PartialEq)]
pub enum SimulatorCommand {
    /// Show the simulated pepper.
    Open,
    /// Move a slider.
    Move(Slider, f64),
    /// Draw another fruit in another pose; the scan's settings stay.
    Another,
    /// Go back to the settings of the first pepper.
    Reset,
    /// Write the pepper of the sliders to a PLY file, and its truth beside it.
    Save(PathBuf),
}

/// The jobs of the simulator.
pub(super) struct Simulator {
    saves: Queue<(), Result<String, String>>,
}

impl Simulator {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            saves: Queue::new(pool, ()),
        }
    }

    pub(super) fn is_busy(&self) -> bool {
        self.saves.is_busy()
    }
}

/// Writes a simulated pepper and its truth; returns what was done, or why not, in a sentence.
fn save(settings: &PepperSettings, path: &Path) -> Result<String, String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}.", path.display());
    let simulated = settings.simulate().map_err(|error| failed(&error))?;
    let both = simulated_files(path, &simulated, Unit::Centimeter, Encoding::default());
    let both = both.map_err(|error| failed(&error))?;
    write_all(&both).map_err(|error| format!("{error}."))?;
    Ok(format!("Saved {} and its truth beside it.", path.display()))
}

impl App {
    /// Does what the panel *Simulate* asks for. Every command but one that fails shows the simulated pepper.
    pub(super) fn simulate(&mut self, command: SimulatorCommand) {
        let simulator = &self.context.state.simulator;
        let before = simulator.settings.as_deref();
        let mut wanted = before.cloned().unwrap_or_else(first);
        let mut moved = None;
        match command {
            SimulatorCommand::Open => {}
            SimulatorCommand::Move(slider, value) => {
                slider.set(&mut wanted, value);
                moved = Some(slider);
            }
            SimulatorCommand::Another => wanted = another(&wanted),
            SimulatorCommand::Reset => wanted = first(),
            SimulatorCommand::Save(path) => {
                self.simulator.saves.submit(move |()| save(&wanted, &path));
                return;
            }
        }
        match wanted.drawn() {
            Ok(settings) => self.context.set_simulated(Arc::new(settings), moved),
            Err(error) => self.context.say(true, sentence(&error.to_string())),
        }
        if !self.context.state.shows_simulated() {
            self.show_simulated();
        }
    }

    /// Puts the pepper of the sliders into the list, and shows it.
    fn show_simulated(&mut self) {
        let Some(settings) = self.context.state.simulator.settings.clone() else {
            return;
        };
        let source = Source::Simulated(SimulatedPepper::new(&settings));
        let is_simulated = |source: &Source| matches!(source, Source::Simulated(_));
        let entries = &mut self.context.state.entries;
        match entries.iter().position(|entry| is_simulated(&entry.source)) {
            Some(place) => {
                entries[place].source = source;
                self.show(place);
            }
            None => self.add_and_show(source),
        }
    }

    /// Lets the cloud in the view follow the sliders, and keeps its error: once a frame. A cloud that is on its way is
    /// waited for, so that something is seen while a slider moves on.
    pub(super) fn update_simulated(&mut self) {
        while let Some((_, result)) = self.simulator.saves.take_within(Duration::ZERO) {
            self.context.say_result(result);
        }
        let is_computing = self.inspector.is_computing();
        let state = &mut self.context.state;
        let (Some(settings), true) = (state.simulator.settings.clone(), state.shows_simulated()) else {
            return;
        };
        if is_computing {
            return;
        }
        state.note_simulated_error();
        let wanted = SimulatedPepper::new(&settings);
        let Some(entry) = state.current.and_then(|place| state.entries.get_mut(place)) else {
            return;
        };
        if entry.source != Source::Simulated(wanted.clone()) {
            entry.source = Source::Simulated(wanted);
            state.settings.plane = PlaneChoice::Best;
        }
    }
}

impl Context {
    /// Sets the sliders: a step of undo, or a part of the gesture of the slider that was moved.
    fn set_simulated(&mut self, settings: Arc<PepperSettings>, moved: Option<Slider>) {
        let simulator = &mut self.state.simulator;
        if simulator.settings.as_ref() == Some(&settings) {
            return;
        }
        if let Some(before) = simulator.settings.replace(settings) {
            self.undo
                .push_of_gesture(Step::Simulated(before), moved.map(Slider::label));
        }
        if let Some(slider) = moved {
            self.state.simulator.trail.follow(slider);
        }
    }
}

impl State {
    /// Whether the cloud in the view is the simulated one.
    pub fn shows_simulated(&self) -> bool {
        matches!(self.source(), Some(Source::Simulated(_)))
    }

    /// Keeps the error of the analysis that is shown, under the settings that it was made of.
    fn note_simulated_error(&mut self) {
        let (Some(walked), Some(Source::Simulated(pepper))) = (&self.walked, self.source()) else {
            return;
        };
        if self.is_stale {
            return;
        }
        let (pepper, params) = (pepper.clone(), walked.analysis.params.clone());
        let error_deg = self.simulated_error_deg();
        self.simulator.trail.note(pepper.settings(), &params, error_deg);
    }

    /// The angle in degrees between the best plane's axis and the true one of the simulated pepper in the view; `None`
    /// if there is no axis, or another cloud is in the view.
    pub fn simulated_error_deg(&self) -> Option<f64> {
        let walked = self.walked.as_ref().filter(|_| self.shows_simulated())?;
        let axis = walked.analysis.axis.as_ref()?.direction;
        let truth = walked.fruit.truth.as_ref()?.axis.direction;
        Some(angle_between_lines_rad(axis, truth).to_degrees())
    }
}

/// An upright pepper at a working distance, for the sliders to begin with.
fn first() -> PepperSettings {
    PepperSettings {
        tilt_towards_camera_deg: Some(0.0),
        tilt_sideways_deg: Some(0.0),
        distance_cm: [60.0, 60.0],
        ..PepperSettings::default()
    }
}

/// Another fruit in another pose before the same camera.
fn another(before: &PepperSettings) -> PepperSettings {
    PepperSettings {
        seed: before.seed.wrapping_add(1),
        asymmetry: before.asymmetry,
        leaf_cover: before.leaf_cover,
        scan: before.scan.clone(),
        camera: before.camera.clone(),
        ..PepperSettings::default()
    }
}
