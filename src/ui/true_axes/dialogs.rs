//! The dialogs of edit mode: the annotator's name, and closing a window with axes that could not be saved.

use egui::{Id, Key, Modal, RichText, TextEdit};

use super::say;
use crate::annotate::Author;
use crate::app::true_axes::Saving;
use crate::app::{Command, State, TrueAxesCommand};
use crate::text::sentence;

/// Shows the dialog for the annotator's name while the state asks for it.
pub(in crate::ui) fn ask_name(ctx: &egui::Context, state: &State, commands: &mut Vec<Command>) {
    if !state.true_axes.asks_name {
        return;
    }
    let memory = Id::unique("annotator's name that is being typed");
    let mut typed = ctx
        .data(|data| data.get_temp::<String>(memory))
        .unwrap_or_else(|| state.true_axes.name.clone());
    let modal = Modal::new(Id::unique("annotator's name")).show(ctx, |ui| {
        ui.set_max_width(380.0);
        ui.heading("Who sets the axis?");
        ui.add_space(4.0);
        let label = ui.label("Your name, as it is to stand in the axis files beside the clouds:");
        let field = TextEdit::singleline(&mut typed).desired_width(f32::INFINITY);
        let response = ui.add(field).labelled_by(label.id);
        response.request_focus();
        let problem = Author::annotator(&typed).err();
        if let Some(problem) = problem.filter(|_| !typed.trim().is_empty()) {
            let text = RichText::new(sentence(&problem.to_string()));
            ui.label(text.color(ui.visuals().error_fg_color));
        }
        let mut is_blind = state.true_axes.is_blind;
        let tip =
            "Hide everything computed and the axes of other annotators, so that they do not draw your hand.";
        if ui
            .checkbox(&mut is_blind, "Set axes blind")
            .on_hover_text(tip)
            .changed()
        {
            say(commands, TrueAxesCommand::Blind(is_blind));
        }
        ui.add_space(8.0);
        let is_entered = ui.input(|i| i.key_pressed(Key::Enter));
        ui.horizontal(|ui| {
            let begin = ui.add_enabled(problem.is_none(), egui::Button::new("Begin"));
            let is_done = problem.is_none() && (begin.clicked() || is_entered);
            (is_done, ui.button("Cancel").clicked())
        })
        .inner
    });
    let (is_done, is_left) = modal.inner;
    if is_done {
        say(commands, TrueAxesCommand::Name(typed.clone()));
    } else if is_left || modal.should_close() {
        say(commands, TrueAxesCommand::WithoutName);
    }
    ctx.data_mut(|data| {
        if is_done || is_left {
            data.remove::<String>(memory);
        } else {
            data.insert_temp(memory, typed);
        }
    });
}

/// The decision about a window that is to be closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::ui) enum CloseDecision {
    /// The window waits for files that are being written, or for an answer.
    Wait,
    /// The window stays open.
    Stay,
    /// The window closes.
    Close,
}

impl CloseDecision {
    /// Decides, by a dialog if an axis could not be saved.
    pub(in crate::ui) fn of(ctx: &egui::Context, state: &State, commands: &mut Vec<Command>) -> Self {
        let annotating = &state.true_axes;
        if !annotating.is_unsaved() {
            return Self::Close;
        }
        if !annotating.has_failed() || matches!(annotating.saving, Saving::Saving) {
            return Self::Wait;
        }
        let modal = Modal::new(Id::unique("unsaved axes")).show(ctx, |ui| {
            ui.set_max_width(440.0);
            ui.heading("Axes are not saved");
            ui.add_space(4.0);
            if let Saving::Failed(problem) = &annotating.saving {
                ui.label(problem);
            }
            for path in &annotating.unsaved_elsewhere {
                ui.label(format!("The axis of {} is not saved.", path.display()));
            }
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                if ui.button("Try again").clicked() {
                    say(commands, TrueAxesCommand::TryAgain);
                }
                let stays = ui.button("Keep the window open").clicked();
                let text = RichText::new("Close and lose them").color(ui.visuals().error_fg_color);
                (stays, ui.button(text).clicked())
            })
            .inner
        });
        match modal.inner {
            (_, true) => Self::Close,
            (true, _) => Self::Stay,
            _ if modal.should_close() => Self::Stay,
            _ => Self::Wait,
        }
    }
}
