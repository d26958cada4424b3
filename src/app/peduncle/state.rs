//! Everything about picking the peduncle that there is to show.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec2;

use super::beside::Beside;
use super::hues::Hues;
use crate::app::inspector::look::Look;
use crate::app::tool::Tool;
use crate::app::workers::Progress;
use crate::geometry::PointSet;
use crate::render::{Camera, Scene, Viewport};

/// The state of picking the peduncle.
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
    /// The reach of growing, in multiples of the points' median spacing.
    pub reach_spacings: f64,
    /// Drags that are not in the settings yet, the oldest first; the last may be under way.
    pub strokes: VecDeque<Stroke>,
    /// Whether the peduncle is highlighted though no tool is in use.
    pub is_previewed: bool,
    /// The view with the peduncle highlighted, while it is.
    pub marked: Option<Arc<Marked>>,
    /// The cloud's histogram of hues, if the peduncle is told by them.
    pub hues: Option<Arc<Hues>>,
    /// Whether a selection is being grown, or a companion written.
    pub is_working: bool,
    /// A question that has to be answered first.
    pub question: Option<Question>,
    /// Whether the analyses with and without the peduncle are to be seen side by side.
    pub wants_beside: bool,
    /// The results of both, once they are known.
    pub beside: Option<Beside>,
    /// Their progress, while they are being computed.
    pub beside_progress: Option<Progress>,
    /// Companions that were written, and what is in them.
    pub(super) saved: Vec<Saved>,
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
    /// Lasso or brush.
    pub tool: Tool,
    /// Whether it takes points away.
    pub removes: bool,
    /// The cursor's path, in logical pixels of the view.
    pub path_px: Vec<DVec2>,
    /// Whether the button was let go.
    pub is_ended: bool,
    /// The camera at the stroke's beginning.
    pub camera: Camera,
    /// The view's size in logical pixels.
    pub viewport: Viewport,
    /// Strokes are told apart by this.
    pub(super) id: u64,
}

/// A question about a file, to be answered before it is written or taken.
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
    pub(super) path: PathBuf,
    pub(super) sha256: String,
    pub(super) points: Arc<PointSet>,
}

/// A view with the peduncle highlighted.
#[derive(Debug, Clone)]
pub struct Marked {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The number of the cloud's points that are highlighted.
    pub points: usize,
    /// The scene of the look that it was made from.
    pub(super) of: Arc<Scene>,
}

impl Marked {
    /// Whether it is the same view as a look.
    pub fn is_of(&self, look: &Look) -> bool {
        Arc::ptr_eq(&self.of, &look.scene)
    }
}

impl PeduncleState {
    /// The file in which these points of a cloud were saved; `None` where they were not, or the file
    /// has been written again since.
    pub(super) fn saved_as(&self, sha256: &str, points: &PointSet) -> Option<&Path> {
        let is_it = |saved: &&Saved| saved.sha256 == sha256 && *saved.points == *points;
        self.saved.iter().find(is_it).map(|saved| saved.path.as_path())
    }
}
