//! What is kept of one cloud: a row of the results.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Examined, TruthChoice, peduncle_disagreement_deg, reference_of};
use crate::geometry::Unit;
use crate::method::{AxisEstimate, AxisSource};
use crate::reference::axis_error_rad;

/// One cloud's results. What does not exist is `None`; a cloud that failed has a `failure` and little
/// else. Positions are in the file's unit and frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The file's name within the folder.
    pub file: String,
    /// SHA-256 of its bytes.
    pub sha256: Option<String>,
    /// Points in the file.
    pub points: Option<u64>,
    /// Points that took part.
    pub used_points: Option<u64>,
    /// The unit of its coordinates.
    pub unit: Option<Unit>,
    /// The fruit center.
    pub center: Option<[f64; 3]>,
    /// The symmetry plane's place in the grid: g, h.
    pub best: Option<[u64; 2]>,
    /// Its score in centimeters.
    pub score_cm: Option<f64>,
    /// The runner-up's score in centimeters.
    pub runner_up_score_cm: Option<f64>,
    /// How much higher that is, as a share of the best.
    pub lead: Option<f64>,
    /// The share of points with a partner under the symmetry plane.
    pub partner_fraction: Option<f64>,
    /// The symmetry axis.
    pub axis: Option<[f64; 3]>,
    /// Where the reference comes from that `error_deg` is measured against.
    pub truth: Option<String>,
    /// Its direction.
    pub truth_axis: Option<[f64; 3]>,
    /// The angle between axis and reference, 0 to 90 degrees.
    pub error_deg: Option<f64>,
    /// The same against the peduncle's axis, whatever the reference.
    pub peduncle_error_deg: Option<f64>,
    /// The same against the peduncle's own direction, whatever the reference.
    #[serde(default)]
    pub peduncle_direction_error_deg: Option<f64>,
    /// How far the peduncle's two references are apart, 0 to 90 degrees.
    #[serde(default)]
    pub peduncle_disagreement_deg: Option<f64>,
    /// The same against the simulator's axis, whatever the reference.
    pub true_axis_error_deg: Option<f64>,
    /// Warnings, as sentences in a row.
    pub warnings: String,
    /// Why there is no error: what could not be read, analyzed, or compared.
    pub failure: Option<String>,
}

impl Row {
    /// The row of a cloud that could not be read or analyzed.
    pub fn failed(file: &str, failure: String) -> Self {
        Self {
            file: file.into(),
            sha256: None,
            points: None,
            used_points: None,
            unit: None,
            center: None,
            best: None,
            score_cm: None,
            runner_up_score_cm: None,
            lead: None,
            partner_fraction: None,
            axis: None,
            truth: None,
            truth_axis: None,
            error_deg: None,
            peduncle_error_deg: None,
            peduncle_direction_error_deg: None,
            peduncle_disagreement_deg: None,
            true_axis_error_deg: None,
            warnings: String::new(),
            failure: Some(failure),
        }
    }

    /// The row of a cloud that was examined.
    pub fn of(file: &str, examined: &Examined, choice: TruthChoice) -> Self {
        let analysis = &examined.analysis;
        let used = analysis.surface.len();
        let axis = analysis.axis.as_ref();
        let truth = reference_of(&examined.references, choice);
        let error_to = |reference: &AxisEstimate| axis.map(|a| axis_error_rad(a, reference).to_degrees());
        let error_to_source = |source: AxisSource| {
            let reference = examined.references.iter().find(|r| r.source == source);
            reference.and_then(error_to)
        };
        let best = analysis.best.ok();
        let partners = best.and_then(|b| {
            let index = analysis.planes.grid.index_of(b.candidate.g, b.candidate.h)?;
            Some(analysis.planes.terms[index].partners)
        });
        let failure = match (axis, truth) {
            (None, _) => Some("there is no symmetry axis".into()),
            (_, None) => Some("there is no reference axis".into()),
            _ => None,
        };
        Self {
            file: file.into(),
            sha256: Some(examined.fruit.file.sha256.clone()),
            points: Some(examined.fruit.cloud().len() as u64),
            used_points: Some(used as u64),
            unit: Some(examined.fruit.unit),
            center: Some(analysis.center.to_array()),
            best: best.map(|b| [b.candidate.g as u64, b.candidate.h as u64]),
            score_cm: best.map(|b| b.score_cm),
            runner_up_score_cm: best.and_then(|b| b.runner_up).map(|(_, score)| score),
            lead: best.and_then(|b| b.lead()),
            partner_fraction: partners.map(|p| p as f64 / used as f64),
            axis: axis.map(|a| a.direction.to_array()),
            truth: truth.map(|t| t.source.name().into_owned()),
            truth_axis: truth.map(|t| t.direction.to_array()),
            error_deg: truth.and_then(error_to),
            peduncle_error_deg: error_to_source(AxisSource::Peduncle),
            peduncle_direction_error_deg: error_to_source(AxisSource::PeduncleDirection),
            peduncle_disagreement_deg: peduncle_disagreement_deg(&examined.references),
            true_axis_error_deg: error_to_source(AxisSource::Simulation),
            warnings: examined.warnings.join(" "),
            failure,
        }
    }

    /// The file's name within `folder`, with forward slashes everywhere.
    pub fn name_in(folder: &Path, path: &Path) -> String {
        let name = path.strip_prefix(folder).unwrap_or(path);
        let parts: Vec<_> = name.iter().map(|part| part.to_string_lossy()).collect();
        parts.join("/")
    }
}
