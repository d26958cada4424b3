//! The two references that a peduncle gives, the angle between them, and both of the paper's experiments.

use egui::{Color32, Grid, Label, Ui};

use crate::app::peduncle::Errors;
use crate::app::{Command, PeduncleCommand, State};
use crate::evaluate::peduncle_disagreement_deg;
use crate::method::AxisSource;
use crate::method::axis_error_rad;
use crate::text::sentence;
use crate::ui::widgets::controls::{caution, checkbox, hint};
use crate::ui::widgets::progress::stage_progress;
use crate::view::{Overlay, reference_color};

/// The angle between the references from which neither is to be trusted blindly: about twice the published errors.
const FAR_APART_DEG: f64 = 15.0;

/// Shows both references with the axis's error against each.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    // Both show computed results.
    if state.true_axes.is_blind {
        return;
    }
    let Some(walked) = &state.walked else { return };
    let Some(peduncle) = &walked.fruit.peduncle else {
        return;
    };
    ui.add_space(2.0);
    Grid::new("peduncle references")
        .num_columns(2)
        .spacing([8.0, 3.0])
        .show(ui, |ui| {
            for (source, text, tip) in [
                (
                    AxisSource::Peduncle,
                    "center to its mean",
                    "The reference of § 3.2: from the fruit center through the mean of the peduncle's points. It is \
                     wrong if the center is.",
                ),
                (
                    AxisSource::PeduncleDirection,
                    "its own direction",
                    "The line along which the peduncle's points spread most. It does not depend on the center, \
                     but a bent peduncle departs from the fruit's axis.",
                ),
            ] {
                let reference = state.references.iter().find(|r| r.source == source);
                // The reference of the errors is drawn in white.
                let is_chosen = state.reference().is_some_and(|r| r.source == source);
                let [r, g, b, _] = if is_chosen {
                    [255; 4]
                } else {
                    reference_color(&source)
                };
                ui.horizontal(|ui| {
                    let (rect, _) = ui.allocate_exact_size(egui::vec2(10.0, 10.0), egui::Sense::hover());
                    // White needs an outline on a light background.
                    let outline = egui::Stroke::new(1.0, ui.visuals().weak_text_color());
                    let fill = Color32::from_rgb(r, g, b);
                    ui.painter()
                        .rect(rect, 2.0, fill, outline, egui::StrokeKind::Inside);
                    ui.add(Label::new(text)).on_hover_text(tip);
                });
                let error = reference
                    .zip(walked.analysis.axis.as_ref())
                    .map(|(reference, axis)| axis_error_rad(axis, reference).to_degrees());
                ui.label(match (reference, error) {
                    (None, _) => "none".into(),
                    (_, None) => "no axis".into(),
                    (_, Some(error)) => format!("{error:.1}° off"),
                });
                ui.end_row();
            }
        });
    let mut style = state.style.clone();
    let mut shows_all = style.overlays.has(Overlay::References);
    let tip =
        "Draw every reference axis in the view, dashed, besides the one that errors are measured against";
    if checkbox(ui, &mut shows_all, "Show all references", tip) {
        style.overlays.set(Overlay::References, shows_all);
        commands.push(Command::Style(Box::new(style)));
    }
    match peduncle_disagreement_deg(&state.references) {
        Some(apart) if apart >= FAR_APART_DEG => {
            caution(
                ui,
                format!(
                    "The two are {apart:.1}° apart: an error against either says as much of the reference as of the \
                     method."
                ),
            );
        }
        Some(apart) => {
            hint(ui, format!("The two are {apart:.1}° apart."));
        }
        None => {
            if let Err(why) = peduncle.direction_axis(walked.analysis.center) {
                hint(ui, sentence(&why.to_string()));
            }
        }
    }
}

/// Shows the errors with and without the peduncle.
pub(in crate::ui) fn beside(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    // Both show computed results.
    if state.true_axes.is_blind {
        return;
    }
    let picking = &state.peduncle;
    let has_peduncle = state
        .walked
        .as_ref()
        .is_some_and(|walked| walked.fruit.peduncle.is_some());
    let mut wants = picking.wants_beside;
    let tip = "Analyze this cloud both ways, as the paper's two experiments do, and show both errors. Unchecking cancels it.";
    let response = ui
        .add_enabled(
            has_peduncle || wants,
            egui::Checkbox::new(&mut wants, "Compare with and without"),
        )
        .on_hover_text(tip);
    if response.changed() {
        commands.push(Command::Peduncle(PeduncleCommand::Compare(wants)));
    }
    if !picking.wants_beside || !has_peduncle {
        return;
    }
    let Some(beside) = &picking.beside else {
        if let Some(progress) = picking.beside_progress {
            ui.add(stage_progress(&progress));
        }
        return;
    };
    let source = state.reference().map(|reference| &reference.source);
    let words = |errors: &Errors| match errors {
        Err(why) => why.clone(),
        Ok(errors) => {
            let of = errors.iter().find(|(s, _)| Some(s) == source);
            of.map_or("no reference".into(), |(source, error)| {
                format!("{error:.1}° off {}", source.in_words())
            })
        }
    };
    Grid::new("with and without")
        .num_columns(2)
        .spacing([8.0, 3.0])
        .show(ui, |ui| {
            for (text, errors) in [
                ("with the peduncle", &beside.with),
                ("without the peduncle", &beside.without),
            ] {
                ui.label(text);
                ui.label(words(errors));
                ui.end_row();
            }
        });
}
