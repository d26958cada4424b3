//! Growing and shrinking a selection, which asks for the neighbors of points.

use std::sync::Arc;

use crate::app::inspector::stages::AnalyzedFruit;
use crate::app::workers::JobWatch;
use crate::geometry::PointSet;
use crate::parallel::Cancelled;
use crate::peduncle::{grown, median_spacing, shrunk};

/// A request to grow or shrink the selection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::app) struct Edit {
    pub(super) grows: bool,
    /// The reach in multiples of the points' median spacing.
    pub(super) reach_spacings: f64,
}

/// A selection before and after an edit.
pub(in crate::app) struct Edited {
    pub(super) sha256: String,
    pub(super) from: Arc<PointSet>,
    pub(super) to: Arc<PointSet>,
    /// The median spacing of the cloud's points.
    pub(super) spacing: f64,
}

impl Edit {
    /// Does the edit. `spacing` is the points' median spacing, if it is known.
    pub(super) fn run(
        self,
        walked: &AnalyzedFruit,
        from: Arc<PointSet>,
        spacing: Option<f64>,
        watch: &JobWatch,
    ) -> Result<Edited, Cancelled> {
        let points = walked.fruit.cloud().positions();
        let spacing = spacing.or_else(|| median_spacing(points)).unwrap_or(0.0);
        let reach = self.reach_spacings * spacing;
        let to = if self.grows {
            grown(points, &from, reach, watch)?
        } else {
            shrunk(points, &from, reach, watch)?
        };
        Ok(Edited {
            sha256: walked.fruit.file.sha256.clone(),
            from,
            to: Arc::new(to),
            spacing,
        })
    }
}
