//! The one choice of the reference axis, by which every error in the window is measured.

use egui::{Button, ComboBox, Role, Ui, WidgetInfo};

use crate::app::{State, TruthChoice};
use crate::evaluate::reference_of;
use crate::method::{AxisEstimate, AxisSource, axis_error_rad};

/// The kinds of references, by their names in the list and what they are.
const KINDS: [(TruthChoice, &str, &str); 5] = [
    (
        TruthChoice::Auto,
        "the best known",
        "The simulator's axis where there is one, else the one set by hand, else the peduncle's",
    ),
    (
        TruthChoice::Peduncle,
        "the peduncle",
        "The axis from the fruit center through the peduncle (§ 3.2)",
    ),
    (
        TruthChoice::PeduncleDirection,
        "the peduncle's direction",
        "The direction in which the peduncle itself runs",
    ),
    (
        TruthChoice::Truth,
        "the simulation",
        "The axis in NAME.truth.json",
    ),
    (
        TruthChoice::Manual,
        "set by hand",
        "The adjudicated axis, else the mean of the annotators'",
    ),
];

/// Returns the name of a kind of reference in the list.
fn title(kind: TruthChoice) -> &'static str {
    KINDS.iter().find(|k| k.0 == kind).map_or("", |k| k.1)
}

/// Returns the reason why a cloud has no error against a kind of reference, as a clause.
pub fn none_in_words(kind: TruthChoice) -> &'static str {
    match kind {
        TruthChoice::Auto => "no reference axis",
        TruthChoice::Peduncle => "no peduncle to measure against",
        TruthChoice::PeduncleDirection => "no peduncle's direction to measure against",
        TruthChoice::Truth => "no simulated axis to measure against",
        TruthChoice::Manual => "no axis set by hand to measure against",
    }
}

/// Returns the reference in words for a tooltip or a heading; `None` if the current cloud has none of that kind.
pub fn of_current(state: &State) -> Option<String> {
    Some(state.reference()?.source.in_words().into_owned())
}

/// Returns the computed axis's error against an axis as the list tells it: none in blind mode.
fn error_words(state: &State, reference: Option<&AxisEstimate>) -> String {
    let axis = state.analysis().and_then(|analysis| analysis.axis.as_ref());
    match axis.zip(reference) {
        Some((axis, reference)) if !state.true_axes.is_blind => {
            format!(" · {:.1}°", axis_error_rad(axis, reference).to_degrees())
        }
        _ => String::new(),
    }
}

/// Shows the choice with each reference's own error for the current cloud; returns a new choice.
pub fn choose(ui: &mut Ui, state: &State) -> Option<TruthChoice> {
    let chosen = state.many.against;
    let mut picked = None;
    let response = ComboBox::from_id_salt("reference")
        .selected_text(selected(state))
        .width(170.0)
        .truncate()
        .show_ui(ui, |ui| {
            for (kind, name, tip) in KINDS {
                let reference = reference_of(&state.references, kind);
                let text = format!("{name}{}", error_words(state, reference));
                let response = ui
                    .add(Button::selectable(kind == chosen, text))
                    .on_hover_text(tip);
                if response.clicked() && kind != chosen {
                    picked = Some(kind);
                }
            }
            if !state.true_axes.is_blind {
                annotators(ui, state);
            }
        })
        .response;
    response
        .on_hover_text("The reference of every error in this window: view, planes, table, charts and gallery")
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Reference axis"));
    picked
}

/// Returns the text of the closed list: the kind, and for the best known which one it is here.
fn selected(state: &State) -> String {
    let name = title(state.many.against);
    match of_current(state) {
        Some(words) if state.many.against == TruthChoice::Auto && !state.true_axes.is_blind => {
            format!("{name}: {}", words.strip_prefix("the ").unwrap_or(&words))
        }
        _ => name.to_owned(),
    }
}

/// Lists the axes of single annotators, which are no kind of reference that other clouds share.
fn annotators(ui: &mut Ui, state: &State) {
    let of_one = |axis: &&AxisEstimate| matches!(axis.source, AxisSource::Annotator(_));
    for axis in state.references.iter().filter(of_one) {
        ui.weak(format!("{}{}", axis.source.in_words(), error_words(state, Some(axis))))
            .on_hover_text("One annotator's axis is told here and measured against by none: choose “set by hand” for their mean.");
    }
}
