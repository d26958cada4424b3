//! All stages in their order, from a cloud to an axis.

use std::sync::Arc;

use glam::DVec3;

use super::{
    AxisError, AxisEstimate, AxisSource, Candidate, CandidateGrid, CenterError, NoSymmetryPlane,
    NormalSource, ParamError, Params, PlaneTerms, Ranking, Surface, SurfaceError, find_center,
    is_viewpoint_inside, plane_terms, symmetry_axis,
};
use crate::geometry::{Cloud, statistical_inliers, voxel_edge_for, voxel_grid};
use crate::parallel::{Cancelled, Watch};

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

/// A [`Watch`] that is also told which stage begins. Clocks are the watcher's: the method has none.
pub trait Observe: Watch {
    /// `stage` begins, and the one before it has ended.
    fn entered(&self, _stage: Stage) {}
}

impl Observe for () {}

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
    /// One camera cannot have seen this from there.
    #[error(
        "the viewpoint ({:.4}, {:.4}, {:.4}) lies inside the cloud, so no camera there can have seen it; state where it was",
        viewpoint.x, viewpoint.y, viewpoint.z
    )]
    ViewpointInsideCloud {
        /// p_v, in the file's unit and frame.
        viewpoint: DVec3,
    },
    /// The work was called off.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl AnalysisError {
    /// Whether the work was called off, at whatever stage.
    pub fn is_cancelled(&self) -> bool {
        matches!(
            self,
            Self::Cancelled(_)
                | Self::Surface(SurfaceError::Cancelled(_))
                | Self::Center(CenterError::Cancelled(_))
        )
    }
}

/// Something that makes the result less certain, without being an error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Warning {
    /// A sample stands for the cloud.
    #[error(
        "{sampled} of {points} points are analyzed, the means of cubes of {edge_cm:.4} cm: more than the {most} that are allowed would take long"
    )]
    Sampled {
        /// How many were analyzed, before those without a normal are left out.
        sampled: usize,
        /// Of how many, after the other filters.
        points: usize,
        /// The most that were allowed.
        most: usize,
        /// The cubes' edge in centimeters.
        edge_cm: f64,
    },
    /// Points without a normal were left out.
    #[error("{left_out} of {points} points have no normal and are left out")]
    PointsWithoutNormal {
        /// How many.
        left_out: usize,
        /// Of how many, after filters.
        points: usize,
    },
    /// k exceeds the number of points.
    #[error("k is {k}, but there are only {points} points: every normal is the whole cloud's")]
    FewerPointsThanNeighbors {
        /// k of Eq. 2.
        k: usize,
        /// How many points there are.
        points: usize,
    },
    /// Many normals face away from the viewpoint.
    #[error(
        "{:.0} % of the normals face away from the viewpoint, as in a cloud fused from several views; the test for visible partners (Eq. 14) takes them at their word",
        100.0 * share
    )]
    NormalsFaceAway {
        /// The share of them, 0 to 1.
        share: f64,
    },
    /// There is no symmetry plane.
    #[error("{0}")]
    NoSymmetryPlane(#[from] NoSymmetryPlane),
    /// There is no axis.
    #[error("{0}")]
    NoAxis(#[from] AxisError),
    /// The best plane's score is an empty sum.
    #[error(
        "the best plane wins with {partners} of {points} points: a sum over hardly any points is small, which is how Eq. 15 as printed goes wrong; compare the as-intended preset"
    )]
    HardlyAnyPartner {
        /// Points with a partner under the best plane.
        partners: usize,
        /// Used points.
        points: usize,
    },
    /// The runner-up is nearly as good.
    #[error(
        "the symmetry plane is ambiguous: the runner-up (g {}, h {}) scores only {:.1} % more and lies {:.0}° away",
        runner_up.g, runner_up.h, 100.0 * lead, angle_deg
    )]
    Ambiguous {
        /// The second best plane.
        runner_up: Candidate,
        /// How much higher its score is, as a share of the best.
        lead: f64,
        /// The angle between the two planes in degrees.
        angle_deg: f64,
    },
}

/// The symmetry plane that won.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BestPlane {
    /// Its place in the grid and its normal.
    pub candidate: Candidate,
    /// Its score in centimeters.
    pub score_cm: f64,
    /// The second best plane and its score, if another has one.
    pub runner_up: Option<(Candidate, f64)>,
}

impl BestPlane {
    /// By how much the runner-up's score exceeds the best, as a share of the best. `None` without a
    /// runner-up, or where the best is zero.
    pub fn lead(&self) -> Option<f64> {
        let (_, runner_up) = self.runner_up?;
        (self.score_cm > 0.0).then(|| runner_up / self.score_cm - 1.0)
    }
}

/// Everything that one analysis found.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// The parameters in force.
    pub params: Params,
    /// The used points and their normals.
    pub surface: Arc<Surface>,
    /// Where these are a sample (see [`super::Filters::max_points`]), the edge of its cubes, in the
    /// file's unit.
    pub sample_edge: Option<f64>,
    /// The fruit center p_c, in the file's unit and frame.
    pub center: DVec3,
    /// n, ΣD and ΣΞ of every candidate plane.
    pub planes: Arc<PlaneTerms>,
    /// Their scores.
    pub ranking: Ranking,
    /// The symmetry plane.
    pub best: Result<BestPlane, NoSymmetryPlane>,
    /// The symmetry axis; `None` where there is no plane, or Eq. 16 is undefined for it (the
    /// warnings say which).
    pub axis: Option<AxisEstimate>,
    /// What makes the result less certain.
    pub warnings: Vec<Warning>,
}

/// Leads below this share of the best score are called ambiguous: a convention of ours, since the
/// paper has none.
const AMBIGUOUS_LEAD: f64 = 0.02;

/// The used points, and what makes them less certain.
#[derive(Debug, Clone)]
pub struct UsedPoints {
    /// The points and their normals.
    pub surface: Arc<Surface>,
    /// Where these are a sample (see [`super::Filters::max_points`]), the edge of its cubes, in the
    /// file's unit.
    pub sample_edge: Option<f64>,
    /// What ought to be known about them.
    pub warnings: Vec<Warning>,
}

/// Walks a cloud through every stage.
///
/// # Errors
/// Where a parameter is out of range, the points are too few, equal or on a line, no center is
/// found, the viewpoint lies inside the cloud, or the work is called off.
pub fn analyze(cloud: &Cloud, params: &Params, observe: &dyn Observe) -> Result<Analysis, AnalysisError> {
    params.check()?;
    let grid = CandidateGrid::new(params.u)?;
    let used = used_points(cloud, params, observe)?;
    observe.entered(Stage::Center);
    let center = find_center(used.surface.points(), &params.center, observe)?;
    observe.entered(Stage::PlaneTerms);
    let planes = plane_terms(
        &used.surface,
        params.unit,
        center,
        params.viewpoint,
        grid,
        observe,
    )?;
    observe.entered(Stage::Scores);
    Ok(Analysis::of_stages(params, &used, center, Arc::new(planes)))
}

/// The first two stages: filters and normals (Eq. 2). What comes out depends on the filters, the
/// source of the normals, k and the viewpoint alone (and on the unit, where there is a voxel grid).
///
/// # Errors
/// Where the points are too few, equal or on a line, the viewpoint lies among them, or the work is
/// called off.
pub fn used_points(
    cloud: &Cloud,
    params: &Params,
    observe: &dyn Observe,
) -> Result<UsedPoints, AnalysisError> {
    observe.entered(Stage::Filters);
    let mut warnings = Vec::new();
    let (filtered, sample_edge) = filter(cloud, params, observe, &mut warnings)?;
    let cloud = filtered.as_ref().unwrap_or(cloud);
    observe.entered(Stage::Normals);
    let surface = match params.normals {
        NormalSource::Estimate => {
            Surface::with_estimated_normals(cloud, params.k, params.viewpoint, observe)?
        }
        NormalSource::File => Surface::with_file_normals(cloud)?,
    };
    if is_viewpoint_inside(surface.points(), params.viewpoint) {
        let viewpoint = params.viewpoint;
        return Err(AnalysisError::ViewpointInsideCloud { viewpoint });
    }
    warnings.extend(surface_warnings(cloud, &surface, params));
    Ok(UsedPoints {
        surface: Arc::new(surface),
        sample_edge,
        warnings,
    })
}

impl Analysis {
    /// The last stage: scores, plane and axis (§ 2.5, Eq. 16) from what the stages before found with
    /// `params`. Takes O(u² log u), whatever the number of points.
    pub fn of_stages(params: &Params, used: &UsedPoints, center: DVec3, planes: Arc<PlaneTerms>) -> Self {
        let ranking = Ranking::new(
            &planes,
            params.tau_cm_per_rad,
            params.aggregation,
            params.min_partner_fraction,
        );
        let best = best_plane(planes.grid, &ranking);
        let mut warnings = used.warnings.clone();
        warnings.extend(plane_warnings(&planes, &best));
        let axis = best.as_ref().ok().and_then(|best| {
            match symmetry_axis(best.candidate.normal, center, params.viewpoint) {
                Ok(direction) => Some(AxisEstimate {
                    source: AxisSource::SymmetryPlane,
                    origin: center,
                    direction,
                    confidence: None,
                }),
                Err(undefined) => {
                    warnings.push(undefined.into());
                    None
                }
            }
        });
        Self {
            params: params.clone(),
            surface: used.surface.clone(),
            sample_edge: used.sample_edge,
            center,
            planes,
            ranking,
            best,
            axis,
            warnings,
        }
    }
}

/// What is left of the cloud, if anything was taken out of it, and the edge of the sample's cubes, if
/// there is one.
fn filter(
    cloud: &Cloud,
    params: &Params,
    watch: &dyn Watch,
    warnings: &mut Vec<Warning>,
) -> Result<(Option<Cloud>, Option<f64>), Cancelled> {
    let mut filtered = None;
    if let Some(outliers) = params.filters.outliers {
        let inliers = statistical_inliers(cloud.positions(), outliers.neighbors, outliers.std_ratio, watch)?;
        filtered = Some(cloud.select(&inliers));
    }
    if let Some(edge_cm) = params.filters.voxel_cm {
        let cloud = filtered.as_ref().unwrap_or(cloud);
        filtered = Some(voxel_grid(cloud, edge_cm / params.unit.in_cm()));
    }
    let cloud = filtered.as_ref().unwrap_or(cloud);
    let most = params.filters.max_points;
    let edge = voxel_edge_for(cloud.positions(), most, watch)?;
    if let Some(edge) = edge {
        let sample = voxel_grid(cloud, edge);
        warnings.push(Warning::Sampled {
            sampled: sample.len(),
            points: cloud.len(),
            most,
            edge_cm: edge * params.unit.in_cm(),
        });
        filtered = Some(sample);
    }
    Ok((filtered, edge))
}

fn best_plane(grid: CandidateGrid, ranking: &Ranking) -> Result<BestPlane, NoSymmetryPlane> {
    let scored = |index: usize| Some((grid.candidate(index), ranking.scores_cm()[index]?));
    let best = ranking.best()?;
    Ok(BestPlane {
        candidate: grid.candidate(best),
        // A ranked plane has a score.
        score_cm: ranking.scores_cm()[best].unwrap_or_default(),
        runner_up: ranking.runner_up().and_then(scored),
    })
}

fn surface_warnings(cloud: &Cloud, surface: &Surface, params: &Params) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let (points, k) = (cloud.len(), params.k.get());
    if surface.len() < points {
        let left_out = points - surface.len();
        warnings.push(Warning::PointsWithoutNormal { left_out, points });
    }
    if params.normals == NormalSource::Estimate && k > points {
        warnings.push(Warning::FewerPointsThanNeighbors { k, points });
    }
    let share = surface.facing_away(params.viewpoint) as f64 / surface.len() as f64;
    if share > 0.05 {
        warnings.push(Warning::NormalsFaceAway { share });
    }
    warnings
}

fn plane_warnings(planes: &PlaneTerms, best: &Result<BestPlane, NoSymmetryPlane>) -> Vec<Warning> {
    let best = match best {
        Ok(best) => best,
        Err(none) => return vec![(*none).into()],
    };
    let mut warnings = Vec::new();
    let index = planes.grid.index_of(best.candidate.g, best.candidate.h);
    let partners = index.map_or(0, |i| planes.terms[i].partners);
    if (partners as f64) < 0.1 * planes.points as f64 {
        let points = planes.points;
        warnings.push(Warning::HardlyAnyPartner { partners, points });
    }
    if let (Some(lead), Some((runner_up, _))) = (best.lead(), best.runner_up)
        && lead < AMBIGUOUS_LEAD
    {
        let angle_rad = crate::geometry::angle_between_lines_rad(best.candidate.normal, runner_up.normal);
        warnings.push(Warning::Ambiguous {
            runner_up,
            lead,
            angle_deg: angle_rad.to_degrees(),
        });
    }
    warnings
}
