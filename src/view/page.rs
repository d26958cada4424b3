//! The page over a picture: the texts and keys that go with a view.

use glam::DVec3;

use super::caption::caption;
use super::legend::Legend;
use super::overlays::Overlay;
use super::primitive::Theme;
use super::scene::axis_ends;
use super::shown::ShownPoints;
use super::style::Style;
use crate::geometry::Unit;
use crate::method::{Analysis, AxisEstimate, axis_error_rad};
use crate::render::Viewport;

/// The texts and keys to be laid out over a picture.
#[derive(Debug, Clone)]
pub struct Page<'a> {
    /// The picture.
    pub viewport: Viewport,
    /// Light on dark, or dark on light.
    pub theme: Theme,
    /// The key to the colors.
    pub legend: Option<&'a Legend>,
    /// The unit of a scale bar's length, such as cm.
    pub scale_unit: Option<&'a str>,
    /// Whether to show the directions of x, y and z.
    pub has_triad: bool,
    /// Lines of a caption, the most important first.
    pub caption: Vec<String>,
    /// A text beside a point in the world: the angle at the axis' end.
    pub label: Option<(DVec3, String)>,
}

/// The facts about a view that its page states.
#[derive(Debug, Clone, Copy)]
pub struct PageFacts<'a> {
    /// The unit of the cloud's coordinates; `None` for no scale bar.
    pub unit: Option<Unit>,
    /// The cloud's points.
    pub shown: &'a ShownPoints,
    /// The analysis; `None` for a cloud that was not analyzed.
    pub analysis: Option<&'a Analysis>,
    /// The plane's index in the grid.
    pub plane: Option<usize>,
    /// The plane's axis.
    pub axis: Option<&'a AxisEstimate>,
    /// The axis that it is compared with.
    pub reference: Option<&'a AxisEstimate>,
    /// The key to the colors.
    pub legend: &'a Legend,
}

impl<'a> Page<'a> {
    /// The page that states these facts about the cloud called `name`, as far as the style's overlays ask for them.
    pub fn new(facts: &PageFacts<'a>, name: &str, style: &Style, viewport: Viewport) -> Self {
        let has = |overlay| style.overlays.has(overlay);
        let analysis = facts.analysis;
        let both = facts
            .axis
            .zip(facts.reference)
            .filter(|_| analysis.is_some() && has(Overlay::Axis) && has(Overlay::Reference));
        let captioned = analysis.filter(|_| has(Overlay::Caption));
        Self {
            viewport,
            theme: style.theme,
            legend: has(Overlay::Legend).then_some(facts.legend),
            scale_unit: facts.unit.map(Unit::symbol).filter(|_| has(Overlay::Scale)),
            has_triad: has(Overlay::Triad),
            caption: captioned.map_or_else(Vec::new, |analysis| {
                caption(name, analysis, facts.plane, facts.axis, facts.reference)
            }),
            label: both.map(|(axis, reference)| {
                let angle = axis_error_rad(axis, reference).to_degrees();
                let [_, upper_end] = axis_ends(axis, facts.shown.extent.size().length());
                (upper_end, format!("{angle:.1}° apart"))
            }),
        }
    }
}
