//! The parameters of the analysis: every number and choice that determines the result.

mod center;
mod cloud;
mod filters;
mod peduncle;
mod scoring;

use egui::Ui;

use crate::app::{Command, State};
use crate::method::{Params, Preset};
use crate::ui::widgets::controls::{Edit, caution};

/// Shows the parameters.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let mut edit = Edit::of(&state.settings.request);
    ui.spacing_mut().item_spacing.y = 4.0;
    reading(ui, state, commands);
    ui.add_space(4.0);
    scoring::grid_and_weight(ui, &mut edit);
    ui.add_space(4.0);
    scoring::show(ui, &mut edit);
    center::show(ui, state, &mut edit, commands);
    cloud::show(ui, state, &mut edit);
    filters::show(ui, &mut edit);
    peduncle::show(ui, state, &mut edit, commands);
    edit.say(commands);
}

/// Shows the two presets, each a reading of the paper.
fn reading(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let chosen = state.settings.request.params.preset();
    ui.label("Reading of the paper").on_hover_text(
        "The interpretation of Eq. 3 (the fruit center) and § 2.5 (how scores are added up). Sets the \
         center's method, the score and the least share of partners; everything else stays.",
    );
    ui.horizontal(|ui| {
        let each = 0.5 * (ui.available_width() - ui.spacing().item_spacing.x);
        for (preset, text, tip) in [
            (
                Preset::AsIntended,
                "As intended",
                "By the words around the equations: the point equidistant from the surface, the mean \
                 score, and only planes for which at least 30 % of the points have a partner.",
            ),
            (
                Preset::AsPrinted,
                "As printed",
                "By the equations themselves: the RMS distance of Eq. 3, the sum of the scores, and every plane in \
                 the running. Planes that leave hardly a point with a partner win.",
            ),
        ] {
            let button = egui::Button::selectable(chosen == Some(preset), text)
                .frame_when_inactive(true)
                .min_size(egui::vec2(each, ui.spacing().interact_size.y));
            if ui.add(button).on_hover_text(tip).clicked() && chosen != Some(preset) {
                commands.push(Command::UsePreset(preset));
            }
        }
    });
    if chosen.is_none() {
        caution(
            ui,
            "Custom: neither reading. The center's method, the score or the least share of partners was \
             changed by itself.",
        );
    }
}

/// Returns the parameters of a preset, with the paper's numbers.
fn defaults(preset: Preset) -> Params {
    Params::new(preset, crate::geometry::Unit::Centimeter)
}
