//! The bar at the bottom: messages, the progress of the analysis, its result, and its warnings.

use egui::RichText;

use crate::app::{Command, State};
use crate::estimate::Estimator;
use crate::method::{Analysis, axis_error_rad};
use crate::ui::widgets::controls::button;
use crate::ui::widgets::progress::stage_progress;
use crate::ui::widgets::reference;
use crate::view::lead_in_words;

/// Shows the bar.
pub fn show(ui: &mut egui::Ui, state: &State, commands: &mut Vec<Command>) {
    for message in state.messages.iter().rev().take(3).rev() {
        ui.horizontal_wrapped(|ui| {
            let visuals = ui.visuals();
            let color = if message.is_error {
                visuals.error_fg_color
            } else {
                visuals.text_color()
            };
            if ui.small_button("Dismiss").clicked() {
                commands.push(Command::Dismiss(message.id));
            }
            ui.label(RichText::new(&message.text).color(color));
        });
    }
    ui.horizontal(|ui| {
        if let Some(progress) = state.progress {
            if button(ui, "Cancel", "Cancel the analysis (Esc)") {
                commands.push(Command::Cancel);
            }
            ui.add(stage_progress(&progress).desired_width(240.0));
        } else if state.was_cancelled {
            ui.label("The analysis was canceled.");
            if button(ui, "Analyze", "Analyze now (F5)") {
                commands.push(Command::Resume);
            }
        } else {
            result(ui, state);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            warnings(ui, state);
        });
    });
}

fn result(ui: &mut egui::Ui, state: &State) {
    let Some(walked) = &state.walked else {
        ui.label(RichText::new("No cloud is analyzed.").weak());
        return;
    };
    let analysis = &walked.analysis;
    let points = analysis.surface.len();
    let used = format!(
        "{points} points used{}, in {}",
        strays_in_words(analysis),
        walked.fruit.unit.symbol()
    );
    if state.true_axes.is_blind {
        ui.label(format!("{used} · blind: results are hidden"));
        return;
    }
    let mut parts = vec![used, format!("preset {}", analysis.params.preset_name())];
    let name = match state.estimators.counts {
        Estimator::Body => "body's axis",
        _ => "best axis",
    };
    match (state.counted_axis(), state.reference()) {
        (Some(axis), Some(reference)) => parts.push(format!(
            "{name} {:.1}° off {}",
            axis_error_rad(axis, reference).to_degrees(),
            reference.source.in_words()
        )),
        (Some(_), None) => parts.push(reference::none_in_words(state.many.against).into()),
        (None, _) if state.estimators.is_pending && state.estimators.counts == Estimator::Body => {
            parts.push("the body is being fitted".into());
        }
        (None, _) => parts.push("no axis".into()),
    }
    ui.label(parts.join(" · "));
    if let Some(lead) = lead_in_words(analysis) {
        ui.add(egui::Label::new(RichText::new(lead).weak()).truncate());
    }
}

/// Returns a clause on the strays of the cloud; nothing if it has none.
fn strays_in_words(analysis: &Analysis) -> String {
    match (analysis.strays.len(), analysis.params.filters.keep_strays) {
        (0, _) => String::new(),
        (1, false) => " without 1 stray".into(),
        (count, false) => format!(" without {count} strays"),
        (1, true) => " with 1 stray".into(),
        (count, true) => format!(" with {count} strays"),
    }
}

fn warnings(ui: &mut egui::Ui, state: &State) {
    let warnings = state.shown_warnings();
    let count = warnings.len();
    if count == 0 {
        return;
    }
    let text = if count == 1 {
        "1 warning".to_owned()
    } else {
        format!("{count} warnings")
    };
    let color = ui.visuals().warn_fg_color;
    ui.menu_button(RichText::new(text).color(color), |ui| {
        ui.set_max_width(420.0);
        for warning in warnings {
            ui.add(egui::Label::new(warning.as_str()).wrap());
        }
    });
}
