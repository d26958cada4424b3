//! The table of all actions: keys, menus, help sheet and command palette are made from it.

mod table;

use egui::KeyboardShortcut;

use crate::app::State;
use crate::ui::action::{Act, Action, Group};
use crate::ui::{many, peduncle, true_axes};
use table::{edit_actions, file_actions, plane_actions, style_actions, view_actions, window_actions};

/// Returns all actions in the current state.
pub fn actions(state: &State) -> Vec<Action> {
    let mut all = file_actions(state);
    all.extend(edit_actions(state));
    all.extend(peduncle::keys::actions(state));
    all.extend(true_axes::actions(state));
    all.extend(plane_actions(state));
    all.extend(view_actions(state));
    all.extend(style_actions(state));
    all.extend(window_actions(state));
    all.extend(many::keys::actions(state));
    if state.true_axes.is_editing {
        give_way(&mut all);
    }
    if state.true_axes.is_blind {
        for action in &mut all {
            action.is_enabled &= !matches!(&action.act, Act::App(command) if command.reveals());
        }
    }
    all
}

/// Takes away keys that turn or change the axis from all other actions, in edit mode.
fn give_way(all: &mut [Action]) {
    let of_axis = |action: &&Action| action.group == Group::TrueAxis;
    let taken: Vec<KeyboardShortcut> = all.iter().filter(of_axis).flat_map(|a| a.keys.clone()).collect();
    for action in all.iter_mut().filter(|a| a.group != Group::TrueAxis) {
        action.keys.retain(|key| !taken.contains(key));
    }
}
