//! The points of the current cloud that are its peduncle.

use std::path::Path;
use std::sync::Arc;

use crate::app::inspector::stages::AnalyzedFruit;
use crate::app::state::State;
use crate::app::tool::Tool;
use crate::fruit::PeduncleChoice;
use crate::geometry::PointSet;
use crate::render::Scene;

impl State {
    /// The cloud that is open, read and analyzed; `None` while another one is still shown.
    pub fn current_walked(&self) -> Option<&Arc<AnalyzedFruit>> {
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

    /// The scene that is drawn, with the peduncle highlighted if it is to be.
    pub fn drawn_scene(&self) -> Option<Arc<Scene>> {
        let look = self.look.as_ref()?;
        let marked = self.peduncle.marked.as_ref().filter(|marked| marked.is_of(look));
        Some(marked.map_or_else(|| look.scene.clone(), |marked| marked.scene.clone()))
    }
}
