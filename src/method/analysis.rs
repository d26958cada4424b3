//! The result of all stages: planes, their ranking, the best plane and its axis.

use std::sync::Arc;

use glam::DVec3;

use super::used_points::UsedPoints;
use super::warning::{plane_warnings, point_warnings};
use super::{
    AxisError, AxisEstimate, AxisSource, Candidate, CenterError, NoSymmetryPlane, ParamError, Params,
    PlaneTerms, Ranking, Surface, SurfaceError, Warning, symmetry_axis,
};
use crate::geometry::Plane;
use crate::parallel::Cancelled;

/// Why a cloud could not be analyzed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// A parameter is out of range.
    #[error(transparent)]
    Params(#[from] ParamError),
    /// The points are no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// No center was found.
    #[error(transparent)]
    Center(#[from] CenterError),
    /// The cubes of the voxel grid are finer than coordinates are exact.
    #[error("voxels of {edge_cm:e} cm are finer than its coordinates are exact; leave the voxel grid out")]
    VoxelsTooFine {
        /// The edge in centimeters.
        edge_cm: f64,
    },
    /// The cubes of the voxel grid are so large that hardly a point is left.
    #[error(
        "voxels of {edge_cm} cm leave {left} of its {points} points, and at least {} are needed",
        Surface::MIN_POINTS
    )]
    VoxelsTooLarge {
        /// The edge in centimeters.
        edge_cm: f64,
        /// Points that are left.
        left: usize,
        /// Points before the voxel grid.
        points: usize,
    },
    /// One camera cannot have seen this from there.
    #[error(
        "the viewpoint ({:.4}, {:.4}, {:.4}) lies inside the cloud, so no camera there can have seen it; state where it was",
        viewpoint.x, viewpoint.y, viewpoint.z
    )]
    ViewpointInsideCloud {
        /// p_v, in the file's unit and frame.
        viewpoint: DVec3,
    },
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl AnalysisError {
    /// Whether the work was cancelled, at whatever stage.
    pub fn is_cancelled(&self) -> bool {
        matches!(
            self,
            Self::Cancelled(_)
                | Self::Surface(SurfaceError::Cancelled(_))
                | Self::Center(CenterError::Cancelled(_))
        )
    }
}

/// The plane with the lowest score: the symmetry plane (§ 2.5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BestPlane {
    /// Its index in the grid.
    pub index: usize,
    /// Its place in the grid and its normal.
    pub candidate: Candidate,
    /// Its score in centimeters.
    pub score_cm: f64,
    /// The second best plane and its score, if another has one.
    pub runner_up: Option<(Candidate, f64)>,
}

impl BestPlane {
    fn new(planes: &PlaneTerms, ranking: &Ranking) -> Result<Self, NoSymmetryPlane> {
        let scored = |index: usize| Some((planes.grid.candidate(index), ranking.scores_cm()[index]?));
        let index = ranking.best()?;
        Ok(Self {
            index,
            candidate: planes.grid.candidate(index),
            // A ranked plane has a score.
            score_cm: ranking.scores_cm()[index].unwrap_or_default(),
            runner_up: ranking.runner_up().and_then(scored),
        })
    }

    /// The excess of the runner-up's score over the best, as a share of the best. `None` without a
    /// runner-up, or if the best score is zero.
    pub fn lead(&self) -> Option<f64> {
        let (_, runner_up) = self.runner_up?;
        (self.score_cm > 0.0).then(|| runner_up / self.score_cm - 1.0)
    }
}

/// The result of every stage. A copy shares the points and the plane terms.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// The parameters of the analysis.
    pub params: Params,
    /// The used points and their normals.
    pub surface: Arc<Surface>,
    /// The indices of the cloud's [`crate::geometry::strays`], ascending; they are left out of the used points
    /// unless [`super::Filters::keep_strays`] is set.
    pub strays: Arc<Vec<usize>>,
    /// The edge of the sample's cubes in the file's unit, if the used points are a sample (see
    /// [`super::Filters::max_points`]).
    pub sample_edge: Option<f64>,
    /// The fruit center p_c, in the file's unit and frame.
    pub center: DVec3,
    /// n, ΣD and ΣΞ of every candidate plane.
    pub planes: Arc<PlaneTerms>,
    /// The planes' scores and their order.
    pub ranking: Ranking,
    /// The symmetry plane.
    pub best: Result<BestPlane, NoSymmetryPlane>,
    /// The symmetry axis; `None` if there is no symmetry plane, or Eq. 16 is undefined for it (the
    /// warnings say which).
    pub axis: Option<AxisEstimate>,
    /// Findings that make the result less certain.
    pub warnings: Vec<Warning>,
}

impl Analysis {
    /// Computes the last stage from the results of the others under the same `params`: scores, plane
    /// and axis (§ 2.5, Eq. 16). Takes O(u² log u), whatever the number of points.
    pub(super) fn new(params: &Params, used: &UsedPoints, center: DVec3, planes: Arc<PlaneTerms>) -> Self {
        let ranking = Ranking::new(
            &planes,
            params.tau_cm_per_rad,
            params.aggregation,
            params.min_partner_fraction,
        );
        let best = BestPlane::new(&planes, &ranking);
        let mut warnings = point_warnings(used, params);
        warnings.extend(plane_warnings(&planes, &best));
        let mut analysis = Self {
            params: params.clone(),
            surface: used.surface.clone(),
            strays: used.strays.clone(),
            sample_edge: used.sample.map(|sample| sample.edge),
            center,
            planes,
            ranking,
            best,
            axis: None,
            warnings,
        };
        match analysis.best.map(|best| analysis.axis_of(best.index)) {
            Ok(Ok(axis)) => analysis.axis = Some(axis),
            Ok(Err(undefined)) => analysis.warnings.push(undefined.into()),
            // A warning says so already.
            Err(NoSymmetryPlane { .. }) => {}
        }
        analysis
    }

    /// The candidate plane at `index` of the grid (0 to u² − 1), in the file's unit and frame.
    pub fn plane(&self, index: usize) -> Plane {
        Plane {
            point: self.center,
            normal: self.planes.grid.candidate(index).normal,
        }
    }

    /// The axis that Eq. 16 gives for the candidate plane at `index` of the grid (0 to u² − 1), as if
    /// that plane were the symmetry plane.
    ///
    /// # Errors
    /// Returns an error if Eq. 16 is undefined for the plane.
    pub fn axis_of(&self, index: usize) -> Result<AxisEstimate, AxisError> {
        let direction = symmetry_axis(self.plane(index).normal, self.center, self.params.viewpoint)?;
        Ok(AxisEstimate {
            source: AxisSource::SymmetryPlane,
            origin: self.center,
            direction,
            confidence: None,
        })
    }
}
