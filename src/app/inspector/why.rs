//! The paper's steps (Eq. 12–15) for one point under the plane that is
//! looked at, as numbers and as lines in space (Fig. 6).

use glam::DVec3;

use super::look::{Contributions, Look};
use crate::app::state::State;
use crate::geometry::Unit;
use crate::method::PointSteps;
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
    pub steps: Result<PointSteps, Unexplained>,
    /// The share of the plane's contributions that are smaller than the point's, 0 to 1, to about the width of a bin
    /// of the histogram; `None` without a partner or a histogram.
    pub share_below: Option<f64>,
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

/// The steps for a point of the picture, by its index among the shown ones; `None` where there is no
/// such point. They are those of the plane and the parameters that are drawn, which may be older than
/// what is set.
pub fn why(state: &State, shown_index: usize) -> Option<Why> {
    let look = state.look.as_ref()?;
    let position = *look.shown.positions.get(shown_index)?;
    let unit = look.analysis.as_ref().map(|analysis| analysis.params.unit);
    let steps = steps(look, shown_index);
    let score_cm = (steps.as_ref().ok())
        .and_then(|steps| steps.partner.as_ref())
        .map(|partner| partner.score_cm);
    let share_below =
        (look.contributions.as_deref().zip(score_cm)).map(|(c, score_cm)| share_below(c, score_cm));
    Some(Why {
        shown_index,
        position,
        unit,
        steps,
        share_below,
    })
}

fn steps(look: &Look, shown_index: usize) -> Result<PointSteps, Unexplained> {
    let analysis = look.analysis.as_ref().ok_or(Unexplained::NotAnalyzed)?;
    let surface_index = look.shown.in_surface.get(shown_index);
    let surface_index = surface_index.ok_or(Unexplained::LeftOut)?;
    let detail = look.detail.as_ref().ok_or(Unexplained::NoPlane)?;
    PointSteps::new(analysis, detail, surface_index).ok_or(Unexplained::LeftOut)
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
    // Where a sample was analyzed, these are the steps of the used point nearest to the shown one.
    let (point, reflection) = (steps.position, steps.reflection);
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
