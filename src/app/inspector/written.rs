//! What is written over the view.

use glam::DVec3;

use super::look::Look;
use super::stages::Source;
use crate::app::state::State;
use crate::method::axis_error_rad;
use crate::render::Viewport;
use crate::view::caption;
use crate::view::{Legend, Overlay, Page};

/// The texts of one view, which a [`Page`] borrows.
#[derive(Debug, Clone)]
pub struct Written<'a> {
    legend: Option<&'a Legend>,
    caption: Vec<String>,
    label: Option<(DVec3, String)>,
    unit: Option<&'static str>,
}

impl<'a> Written<'a> {
    /// What is to be said of a look.
    pub fn of(state: &State, look: &'a Look) -> Self {
        let overlays = state.shown_style().overlays;
        let has = |overlay| look.analysis.is_some() && overlays.has(overlay);
        let (axis, reference) = (look.axis.as_ref(), look.reference.as_ref());
        let both = axis
            .zip(reference)
            .filter(|_| has(Overlay::Axis) && has(Overlay::Reference));
        let label = both.map(|(axis, reference)| {
            let text = format!("{:.1}° apart", axis_error_rad(axis, reference).to_degrees());
            let upward = if axis.direction.y > 0.0 {
                -axis.direction
            } else {
                axis.direction
            };
            // Where the drawn line ends: 0.62 of the fruit's size, which is twice the shading's length.
            let reach = 1.24 * f64::from(look.scene.eye_dome.scale);
            (axis.origin + reach * upward, text)
        });
        let name = state.source().map(Source::name).unwrap_or_default();
        let caption = match &look.analysis {
            Some(analysis) if has(Overlay::Caption) => {
                caption(&name, analysis, look.plane_index, axis, reference)
            }
            _ => Vec::new(),
        };
        Self {
            legend: overlays.has(Overlay::Legend).then_some(&*look.legend),
            caption,
            label,
            unit: state.walked.as_ref().map(|w| w.fruit.unit.symbol()),
        }
    }

    /// The page for a view of that size.
    pub fn page(&'a self, state: &State, viewport: Viewport) -> Page<'a> {
        let overlays = &state.style.overlays;
        Page {
            viewport,
            theme: state.style.theme,
            legend: self.legend,
            scale_unit: self.unit.filter(|_| overlays.has(Overlay::Scale)),
            has_triad: overlays.has(Overlay::Triad),
            caption: &self.caption,
            label: self.label.as_ref().map(|(place, text)| (*place, text.as_str())),
        }
    }
}
