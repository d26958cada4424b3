//! Picking the peduncle: lasso and brush, growing, a preview of hues, the companion file, and both of the
//! paper's experiments side by side.
//!
//! ```text
//! drag ─▶ stroke ─▶ marks worker ─▶ highlight … button let go ─▶ settings (one step of undo) ─▶ analysis
//! ```

mod apply;
mod beside;
mod companion;
mod edits;
mod hues;
mod marks;

use std::collections::{HashSet, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec2;

use super::state::Tool;
use crate::app::workers::{Lane, Pool, Progress};
use crate::fruit::PeduncleChoice;
use crate::geometry::PointSet;
use crate::render::{Camera, Viewport};

pub use beside::{Beside, Errors};
pub use hues::Hues;
pub use marks::Marked;

/// What there is to show of picking the peduncle.
#[derive(Debug, Clone)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each says one thing that is so or not"
)]
pub struct PeduncleState {
    /// The brush's radius in logical pixels.
    pub brush_radius_px: f64,
    /// Whether lasso and brush take points that others hide as well.
    pub is_through: bool,
    /// How far a selection grows, in multiples of the points' median spacing.
    pub reach_spacings: f64,
    /// Drags that are not in the settings yet, the oldest first; the last may be under way.
    pub strokes: VecDeque<Stroke>,
    /// Whether the peduncle is highlighted though no tool is in use.
    pub is_previewed: bool,
    /// The view with the peduncle highlighted, while it is.
    pub marked: Option<Arc<Marked>>,
    /// How the cloud's hues are spread, where the peduncle is told by them.
    pub hues: Option<Arc<Hues>>,
    /// Whether a selection is being grown, or a companion written.
    pub is_working: bool,
    /// What has to be answered first.
    pub question: Option<Question>,
    /// Whether the analyses with and without the peduncle are to be seen side by side.
    pub wants_beside: bool,
    /// What they came to, once that is known.
    pub beside: Option<Beside>,
    /// How far they are, while they are being computed.
    pub beside_progress: Option<Progress>,
    /// Companions that were written, and what is in them.
    saved: Vec<Saved>,
}

impl Default for PeduncleState {
    fn default() -> Self {
        Self {
            brush_radius_px: 20.0,
            is_through: false,
            reach_spacings: 2.0,
            strokes: VecDeque::new(),
            is_previewed: false,
            marked: None,
            hues: None,
            is_working: false,
            question: None,
            wants_beside: false,
            beside: None,
            beside_progress: None,
            saved: Vec::new(),
        }
    }
}

/// One drag with the lasso or the brush.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Which of the two.
    pub tool: Tool,
    /// Whether it takes points away.
    pub removes: bool,
    /// Where the cursor was, in logical pixels of the view.
    pub path_px: Vec<DVec2>,
    /// Whether the button was let go.
    pub is_ended: bool,
    /// Where the view was seen from.
    pub camera: Camera,
    /// The view's size in logical pixels.
    pub viewport: Viewport,
    /// Strokes are told apart by this.
    id: u64,
}

/// What has to be answered before a file is written or taken.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Question {
    /// This file is there already. Is it to be replaced?
    Replace(PathBuf),
    /// This file was dropped. Is it the peduncle of the open cloud?
    Offer(PathBuf),
}

/// A companion that was written.
#[derive(Debug, Clone)]
pub(in crate::app) struct Saved {
    path: PathBuf,
    sha256: String,
    points: Arc<PointSet>,
}

/// What a dialog of the desktop is to ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PedunclePath {
    /// The peduncle's file.
    File,
    /// The folder of the clouds without their peduncles.
    Removed,
    /// Where the companion is to be written.
    SaveAs,
}

/// Something that is asked for about the peduncle.
#[derive(Debug, Clone, PartialEq)]
pub enum PeduncleCommand {
    /// The tool was dragged to a place of the view, in logical pixels, beginning a stroke or going on.
    Draw {
        /// Where.
        at_px: DVec2,
        /// Whether the stroke takes points away; counts where it begins.
        removes: bool,
    },
    /// The button was let go: the stroke counts.
    EndStroke,
    /// The stroke under way does not count.
    DropStroke,
    /// Add the neighbors of the selected points.
    Grow,
    /// Take the selected points away that have neighbors which are not selected.
    Shrink,
    /// Select nothing.
    Clear,
    /// Select what is not selected.
    Invert,
    /// How large the brush is, in logical pixels.
    BrushRadius(f64),
    /// Whether hidden points are taken as well.
    Through(bool),
    /// How far a selection grows, in multiples of the points' median spacing.
    Reach(f64),
    /// Highlight the peduncle, or no longer.
    Preview(bool),
    /// Where the peduncle is.
    Choose(PeduncleChoice),
    /// A file was dropped that may be the open cloud's peduncle.
    Offer(PathBuf),
    /// Write the peduncle's points beside the cloud, under the companion's name.
    Save,
    /// Write them there, whatever is there.
    SaveAs(PathBuf),
    /// Drop the question.
    Dismiss,
    /// Compute the analyses with and without the peduncle, or no longer.
    Compare(bool),
    /// Ask for a path in a dialog of the desktop: the window's part.
    Ask(PedunclePath),
}

/// What works beside the interface.
pub(super) struct Work {
    marks: Lane<marks::Marking>,
    asked_marks: Option<marks::Wanted>,
    screens: marks::Screens,
    edits: Lane<Result<edits::Edited, crate::parallel::Cancelled>>,
    waiting_edits: VecDeque<edits::Edit>,
    /// The median spacing of a cloud's points, by its SHA-256, which takes a tree of them to tell.
    spacing: Option<(String, f64)>,
    companions: Lane<companion::Written>,
    /// Clouds whose companions were compared with what the last session had picked.
    compared: HashSet<String>,
    hues: Lane<Option<Hues>>,
    asked_hues: Option<String>,
    besides: Lane<Option<Beside>>,
    asked_beside: Option<beside::Key>,
    next_stroke: u64,
}

impl Work {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            marks: Lane::new(pool),
            asked_marks: None,
            screens: marks::Screens::default(),
            edits: Lane::new(pool),
            waiting_edits: VecDeque::new(),
            spacing: None,
            companions: Lane::new(pool),
            compared: HashSet::new(),
            hues: Lane::new(pool),
            asked_hues: None,
            besides: Lane::new(pool),
            asked_beside: None,
            next_stroke: 0,
        }
    }

    /// Whether anything is under way, or to be handed out.
    pub(super) fn is_busy(&self) -> bool {
        self.marks.is_busy()
            || self.edits.is_busy()
            || !self.waiting_edits.is_empty()
            || self.companions.is_busy()
            || self.hues.is_busy()
            || self.besides.is_busy()
    }
}

impl PeduncleState {
    /// The file in which these points of a cloud were saved; `None` where they were not, or the file
    /// has been written again since.
    fn saved_as(&self, sha256: &str, points: &PointSet) -> Option<&Path> {
        let is_it = |saved: &&Saved| saved.sha256 == sha256 && *saved.points == *points;
        self.saved.iter().find(is_it).map(|saved| saved.path.as_path())
    }
}

impl super::State {
    /// The cloud that is open, read and analyzed; `None` while another one is still shown.
    pub fn current_walked(&self) -> Option<&Arc<super::AnalyzedFruit>> {
        let path = self.source()?.path();
        self.walked
            .as_ref()
            .filter(|walked| walked.fruit.file.path == path)
    }

    /// The current cloud's points that were picked by hand, which may be newer than the analysis;
    /// `None` where its peduncle is told otherwise.
    pub fn picked_peduncle(&self) -> Option<&Arc<PointSet>> {
        match &self.settings.request.peduncle {
            PeduncleChoice::Points(picked) => picked.of(&self.current_walked()?.fruit.file.sha256),
            _ => None,
        }
    }

    /// The current cloud's points that are its peduncle, however that is told.
    pub fn peduncle_points(&self) -> Option<Arc<PointSet>> {
        if let Some(picked) = self.picked_peduncle() {
            return Some(picked.clone());
        }
        let found = self.current_walked()?.fruit.peduncle.as_ref();
        Some(Arc::new(
            found
                .map(|p| p.in_cloud.iter().copied().collect())
                .unwrap_or_default(),
        ))
    }

    /// The file in which the picked peduncle was saved, for the command line. `None` where nothing is
    /// picked, or what is picked was not saved.
    pub fn saved_peduncle(&self) -> Option<&Path> {
        let sha256 = &self.current_walked()?.fruit.file.sha256;
        self.peduncle.saved_as(sha256, self.picked_peduncle()?)
    }

    /// Whether the peduncle was picked by hand and lies in no file yet.
    pub fn has_unsaved_peduncle(&self) -> bool {
        self.picked_peduncle().is_some() && self.saved_peduncle().is_none()
    }

    /// Whether the lasso or the brush is in hand.
    pub fn is_picking(&self) -> bool {
        matches!(self.tool, Tool::Lasso | Tool::Brush)
    }

    /// What is drawn: with the peduncle highlighted where it is to be.
    pub fn drawn_scene(&self) -> Option<Arc<crate::render::Scene>> {
        let look = self.look.as_ref()?;
        let marked = self.peduncle.marked.as_ref().filter(|marked| marked.is_of(look));
        Some(marked.map_or_else(|| look.scene.clone(), |marked| marked.scene.clone()))
    }
}
