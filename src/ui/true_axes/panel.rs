//! The panel of true axes: the annotator, the state of the files, the own axis, and the other annotators'.

use egui::{Button, ComboBox, ProgressBar, RichText, Role as Spoken, TextEdit, Ui, WidgetInfo};

use super::{annotators, own_axis, say};
use crate::annotate::{Author, Role};
use crate::app::true_axes::Saving;
use crate::app::{Command, State, TrueAxesCommand};
use crate::text::sentence;
use crate::ui::widgets::controls::{caution, hint};

/// Shows the panel, and appends the commands of its controls.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.y = 4.0;
    who(ui, state, commands);
    mode(ui, state, commands);
    files(ui, state, commands);
    progress(ui, state, commands);
    own_axis::show(ui, state, commands);
    annotators::show(ui, state, commands);
}

fn who(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    let memory = ui.make_persistent_id("name");
    let mut typed = ui
        .data(|data| data.get_temp::<String>(memory))
        .unwrap_or_else(|| annotating.name.clone());
    ui.horizontal(|ui| {
        let label = ui.label("Annotator");
        let role_width = 106.0;
        let field = TextEdit::singleline(&mut typed)
            .hint_text("Your name")
            .desired_width((ui.available_width() - role_width).max(60.0));
        let response = ui
            .add(field)
            .labelled_by(label.id)
            .on_hover_text("It stands in the axis files and in their names.");
        if response.lost_focus() && Author::annotator(&typed).is_ok() {
            if typed.trim() != annotating.name {
                say(commands, TrueAxesCommand::Name(typed.clone()));
            }
            ui.data_mut(|data| data.remove::<String>(memory));
        } else if response.has_focus() || typed.trim() != annotating.name {
            ui.data_mut(|data| data.insert_temp(memory, typed.clone()));
        }
        let name = |role| match role {
            Role::Annotator => "annotator",
            Role::Adjudicator => "adjudicator",
        };
        let combo = ComboBox::from_id_salt("role")
            .selected_text(name(annotating.role))
            .width(role_width - 10.0)
            .show_ui(ui, |ui| {
                for role in [Role::Annotator, Role::Adjudicator] {
                    let is_on = annotating.role == role;
                    if ui.selectable_label(is_on, name(role)).clicked() && !is_on {
                        say(commands, TrueAxesCommand::Role(role));
                    }
                }
            });
        combo
            .response
            .on_hover_text(
                "An annotator's axis is one opinion among several; the adjudicator's is the one that counts, one \
                 a cloud.",
            )
            .widget_info(|| WidgetInfo::labeled(Spoken::ComboBox, true, "Role"));
    });
    if let Some(problem) = Author::annotator(&typed)
        .err()
        .filter(|_| !typed.trim().is_empty())
    {
        caution(ui, sentence(&problem.to_string()));
    }
}

fn mode(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    ui.horizontal(|ui| {
        let text = if annotating.is_editing {
            "Setting the axis"
        } else {
            "Set the axis"
        };
        let button = Button::selectable(annotating.is_editing, text).frame_when_inactive(true);
        let tip = "Edit mode (T): the left button sets the axis in the view, and nothing else does.";
        let can = annotating.is_editing || state.shown().is_some();
        if ui.add_enabled(can, button).on_hover_text(tip).clicked() {
            say(commands, TrueAxesCommand::Edit(!annotating.is_editing));
        }
        let mut is_blind = annotating.is_blind;
        let tip = "Hides the computed plane and axis, the scores, and everybody else's axes (Shift+B). An axis \
                   that was set without having seen them is recorded as blind.";
        if ui.checkbox(&mut is_blind, "Blind").on_hover_text(tip).changed() {
            say(commands, TrueAxesCommand::Blind(is_blind));
        }
    });
    if state.source().is_some_and(|source| !source.is_file()) {
        hint(
            ui,
            "This cloud lies in no folder in which its axis could be kept: open one from a file.",
        );
    }
}

/// Shows whether the axis is saved, and the notices about its files.
fn files(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    if annotating.is_editing && annotating.subject.is_some() {
        let file = annotating.axis_file.as_ref().and_then(|path| path.file_name());
        let file = file.map(|name| name.to_string_lossy().into_owned());
        match &annotating.saving {
            Saving::Opening => {
                hint(ui, "Opening the axis file …");
            }
            Saving::Nothing => {
                hint(ui, "No axis yet: nothing to save.");
            }
            Saving::Saving => {
                hint(ui, "Saving …");
            }
            Saving::Saved => {
                let text = file.map_or("Saved.".into(), |file| format!("Saved in {file}"));
                let path = annotating.axis_file.as_ref().map(|p| p.display().to_string());
                hint(ui, text).on_hover_text(path.unwrap_or_default());
            }
            Saving::Failed(problem) => {
                let what = if annotating.judgment().is_some() {
                    "Not saved"
                } else {
                    "Axes cannot be saved here"
                };
                failure(ui, &format!("{what}: {problem}"), commands);
            }
        }
    }
    if !annotating.unsaved_elsewhere.is_empty() {
        let names: Vec<String> = annotating
            .unsaved_elsewhere
            .iter()
            .map(|path| {
                path.file_name()
                    .unwrap_or(path.as_os_str())
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        failure(
            ui,
            &format!("Not saved yet: the axes of {}.", names.join(", ")),
            commands,
        );
    }
    for notice in &annotating.notices {
        caution(ui, notice);
    }
}

fn failure(ui: &mut Ui, text: &str, commands: &mut Vec<Command>) {
    ui.label(RichText::new(text).color(ui.visuals().error_fg_color));
    ui.horizontal(|ui| {
        if ui.button("Try again").on_hover_text("F6").clicked() {
            say(commands, TrueAxesCommand::TryAgain);
        }
        hint(ui, "It is kept until then.");
    });
}

fn progress(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    let Some((set, count)) = annotating.progress().filter(|&(_, count)| count > 1) else {
        return;
    };
    ui.horizontal(|ui| {
        let share = set as f32 / count as f32;
        let bar = ProgressBar::new(share).text(format!("{set} of {count} set"));
        ui.add(bar.desired_width((ui.available_width() - 130.0).max(60.0)));
        if ui
            .add_enabled(set < count, Button::new("Next without"))
            .on_hover_text("The next cloud without an axis of yours (Ctrl+PageDown)")
            .clicked()
        {
            say(commands, TrueAxesCommand::NextWithout);
        }
    });
}
