//! The report of one analysis as JSON: `axiscope.analysis/1`, which other programs rely on.

use std::path::Path;

use serde::Serialize;

use super::point_report::PointReport;
use super::{ErrorBreakdown, Examination, PointRow, TruthChoice, peduncle_disagreement_deg, reference_of};
use crate::estimate::{Alternative, Estimate, Occlusion};
use crate::fruit::Request;
use crate::geometry::Unit;
use crate::method::{
    Aggregation, AxisEstimate, Candidate, CenterMethod, NormalSource, Params, axis_error_rad,
};

/// The schema's name and version.
pub const SCHEMA: &str = "axiscope.analysis/1";

/// One analysis, as `analyze --format json` prints it.
#[derive(Debug, Clone, Serialize)]
pub struct AnalysisReport {
    schema: &'static str,
    cloud: CloudReport,
    params: ParamsReport,
    center: [f64; 3],
    planes: Vec<PlaneReport>,
    best: Option<BestReport>,
    axis: Option<AxisReport>,
    reference: Option<ReferenceReport>,
    references: Vec<ReferenceReport>,
    peduncle_disagreement_deg: Option<f64>,
    error_parts: Option<ErrorBreakdown>,
    warnings: Vec<String>,
    timings_ms: Timings,
    prior: String,
    estimates: Vec<EstimateReport>,
    point: Option<PointReport>,
}

/// The durations of the stages in milliseconds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Timings {
    /// Reading of the files, up to the cloud in memory.
    pub read: f64,
    /// Estimation of normals, or their copy from the file.
    pub normals: f64,
    /// Search for the fruit center.
    pub center: f64,
    /// Computation of n, ΣD and ΣΞ of all planes, including the search tree.
    pub plane_terms: f64,
    /// Time from the start of reading to the finished report.
    pub total: f64,
}

#[derive(Debug, Clone, Serialize)]
struct CloudReport {
    file: String,
    sha256: String,
    points: usize,
    used_points: usize,
    unit: Unit,
}

#[derive(Debug, Clone, Serialize)]
struct ParamsReport {
    preset: &'static str,
    u: usize,
    tau: f64,
    unit: Unit,
    normals: &'static str,
    k: usize,
    center: CenterReport,
    center_samples: Option<usize>,
    center_spread: Option<f64>,
    aggregate: Aggregation,
    min_partner_fraction: f64,
    viewpoint: [f64; 3],
    seed: u64,
    peduncle: String,
    without_peduncle: bool,
    keep_strays: bool,
    outlier_neighbors: Option<usize>,
    outlier_std: Option<f64>,
    voxel_cm: Option<f64>,
    max_points: usize,
}

#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
enum CenterReport {
    Method(&'static str),
    Given([f64; 3]),
}

#[derive(Debug, Clone, Serialize)]
struct PlaneReport {
    g: usize,
    h: usize,
    alpha_rad: f64,
    beta_rad: f64,
    normal: [f64; 3],
    partners: usize,
    distance_sum_cm: f64,
    angle_sum_rad: f64,
    score: Option<f64>,
}

#[derive(Debug, Clone, Serialize)]
struct BestReport {
    g: usize,
    h: usize,
    normal: [f64; 3],
    score: f64,
    runner_up_score: Option<f64>,
}

#[derive(Debug, Clone, Serialize)]
struct AxisReport {
    origin: [f64; 3],
    direction: [f64; 3],
}

#[derive(Debug, Clone, Serialize)]
struct ReferenceReport {
    kind: String,
    direction: [f64; 3],
    error_deg: Option<f64>,
}

impl AnalysisReport {
    /// Creates a report. `path` is the cloud's file as the user named it, and `seed` the given seed, whether it is
    /// used or not. The error against the reference `truth` is taken apart.
    pub fn new(
        path: &Path,
        request: &Request,
        seed: u64,
        examined: &Examination,
        truth: TruthChoice,
        timings_ms: Timings,
        estimates: &[TimedEstimate],
    ) -> Self {
        let Examination {
            fruit,
            analysis,
            references,
            warnings,
            ..
        } = examined;
        let reference = reference_of(references, TruthChoice::Peduncle);
        let reported = |reference: &AxisEstimate| ReferenceReport {
            kind: reference.source.name().into_owned(),
            direction: reference.direction.to_array(),
            error_deg: analysis
                .axis
                .as_ref()
                .map(|axis| axis_error_rad(axis, reference).to_degrees()),
        };
        let planes = &analysis.planes;
        let rows = planes
            .grid
            .candidates()
            .zip(&planes.terms)
            .zip(analysis.ranking.scores_cm());
        Self {
            schema: SCHEMA,
            cloud: CloudReport {
                file: path.display().to_string(),
                sha256: fruit.file.sha256.clone(),
                points: fruit.cloud().len(),
                used_points: analysis.surface.len(),
                unit: fruit.unit,
            },
            params: params_report(request, seed, &analysis.params),
            center: analysis.center.to_array(),
            planes: rows
                .map(|((candidate, term), score)| PlaneReport {
                    g: candidate.g,
                    h: candidate.h,
                    alpha_rad: candidate.alpha_rad,
                    beta_rad: candidate.beta_rad,
                    normal: candidate.normal.to_array(),
                    partners: term.partners,
                    distance_sum_cm: term.distance_sum_cm,
                    angle_sum_rad: term.angle_sum_rad,
                    score: *score,
                })
                .collect(),
            best: analysis.best.ok().map(|best| BestReport {
                g: best.candidate.g,
                h: best.candidate.h,
                normal: best.candidate.normal.to_array(),
                score: best.score_cm,
                runner_up_score: best.runner_up.map(|(_, score)| score),
            }),
            axis: analysis.axis.as_ref().map(AxisReport::new),
            reference: reference.map(reported),
            references: references.iter().map(reported).collect(),
            peduncle_disagreement_deg: peduncle_disagreement_deg(references),
            error_parts: reference_of(references, truth).and_then(|r| examined.error_breakdown(r)),
            warnings: warnings.clone(),
            timings_ms,
            prior: request.estimates.prior.to_string(),
            estimates: estimates
                .iter()
                .map(|timed| EstimateReport::new(timed, references))
                .collect(),
            point: None,
        }
    }

    /// Adds the steps of one point under the plane of `candidate`.
    #[must_use]
    pub fn with_point(mut self, candidate: &Candidate, row: &PointRow) -> Self {
        self.point = Some(PointReport::new(candidate, row));
        self
    }
}

/// An estimate, and how long it took.
#[derive(Debug, Clone, PartialEq)]
pub struct TimedEstimate {
    /// The estimate.
    pub estimate: Estimate,
    /// The time that it takes alone, with all that it builds on, in milliseconds.
    pub ms: f64,
}

impl TimedEstimate {
    /// Returns the angle in degrees to the reference that [`TruthChoice::Auto`] chooses; `None` without an axis or a
    /// reference.
    pub fn error_deg(&self, references: &[AxisEstimate]) -> Option<f64> {
        let axis = self.estimate.axis.as_ref()?;
        let reference = reference_of(references, TruthChoice::Auto)?;
        Some(axis_error_rad(axis, reference).to_degrees())
    }
}

#[derive(Debug, Clone, Serialize)]
struct EstimateReport {
    name: &'static str,
    axis: Option<AxisReport>,
    center: Option<[f64; 3]>,
    confidence: Option<f64>,
    ambiguous: bool,
    lead: Option<f64>,
    error_deg: Option<f64>,
    alternatives: Vec<AlternativeReport>,
    seen_share: Option<f64>,
    occlusion: Option<Occlusion>,
    warnings: Vec<String>,
    ms: f64,
}

#[derive(Debug, Clone, Serialize)]
struct AlternativeReport {
    direction: [f64; 3],
    cost: f64,
}

impl EstimateReport {
    fn new(timed: &TimedEstimate, references: &[AxisEstimate]) -> Self {
        let estimate = &timed.estimate;
        let alternative = |a: &Alternative| AlternativeReport {
            direction: a.direction.to_array(),
            cost: a.cost,
        };
        Self {
            name: estimate.estimator.name(),
            axis: estimate.axis.as_ref().map(AxisReport::new),
            center: estimate.center.map(|center| center.to_array()),
            confidence: estimate.confidence,
            ambiguous: estimate.ambiguous,
            lead: estimate.lead,
            error_deg: timed.error_deg(references),
            alternatives: estimate.alternatives.iter().map(alternative).collect(),
            seen_share: estimate.seen_share,
            occlusion: estimate.occlusion,
            warnings: estimate.warnings.clone(),
            ms: timed.ms,
        }
    }
}

impl AxisReport {
    fn new(axis: &AxisEstimate) -> Self {
        Self {
            origin: axis.origin.to_array(),
            direction: axis.direction.to_array(),
        }
    }
}

fn params_report(request: &Request, seed: u64, params: &Params) -> ParamsReport {
    let search = params.center.search();
    ParamsReport {
        preset: params.preset_name(),
        u: params.u,
        tau: params.tau_cm_per_rad,
        unit: params.unit,
        normals: match params.normals {
            NormalSource::Estimate => "estimate",
            NormalSource::File => "file",
        },
        k: params.k.get(),
        center: match params.center {
            CenterMethod::MeanRms(_) => CenterReport::Method("mean-rms"),
            CenterMethod::Equidistant(_) => CenterReport::Method("equidistant"),
            CenterMethod::Sphere => CenterReport::Method("sphere"),
            CenterMethod::Given(center) => CenterReport::Given(center.to_array()),
        },
        center_samples: search.map(|s| s.count),
        center_spread: search.map(|s| s.spread),
        aggregate: params.aggregation,
        min_partner_fraction: params.min_partner_fraction,
        viewpoint: params.viewpoint.to_array(),
        seed,
        peduncle: request.peduncle.to_string(),
        without_peduncle: request.without_peduncle,
        keep_strays: params.filters.keep_strays,
        outlier_neighbors: params.filters.outliers.map(|f| f.neighbors.get()),
        outlier_std: params.filters.outliers.map(|f| f.std_ratio),
        voxel_cm: params.filters.voxel_cm,
        max_points: params.filters.max_points,
    }
}
