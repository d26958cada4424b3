//! What panels say where there is nothing to show, or nothing new yet.

use egui::{Align, Layout, RichText, Ui};

use crate::app::{Command, Source, State};

/// Says why there is no analysis to show.
pub fn nothing_to_show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let (text, can_resume) = reason(state);
    let height = ui.available_height();
    ui.allocate_ui_with_layout(ui.available_size(), Layout::top_down(Align::Center), |ui| {
        ui.add_space((0.5 * height - 24.0).clamp(4.0, 160.0));
        ui.label(text);
        if can_resume && ui.button("Analyze").clicked() {
            commands.push(Command::Resume);
        }
    });
}

/// Stands in for what blind mode hides.
pub fn hidden(ui: &mut Ui) {
    let height = ui.available_height();
    ui.allocate_ui_with_layout(ui.available_size(), Layout::top_down(Align::Center), |ui| {
        ui.add_space((0.5 * height - 24.0).clamp(4.0, 160.0));
        ui.label("Hidden in blind mode (Shift+B).");
    });
}

fn reason(state: &State) -> (String, bool) {
    let name = state.source().map(Source::name);
    let problem = state
        .current
        .and_then(|i| state.entries.get(i))
        .and_then(|entry| entry.problem.clone());
    match (name, problem) {
        (None, _) => (
            "No cloud is open. Open a file, or one of the samples.".into(),
            false,
        ),
        (Some(_), Some(problem)) => (problem, false),
        (Some(name), None) if state.was_cancelled => (format!("The analysis of {name} was stopped."), true),
        (Some(name), None) => (format!("{name} is being analyzed."), false),
    }
}

/// A line above results that are older than the settings.
pub fn if_stale(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    if !state.is_stale {
        return;
    }
    let font = super::marks::label_font(ui);
    let note = |text: &str| RichText::new(text).font(font.clone()).italics();
    if state.was_cancelled {
        ui.horizontal_wrapped(|ui| {
            ui.label(note("Of the settings before: the new analysis was stopped."));
            if ui.small_button("Analyze").clicked() {
                commands.push(Command::Resume);
            }
        });
    } else {
        ui.label(note("Of the settings before, until the new analysis is done."));
    }
}

/// How opaque results are drawn: older ones are faded, while texts stay as they are.
pub fn opacity(state: &State) -> f32 {
    if state.is_stale { 0.45 } else { 1.0 }
}

/// Why no plane can be the symmetry plane, where that is so.
pub fn if_no_plane(ui: &mut Ui, analysis: &crate::method::Analysis) {
    if let Err(none) = &analysis.best {
        ui.label(crate::text::sentence(&none.to_string()));
    }
}
