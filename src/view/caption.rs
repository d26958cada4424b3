//! The result in words, for the window and the captions of pictures.

use crate::method::axis_error_rad;
use crate::method::{Analysis, AxisEstimate, Candidate, Warning};

/// Two lines: the cloud with its settings, and the plane with its result.
pub fn caption(
    name: &str,
    analysis: &Analysis,
    plane: Option<usize>,
    axis: Option<&AxisEstimate>,
    reference: Option<&AxisEstimate>,
) -> Vec<String> {
    let u = analysis.planes.grid.u();
    let first = format!(
        "{name} · {} points used · preset {} · {u} × {u} planes",
        analysis.surface.len(),
        analysis.params.preset_name()
    );
    let Some(index) = plane else {
        return vec![first, "no symmetry plane".into()];
    };
    let Candidate { g, h, .. } = analysis.planes.grid.candidate(index);
    let rank = analysis.ranking.order().iter().position(|&i| i == index);
    let score = match (rank, analysis.ranking.scores_cm()[index]) {
        (Some(0), Some(score)) => format!("the best, score {score:.4} cm"),
        (Some(rank), Some(score)) => format!("rank {}, score {score:.4} cm", rank + 1),
        _ => "too few partners for a score".into(),
    };
    let error = match (axis, reference) {
        (Some(axis), Some(reference)) => {
            let degrees = axis_error_rad(axis, reference).to_degrees();
            format!("axis {degrees:.1}° off {}", reference.source.in_words())
        }
        (Some(_), None) => "no reference".into(),
        (None, _) => "no axis".into(),
    };
    vec![first, format!("plane g {g}, h {h}: {score} · {error}")]
}

/// The lead of the winner in words; `None` if there is no winner or no runner-up.
pub fn lead_in_words(analysis: &Analysis) -> Option<String> {
    let best = analysis.best.as_ref().ok()?;
    let (runner_up, runner_up_cm) = best.runner_up?;
    let Some(lead) = best.lead() else {
        let (g, h) = (runner_up.g, runner_up.h);
        return Some(if runner_up_cm <= best.score_cm {
            format!("Ambiguous: the runner-up (g {g}, h {h}) scores the same")
        } else {
            format!("The best plane scores 0 and the runner-up (g {g}, h {h}) {runner_up_cm:.4} cm")
        });
    };
    let ambiguous = analysis
        .warnings
        .iter()
        .any(|warning| matches!(warning, Warning::Ambiguous { .. }));
    let angle =
        crate::geometry::angle_between_lines_rad(best.candidate.normal, runner_up.normal).to_degrees();
    Some(format!(
        "{}: the runner-up (g {}, h {}) scores {:.1} % more and lies {angle:.0}° away",
        if ambiguous { "Ambiguous" } else { "Clear" },
        runner_up.g,
        runner_up.h,
        100.0 * lead
    ))
}

/// A count with commas between thousands.
pub fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
