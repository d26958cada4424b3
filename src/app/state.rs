//! Everything that the window shows: panels read it and change nothing.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::estimators::EstimatorsState;
use super::peduncle::state::PeduncleState;
use super::simulator::SimulatorState;
use super::tool::Tool;
use crate::app::inspector::look::Look;
use crate::app::inspector::stages::AnalyzedFruit;
use crate::app::many::state::{KeptMany, ManyState};
use crate::app::source::Source;
use crate::app::true_axes::state::{KeptTrueAxes, TrueAxesState};
use crate::app::workers::Progress;
use crate::evaluate::{ErrorBreakdown, reference_of};
use crate::fruit::Request;
use crate::method::{Analysis, AxisEstimate, CandidateAxes, Params, PlaneDetail, PointDetail};
use crate::render::{Camera, Viewport};
use crate::view::{ShownPoints, Style, Theme};

pub use crate::evaluate::TruthChoice;

/// The candidate plane that is looked at.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum PlaneChoice {
    /// The one with the lowest score, whichever it is.
    #[default]
    Best,
    /// The one at step g, h of the grid, each from 1.
    At {
        /// The step of α.
        g: usize,
        /// The step of β.
        h: usize,
    },
}

/// The settings that undo and redo bring back.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The settings of the analysis.
    pub request: Request,
    /// The plane that is looked at.
    pub plane: PlaneChoice,
}

/// One cloud of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The cloud's origin.
    pub source: Source,
    /// The reason why it cannot be used, once that is known.
    pub problem: Option<String>,
}

/// Something that the person at the screen has to be told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// Told apart by this.
    pub id: u64,
    /// Whether something failed.
    pub is_error: bool,
    /// The message, in a sentence.
    pub text: String,
}

/// Everything that the window shows.
#[derive(Debug, Clone)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each says one thing that is so or not"
)]
pub struct State {
    /// The clouds that are open.
    pub entries: Vec<Entry>,
    /// The place of the one that is shown.
    pub current: Option<usize>,
    /// Files opened lately, the last one first.
    pub recent: Vec<PathBuf>,
    /// The settings that undo brings back.
    pub settings: Settings,
    /// Whether there is something to undo.
    pub can_undo: bool,
    /// Whether there is something to redo.
    pub can_redo: bool,
    /// The newest analysis, which may be of older settings.
    pub walked: Option<Arc<AnalyzedFruit>>,
    /// A cloud that was read but not analyzed, and why: `None` where it only is not yet.
    pub unanalyzed: Option<(Arc<ShownPoints>, Option<String>)>,
    /// Whether it was not analyzed because the viewpoint lies among its points, as that of a whole scan does.
    pub is_viewpoint_inside: bool,
    /// The axes to compare with.
    pub references: Vec<AxisEstimate>,
    /// Warnings about the result, a sentence each.
    pub warnings: Vec<String>,
    /// Whether the analysis is of older settings than those that are shown.
    pub is_stale: bool,
    /// The progress of the analysis under way.
    pub progress: Option<Progress>,
    /// Whether the analysis was called off by hand.
    pub was_cancelled: bool,
    /// A plane that is only previewed, by its index in the grid.
    pub previewed: Option<usize>,
    /// Whether the planes are played through.
    pub is_playing: bool,
    /// The style in which the cloud is drawn.
    pub style: Style,
    /// The newest view of the cloud.
    pub look: Option<Arc<Look>>,
    /// Whether what is drawn is of an older plane or coloring.
    pub is_look_pending: bool,
    /// The camera.
    pub camera: Camera,
    /// The view's size, in logical pixels, when it was last drawn.
    pub viewport: Viewport,
    /// Physical pixels a logical one.
    pub pixels_per_point: f32,
    /// The estimates of the axis.
    pub estimators: EstimatorsState,
    /// The tool of the left mouse button.
    pub tool: Tool,
    /// The simulated pepper.
    pub simulator: SimulatorState,
    /// Picking the peduncle.
    pub peduncle: PeduncleState,
    /// The picked point, by its index among the shown ones.
    pub picked: Option<usize>,
    /// The point under the cursor.
    pub pointed_at: Option<usize>,
    /// The contributions that are brushed, in centimeters.
    pub brush_cm: Option<RangeInclusive<f64>>,
    /// The messages that have not been dismissed.
    pub messages: Vec<Message>,
    /// Whether pictures are drawn by the processor, which wants fewer points while the camera moves.
    pub is_software: bool,
    /// The scale of the interface; 1 as the screen asks for.
    pub interface_scale: f32,
    /// The open clouds as a set.
    pub many: ManyState,
    /// Axes set by hand.
    pub true_axes: TrueAxesState,
}

impl State {
    pub(super) fn new(settings: Settings, style: Style) -> Self {
        Self {
            entries: Vec::new(),
            current: None,
            recent: Vec::new(),
            settings,
            can_undo: false,
            can_redo: false,
            walked: None,
            unanalyzed: None,
            is_viewpoint_inside: false,
            references: Vec::new(),
            warnings: Vec::new(),
            is_stale: false,
            progress: None,
            was_cancelled: false,
            previewed: None,
            is_playing: false,
            style,
            look: None,
            is_look_pending: false,
            camera: Camera::looking_at(glam::DVec3::ZERO, glam::DVec3::Z, glam::DVec3::NEG_Y),
            viewport: Viewport::new(800.0, 600.0),
            pixels_per_point: 1.0,
            estimators: EstimatorsState::default(),
            tool: Tool::Navigate,
            simulator: SimulatorState::default(),
            peduncle: PeduncleState::default(),
            picked: None,
            pointed_at: None,
            brush_cm: None,
            messages: Vec::new(),
            is_software: false,
            interface_scale: 1.0,
            many: ManyState::new(KeptMany::default()),
            true_axes: TrueAxesState::new(KeptTrueAxes::default()),
        }
    }

    /// The newest analysis.
    pub fn analysis(&self) -> Option<&Arc<Analysis>> {
        self.walked.as_ref().map(|w| &w.analysis)
    }

    /// The parameters: as in force where there is an analysis of them, else as asked for.
    pub fn params(&self) -> Params {
        let request = &self.settings.request;
        match &self.walked {
            Some(walked) => request.params(&walked.fruit),
            None => request.params.clone(),
        }
    }

    /// The current cloud.
    pub fn source(&self) -> Option<&Source> {
        Some(&self.entries.get(self.current?)?.source)
    }

    /// The points that can be shown, analyzed or not.
    pub fn shown(&self) -> Option<&Arc<ShownPoints>> {
        match (&self.walked, &self.unanalyzed) {
            (_, Some((shown, _))) => Some(shown),
            (Some(walked), None) => Some(&walked.shown),
            (None, None) => None,
        }
    }

    /// The index of the plane that is looked at or previewed; `None` where there is none.
    pub fn plane_index(&self) -> Option<usize> {
        let analysis = self.analysis()?;
        let grid = analysis.planes.grid;
        if let Some(index) = self.previewed.filter(|&i| i < grid.plane_count()) {
            return Some(index);
        }
        self.chosen_plane_index()
    }

    /// The index of the plane that was chosen, whatever is previewed.
    pub fn chosen_plane_index(&self) -> Option<usize> {
        let analysis = self.analysis()?;
        match self.settings.plane {
            PlaneChoice::Best => analysis.ranking.best().ok(),
            PlaneChoice::At { g, h } => analysis.planes.grid.index_of(g, h),
        }
    }

    /// The axis that errors are measured against: the current cloud's reference by the choice that table, charts and
    /// gallery follow too. `None` if this cloud has none of that kind.
    pub fn reference(&self) -> Option<&AxisEstimate> {
        reference_of(&self.references, self.many.against)
    }

    /// The parts of the axis's error against the chosen reference. Takes O(u²).
    pub fn error_breakdown(&self) -> Option<ErrorBreakdown> {
        let (walked, reference) = (self.walked.as_ref()?, self.reference()?);
        let given = walked.at_true_center.as_deref().map(CandidateAxes::new);
        let computed = CandidateAxes::new(&walked.analysis);
        ErrorBreakdown::new(&walked.fruit, &computed, given.as_ref(), reference)
    }

    /// The detail of the plane that is drawn.
    pub fn detail(&self) -> Option<&PlaneDetail> {
        self.look.as_ref()?.detail.as_deref()
    }

    /// A shown point's index in the surface, and its part in the score of the plane that is drawn.
    pub fn point_detail(&self, shown_index: usize) -> Option<(usize, PointDetail)> {
        let look = self.look.as_ref()?;
        let in_surface = look.shown.in_surface.get(shown_index)?;
        let detail = look.detail.as_ref()?;
        Some((in_surface, *detail.points.get(in_surface)?))
    }

    /// Whether something dark lies behind everything.
    pub fn is_dark(&self) -> bool {
        self.style.theme == Theme::Dark
    }
}
