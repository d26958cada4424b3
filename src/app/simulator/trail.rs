//! The errors of a simulated pepper over the slider that is being moved.

use std::sync::{Arc, Weak};

use super::sliders::Slider;
use crate::method::{Analysis, Params};
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
    /// The analysis whose error was added last.
    noted: Weak<Analysis>,
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

    /// Whether this analysis, by its address, is the one whose error was added last.
    pub(super) fn has_noted(&self, analysis: &Arc<Analysis>) -> bool {
        std::ptr::eq(self.noted.as_ptr(), Arc::as_ptr(analysis))
    }

    /// Adds the error of an analysis. Those that were made with anything else than the slider set otherwise are forgotten.
    pub(super) fn note(
        &mut self,
        settings: &PepperSettings,
        analysis: &Arc<Analysis>,
        error_deg: Option<f64>,
    ) {
        self.noted = Arc::downgrade(analysis);
        let Some((slider, value)) = self.slider.and_then(|s| Some((s, s.value(settings)?))) else {
            return;
        };
        let mut others = settings.clone();
        slider.clear(&mut others);
        let made_with = Some((others, analysis.params.clone()));
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
