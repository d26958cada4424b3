//! The actions on the peduncle, with their keys.

use egui::Key;

use crate::app::{Command, PeduncleCommand, State, Tool};
use crate::ui::action::{Action, CTRL, Group, NONE, SHIFT};

/// The factor by which a key sizes the brush.
const BRUSH_STEP: f64 = 1.25;

/// Returns the actions in the current state.
pub(in crate::ui) fn actions(state: &State) -> Vec<Action> {
    let can_pick = state.current_walked().is_some();
    let tool = |title: &str, tool: Tool, key: Key| {
        let is_on = state.tool == tool;
        let next = if is_on { Tool::Navigate } else { tool };
        Action::app(Group::Edit, title, Command::Use(next))
            .key(NONE, key)
            .on(is_on)
            .when(can_pick)
    };
    let edit = |title: &str, command: PeduncleCommand| {
        Action::app(Group::Edit, title, Command::Peduncle(command)).when(can_pick)
    };
    let picking = &state.peduncle;
    let mut actions = vec![
        tool("Pick the peduncle with a lasso", Tool::Lasso, Key::K),
        tool("Pick the peduncle with a brush", Tool::Brush, Key::B),
        edit("Grow the peduncle to its neighbors", PeduncleCommand::Grow)
            .key(SHIFT, Key::G)
            .repeating(),
        edit("Shrink the peduncle", PeduncleCommand::Shrink)
            .key(SHIFT, Key::S)
            .repeating(),
        edit("Invert the picked points", PeduncleCommand::Invert),
        edit("Clear the picked points", PeduncleCommand::Clear),
        edit(
            "Pick hidden points as well",
            PeduncleCommand::Through(!picking.is_through),
        )
        .key(SHIFT, Key::H)
        .on(picking.is_through),
        edit("Save the peduncle beside the cloud", PeduncleCommand::Save).key(CTRL | SHIFT, Key::S),
    ];
    if state.tool == Tool::Brush {
        let sized =
            |factor: f64| Command::Peduncle(PeduncleCommand::BrushRadius(factor * picking.brush_radius_px));
        actions.extend([
            Action::app(Group::Edit, "Larger brush", sized(BRUSH_STEP))
                .key(NONE, Key::CloseBracket)
                .repeating(),
            Action::app(Group::Edit, "Smaller brush", sized(1.0 / BRUSH_STEP))
                .key(NONE, Key::OpenBracket)
                .repeating(),
        ]);
    }
    actions
}
