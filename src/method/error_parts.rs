//! The error of an axis taken apart: the lean, the grid, the choice of the plane, and the center.
//!
//! Eq. 16 makes every axis perpendicular to the view ray through the fruit center, so no plane brings the
//! error (§ 3) below the angle by which the true axis leans out of that perpendicular plane. Of the grid's
//! u² planes one has the axis nearest to the truth, and the plane with the lowest score is mostly another.
//! The three steps add up to the error:
//!
//! ```text
//! error = lean + (nearest candidate − lean) + (chosen plane − nearest candidate)
//!         lean           grid                          choice
//! ```
//!
//! All three are seen from one and the same center. The center's share is told by a comparison of its own:
//! the parts of a second analysis that was given the true center.

use glam::DVec3;

use super::{Analysis, AxisError, Candidate};
use crate::geometry::angle_between_lines_rad;

/// Errors in radians that count as equal: a fruit before the middle of the camera has whole rows of
/// candidates with one axis, which rounding alone tells apart.
const EQUAL_RAD: f64 = 1e-9;

/// The candidate plane whose axis is nearest to the truth.
///
/// Eq. 16 uses no more of a normal than its part across the view ray, so such a plane need not be near the
/// fruit's mirror plane. Its rank tells whether the scores speak for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestCandidate {
    /// Its index in the grid.
    pub index: usize,
    /// Its place in the grid and its normal.
    pub candidate: Candidate,
    /// The angle between its axis and the true one, 0 to π/2.
    pub error_rad: f64,
    /// Its place among the scored planes, from 1; `None` if too few points have a partner for a score. Of
    /// several candidates that are equally near, the one with the best place is taken.
    pub rank: Option<usize>,
}

/// The parts of the error of one analysis against a true axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorParts {
    /// The angle between the true axis and the plane through the analysis's center across the view ray, 0 to
    /// π/2: the least error that Eq. 16 allows.
    pub lean_rad: f64,
    /// The candidate plane whose axis is nearest to the truth.
    pub nearest: NearestCandidate,
    /// The angle between the analysis's axis and the true one (§ 3), 0 to π/2; `None` without an axis.
    pub error_rad: Option<f64>,
}

/// The axes that Eq. 16 gives for all candidate planes of an analysis, for the comparison with several true axes.
#[derive(Debug, Clone)]
pub struct CandidateAxes<'a> {
    analysis: &'a Analysis,
    /// The unit directions, in the grid's order; `None` for a normal along the view ray.
    directions: Vec<Option<DVec3>>,
}

impl<'a> CandidateAxes<'a> {
    /// Computes the axes. Takes O(u²), whatever the number of points.
    pub fn new(analysis: &'a Analysis) -> Self {
        let direction = |index| analysis.axis_of(index).ok().map(|axis| axis.direction);
        Self {
            analysis,
            directions: (0..analysis.planes.grid.plane_count()).map(direction).collect(),
        }
    }

    /// Returns the analysis.
    pub fn analysis(&self) -> &'a Analysis {
        self.analysis
    }

    /// Returns the candidate nearest to the direction `truth`; `None` if no candidate has an axis.
    fn nearest(&self, truth: DVec3) -> Option<NearestCandidate> {
        let mut nearest: Vec<(usize, f64)> = Vec::new();
        let mut least = f64::INFINITY;
        for (index, direction) in self.directions.iter().enumerate() {
            let Some(direction) = direction else { continue };
            let error = angle_between_lines_rad(*direction, truth);
            if error < least {
                least = error;
                nearest.retain(|&(_, error)| error <= least + EQUAL_RAD);
            }
            if error <= least + EQUAL_RAD {
                nearest.push((index, error));
            }
        }
        let order = self.analysis.ranking.order();
        let ranked = order.iter().enumerate().find_map(|(place, index)| {
            let found = nearest.iter().find(|(i, _)| i == index)?;
            Some((*found, Some(place + 1)))
        });
        let ((index, error_rad), rank) = ranked.or_else(|| Some((*nearest.first()?, None)))?;
        Some(NearestCandidate {
            index,
            candidate: self.analysis.planes.grid.candidate(index),
            error_rad,
            rank,
        })
    }
}

impl ErrorParts {
    /// Takes the error of an analysis against the true axis apart; `truth` is its direction, of unit length.
    ///
    /// # Errors
    /// Returns an error if Eq. 16 gives no candidate an axis, since the viewpoint is the center.
    pub fn new(candidates: &CandidateAxes<'_>, truth: DVec3) -> Result<Self, AxisError> {
        let analysis = candidates.analysis;
        let axis = analysis.axis.as_ref();
        Ok(Self {
            lean_rad: lean_rad(truth, analysis.center, analysis.params.viewpoint)?,
            nearest: candidates.nearest(truth).ok_or(AxisError::NormalAlongViewRay)?,
            error_rad: axis.map(|axis| angle_between_lines_rad(axis.direction, truth)),
        })
    }

    /// Returns the part of the error that is due to the grid, 0 or more: the excess of the nearest
    /// candidate's error over the lean.
    pub fn grid_rad(&self) -> f64 {
        // Rounding may put the nearest candidate's error just below its bound.
        (self.nearest.error_rad - self.lean_rad).max(0.0)
    }

    /// Returns the part of the error that is due to the choice of the plane, 0 or more: the excess of the
    /// analysis's error over that of the nearest candidate. `None` without an axis.
    pub fn choice_rad(&self) -> Option<f64> {
        Some((self.error_rad? - self.nearest.error_rad).max(0.0))
    }
}

/// Computes the angle between a direction and the plane across the view ray from `viewpoint` to `center`, 0
/// to π/2: 0 for a fruit that is upright before the camera, and the error that remains under Eq. 16 for one
/// that leans towards the camera or away from it. `direction` has any length but zero.
///
/// # Errors
/// Returns an error if the viewpoint is the center.
pub fn lean_rad(direction: DVec3, center: DVec3, viewpoint: DVec3) -> Result<f64, AxisError> {
    let ray = (viewpoint - center)
        .try_normalize()
        .ok_or(AxisError::ViewpointAtCenter)?;
    // By the tangent: the arc sine loses half of its digits near π/2.
    Ok(direction.dot(ray).abs().atan2(direction.cross(ray).length()))
}
