//! The keyboard actions on the open clouds as a set.

use egui::{Key, Modifiers};

use crate::app::many::ManyCommand;
use crate::app::{Command, State};
use crate::ui::action::{Action, Group, WindowAct};
use crate::ui::pane::Pane;

/// Returns the actions.
pub(in crate::ui) fn actions(state: &State) -> Vec<Action> {
    let folder = &state.many;
    let pane = |title: &str, pane, key| {
        Action::window(title, Group::Window, WindowAct::Show(pane)).key(Modifiers::COMMAND, key)
    };
    let has_files = folder.rows.iter().any(|row| row.path.is_some());
    let evaluation = if folder.progress.is_some() {
        Action::app(
            Group::File,
            "Stop evaluating the clouds",
            Command::Many(ManyCommand::Cancel),
        )
    } else {
        Action::app(
            Group::File,
            "Evaluate all open clouds",
            Command::Many(ManyCommand::Evaluate),
        )
        // Also if no row is missing: files may have changed.
        .when(has_files)
    };
    let worse = |title: &str, by, key| {
        Action::app(Group::File, title, Command::Many(ManyCommand::GoWorse(by)))
            .key(Modifiers::SHIFT, key)
            .when(folder.rows.len() > 1)
            .repeating()
    };
    vec![
        Action::window(
            "Save the results of all clouds …",
            Group::File,
            WindowAct::SaveResults,
        )
        .key(Modifiers::COMMAND | Modifiers::SHIFT, Key::E)
        .when(has_files && folder.missing == 0),
        Action::window(
            "Copy the command line that evaluates all clouds",
            Group::File,
            WindowAct::CopyEvaluation,
        )
        .when(has_files),
        evaluation.key(Modifiers::COMMAND, Key::E),
        worse("Cloud with the next smaller error", -1, Key::PageUp),
        worse("Cloud with the next larger error", 1, Key::PageDown),
        pane("Panel: View", Pane::View, Key::Num1),
        pane("Panel: Table", Pane::Table, Key::Num2).key(Modifiers::COMMAND, Key::T),
        pane("Panel: Charts", Pane::Charts, Key::Num3),
        pane("Panel: Gallery", Pane::Gallery, Key::Num4),
        pane("Panel: Sweep", Pane::Sweep, Key::Num5),
    ]
}
