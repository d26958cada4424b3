//! The bar at the bottom: what is being done and how far it is, what came out, and what went wrong.

use egui::{ProgressBar, RichText};

use crate::app::{Command, State};
use crate::method::Stage;
use crate::method::axis_error_rad;
use crate::view::lead_in_words;

/// What a stage is called while it runs.
pub fn stage_name(stage: Stage) -> &'static str {
    match stage {
        Stage::Filters => "Filters",
        Stage::Normals => "Normals",
        Stage::Center => "Fruit center",
        Stage::PlaneTerms => "Candidate planes",
        Stage::Scores => "Scores",
    }
}

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
            if ui
                .button("Cancel")
                .on_hover_text("Call the analysis off (Esc)")
                .clicked()
            {
                commands.push(Command::Cancel);
            }
            let name = progress.stage.map_or("Reading", stage_name);
            let share = progress.share as f32;
            let seconds = progress.elapsed.as_secs();
            let text = if seconds >= 2 {
                format!("{name} · {:.0} % · {seconds} s", 100.0 * share)
            } else {
                format!("{name} · {:.0} %", 100.0 * share)
            };
            ui.add(ProgressBar::new(share).desired_width(240.0).text(text));
        } else if state.was_cancelled {
            ui.label("The analysis was called off.");
            if ui
                .button("Analyze")
                .on_hover_text("Analyze after all (F5)")
                .clicked()
            {
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
        ui.label(RichText::new("Nothing is analyzed.").weak());
        return;
    };
    let analysis = &walked.analysis;
    let points = analysis.surface.len();
    let used = format!("{points} points used, in {}", walked.fruit.unit.symbol());
    if state.true_axes.is_blind {
        ui.label(format!("{used} · blind: results are hidden"));
        return;
    }
    let mut parts = vec![used, format!("preset {}", analysis.params.preset_name())];
    match (&analysis.axis, state.reference()) {
        (Some(axis), Some(reference)) => parts.push(format!(
            "best axis {:.1}° off the {} axis",
            axis_error_rad(axis, reference).to_degrees(),
            reference_name(&reference.source.name())
        )),
        (Some(_), None) => parts.push("no reference axis".into()),
        (None, _) => parts.push("no axis".into()),
    }
    ui.label(parts.join(" · "));
    if let Some(lead) = lead_in_words(analysis) {
        ui.add(egui::Label::new(RichText::new(lead).weak()).truncate());
    }
}

/// A reference's source in words.
pub fn reference_name(source: &str) -> &str {
    match source {
        "simulation" => "simulated",
        "peduncle" => "peduncle's",
        "peduncle-direction" => "peduncle's own",
        "adjudicated" => "adjudicated",
        other if other.starts_with("annotators:") => "annotators' mean",
        other => other.strip_prefix("annotator:").unwrap_or(other),
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
