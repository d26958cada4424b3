//! The state of the simulator, and what can be asked of it.

use std::sync::Arc;

use super::sliders::Slider;
use super::trail::Trail;
use crate::simulate::PepperSettings;

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
}
