//! The questions before a file is replaced, or used as the peduncle.

use egui::{Align2, vec2};

use crate::app::peduncle::Question;
use crate::app::{Command, PeduncleCommand, Source, State};
use crate::fruit::PeduncleChoice;

/// Shows the open question, if there is one.
pub(in crate::ui) fn show(ctx: &egui::Context, state: &State, commands: &mut Vec<Command>) {
    let Some(question) = &state.peduncle.question else {
        return;
    };
    let title = match question {
        Question::Replace(_) => "Replace the file?",
        Question::Offer(_) => "Is this the peduncle?",
    };
    let mut say = |command: PeduncleCommand| commands.push(Command::Peduncle(command));
    let mut opened = None;
    egui::Window::new(title)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, -40.0))
        .show(ctx, |ui| {
            ui.set_max_width(420.0);
            match question {
                Question::Replace(path) => {
                    ui.label(format!(
                        "{} already exists. It may hold somebody's work.",
                        path.display()
                    ));
                    ui.add_space(6.0);
                    ui.horizontal(|ui| {
                        if ui.button("Replace").clicked() {
                            say(PeduncleCommand::SaveAs(path.clone()));
                        }
                        if ui.button("Keep it").clicked() {
                            say(PeduncleCommand::Dismiss);
                        }
                    });
                }
                Question::Offer(path) => {
                    let cloud = state.source().map(Source::name).unwrap_or_default();
                    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
                    ui.label(format!("{name} may be the peduncle of {cloud}."));
                    ui.add_space(6.0);
                    ui.horizontal(|ui| {
                        if ui.button("Use as its peduncle").clicked() {
                            let choice = PeduncleChoice::File(path.clone());
                            say(PeduncleCommand::Choose(choice));
                        }
                        if ui.button("Open as a cloud").clicked() {
                            say(PeduncleCommand::Dismiss);
                            opened = Some(path.clone());
                        } else if ui.button("Neither").clicked() {
                            say(PeduncleCommand::Dismiss);
                        }
                    });
                }
            }
        });
    commands.extend(opened.map(|path| Command::Open(vec![path])));
}
