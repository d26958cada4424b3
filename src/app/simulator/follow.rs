//! The cloud in the view, which follows the sliders.

use std::sync::Arc;

use super::pepper::SimulatedPepper;
use super::sliders::Slider;
use super::state::SimulatorCommand;
use crate::app::App;
use crate::app::context::{Context, Step};
use crate::app::source::Source;
use crate::app::state::{PlaneChoice, State};
use crate::geometry::angle_between_lines_rad;
use crate::simulate::PepperSettings;
use crate::text::sentence;

impl App {
    /// Does what the panel *Simulate* asks for. Every command but one that fails shows the simulated pepper.
    pub(in crate::app) fn simulate(&mut self, command: &SimulatorCommand) {
        let simulator = &self.context.state.simulator;
        let before = simulator.settings.as_deref();
        let mut wanted = before.cloned().unwrap_or_else(first);
        let mut moved = None;
        match *command {
            SimulatorCommand::Open => {}
            SimulatorCommand::Move(slider, value) => {
                slider.set(&mut wanted, value);
                moved = Some(slider);
            }
            SimulatorCommand::Another => wanted = another(&wanted),
            SimulatorCommand::Reset => wanted = first(),
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
        let source = Source::Simulated(SimulatedPepper::new(settings));
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
    pub(in crate::app) fn update_simulated(&mut self) {
        let is_computing = self.inspector.is_computing();
        let state = &mut self.context.state;
        let (Some(settings), true) = (state.simulator.settings.clone(), state.shows_simulated()) else {
            return;
        };
        if is_computing {
            return;
        }
        state.note_simulated_error();
        let Some(entry) = state.current.and_then(|place| state.entries.get_mut(place)) else {
            return;
        };
        // By address: this is asked in every frame.
        if matches!(&entry.source, Source::Simulated(pepper) if pepper.is_of(&settings)) {
            return;
        }
        let wanted = Source::Simulated(SimulatedPepper::new(settings));
        if entry.source != wanted {
            state.settings.plane = PlaneChoice::Best;
        }
        entry.source = wanted;
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
        if self.is_stale || self.simulator.trail.has_noted(&walked.analysis) {
            return;
        }
        let (pepper, analysis) = (pepper.clone(), walked.analysis.clone());
        let error_deg = self.simulated_error_deg();
        let trail = &mut self.simulator.trail;
        trail.note(pepper.settings(), &analysis, error_deg);
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
