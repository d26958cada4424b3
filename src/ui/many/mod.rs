//! The open clouds as a set: a table, charts, a gallery and a map over settings, each a panel.

mod bar;
mod charts;
mod filters;
mod gallery;
pub(in crate::ui) mod keys;
mod sweep;
mod table;
mod tagging;

use egui::Ui;

use crate::app::{Command, State};
use crate::ui::pane::Pane;

/// What a panel of clouds cannot do itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FolderAnswer {
    /// The view is wanted in front: a cloud was chosen to be looked at.
    ShowView,
    /// Somebody wants to say where results are to be saved.
    SaveResults,
    /// The command line that evaluates the same is wanted on the clipboard.
    CopyCommandLine,
}

/// Draws one of the panels; says whether the view is wanted.
pub fn show(ui: &mut Ui, pane: Pane, state: &State, commands: &mut Vec<Command>) -> Option<FolderAnswer> {
    match pane {
        Pane::Table => table::show(ui, state, commands),
        Pane::Charts => charts::show(ui, state, commands),
        Pane::Gallery => gallery::show(ui, state, commands),
        Pane::Sweep => sweep::show(ui, state, commands),
        _ => None,
    }
}
