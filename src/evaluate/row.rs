//! The row of one cloud in the results.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::ErrorBreakdown;
use crate::geometry::Unit;

/// The results of one cloud against one reference axis. Values that do not exist are `None`; a cloud that failed has
/// a `failure` and little else. Positions are in the file's unit and frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The file's name within the folder.
    pub file: String,
    /// SHA-256 of the file.
    pub sha256: Option<String>,
    /// Points in the file.
    pub points: Option<u64>,
    /// Points in the analysis.
    pub used_points: Option<u64>,
    /// The unit of the coordinates.
    pub unit: Option<Unit>,
    /// The fruit center.
    pub center: Option<[f64; 3]>,
    /// The steps g and h of the symmetry plane in the grid.
    pub best: Option<[u64; 2]>,
    /// The score of the symmetry plane in centimeters.
    pub score_cm: Option<f64>,
    /// The score of the runner-up in centimeters.
    pub runner_up_score_cm: Option<f64>,
    /// The difference of the two scores as a share of the best.
    pub lead: Option<f64>,
    /// The share of points with a partner under the symmetry plane.
    pub partner_fraction: Option<f64>,
    /// The direction of the symmetry axis, of unit length.
    pub axis: Option<[f64; 3]>,
    /// The origin of the reference axis of `error_deg`.
    pub truth: Option<String>,
    /// The direction of that reference axis.
    pub truth_axis: Option<[f64; 3]>,
    /// The angle between symmetry axis and reference axis, 0 to 90 degrees.
    pub error_deg: Option<f64>,
    /// The angle to the peduncle's axis (§ 3.2), 0 to 90 degrees.
    pub peduncle_error_deg: Option<f64>,
    /// The angle to the peduncle's own direction, 0 to 90 degrees.
    #[serde(default)]
    pub peduncle_direction_error_deg: Option<f64>,
    /// The angle between the two reference axes of the peduncle, 0 to 90 degrees.
    #[serde(default)]
    pub peduncle_disagreement_deg: Option<f64>,
    /// The angle to the simulator's axis, 0 to 90 degrees.
    pub true_axis_error_deg: Option<f64>,
    /// The angle to the axis set by hand, 0 to 90 degrees.
    #[serde(default)]
    pub manual_error_deg: Option<f64>,
    /// The parts of `error_deg`.
    #[serde(default)]
    pub error_parts: Option<ErrorBreakdown>,
    /// The share of the fruit's surface that the camera saw, 0 to 1, from the simulator's truth.
    #[serde(default)]
    pub coverage: Option<f64>,
    /// The names of the annotators who set an axis of this cloud, separated by commas.
    #[serde(default)]
    pub annotators: String,
    /// The warnings, one sentence after another.
    pub warnings: String,
    /// The reason why there is no error, as a clause.
    pub failure: Option<String>,
    /// The tags of the cloud, separated by commas. They are not results, and are kept in a file of their own.
    #[serde(skip)]
    pub tags: String,
    /// The user's note on the cloud.
    #[serde(skip)]
    pub note: String,
}

impl Row {
    /// Creates the row of a cloud that could not be read or analyzed.
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
            error_parts: None,
            coverage: None,
            annotators: String::new(),
            warnings: String::new(),
            failure: Some(failure),
            tags: String::new(),
            note: String::new(),
        }
    }

    /// Returns the path of a file relative to `folder`, with forward slashes.
    pub fn name_in(folder: &Path, path: &Path) -> String {
        let name = path.strip_prefix(folder).unwrap_or(path);
        let parts: Vec<_> = name.iter().map(|part| part.to_string_lossy()).collect();
        parts.join("/")
    }
}
