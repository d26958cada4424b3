//! Keys, and which of them act while a widget has the focus.

use std::cmp::Reverse;

use egui::{Event, Key, KeyboardShortcut, Memory, Popup};

use super::Window;
use crate::app::Command;
use crate::ui::action::{Act, Action, Group, WindowAct};
use crate::ui::inspector::plane_bar::walks_by_rank;
use crate::ui::widgets::arrows::arrows_walk;

impl Window {
    /// Collects the acts of the keys pressed in this frame.
    pub(super) fn take_keys(&self, ctx: &egui::Context, all: &[Action], acts: &mut Vec<Act>) {
        let is_asking = self.app.state().true_axes.asks_name || self.is_closing;
        let is_covered = self.is_help_open || self.is_about_open || self.saving.is_some() || is_asking;
        if is_covered || self.palette.is_some() || ctx.text_edit_focused() {
            return;
        }
        let is_focused = ctx.memory(Memory::focused).is_some();
        // Keys with more modifiers come first: Shift + Left is also a Left.
        let mut keys: Vec<(&Action, KeyboardShortcut)> = all
            .iter()
            .flat_map(|action| action.keys.iter().map(move |key| (action, *key)))
            .collect();
        let modifiers =
            |m: egui::Modifiers| u8::from(m.command) + u8::from(m.ctrl) + u8::from(m.shift) + u8::from(m.alt);
        keys.sort_by_key(|(_, key)| Reverse(modifiers(key.modifiers)));
        for (action, key) in keys {
            // A focused slider or button takes these itself.
            let is_widgets = key.modifiers.is_none()
                && matches!(
                    key.logical_key,
                    Key::Space | Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp | Key::ArrowDown
                );
            // But the arrows turn the axis although a button was clicked, unless they walk through a list.
            let turns_axis = action.group == Group::TrueAxis && !arrows_walk(ctx);
            if is_focused && is_widgets && !turns_axis {
                continue;
            }
            // Escape closes a list or a menu first.
            if key.logical_key == Key::Escape && Popup::is_any_open(ctx) {
                continue;
            }
            let is_first = ctx.input(|i| {
                i.events.iter().any(|event| {
                    matches!(event, Event::Key { key: k, pressed: true, repeat: false, .. } if *k == key.logical_key)
                })
            });
            if ctx.input_mut(|i| i.consume_shortcut(&key))
                && action.is_enabled
                && (is_first || action.repeats)
            {
                let is_last = opens_dialog(&action.act);
                acts.push(match action.act {
                    // Arrows step as the bar under the view does.
                    Act::App(Command::Step(by)) if by.abs() == 1 && walks_by_rank(ctx) => {
                        Act::App(Command::StepRank(by))
                    }
                    _ => action.act.clone(),
                });
                // Whatever else was typed in this frame is for the dialog.
                if is_last {
                    return;
                }
            }
        }
    }
}

/// Whether an act opens something that has the keyboard from then on.
fn opens_dialog(act: &Act) -> bool {
    matches!(
        act,
        Act::Window(WindowAct::Palette | WindowAct::Help | WindowAct::About | WindowAct::SaveImage)
    )
}
