//! Scores of planes and their ranking (§ 2.5), from n, ΣD and ΣΞ alone.

use serde::{Deserialize, Serialize};

use super::{PlaneTerm, PlaneTerms};

/// The way that a plane's score is made of its points' scores S.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Aggregation {
    /// The mean over the points with a partner.
    Mean,
    /// The sum over them, as printed. A plane that leaves hardly a point with a partner wins.
    Sum,
}

impl Aggregation {
    /// The least partner fraction that goes with this reading: 30 % for the mean; none for the sum,
    /// which the paper takes over every plane.
    pub fn default_min_partner_fraction(self) -> f64 {
        match self {
            Self::Mean => 0.3,
            Self::Sum => 0.0,
        }
    }

    /// Computes the score of one plane in centimeters; the lowest wins. Without a partner the mean does
    /// not exist (`None`), and the sum is zero.
    pub fn score_cm(self, term: &PlaneTerm, tau_cm_per_rad: f64) -> Option<f64> {
        let sum = term.distance_sum_cm + tau_cm_per_rad * term.angle_sum_rad;
        match self {
            Self::Sum => Some(sum),
            Self::Mean => (term.partners > 0).then(|| sum / term.partners as f64),
        }
    }
}

/// The error of a ranking in which no plane can be the symmetry plane.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "no candidate plane has a partner for {:.0} % of the points; the most that one has is {:.1} %",
    100.0 * min_partner_fraction,
    100.0 * largest_partner_fraction
)]
pub struct NoSymmetryPlane {
    /// The fraction that was asked for.
    pub min_partner_fraction: f64,
    /// The largest that any plane reaches.
    pub largest_partner_fraction: f64,
}

/// The score of every plane, and the planes in the order of their scores.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    scores_cm: Vec<Option<f64>>,
    order: Vec<usize>,
    no_plane: NoSymmetryPlane,
}

impl Ranking {
    /// Scores all planes and sorts them. Planes with a partner for less than `min_partner_fraction` of the
    /// points have no score. Takes O(u² log u), whatever the number of points.
    pub fn new(
        planes: &PlaneTerms,
        tau_cm_per_rad: f64,
        aggregation: Aggregation,
        min_partner_fraction: f64,
    ) -> Self {
        let least = min_partner_fraction * planes.points as f64;
        let score = |term: &PlaneTerm| {
            let enough = term.partners as f64 >= least;
            enough
                .then(|| aggregation.score_cm(term, tau_cm_per_rad))
                .flatten()
                .filter(|score| score.is_finite())
        };
        let scores_cm: Vec<Option<f64>> = planes.terms.iter().map(score).collect();
        let mut scored: Vec<(f64, usize)> = scores_cm
            .iter()
            .enumerate()
            .filter_map(|(i, s)| s.map(|s| (s, i)))
            .collect();
        // Equal scores keep the grid's order, in which the paper's loop over g and h would find them.
        scored.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let most = planes.terms.iter().map(|t| t.partners).max().unwrap_or(0);
        Self {
            scores_cm,
            order: scored.into_iter().map(|(_, i)| i).collect(),
            no_plane: NoSymmetryPlane {
                min_partner_fraction,
                largest_partner_fraction: most as f64 / planes.points.max(1) as f64,
            },
        }
    }

    /// Each plane's score in centimeters, in the grid's order; `None` below the partner fraction.
    pub fn scores_cm(&self) -> &[Option<f64>] {
        &self.scores_cm
    }

    /// The indices of the planes that have a score, best first.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// The index of the plane with the lowest score: the symmetry plane.
    ///
    /// # Errors
    /// Returns an error if no plane reaches the partner fraction.
    pub fn best(&self) -> Result<usize, NoSymmetryPlane> {
        self.order.first().copied().ok_or(self.no_plane)
    }

    /// The index of the plane with the second lowest score, if there is one.
    pub fn runner_up(&self) -> Option<usize> {
        self.order.get(1).copied()
    }
}
