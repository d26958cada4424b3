//! What is kept of one cloud: a row of the results.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Examined, Outcome, TruthChoice};
use crate::geometry::Unit;

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
    /// The same against the axis set by hand, whatever the reference.
    #[serde(default)]
    pub manual_error_deg: Option<f64>,
    /// Who has set an axis of this cloud by hand, with commas between the names.
    #[serde(default)]
    pub annotators: String,
    /// Warnings, as sentences in a row.
    pub warnings: String,
    /// Why there is no error: what could not be read, analyzed, or compared.
    pub failure: Option<String>,
    /// What somebody tagged the cloud with, with commas between the tags. Not a result: it is kept in a
    /// file of its own.
    #[serde(skip)]
    pub tags: String,
    /// What somebody noted of the cloud.
    #[serde(skip)]
    pub note: String,
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
            manual_error_deg: None,
            annotators: String::new(),
            warnings: String::new(),
            failure: Some(failure),
            tags: String::new(),
            note: String::new(),
        }
    }

    /// The row of a cloud that was examined.
    pub fn of(file: &str, examined: &Examined, choice: TruthChoice) -> Self {
        Outcome::of(file, examined).against(choice)
    }

    /// The file's name within `folder`, with forward slashes everywhere.
    pub fn name_in(folder: &Path, path: &Path) -> String {
        let name = path.strip_prefix(folder).unwrap_or(path);
        let parts: Vec<_> = name.iter().map(|part| part.to_string_lossy()).collect();
        parts.join("/")
    }
}
