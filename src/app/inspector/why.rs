//! The paper's steps (Eq. 12–15) for one point under the plane that is
//! looked at, as numbers and as lines in space (Fig. 6).

use glam::DVec3;

use super::look::Contributions;
use crate::app::state::State;
use crate::geometry::{Plane, Unit};
use crate::method::Side;
use crate::render::{Color, Line};
use crate::view::Theme;

/// One point, and what the method makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Why {
    /// Its index among the shown points.
    pub shown_index: usize,
    /// The position, in the file's unit and frame.
    pub position: DVec3,
    /// The file's unit; `None` where the cloud was not analyzed.
    pub unit: Option<Unit>,
    /// The steps under the plane that is looked at.
    pub steps: Result<Steps, Unexplained>,
}

/// The reason why there are no steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unexplained {
    /// The cloud was not analyzed.
    #[error("the cloud was not analyzed")]
    NotAnalyzed,
    /// The point was left out.
    #[error("the point is not used: a filter, a missing normal or the peduncle's removal left it out")]
    LeftOut,
    /// No plane is looked at.
    #[error("there is no plane to reflect it in")]
    NoPlane,
}

/// The steps of the paper for one point. Positions are in the file's unit and frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// The point's index in the surface.
    pub surface_index: usize,
    /// Its unit normal.
    pub normal: DVec3,
    /// The plane that is looked at.
    pub plane: Plane,
    /// The point's side of it.
    pub side: Side,
    /// Its distance from the plane in centimeters, positive in front.
    pub plane_distance_cm: f64,
    /// p̈, its mirror image (Eq. 12).
    pub reflection: DVec3,
    /// ñ, its normal's mirror image (Eq. 13), of unit length.
    pub reflected_normal: DVec3,
    /// p_v.
    pub viewpoint: DVec3,
    /// ⟨ñ, p_v − p̈⟩ in centimeters (Eq. 14): positive where a partner would be visible.
    pub visibility_cm: f64,
    /// The match; `None` if a partner would not be visible.
    pub partner: Option<Match>,
}

/// A point's reflection beside its nearest neighbor (Fig. 6).
#[derive(Debug, Clone, PartialEq)]
pub struct Match {
    /// The neighbor's index in the surface.
    pub surface_index: usize,
    /// The position, in the file's unit and frame.
    pub position: DVec3,
    /// Its unit normal.
    pub normal: DVec3,
    /// d: from the reflection to the neighbor, in centimeters.
    pub distance_cm: f64,
    /// ξ: between the reflected normal and the neighbor's, in radians, 0 to π.
    pub angle_rad: f64,
    /// τ in centimeters per radian.
    pub tau_cm_per_rad: f64,
    /// τξ in centimeters.
    pub weighted_angle_cm: f64,
    /// S = d + τξ in centimeters (Eq. 15).
    pub score_cm: f64,
    /// The share of the plane's contributions that are smaller, 0 to 1, to about the width of a bin of
    /// the histogram.
    pub share_below: Option<f64>,
}

/// The steps for a point of the picture, by its index among the shown ones; `None` where there is no
/// such point. They are those of the plane and the parameters that are drawn, which may be older than
/// what is set.
pub fn why(state: &State, shown_index: usize) -> Option<Why> {
    let look = state.look.as_ref()?;
    let position = *look.shown.positions.get(shown_index)?;
    let of = |unit, steps| {
        Some(Why {
            shown_index,
            position,
            unit,
            steps,
        })
    };
    let Some(analysis) = &look.analysis else {
        return of(None, Err(Unexplained::NotAnalyzed));
    };
    let (surface, params) = (&analysis.surface, &analysis.params);
    let unit = Some(params.unit);
    let Some(surface_index) = look.shown.in_surface.get(shown_index) else {
        return of(unit, Err(Unexplained::LeftOut));
    };
    let Some(detail) = &look.detail else {
        return of(unit, Err(Unexplained::NoPlane));
    };
    let normal = *surface.normals().get(surface_index)?;
    let point = *detail.points.get(surface_index)?;
    let plane = detail.plane;
    let reflection = plane.reflect_point(position);
    let reflected_normal = plane.reflect_direction(normal);
    let in_cm = params.unit.in_cm();
    let tau_cm_per_rad = params.tau_cm_per_rad;
    let partner = point.partner.and_then(|partner| {
        let score_cm = partner.score_cm(tau_cm_per_rad);
        Some(Match {
            surface_index: partner.index,
            position: *surface.points().get(partner.index)?,
            normal: *surface.normals().get(partner.index)?,
            distance_cm: partner.distance_cm,
            angle_rad: partner.angle_rad,
            tau_cm_per_rad,
            weighted_angle_cm: tau_cm_per_rad * partner.angle_rad,
            score_cm,
            share_below: look.contributions.as_deref().map(|c| share_below(c, score_cm)),
        })
    });
    of(
        unit,
        Ok(Steps {
            surface_index,
            normal,
            plane,
            side: point.side,
            plane_distance_cm: plane.signed_distance(position) * in_cm,
            reflection,
            reflected_normal,
            viewpoint: params.viewpoint,
            visibility_cm: reflected_normal.dot(params.viewpoint - reflection) * in_cm,
            partner,
        }),
    )
}

/// The share of contributions below `score_cm`, evenly spread within each bin.
fn share_below(contributions: &Contributions, score_cm: f64) -> f64 {
    let total: usize = contributions.counts.iter().sum();
    let last = contributions.counts.len().saturating_sub(1);
    let mut below = 0.0;
    for (bin, &count) in contributions.counts.iter().enumerate() {
        let from = bin as f64 * contributions.bin_cm;
        let width = if bin == last {
            (contributions.most_cm - from).max(contributions.bin_cm)
        } else {
            contributions.bin_cm
        };
        below += count as f64 * ((score_cm - from) / width).clamp(0.0, 1.0);
    }
    below / total.max(1) as f64
}

// Of Okabe and Ito's set, which people tell apart with every kind of color vision.
/// The color of the point and its normal.
pub const POINT_COLOR: Color = [0xe6, 0x9f, 0x00, 255];
/// The color of its reflection and the reflected normal.
pub const REFLECTION_COLOR: Color = [0x56, 0xb4, 0xe9, 255];
/// The color of the nearest neighbor and its normal.
pub const NEIGHBOR_COLOR: Color = [0xcc, 0x79, 0xa7, 255];

/// Fig. 6 in space: the point, dashed through its foot on the plane to its reflection, from there to
/// the nearest neighbor (d), and the normals (ξ), the reflected one once more at the neighbor. Where
/// there is no partner, the way from the reflection towards the viewpoint instead. `size` is the
/// cloud's in its own unit.
pub fn why_lines(why: &Why, size: f64, theme: Theme) -> Vec<Line> {
    let edge = theme.background().bottom;
    let disc = |at: DVec3, color: Color, width_px: f32| {
        Line::new(at, at, color, width_px)
            .outlined(theme.ink(), 2.0)
            .shining_through(0.9)
    };
    let line = |from: DVec3, to: DVec3, color: Color, width_px: f32| {
        Line::new(from, to, color, width_px)
            .outlined(edge, 1.0)
            .shining_through(0.7)
    };
    let Ok(steps) = &why.steps else {
        return vec![disc(why.position, POINT_COLOR, 10.0)];
    };
    let (point, reflection) = (why.position, steps.reflection);
    let foot = 0.5 * (point + reflection);
    let normal_length = 0.09 * size;
    let mut lines = vec![
        line(point, foot, POINT_COLOR, 2.0).dashed(),
        line(foot, reflection, REFLECTION_COLOR, 2.0).dashed(),
        line(point, point + normal_length * steps.normal, POINT_COLOR, 2.4),
        line(
            reflection,
            reflection + normal_length * steps.reflected_normal,
            REFLECTION_COLOR,
            2.4,
        ),
    ];
    if let Some(partner) = &steps.partner {
        let at = partner.position;
        lines.extend([
            line(reflection, at, theme.ink(), 2.8),
            line(
                at,
                at + normal_length * steps.reflected_normal,
                REFLECTION_COLOR,
                1.6,
            )
            .dashed(),
            line(at, at + normal_length * partner.normal, NEIGHBOR_COLOR, 2.4),
            disc(at, NEIGHBOR_COLOR, 10.0),
        ]);
    } else {
        let toward = (steps.viewpoint - reflection).normalize_or_zero();
        let to = reflection + 2.0 * normal_length * toward;
        lines.push(line(reflection, to, theme.quiet_ink(), 1.6).dashed());
    }
    lines.extend([
        disc(foot, theme.quiet_ink(), 5.0),
        disc(reflection, REFLECTION_COLOR, 10.0),
        disc(point, POINT_COLOR, 10.0),
    ]);
    lines
}
