//! Notices of panels that have nothing to show, or only older results.

use std::sync::Arc;

use egui::{Align, Layout, RichText, Ui};

use super::plane_tip::planes_of;
use crate::app::inspector::planes::Planes;
use crate::app::{Command, Source, State};

/// Returns the planes to show under a notice where they are old or none wins; without an analysis, shows why there
/// is none.
pub fn planes_or_reason(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<Arc<Planes>> {
    let planes = planes_of(ui.ctx(), state);
    match &planes {
        Some(planes) => {
            if_stale(ui, state, commands);
            if_no_plane(ui, &planes.analysis);
        }
        None => nothing_to_show(ui, state, commands),
    }
    planes
}

/// Shows the reason why there is no analysis.
pub fn nothing_to_show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let (text, can_resume) = reason(state);
    in_the_middle(ui, |ui| {
        ui.label(text);
        if can_resume && ui.button("Analyze").clicked() {
            commands.push(Command::Resume);
        }
    });
}

/// Shows a notice in place of a panel that blind mode hides.
pub fn hidden(ui: &mut Ui) {
    in_the_middle(ui, |ui| {
        ui.label("Hidden in blind mode (Shift+B).");
    });
}

fn in_the_middle(ui: &mut Ui, add_contents: impl FnOnce(&mut Ui)) {
    let height = ui.available_height();
    ui.allocate_ui_with_layout(ui.available_size(), Layout::top_down(Align::Center), |ui| {
        ui.add_space((0.5 * height - 24.0).clamp(4.0, 160.0));
        add_contents(ui);
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
        // With its reason and the ways out in the view, once.
        (Some(_), Some(_)) if state.is_viewpoint_inside => ("Not analyzed: see the view.".into(), false),
        (Some(_), Some(problem)) => (problem, false),
        (Some(name), None) if state.was_cancelled => (format!("The analysis of {name} was stopped."), true),
        (Some(name), None) => (format!("{name} is being analyzed."), false),
    }
}

/// Shows a line above results that are older than the settings.
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

/// Returns the opacity of drawn results: older ones are faded, while texts stay as they are.
pub fn opacity(state: &State) -> f32 {
    if state.is_stale { 0.45 } else { 1.0 }
}

/// Shows the reason why no plane can be the symmetry plane, if none can.
pub fn if_no_plane(ui: &mut Ui, analysis: &crate::method::Analysis) {
    if let Err(none) = &analysis.best {
        ui.label(crate::text::sentence(&none.to_string()));
    }
}
