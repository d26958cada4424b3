//! The estimates of one cloud by several estimators, and their part of a row.

use serde::{Deserialize, Serialize};

use super::Examination;
use crate::estimate::{Estimate, EstimateError, EstimateSettings, Estimator, Occlusion, Surface, estimate};
use crate::fruit::Fruit;
use crate::geometry::statistical_inliers;
use crate::method::Params;
use crate::parallel::{Cancelled, Watch};

/// Prepares the surface of an examined fruit for estimators: its points without the peduncle, as far as that is known,
/// and without the outliers that the analysis leaves out.
///
/// # Errors
/// Returns an error if the points are no surface of a fruit, or the watch cancels the work.
pub fn surface_of(examined: &Examination, watch: &dyn Watch) -> Result<Surface, EstimateError> {
    surface_of_fruit(&examined.fruit, &examined.analysis.params, watch)
}

/// Prepares the surface of a fruit for estimators, as [`surface_of`] does, for parameters in the file's unit.
///
/// # Errors
/// Returns an error if the points are no surface of a fruit, or the watch cancels the work.
pub fn surface_of_fruit(fruit: &Fruit, params: &Params, watch: &dyn Watch) -> Result<Surface, EstimateError> {
    let mut body = fruit.body();
    if let Some(outliers) = params.filters.outliers {
        let inliers = statistical_inliers(body.positions(), outliers.neighbors, outliers.std_ratio, watch)?;
        body = body.select(&inliers);
    }
    Surface::new(body.positions(), params.unit, params.viewpoint, watch)
}

/// Runs the estimators of `settings` on an examined cloud.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work. Whatever else goes wrong is in the estimate.
pub fn estimates_of(
    examined: &Examination,
    settings: &EstimateSettings,
    watch: &dyn Watch,
) -> Result<Vec<Estimate>, Cancelled> {
    let needs_surface = settings.estimators.iter().any(|&e| e != Estimator::Paper);
    let surface = if needs_surface {
        surface_of(examined, watch)
    } else {
        Err(EstimateError::NoFit)
    };
    let run =
        |&estimator: &Estimator| estimate(estimator, &examined.analysis, &surface, settings.prior, watch);
    settings.estimators.iter().map(run).collect()
}

/// The estimate of one estimator in a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateInRow {
    /// The estimator.
    pub estimator: Estimator,
    /// The unit direction of the axis.
    pub axis: Option<[f64; 3]>,
    /// The angle to the reference axis of the row, 0 to 90 degrees.
    pub error_deg: Option<f64>,
    /// The probability that the axis is within 15° of the true one, 0 to 1.
    pub confidence: Option<f64>,
    /// Whether the axis should not be relied on.
    pub ambiguous: bool,
    /// The share of the fruit's cross-section that is seen, 0 to 1.
    pub seen_share: Option<f64>,
    /// Its class.
    pub occlusion: Option<Occlusion>,
}

impl EstimateInRow {
    /// Creates the estimate's part of a row, without an error.
    pub(super) fn of(estimate: &Estimate) -> Self {
        Self {
            estimator: estimate.estimator,
            axis: estimate.axis.as_ref().map(|axis| axis.direction.to_array()),
            error_deg: None,
            confidence: estimate.confidence,
            ambiguous: estimate.ambiguous,
            seen_share: estimate.seen_share,
            occlusion: estimate.occlusion,
        }
    }

    /// Returns the order in which a robot would pick, 1 first: free fruits with a sure axis, then lightly hidden ones,
    /// then those with a doubtful axis or none, and seriously hidden ones last.
    pub fn priority(&self) -> u64 {
        match self.occlusion {
            Some(Occlusion::Serious) => 4,
            _ if self.ambiguous || self.axis.is_none() => 3,
            Some(Occlusion::Light) => 2,
            Some(Occlusion::None) | None => 1,
        }
    }
}
