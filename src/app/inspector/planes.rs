//! The candidate planes of an analysis with their ranks, axes and errors, as the panels show them.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use super::super::PlaneChoice;
use crate::geometry::angle_between_lines_rad;
use crate::method::{Analysis, AxisEstimate};
use crate::render::Color;
use crate::view::value_color;

/// One candidate plane with its rank, its axis and the axis's error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneFacts {
    /// The step of α, from 1.
    pub g: usize,
    /// The step of β, from 1.
    pub h: usize,
    /// The plane's unit normal, in the file's frame.
    pub normal: DVec3,
    /// The score in centimeters; `None` below the partner fraction.
    pub score_cm: Option<f64>,
    /// The place in the ranking, from 1; `None` without a score.
    pub rank: Option<usize>,
    /// The number of points with a visible symmetric partner.
    pub partners: usize,
    /// ΣD in centimeters.
    pub distance_sum_cm: f64,
    /// ΣΞ in radians.
    pub angle_sum_rad: f64,
    /// The unit direction of the plane's axis; `None` where Eq. 16 gives none.
    pub axis: Option<DVec3>,
    /// The axis's angle to the reference in degrees; `None` without either.
    pub error_deg: Option<f64>,
}

impl PlaneFacts {
    /// Returns the mean of d over the points with a partner, in centimeters.
    pub fn mean_distance_cm(&self) -> Option<f64> {
        (self.partners > 0).then(|| self.distance_sum_cm / self.partners as f64)
    }

    /// Returns the mean of ξ over the points with a partner, in degrees.
    pub fn mean_angle_deg(&self) -> Option<f64> {
        (self.partners > 0).then(|| (self.angle_sum_rad / self.partners as f64).to_degrees())
    }

    /// Returns the choice of this plane.
    pub fn choice(&self) -> PlaneChoice {
        PlaneChoice::At { g: self.g, h: self.h }
    }
}

/// Every candidate plane of one analysis, in the grid's order.
#[derive(Debug, Clone)]
pub struct Planes {
    /// The analysis.
    pub analysis: Arc<Analysis>,
    /// The facts of each plane.
    pub facts: Vec<PlaneFacts>,
    /// The range of the colors; `None` if no plane has a score.
    pub scale: Option<ScoreScale>,
    /// The reference of the errors, in words.
    pub against: Option<Cow<'static, str>>,
}

/// The range of scores that the colors span, in centimeters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScoreScale {
    /// The lowest score: the best plane's.
    pub low_cm: f64,
    /// The upper end.
    pub high_cm: f64,
    /// Whether there are scores beyond the upper end.
    pub is_open: bool,
}

/// The share of the scores that the colors span.
const SCALE_SHARE: f64 = 0.98;

impl ScoreScale {
    /// Returns the color of a score: the program's ramp turned around, so that the lowest is the brightest.
    pub fn color(&self, score_cm: f64) -> Color {
        let span = self.high_cm - self.low_cm;
        let t = if span > 0.0 {
            (score_cm - self.low_cm) / span
        } else {
            0.0
        };
        value_color(1.0 - t)
    }

    /// Formats a score with the digits that the scale can tell apart.
    pub fn digits(&self, score_cm: f64) -> String {
        let span = (self.high_cm - self.low_cm).max(1e-6);
        // From 0 to 6.
        let decimals = (2.0 - span.log10().floor()).clamp(0.0, 6.0) as usize;
        format!("{score_cm:.decimals$}")
    }
}

impl Planes {
    /// Collects the planes of an analysis, whose axes are compared with `reference`.
    pub fn new(analysis: &Arc<Analysis>, reference: Option<&AxisEstimate>) -> Self {
        let ranking = &analysis.ranking;
        let grid = analysis.planes.grid;
        let mut ranks = vec![None; grid.plane_count()];
        for (place, &index) in ranking.order().iter().enumerate() {
            ranks[index] = Some(place + 1);
        }
        let facts = grid.candidates().enumerate().map(|(index, candidate)| {
            let term = analysis.planes.terms[index];
            let axis = analysis.axis_of(index).ok().map(|axis| axis.direction);
            let error = axis
                .zip(reference)
                .map(|(a, r)| angle_between_lines_rad(a, r.direction));
            PlaneFacts {
                g: candidate.g,
                h: candidate.h,
                normal: candidate.normal,
                score_cm: ranking.scores_cm()[index],
                rank: ranks[index],
                partners: term.partners,
                distance_sum_cm: term.distance_sum_cm,
                angle_sum_rad: term.angle_sum_rad,
                axis,
                error_deg: error.map(f64::to_degrees),
            }
        });
        Self {
            facts: facts.collect(),
            scale: score_scale(analysis),
            analysis: analysis.clone(),
            against: reference.map(|axis| axis.source.in_words()),
        }
    }

    /// Returns u, the number of steps along each angle.
    pub fn u(&self) -> usize {
        self.analysis.planes.grid.u()
    }

    /// Returns the index of the best plane.
    pub fn best(&self) -> Option<usize> {
        self.analysis.ranking.order().first().copied()
    }

    /// Returns the index of the runner-up.
    pub fn runner_up(&self) -> Option<usize> {
        self.analysis.ranking.runner_up()
    }

    /// Returns the number of planes with a score.
    pub fn ranked(&self) -> usize {
        self.analysis.ranking.order().len()
    }

    /// Returns the number of points analyzed.
    pub fn points(&self) -> usize {
        self.analysis.planes.points
    }

    /// Returns the share of the points that have a partner under a plane, in percent.
    pub fn partner_percent(&self, facts: &PlaneFacts) -> f64 {
        100.0 * facts.partners as f64 / self.points().max(1) as f64
    }

    /// Returns a plane's color; `None` without a score.
    pub fn color(&self, index: usize) -> Option<Color> {
        let score = self.facts.get(index)?.score_cm?;
        Some(self.scale?.color(score))
    }

    /// Returns the indices of all planes from the best to the worst, then of those without a score in the grid's
    /// order.
    pub fn in_rank_order(&self) -> Vec<usize> {
        let scored = self.analysis.ranking.order().iter().copied();
        let others = (0..self.facts.len()).filter(|&i| self.facts[i].rank.is_none());
        scored.chain(others).collect()
    }
}

fn score_scale(analysis: &Analysis) -> Option<ScoreScale> {
    let (ranking, scores) = (&analysis.ranking, analysis.ranking.scores_cm());
    let order = ranking.order();
    let score_at = |place: usize| order.get(place).and_then(|&i| scores[i]);
    let last = order.len().checked_sub(1)?;
    let place = ((SCALE_SHARE * order.len() as f64).ceil() as usize).clamp(1, order.len()) - 1;
    Some(ScoreScale {
        low_cm: score_at(0)?,
        high_cm: score_at(place)?,
        is_open: place < last,
    })
}
