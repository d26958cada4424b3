//! The chain of stages from a cloud to its axis, with the result of each stage kept for the next analysis.

use std::sync::Arc;

use glam::DVec3;

use super::used_points::{UsedPoints, UsedPointsKey};
use super::{
    Analysis, AnalysisError, CandidateGrid, CenterMethod, Params, PlaneTerms, find_center, plane_terms,
};
use crate::geometry::{Cloud, Unit};
use crate::parallel::Watch;

/// A stage of the analysis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Outlier removal and voxel grid.
    Filters,
    /// Normals (Eq. 2).
    Normals,
    /// Fruit center (Eq. 3).
    Center,
    /// n, ΣD and ΣΞ of every candidate plane (Eq. 4–15).
    PlaneTerms,
    /// Scores, plane and axis (§ 2.5, Eq. 16).
    Scores,
}

/// A [`Watch`] that is also told which stage begins. It may keep a clock; the method has none.
pub trait Observe: Watch {
    /// Called when `stage` begins, which ends the stage before it. A stage whose result is kept from
    /// an earlier analysis does not begin.
    fn entered(&self, _stage: Stage) {}
}

impl Observe for () {}

/// Grids whose plane terms are kept, so that going back to one takes no work.
const KEPT_GRIDS: usize = 12;

/// A cloud and the results of the stages of its analysis. Each result is kept under the parameters that
/// it depends on and the results that it was made from, so that an analysis under other parameters
/// repeats only the stages that they change:
///
/// | result | depends on |
/// | --- | --- |
/// | used points and normals | filters, source of normals, k, viewpoint; the unit if there is a voxel grid |
/// | fruit center | used points, method of the center with its seed |
/// | plane terms | used points, center, u, unit |
/// | scores, plane, axis | plane terms, τ, aggregation, partner fraction |
///
/// Scores are computed anew for each analysis, in O(u² log u). The analysis is the same to the bit as
/// that of [`analyze`], whichever analyses came before. A copy shares the results.
#[derive(Debug, Clone)]
pub struct Stages {
    cloud: Cloud,
    used: Option<(UsedPointsKey, Arc<UsedPoints>)>,
    /// The newest center that was searched for in the used points.
    center: Option<(CenterMethod, DVec3)>,
    /// Plane terms of the used points, the newest last.
    planes: Vec<(PlanesKey, Arc<PlaneTerms>)>,
}

/// The parameters that plane terms depend on, beside the used points.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PlanesKey {
    center: DVec3,
    u: usize,
    unit: Unit,
}

/// Analyzes a cloud: walks it through every stage.
///
/// # Errors
/// Returns an error if a parameter is out of range, the points are too few, all equal or on a line, no
/// center is found, the viewpoint lies inside the cloud, or `observe` cancels the work.
pub fn analyze(cloud: &Cloud, params: &Params, observe: &dyn Observe) -> Result<Analysis, AnalysisError> {
    Stages::new(cloud.clone()).analyze(params, observe)
}

impl Stages {
    /// The stages of a cloud, none of which has run.
    pub fn new(cloud: Cloud) -> Self {
        Self {
            cloud,
            used: None,
            center: None,
            planes: Vec::new(),
        }
    }

    /// The cloud.
    pub fn cloud(&self) -> &Cloud {
        &self.cloud
    }

    /// Analyzes the cloud, running only the stages whose result is not kept.
    ///
    /// # Errors
    /// Returns the errors of [`analyze`]. The stages that had ended before the error keep their results.
    pub fn analyze(&mut self, params: &Params, observe: &dyn Observe) -> Result<Analysis, AnalysisError> {
        params.check()?;
        let used = self.used_points(params, observe)?;
        let center = self.center(&used, params, observe)?;
        let planes = self.plane_terms(&used, center, params, observe)?;
        observe.entered(Stage::Scores);
        Ok(Analysis::new(params, &used, center, planes))
    }

    /// The analysis, if only scores have to be computed for it: τ, the aggregation and the partner
    /// fraction change nothing else. `None` if a stage would have to run or a parameter is out of range.
    pub fn analyze_kept(&self, params: &Params) -> Option<Analysis> {
        params.check().ok()?;
        let used = self.kept_points(params)?;
        let center = self.kept_center(params)?;
        let planes = self.kept_planes(PlanesKey::new(center, params))?;
        Some(Analysis::new(params, used, center, planes.clone()))
    }

    fn used_points(
        &mut self,
        params: &Params,
        observe: &dyn Observe,
    ) -> Result<Arc<UsedPoints>, AnalysisError> {
        if let Some(used) = self.kept_points(params) {
            return Ok(used.clone());
        }
        let used = Arc::new(UsedPoints::new(&self.cloud, params, observe)?);
        self.used = Some((UsedPointsKey::new(params), used.clone()));
        // They are of other points.
        self.center = None;
        self.planes.clear();
        Ok(used)
    }

    fn center(
        &mut self,
        used: &UsedPoints,
        params: &Params,
        observe: &dyn Observe,
    ) -> Result<DVec3, AnalysisError> {
        if let Some(center) = self.kept_center(params) {
            return Ok(center);
        }
        observe.entered(Stage::Center);
        let center = find_center(used.surface.points(), &params.center, observe)?;
        self.center = Some((params.center, center));
        Ok(center)
    }

    fn plane_terms(
        &mut self,
        used: &UsedPoints,
        center: DVec3,
        params: &Params,
        observe: &dyn Observe,
    ) -> Result<Arc<PlaneTerms>, AnalysisError> {
        let key = PlanesKey::new(center, params);
        if let Some(planes) = self.kept_planes(key) {
            return Ok(planes.clone());
        }
        let grid = CandidateGrid::new(params.u)?;
        observe.entered(Stage::PlaneTerms);
        let (surface, viewpoint) = (&used.surface, params.viewpoint);
        let planes = Arc::new(plane_terms(
            surface,
            params.unit,
            center,
            viewpoint,
            grid,
            observe,
        )?);
        if self.planes.len() == KEPT_GRIDS {
            self.planes.remove(0);
        }
        self.planes.push((key, planes.clone()));
        Ok(planes)
    }

    fn kept_points(&self, params: &Params) -> Option<&Arc<UsedPoints>> {
        let (key, used) = self.used.as_ref()?;
        (*key == UsedPointsKey::new(params)).then_some(used)
    }

    /// The center, if it needs no search. One that is given is never stored, so that a center that is
    /// dragged about does not push out the one that took a search.
    fn kept_center(&self, params: &Params) -> Option<DVec3> {
        if let CenterMethod::Given(center) = params.center {
            return Some(center);
        }
        let (method, center) = self.center.as_ref()?;
        (*method == params.center).then_some(*center)
    }

    fn kept_planes(&self, key: PlanesKey) -> Option<&Arc<PlaneTerms>> {
        let found = self.planes.iter().find(|(kept, _)| *kept == key);
        found.map(|(_, planes)| planes)
    }
}

impl PlanesKey {
    fn new(center: DVec3, params: &Params) -> Self {
        Self {
            center,
            u: params.u,
            unit: params.unit,
        }
    }
}
