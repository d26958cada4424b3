//! Candidate planes under the cursor: their facts in words, and the commands of hovering and clicking.

use std::sync::Arc;

use egui::{Context, EventFilter, Id, Key, Modifiers, Response, Ui};

use super::arrows::take_arrows;
use super::memo::{ByAddress, memo};
use crate::app::inspector::planes::{PlaneFacts, Planes};
use crate::app::{Command, State};

/// Returns the planes of the newest analysis, computed anew only if it or the reference has changed.
pub fn planes_of(ctx: &Context, state: &State) -> Option<Arc<Planes>> {
    let analysis = state.analysis()?;
    let reference = state.reference();
    let key = (ByAddress(analysis.clone()), reference.cloned());
    let id = Id::unique("planes of the newest analysis");
    Some(memo(ctx, id, key, || Planes::new(analysis, reference)))
}

/// Returns the plane's place among all, in words.
pub fn standing(planes: &Planes, facts: &PlaneFacts) -> String {
    match facts.rank {
        Some(1) => format!("the best of {}", planes.ranked()),
        Some(2) => format!("the runner-up of {}", planes.ranked()),
        Some(rank) => format!("rank {rank} of {}", planes.ranked()),
        None => "too few partners for a score".into(),
    }
}

fn score_words(facts: &PlaneFacts) -> String {
    facts
        .score_cm
        .map_or_else(|| "none".into(), |score| format!("{score:.4} cm"))
}

/// Returns the axis's error, or the reason why there is none.
fn error_words(planes: &Planes, facts: &PlaneFacts) -> String {
    match (facts.axis, facts.error_deg) {
        (_, Some(error)) => match &planes.against {
            Some(reference) => format!("{error:.1}° off {reference}"),
            None => format!("{error:.1}°"),
        },
        (None, _) => "no axis: the normal lies along the view ray".into(),
        (Some(_), None) => "no reference to compare with".into(),
    }
}

fn partner_words(planes: &Planes, facts: &PlaneFacts, verb: &str) -> String {
    format!(
        "{} of {}{verb} ({:.1} %)",
        facts.partners,
        planes.points(),
        planes.partner_percent(facts)
    )
}

/// Returns a plane's facts in one line.
pub fn line(planes: &Planes, index: usize) -> String {
    let Some(facts) = planes.facts.get(index) else {
        return String::new();
    };
    let mut score = standing(planes, facts);
    if facts.score_cm.is_some() {
        score = format!("score {}, {score}", score_words(facts));
    }
    let error = match facts.error_deg {
        Some(_) => format!("axis {}", error_words(planes, facts)),
        None => error_words(planes, facts),
    };
    let partners = partner_words(planes, facts, " points have a partner");
    format!("{score} · {partners} · {error}")
}

/// Shows a plane's facts, a row each.
fn table(ui: &mut Ui, planes: &Planes, index: usize) {
    let Some(facts) = planes.facts.get(index) else {
        return;
    };
    ui.strong(format!("Plane g {}, h {}", facts.g, facts.h));
    ui.label(standing(planes, facts));
    let mean_distance = facts.mean_distance_cm().map(|mean| format!("{mean:.3} cm"));
    let mean_angle = facts.mean_angle_deg().map(|mean| format!("{mean:.1}°"));
    let none = || "none".into();
    let rows = [
        ("Score", score_words(facts)),
        ("Points with a partner", partner_words(planes, facts, "")),
        ("Mean distance d", mean_distance.unwrap_or_else(none)),
        ("Mean angle ξ", mean_angle.unwrap_or_else(none)),
        ("Axis error", error_words(planes, facts)),
    ];
    egui::Grid::new("plane facts").num_columns(2).show(ui, |ui| {
        for (name, value) in rows {
            ui.label(name);
            ui.strong(value);
            ui.end_row();
        }
    });
}

/// Handles the plane at the cursor in a drawing of planes: previews it, shows its facts beside the cursor, and
/// looks at it on a click.
pub fn interact(
    ui: &Ui,
    response: &Response,
    planes: &Planes,
    hovered: Option<usize>,
    commands: &mut Vec<Command>,
) {
    preview(ui, response.id, hovered, commands);
    let Some(index) = hovered else { return };
    egui::Tooltip::for_enabled(response)
        .at_pointer()
        .gap(14.0)
        .show(|ui| {
            ui.set_max_width(ui.spacing().tooltip_width);
            table(ui, planes, index);
        });
    if response.clicked() {
        commands.push(Command::LookAt(planes.facts[index].choice()));
    }
}

/// Shows the reason why the plane under the cursor has no score, if it has none.
pub fn explain_missing(response: &Response, planes: &Planes, index: usize) {
    if planes.facts.get(index).is_some_and(|f| f.score_cm.is_none()) {
        let least = 100.0 * planes.analysis.params.min_partner_fraction;
        let percent = planes.partner_percent(&planes.facts[index]);
        response.clone().on_hover_text_at_pointer(format!(
            "Too few partners for a score: {percent:.0} % of the points have one, at least {least:.0} % are needed."
        ));
    }
}

/// Previews the plane under the cursor, and ends the preview once when the cursor has left `widget`.
pub fn preview(ui: &Ui, widget: Id, hovered: Option<usize>, commands: &mut Vec<Command>) {
    let id = widget.with("previewed plane");
    let before: Option<usize> = ui.data(|data| data.get_temp(id)).flatten();
    if before != hovered {
        ui.data_mut(|data| data.insert_temp(id, hovered));
        commands.push(Command::Preview(hovered));
    }
}

/// Takes the presses of the arrow keys while the widget has the focus: those to the right, and those down.
pub fn arrow_presses(ui: &Ui, response: &Response) -> [isize; 2] {
    if !response.has_focus() {
        return [0, 0];
    }
    let arrows = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    take_arrows(ui, response, arrows);
    let pressed = |key| {
        let count = ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
        count.cast_signed()
    };
    [
        pressed(Key::ArrowRight) - pressed(Key::ArrowLeft),
        pressed(Key::ArrowDown) - pressed(Key::ArrowUp),
    ]
}

/// Returns the description of a drawing of planes for a screen reader.
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
