//! The paper's symmetry plane, refined without the grid.
//!
//! A plane n·p = o has three free numbers: two of its unit normal n and its offset o, which the paper fixes by the fruit
//! center. Each point p whose mirror partner can be seen (Eq. 11–14) is reflected to p̈ = p − 2 (n·p − o) n, and its partner
//! is the nearest point b of the surface, with the normal m. The distance of p̈ from the partner's tangent plane,
//! r = (p̈ − b)·m, is made least over n and o with the partners held, Huber's loss against partners that are none, and
//! partners are searched for anew after every step (iterated closest points). With δ a turn of n within its tangent plane,
//!
//! ∂r/∂δ = −2 [(m·n) p + (n·p − o) m],  ∂r/∂o = 2 m·n.
//!
//! The search starts at the best planes of the paper's ranking and at planes through the center in directions of its own.
//! The cost of the plane that it ends in is the paper's score, the mean of d + τξ over the points with a partner
//! (Eq. 15, τ = 3/π cm per radian), in centimeters; planes with a partner for less than 30 % of the points are left out.
//!
//! The axis follows from the plane by Eq. 16. It is therefore perpendicular to the line of sight: **this estimator cannot
//! see a lean** towards the camera or away from it, and misses the axis by at least that lean, however good its plane is.

use glam::DVec3;
use nalgebra::{Matrix3, Vector3};

use super::{Alternative, Estimate, EstimateError, Estimator, Surface, View, half_sphere};
use crate::geometry::{Plane, angle_between_directions_rad, angle_between_lines_rad};
use crate::method::{Aggregation, Analysis, TAU_CM_PER_RAD, has_visible_partner, symmetry_axis};
use crate::neighbors::Neighbors;
use crate::parallel::{Watch, map_pieces};

/// Planes of the paper's ranking at which searches start.
const RANKED: usize = 6;
/// Directions of normals at which further searches start.
const STARTS: usize = 24;
const STEPS: usize = 12;
/// Steps that turn the plane by less than this (and move it by less than this share of the size) end the search.
const LEAST_STEP: f64 = 1e-4;
/// The residual beyond which a pair weighs less, relative to the fruit's size.
const THRESHOLD: f64 = 0.03;
/// Axes closer than this are one, found twice.
const SAME_DEG: f64 = 8.0;
/// The most alternatives that are reported.
const ALTERNATIVES: usize = 5;
/// The lead, as a share of the best score, below which the axis is ambiguous.
const LEAST_LEAD: f64 = 0.2;

/// Refines the best planes of the paper's ranking, and others.
///
/// # Errors
/// Returns an error if no plane has enough points with a partner, or the watch cancels the work.
pub(super) fn estimate(
    surface: &Surface,
    analysis: &Analysis,
    watch: &dyn Watch,
) -> Result<Estimate, EstimateError> {
    let neighbors = Neighbors::new_watched(&surface.points, watch)?.ok_or(EstimateError::NoFit)?;
    let refinement = Refinement {
        surface,
        neighbors: &neighbors,
    };
    let ranked = analysis.ranking.order().iter().take(RANKED);
    let ranked = ranked.map(|&index| Plane {
        point: surface.of_file(analysis.center),
        normal: analysis.planes.grid.candidate(index).normal,
    });
    let own = half_sphere(STARTS).into_iter().map(|normal| Plane {
        point: surface.center,
        normal,
    });
    let starts: Vec<Plane> = ranked.chain(own).collect();
    let found = map_pieces(starts.len(), 1, watch, |range| {
        refinement.fit(starts[range.start])
    })?;
    let mut fits: Vec<Fit> = found.into_iter().flatten().collect();
    fits.sort_by(|a, b| a.axis.cost.total_cmp(&b.axis.cost));
    let best = *fits.first().ok_or(EstimateError::NoFit)?;
    let mut others: Vec<Alternative> = Vec::new();
    for Fit { axis, .. } in fits {
        let apart =
            |a: &Alternative| angle_between_lines_rad(a.direction, axis.direction).to_degrees() > SAME_DEG;
        if apart(&best.axis) && others.iter().all(apart) && others.len() < ALTERNATIVES {
            others.push(axis);
        }
    }
    let mut estimate = Estimate::fitted(Estimator::Plane, surface, best.center_cm, &best.axis, others);
    estimate.ambiguous = estimate
        .lead
        .is_some_and(|lead| lead < LEAST_LEAD * best.axis.cost);
    Ok(estimate)
}

/// The axis of a refined plane, with the plane's cost, and the point of the plane that is nearest to the center.
#[derive(Clone, Copy)]
struct Fit {
    axis: Alternative,
    center_cm: DVec3,
}

struct Refinement<'a> {
    surface: &'a Surface,
    neighbors: &'a Neighbors,
}

/// A point, its reflection and its partner.
struct Pair {
    point: DVec3,
    reflected: DVec3,
    reflected_normal: DVec3,
    partner: DVec3,
    partner_normal: DVec3,
}

impl Refinement<'_> {
    /// The pairs of the points whose partner can be seen. Without a single camera every partner can.
    fn pairs(&self, plane: &Plane) -> Vec<Pair> {
        let sample = &self.surface.fine;
        let is_seen = |point: DVec3, normal: DVec3| {
            self.surface.view != View::OneCamera || has_visible_partner(plane, point, normal, DVec3::ZERO)
        };
        let both = sample.points.iter().zip(&sample.normals);
        let seen: Vec<(DVec3, DVec3)> = both
            .map(|(p, n)| (*p, *n))
            .filter(|(p, n)| is_seen(*p, *n))
            .collect();
        let reflected: Vec<DVec3> = seen.iter().map(|(p, _)| plane.reflect_point(*p)).collect();
        let partners = self.neighbors.nearest_of_each(&reflected);
        let pair = |((&(point, normal), &reflected), partner): (
            (&(DVec3, DVec3), &DVec3),
            crate::neighbors::Neighbor,
        )| Pair {
            point,
            reflected,
            reflected_normal: plane.reflect_direction(normal),
            partner: self.surface.points[partner.index],
            partner_normal: self.surface.normals[partner.index],
        };
        seen.iter().zip(&reflected).zip(partners).map(pair).collect()
    }

    /// Refines a plane; `None` if too few of the points have a partner, or Eq. 16 gives no axis.
    fn fit(&self, start: Plane) -> Option<Fit> {
        let least = Aggregation::Mean.default_min_partner_fraction() * self.surface.fine.len() as f64;
        let enough = |pairs: &[Pair]| pairs.len() as f64 >= least && pairs.len() > 3;
        let mut plane = start;
        let mut best: Option<(f64, Plane)> = None;
        for _ in 0..STEPS {
            let pairs = self.pairs(&plane);
            if !enough(&pairs) {
                break;
            }
            let score = score_cm(&pairs);
            if best.is_none_or(|(lowest, _)| score < lowest) {
                best = Some((score, plane));
            }
            let Some((moved, step)) = self.moved(&plane, &pairs) else {
                break;
            };
            plane = moved;
            if step < LEAST_STEP {
                break;
            }
        }
        let (cost, plane) = best?;
        // The point of the plane nearest to the first guess of the center.
        let center_cm = self.surface.center - plane.signed_distance(self.surface.center) * plane.normal;
        let direction = symmetry_axis(plane.normal, center_cm, DVec3::ZERO).ok()?;
        Some(Fit {
            axis: Alternative { direction, cost },
            center_cm,
        })
    }

    /// The plane after a step of least squares, and the size of the step.
    fn moved(&self, plane: &Plane, pairs: &[Pair]) -> Option<(Plane, f64)> {
        let (e1, e2) = plane.normal.any_orthonormal_pair();
        let size = self.surface.size_cm;
        // About the plane's own point, so that a turn does not move the plane far away.
        let (mut information, mut descent) = (Matrix3::zeros(), Vector3::zeros());
        for pair in pairs {
            let residual = (pair.reflected - pair.partner).dot(pair.partner_normal);
            let q = pair.point - plane.point;
            let along = pair.partner_normal.dot(plane.normal);
            let turn = -2.0 * (along * q + q.dot(plane.normal) * pair.partner_normal);
            let row = Vector3::new(turn.dot(e1), turn.dot(e2), 2.0 * along * size);
            let far = pair.reflected.distance(pair.partner) / (THRESHOLD * size);
            let weight = 1.0 / (1.0 + far * far);
            information += row * row.transpose() * weight;
            descent -= row * (residual * weight);
        }
        // A direction in which the mirrored surface slides on itself is left alone.
        let damping = 1e-3 * information.trace();
        for i in 0..3 {
            information[(i, i)] += damping;
        }
        let step = information.cholesky()?.solve(&descent);
        let turn = (step[0] * e1 + step[1] * e2).clamp_length_max(0.3);
        let shift = step[2].clamp(-0.2, 0.2);
        let moved = Plane {
            point: plane.point + shift * size * plane.normal,
            normal: (plane.normal + turn).normalize(),
        };
        Some((moved, turn.length().max(shift.abs())))
    }
}

/// The paper's score of pairs: the mean of d + τξ in centimeters.
fn score_cm(pairs: &[Pair]) -> f64 {
    let of = |pair: &Pair| {
        let angle_rad = angle_between_directions_rad(pair.reflected_normal, pair.partner_normal);
        pair.reflected.distance(pair.partner) + TAU_CM_PER_RAD * angle_rad
    };
    pairs.iter().map(of).sum::<f64>() / pairs.len() as f64
}
