//! The panels about the open clouds as a set: table, charts, gallery, and the map over settings.

mod bar;
mod charts;
mod cloud_table;
mod filters;
mod gallery;
pub(in crate::ui) mod keys;
mod sweep;
mod tagging;

use egui::Ui;

use crate::app::{Command, State};
use crate::ui::pane::Pane;

/// A request of a panel to the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PanelRequest {
    /// Bring the view to the front: the user chose a cloud.
    ShowView,
    /// Ask for the folder to save results in.
    SaveResults,
    /// Copy the command line of the same evaluation to the clipboard.
    CopyCommandLine,
}

/// Draws one of the panels.
pub fn show(ui: &mut Ui, pane: Pane, state: &State, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    match pane {
        Pane::Table => cloud_table::show(ui, state, commands),
        Pane::Charts => charts::show(ui, state, commands),
        Pane::Gallery => gallery::show(ui, state, commands),
        Pane::Sweep => sweep::show(ui, state, commands),
        _ => None,
    }
}
