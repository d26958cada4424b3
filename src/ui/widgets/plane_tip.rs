//! What is said of the candidate plane under the cursor, and how hovering and clicking it go.

use egui::{Id, Response, Ui};

use super::planes::{PlaneFacts, Planes};
use crate::app::{Command, State};

/// The plane's place among all, in words.
pub fn standing(planes: &Planes, facts: &PlaneFacts) -> String {
    match facts.rank {
        Some(1) => format!("the best of {}", planes.ranked()),
        Some(2) => format!("the runner-up of {}", planes.ranked()),
        Some(rank) => format!("rank {rank} of {}", planes.ranked()),
        None => "too few partners for a score".into(),
    }
}

/// The score, or that there is none.
pub fn score_words(facts: &PlaneFacts) -> String {
    facts
        .score_cm
        .map_or_else(|| "none".into(), |score| format!("{score:.4} cm"))
}

/// The axis's error, or why there is none.
pub fn error_words(facts: &PlaneFacts) -> String {
    match (facts.axis, facts.error_deg) {
        (_, Some(error)) => format!("{error:.1}°"),
        (None, _) => "no axis: the normal lies along the view ray".into(),
        (Some(_), None) => "no reference to compare with".into(),
    }
}

/// One line on a plane.
pub fn line(planes: &Planes, index: usize) -> String {
    let Some(facts) = planes.facts.get(index) else {
        return String::new();
    };
    let score = match (facts.score_cm, facts.rank) {
        (Some(_), _) => format!("score {}, {}", score_words(facts), standing(planes, facts)),
        (None, _) => standing(planes, facts),
    };
    let error = match facts.error_deg {
        Some(error) => format!("axis error {error:.1}°"),
        None => error_words(facts),
    };
    format!(
        "{score} · {} of {} points have a partner ({:.1} %) · {error}",
        facts.partners,
        planes.points(),
        planes.partner_percent(facts)
    )
}

/// A plane's facts, a row each.
pub fn table(ui: &mut Ui, planes: &Planes, index: usize) {
    let Some(facts) = planes.facts.get(index) else {
        return;
    };
    ui.strong(format!("Plane g {}, h {}", facts.g, facts.h));
    ui.label(standing(planes, facts));
    let number = |value: Option<f64>, unit: &str| {
        value.map_or_else(|| "none".into(), |value| format!("{value:.3}{unit}"))
    };
    let rows = [
        ("Score", score_words(facts)),
        (
            "Points with a partner",
            format!(
                "{} of {} ({:.1} %)",
                facts.partners,
                planes.points(),
                planes.partner_percent(facts)
            ),
        ),
        ("Mean distance d", number(facts.mean_distance_cm(), " cm")),
        (
            "Mean angle ξ",
            facts
                .mean_angle_deg()
                .map_or_else(|| "none".into(), |angle| format!("{angle:.1}°")),
        ),
        ("Axis error", error_words(facts)),
    ];
    egui::Grid::new("plane facts").num_columns(2).show(ui, |ui| {
        for (name, value) in rows {
            ui.label(name);
            ui.strong(value);
            ui.end_row();
        }
    });
}

/// Shows the facts of the plane under the cursor, next to it.
pub fn tooltip(response: &Response, planes: &Planes, index: usize) {
    egui::Tooltip::for_enabled(response)
        .at_pointer()
        .gap(14.0)
        .show(|ui| {
            ui.set_max_width(ui.spacing().tooltip_width);
            table(ui, planes, index);
        });
}

/// Says why the plane under the cursor has no score.
pub fn explain_missing(response: &Response, planes: &Planes, index: usize) {
    if planes.facts.get(index).is_some_and(|f| f.score_cm.is_none()) {
        let least = 100.0 * planes.analysis.params.min_partner_fraction;
        let percent = planes.partner_percent(&planes.facts[index]);
        response.clone().on_hover_text_at_pointer(format!(
            "Too few partners for a score: {percent:.0} % of the points have one, {least:.0} % are asked for."
        ));
    }
}

/// Previews the plane under the cursor, and takes that back once when the cursor has left. `widget` is
/// whoever is hovered.
pub fn preview(ui: &Ui, widget: Id, hovered: Option<usize>, commands: &mut Vec<Command>) {
    let id = widget.with("previewed plane");
    let before: Option<usize> = ui.data(|data| data.get_temp(id)).flatten();
    if before != hovered {
        ui.data_mut(|data| data.insert_temp(id, hovered));
        commands.push(Command::Preview(hovered));
    }
}

/// The plane in words for those who do not see it.
pub fn spoken(state: &State, planes: &Planes) -> String {
    let place = |index: Option<usize>| index.and_then(|i| planes.facts.get(i));
    let best = place(planes.best()).map_or_else(
        || "none has enough partners".into(),
        |best| format!("best g {} h {}", best.g, best.h),
    );
    let chosen = place(state.chosen_plane_index())
        .map(|chosen| format!(", looking at g {} h {}", chosen.g, chosen.h))
        .unwrap_or_default();
    format!("{} planes, {best}{chosen}", planes.facts.len())
}
