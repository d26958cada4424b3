//! A simulated pepper whose settings are changed while its analysis follows.
//!
//! A slider changes the settings at once; the cloud in the view follows as fast as it is simulated and analyzed. While
//! one is on its way, only the newest of the settings that were wanted meanwhile is kept for the next.

mod follow;
pub(super) mod pepper;
mod sliders;
mod state;
mod trail;

pub use pepper::SimulatedPepper;
pub use sliders::{Slider, SliderGroup};
pub use state::{SimulatorCommand, SimulatorState};
pub use trail::Trail;
