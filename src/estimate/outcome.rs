//! The result of one estimator, and why there may be none.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Estimator, Surface};
use crate::geometry::angle_between_lines_rad;
use crate::method::{AxisEstimate, AxisSource};
use crate::parallel::Cancelled;

/// The standard deviation of the seen share, of 1, over simulated fruits with a leaf.
pub const SEEN_SHARE_SD: f64 = 0.04;

/// Why an estimator gives no estimate at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EstimateError {
    /// The fruit has too few points.
    #[error("{points} points with a normal are too few to fit a body to: at least {least} are needed")]
    TooFewPoints {
        /// The points of the fruit that have a normal.
        points: usize,
        /// The fewest that are enough.
        least: usize,
    },
    /// The points lie on a line, or all at one place.
    #[error("the points lie on a line, which is no surface")]
    Line,
    /// The points lie in a plane.
    #[error("the points lie in a plane, which no body of a fruit fits")]
    Flat,
    /// No start of the search led to a body that fits.
    #[error("no body fits the points")]
    NoFit,
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The occlusion of a fruit: whether something hides a part of what its camera would see.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Occlusion {
    /// Hardly anything is hidden.
    None,
    /// A part is hidden, but less than half of the cross-section.
    Light,
    /// Half of the cross-section or more is hidden (§ 3.3).
    Serious,
}

impl Occlusion {
    /// Returns the name that reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Light => "light",
            Self::Serious => "serious",
        }
    }
}

/// An axis that an estimator considered, the best one left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alternative {
    /// Its unit direction, in the file's frame.
    pub direction: DVec3,
    /// Its cost, in the estimator's own unit; the best axis has the lowest.
    pub cost: f64,
}

/// The estimate of a fruit's axis by one estimator. Positions are in the file's unit and frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The estimator.
    pub estimator: Estimator,
    /// The axis; `None` if there is none, and then a warning says why.
    pub axis: Option<AxisEstimate>,
    /// The center of the fruit; `None` if none was found.
    pub center: Option<DVec3>,
    /// The probability that the axis is within 15° of the true one, 0 to 1; `None` if the estimator states none.
    pub confidence: Option<f64>,
    /// Whether the axis should not be relied on: another one explains the points about as well, or too little fits.
    pub ambiguous: bool,
    /// The cost by which the best axis leads over the best one more than 20° away, in the unit of the costs; `None` if
    /// there is no other, or the estimator has no costs.
    pub lead: Option<f64>,
    /// The other axes, the best first.
    pub alternatives: Vec<Alternative>,
    /// The share of the fruit's cross-section in the image that is seen, 0 to 1, to within about [`SEEN_SHARE_SD`]; `None` if
    /// it is not known.
    pub seen_share: Option<f64>,
    /// The class of `seen_share`; `None` if it is not known.
    pub occlusion: Option<Occlusion>,
    /// The warnings, as sentences.
    pub warnings: Vec<String>,
}

impl Estimate {
    /// Creates the estimate of a fitted body or plane: the axis through `center_cm` (as in [`Surface`]) along the best
    /// direction, without a confidence. `others` are the other axes, the best first.
    pub fn fitted(
        estimator: Estimator,
        surface: &Surface,
        center_cm: DVec3,
        best: &Alternative,
        others: Vec<Alternative>,
    ) -> Self {
        let center = surface.in_file(center_cm);
        Self {
            axis: Some(AxisEstimate {
                source: AxisSource::Fitted(estimator.name()),
                origin: center,
                direction: best.direction,
                confidence: None,
            }),
            center: Some(center),
            ambiguous: false,
            lead: lead_over(best, &others),
            alternatives: others,
            warnings: Vec::new(),
            ..Self::without_axis(estimator, String::new())
        }
    }

    /// Creates an estimate without an axis, for which `warning` gives the reason.
    pub fn without_axis(estimator: Estimator, warning: String) -> Self {
        Self {
            estimator,
            axis: None,
            center: None,
            confidence: None,
            ambiguous: true,
            lead: None,
            alternatives: Vec::new(),
            seen_share: None,
            occlusion: None,
            warnings: vec![warning],
        }
    }
}

/// The angle in degrees beyond which another axis is a rival rather than the same axis, found twice.
const RIVAL_DEG: f64 = 20.0;

/// Returns the cost by which `best` leads over the best of `others` (the best first) that lies more than 20° away; `None`
/// if there is none.
pub(super) fn lead_over(best: &Alternative, others: &[Alternative]) -> Option<f64> {
    let apart = |other: &&Alternative| {
        angle_between_lines_rad(other.direction, best.direction).to_degrees() > RIVAL_DEG
    };
    others.iter().find(apart).map(|rival| rival.cost - best.cost)
}
