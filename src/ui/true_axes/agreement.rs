//! Everybody's axes of this cloud and of all open ones, how far they agree, and the decision.

use egui::{Button, Grid, ProgressBar, RichText, Sense, Ui, vec2};

use super::{say, stage::other_color};
use crate::annotate::{Annotation, CloudAgreement, FAR_OFF_DEG, Role};
use crate::app::true_axes::{Decision, SetReport};
use crate::app::{Command, State, TrueAxesCommand};
use crate::geometry::angle_between_lines_rad;
use crate::ui::widgets::controls::{caution, hint, section};
use crate::ui::widgets::marks::color32;

/// Rows of a table that are shown before it has to be opened.
const ROWS: usize = 12;

/// Shows it, unless blind mode hides it.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    ui.separator();
    if annotating.is_blind {
        hint(ui, "Everybody else's axes are hidden in blind mode.");
        return;
    }
    section(ui, "This cloud", true, false, |ui| cloud(ui, state, commands));
    section(ui, "All open clouds", false, false, |ui| set(ui, state, commands));
}

fn cloud(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    if annotating.annotations.is_empty() {
        hint(ui, "Nobody has set an axis of this cloud yet.");
        return;
    }
    let mut shows_all = annotating.shows_all;
    let tip = "Draws everybody's axes in the view, with their names (W)";
    if ui
        .checkbox(&mut shows_all, "Show all in the view")
        .on_hover_text(tip)
        .changed()
    {
        say(commands, TrueAxesCommand::ShowAll(shows_all));
    }
    let agreement = annotating.agreement.as_ref();
    people(ui, &annotating.annotations, agreement);
    let Some(agreement) = agreement else { return };
    pairs(ui, agreement);
    decision(ui, agreement, commands);
}

fn people(ui: &mut Ui, annotations: &[Annotation], agreement: Option<&CloudAgreement>) {
    let mean = agreement
        .and_then(|a| a.mean.as_ref())
        .filter(|mean| mean.count > 1);
    Grid::new("annotators")
        .num_columns(4)
        .striped(true)
        .spacing(vec2(10.0, 3.0))
        .show(ui, |ui| {
            ui.label("");
            ui.weak("set by");
            ui.weak("off mean")
                .on_hover_text("The angle to the annotators' mean axis, in degrees");
            ui.weak("sure")
                .on_hover_text("The annotator's confidence, from 0 to 1");
            ui.end_row();
            for (i, annotation) in annotations.iter().enumerate() {
                let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
                ui.painter()
                    .circle_filled(rect.center(), 4.5, color32(other_color(annotation, i)));
                let name = &annotation.annotator;
                let is_far = agreement.is_some_and(|a| a.far_off.contains(name));
                let text = match annotation.role {
                    Role::Adjudicator => format!("{name}, adjudicated"),
                    Role::Annotator if is_far => format!("{name}: far off"),
                    Role::Annotator => name.clone(),
                };
                let mut text = RichText::new(text);
                if is_far {
                    text = text.color(ui.visuals().warn_fg_color);
                }
                let judgment = &annotation.judgment;
                let mut tip = format!("{}, {}", judgment.method.name(), annotation.modified);
                if judgment.blind {
                    tip.push_str(", blind");
                }
                if !judgment.note.is_empty() {
                    tip.push('\n');
                    tip.push_str(&judgment.note);
                }
                ui.label(text).on_hover_text(tip);
                let angle = annotation.ends().zip(mean).map(|(ends, mean)| {
                    angle_between_lines_rad(ends.direction(), mean.direction).to_degrees()
                });
                match (annotation.ends(), angle) {
                    (None, _) => ui.label("cannot tell"),
                    (_, Some(angle)) => ui.label(format!("{angle:.1}°")),
                    (_, None) => ui.label("–"),
                };
                let sure = judgment
                    .confidence
                    .map_or("–".into(), |c| format!("{:.2}", c.value()));
                ui.label(sure);
                ui.end_row();
            }
        });
}

fn pairs(ui: &mut Ui, agreement: &CloudAgreement) {
    if agreement.pairs.is_empty() {
        return;
    }
    ui.add_space(2.0);
    hint(ui, "Angles between annotators:");
    Grid::new("pairs")
        .num_columns(3)
        .spacing(vec2(10.0, 2.0))
        .show(ui, |ui| {
            for pair in &agreement.pairs {
                ui.label(format!("{} and {}", pair.a, pair.b));
                let mut angle = RichText::new(format!("{:.1}°", pair.angle_deg));
                if pair.angle_deg > FAR_OFF_DEG {
                    angle = angle.color(ui.visuals().warn_fg_color);
                }
                ui.label(angle);
                ui.label(if pair.is_opposite { "opposite ends" } else { "" });
                ui.end_row();
            }
        });
    if let Some(mean) = &agreement.mean {
        hint(
            ui,
            format!(
                "Mean of {}: spread {:.1}° (root mean square)",
                mean.count, mean.spread_deg
            ),
        );
    } else {
        caution(ui, "They contradict one another: there is no mean.");
    }
}

fn decision(ui: &mut Ui, agreement: &CloudAgreement, commands: &mut Vec<Command>) {
    ui.add_space(2.0);
    let decided = match &agreement.adjudicator {
        Some(name) if agreement.adjudicated.is_some() => format!("Adjudicated by {name}. Decide again:"),
        Some(name) => format!("{name} decided that it cannot be told. Decide again:"),
        None => "The axis that counts (adjudication):".into(),
    };
    hint(ui, decided);
    ui.horizontal_wrapped(|ui| {
        let mean = Button::new("Take the mean");
        if ui.add_enabled(agreement.mean.is_some(), mean).clicked() {
            say(commands, TrueAxesCommand::Decide(Decision::Mean));
        }
        for name in &agreement.annotators {
            if ui.button(format!("Take {name}'s")).clicked() {
                say(commands, TrueAxesCommand::Decide(Decision::Of(name.clone())));
            }
        }
        let tip = "Enters edit mode as the adjudicator";
        if ui.button("Set by hand").on_hover_text(tip).clicked() {
            say(commands, TrueAxesCommand::Decide(Decision::ByHand));
        }
    });
}

fn set(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    if let Some(share) = annotating.set_progress {
        ui.horizontal(|ui| {
            ui.add(ProgressBar::new(share as f32).desired_width((ui.available_width() - 80.0).max(60.0)));
            if ui.button("Cancel").clicked() {
                say(commands, TrueAxesCommand::CancelSet);
            }
        });
    } else {
        let text = if annotating.set.is_some() {
            "Compare again"
        } else {
            "Compare the annotators"
        };
        let tip = "Reads the axis files of all open clouds";
        if ui.button(text).on_hover_text(tip).clicked() {
            say(commands, TrueAxesCommand::CompareSet);
        }
    }
    if let Some(report) = &annotating.set {
        summary(ui, state, report, commands);
    }
}

fn degrees(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| format!("{value:.1}°"))
}

fn summary(ui: &mut Ui, state: &State, report: &SetReport, commands: &mut Vec<Command>) {
    let set = &report.agreement;
    if set.annotators.is_empty() {
        hint(ui, "No open cloud has an axis set by hand.");
        return;
    }
    Grid::new("annotators of the set")
        .striped(true)
        .spacing(vec2(10.0, 3.0))
        .show(ui, |ui| {
            ui.weak("annotator");
            ui.weak("clouds")
                .on_hover_text("Clouds with an axis; those that could not be told are not counted");
            ui.weak("off others")
                .on_hover_text("The mean angle to the other annotators");
            ui.weak("far off")
                .on_hover_text(format!("Clouds more than {FAR_OFF_DEG}° from most others"));
            ui.end_row();
            for one in &set.annotators {
                ui.label(&one.annotator);
                ui.label(one.clouds.to_string());
                ui.label(degrees(one.mean_deg));
                ui.label(one.far_off.to_string());
                ui.end_row();
            }
        });
    if !set.pairs.is_empty() {
        pairs_of_set(ui, report);
    }
    worst(ui, state, report, commands);
    for warning in &report.warnings {
        caution(ui, warning);
    }
}

fn pairs_of_set(ui: &mut Ui, report: &SetReport) {
    ui.add_space(4.0);
    Grid::new("pairs of the set")
        .striped(true)
        .spacing(vec2(10.0, 3.0))
        .show(ui, |ui| {
            ui.weak("pair");
            ui.weak("mean")
                .on_hover_text("The mean of the angles between their axes");
            ui.weak("largest").on_hover_text("The largest of these angles");
            ui.weak("clouds").on_hover_text("Clouds with an axis of both");
            ui.end_row();
            for pair in &report.agreement.pairs {
                let names = format!("{} and {}", pair.a, pair.b);
                match pair.opposite {
                    0 => ui.label(names),
                    count => ui
                        .label(format!("{names} (!)"))
                        .on_hover_text(format!("They call opposite ends the peduncle's: {count} times")),
                };
                ui.label(format!("{:.1}°", pair.mean_deg));
                ui.label(format!("{:.1}°", pair.largest_deg));
                ui.label(pair.clouds.to_string());
                ui.end_row();
            }
        });
}

/// The clouds about which annotators disagree most; a click opens one.
fn worst(ui: &mut Ui, state: &State, report: &SetReport, commands: &mut Vec<Command>) {
    let mut worst: Vec<(f64, &CloudAgreement)> = report
        .agreement
        .clouds
        .iter()
        .filter_map(|cloud| Some((cloud.largest_deg?, cloud)))
        .collect();
    if worst.is_empty() {
        return;
    }
    // Few have several annotators, and the list is only made while the section is open.
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    hint(ui, "Where they disagree most:");
    for (angle, cloud) in worst.into_iter().take(ROWS) {
        let far = if cloud.far_off.is_empty() {
            String::new()
        } else {
            format!(" · far off: {}", cloud.far_off.join(", "))
        };
        let button = Button::new(format!("{} · {angle:.1}°{far}", cloud.file)).truncate();
        if ui.add(button).on_hover_text("Opens this cloud").clicked()
            && let Some(place) = state
                .entries
                .iter()
                .position(|entry| entry.source.name() == cloud.file)
        {
            commands.push(Command::Show(place));
        }
    }
}
