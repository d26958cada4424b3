//! The errors of a simulated pepper over the slider that is being moved.

use super::sliders::Slider;
use crate::method::Params;
use crate::simulate::PepperSettings;

/// An error at a place of the slider.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrailPoint {
    /// The slider's value, in its unit.
    pub value: f64,
    /// The error in degrees; `None` if there is no axis.
    pub error_deg: Option<f64>,
}

/// The errors over one slider, while everything else stays as it is.
#[derive(Debug, Clone, Default)]
pub struct Trail {
    slider: Option<Slider>,
    /// The settings but for the slider's, and the parameters, that the errors were made with.
    made_with: Option<(PepperSettings, Params)>,
    points: Vec<TrailPoint>,
}

impl Trail {
    /// The slider; `None` before one was moved.
    pub fn slider(&self) -> Option<Slider> {
        self.slider
    }

    /// The errors, by increasing value of the slider.
    pub fn points(&self) -> &[TrailPoint] {
        &self.points
    }

    /// Follows a slider. The errors over another one are forgotten.
    pub(super) fn follow(&mut self, slider: Slider) {
        if self.slider != Some(slider) {
            *self = Self {
                slider: Some(slider),
                ..Self::default()
            };
        }
    }

    /// Adds an error. Those that were made with anything else than the slider set otherwise are forgotten.
    pub(super) fn note(&mut self, settings: &PepperSettings, params: &Params, error_deg: Option<f64>) {
        let Some((slider, value)) = self.slider.and_then(|s| Some((s, s.value(settings)?))) else {
            return;
        };
        let mut others = settings.clone();
        slider.clear(&mut others);
        let made_with = Some((others, params.clone()));
        if self.made_with != made_with {
            self.made_with = made_with;
            self.points.clear();
        }
        let point = TrailPoint { value, error_deg };
        match self.points.binary_search_by(|p| p.value.total_cmp(&value)) {
            Ok(place) => self.points[place] = point,
            Err(place) => self.points.insert(place, point),
        }
    }
}
