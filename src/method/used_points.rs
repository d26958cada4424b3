//! The first two stages: filters and normals (Eq. 2), from a cloud to the points that the method uses.

use std::num::NonZeroUsize;
use std::sync::Arc;

use glam::DVec3;

use super::{AnalysisError, Filters, NormalSource, Observe, Params, Stage, Surface, is_viewpoint_inside};
use crate::geometry::{
    Cloud, Extent, Unit, statistical_inliers, strays_watched, voxel_edge_for, voxel_grid_watched, without,
};
use crate::parallel::Watch;

/// The points that are left after the filters and have a normal, with the counts that the warnings
/// about them are made of.
#[derive(Debug, Clone)]
pub(super) struct UsedPoints {
    /// The points and their normals.
    pub(super) surface: Arc<Surface>,
    /// The indices of the strays in the cloud, ascending.
    pub(super) strays: Arc<Vec<usize>>,
    /// Points of the cloud, before the filters.
    pub(super) all: usize,
    /// Points after the filters, before those without a normal are left out.
    pub(super) filtered: usize,
    /// The sampling that [`Filters::max_points`] asked for; `None` for a cloud that is small enough.
    pub(super) sample: Option<Sample>,
    /// Used points whose normal faces away from the viewpoint.
    pub(super) facing_away: usize,
}

/// The thinning of a large cloud to the means of equal cubes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// The edge of the cubes, in the file's unit.
    pub(super) edge: f64,
    /// Points before the thinning, after the other filters.
    pub(super) points: usize,
}

/// The parameters that the used points depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UsedPointsKey {
    filters: Filters,
    /// The unit, where the edge of a voxel grid is given in centimeters.
    unit: Option<Unit>,
    /// k of Eq. 2, where normals are estimated; `None` where they are the file's.
    k: Option<NonZeroUsize>,
    viewpoint: DVec3,
}

impl UsedPointsKey {
    pub(super) fn new(params: &Params) -> Self {
        Self {
            filters: params.filters,
            unit: params.filters.voxel_cm.map(|_| params.unit),
            k: (params.normals == NormalSource::Estimate).then_some(params.k),
            viewpoint: params.viewpoint,
        }
    }
}

impl UsedPoints {
    /// Filters `cloud` and finds its normals.
    ///
    /// # Errors
    /// Returns an error if the points are too few, all equal or on a line, if the viewpoint lies among
    /// them, or if the watch cancels the work.
    pub(super) fn new(cloud: &Cloud, params: &Params, observe: &dyn Observe) -> Result<Self, AnalysisError> {
        observe.entered(Stage::Filters);
        let (all, strays) = (cloud.len(), strays_watched(cloud.positions(), observe)?);
        let (filtered, sample) = filter(cloud, &strays, params, observe)?;
        let cloud = filtered.as_ref().unwrap_or(cloud);
        observe.entered(Stage::Normals);
        let viewpoint = params.viewpoint;
        let surface = match params.normals {
            NormalSource::Estimate => Surface::with_estimated_normals(cloud, params.k, viewpoint, observe)?,
            NormalSource::File => Surface::with_file_normals(cloud)?,
        };
        if is_viewpoint_inside(surface.points(), viewpoint) {
            return Err(AnalysisError::ViewpointInsideCloud { viewpoint });
        }
        Ok(Self {
            strays: Arc::new(strays),
            all,
            filtered: cloud.len(),
            sample,
            facing_away: surface.facing_away(viewpoint),
            surface: Arc::new(surface),
        })
    }
}

/// Returns the filtered cloud, or `None` if no filter changed it, and the sampling, if there was one.
fn filter(
    cloud: &Cloud,
    strays: &[usize],
    params: &Params,
    watch: &dyn Watch,
) -> Result<(Option<Cloud>, Option<Sample>), AnalysisError> {
    let Filters {
        keep_strays,
        outliers,
        voxel_cm,
        max_points,
    } = params.filters;
    let mut filtered = None;
    if !(keep_strays || strays.is_empty()) {
        let kept: Vec<usize> = without(strays, cloud.len()).collect();
        filtered = Some(cloud.select(&kept));
    }
    if let Some(outliers) = outliers {
        let cloud = filtered.as_ref().unwrap_or(cloud);
        let inliers = statistical_inliers(cloud.positions(), outliers.neighbors, outliers.std_ratio, watch)?;
        filtered = Some(cloud.select(&inliers));
    }
    if let Some(edge_cm) = voxel_cm {
        let cloud = filtered.as_ref().unwrap_or(cloud);
        filtered = Some(thinned(cloud, edge_cm, params.unit, watch)?);
    }
    let cloud = filtered.as_ref().unwrap_or(cloud);
    let Some(edge) = voxel_edge_for(cloud.positions(), max_points, watch)? else {
        return Ok((filtered, None));
    };
    let points = cloud.len();
    let thinned = voxel_grid_watched(cloud, edge, watch)?;
    Ok((Some(thinned), Some(Sample { edge, points })))
}

/// Thins a cloud by the voxel grid that was asked for.
fn thinned(cloud: &Cloud, edge_cm: f64, unit: Unit, watch: &dyn Watch) -> Result<Cloud, AnalysisError> {
    // From here on, the number of a cube is not exact, and coordinates may be farther apart than cubes.
    const FINEST: f64 = 1.0 / f64::EPSILON;
    let edge = edge_cm / unit.in_cm();
    let farthest = Extent::of(cloud.positions()).map_or(0.0, |e| e.min.abs().max(e.max.abs()).max_element());
    if edge < f64::MIN_POSITIVE || farthest / edge > FINEST {
        return Err(AnalysisError::VoxelsTooFine { edge_cm });
    }
    let thinned = voxel_grid_watched(cloud, edge, watch)?;
    let (left, points) = (thinned.len(), cloud.len());
    if left < Surface::MIN_POINTS && points >= Surface::MIN_POINTS {
        return Err(AnalysisError::VoxelsTooLarge {
            edge_cm,
            left,
            points,
        });
    }
    Ok(thinned)
}
