//! The bar at the top: menus made from the table of actions, and the steps from cloud to cloud.

use egui::{MenuBar, RichText};

use crate::app::{Command, State};
use crate::ui::action::{Act, Action, Group, key_text};

/// Shows the bar; the chosen act goes to `acts`.
pub fn show(ui: &mut egui::Ui, state: &State, actions: &[Action], acts: &mut Vec<Act>) {
    MenuBar::new().ui(ui, |ui| {
        for group in Group::ALL {
            ui.menu_button(group.title(), |ui| {
                ui.set_min_width(240.0);
                for action in actions.iter().filter(|a| a.group == group) {
                    item(ui, action, acts);
                }
                if group == Group::File {
                    recent(ui, state, acts);
                }
            });
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            steps(ui, state, actions, acts);
        });
    });
}

fn item(ui: &mut egui::Ui, action: &Action, acts: &mut Vec<Act>) {
    let keys = action
        .keys
        .first()
        .map(|key| key_text(ui.ctx(), key))
        .unwrap_or_default();
    let chosen = if let Some(mut is_on) = action.is_on {
        ui.horizontal(|ui| {
            let response = ui.add_enabled(
                action.is_enabled,
                egui::Checkbox::new(&mut is_on, action.title.as_str()),
            );
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.label(RichText::new(keys).weak());
            });
            response.clicked()
        })
        .inner
    } else {
        let button = egui::Button::new(action.title.as_str()).shortcut_text(keys);
        ui.add_enabled(action.is_enabled, button).clicked()
    };
    if chosen {
        acts.push(action.act.clone());
        if action.is_on.is_none() {
            ui.close();
        }
    }
}

fn recent(ui: &mut egui::Ui, state: &State, acts: &mut Vec<Act>) {
    ui.separator();
    ui.add_enabled_ui(!state.recent.is_empty(), |ui| {
        ui.menu_button("Recently opened", |ui| {
            for path in &state.recent {
                let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
                let button = ui.button(name).on_hover_text(path.display().to_string());
                if button.clicked() {
                    acts.push(Act::App(Command::Open(vec![path.clone()])));
                    ui.close();
                }
            }
        });
    });
}

/// Shows the name of the cloud, its place among the others, and the buttons to the previous and the next.
fn steps(ui: &mut egui::Ui, state: &State, actions: &[Action], acts: &mut Vec<Act>) {
    let (Some(source), Some(current)) = (state.source(), state.current) else {
        return;
    };
    let count = state.entries.len();
    if count > 1 {
        for (by, text) in [(1, "Next"), (-1, "Previous")] {
            let action = actions.iter().find(|a| a.act == Act::App(Command::Go(by)));
            let is_enabled = action.is_some_and(|a| a.is_enabled);
            let keys = action.map(|a| a.keys_text(ui.ctx())).unwrap_or_default();
            let button = ui.add_enabled(is_enabled, egui::Button::new(text));
            if button.on_hover_text(format!("{text} cloud ({keys})")).clicked() {
                acts.push(Act::App(Command::Go(by)));
            }
        }
        ui.label(RichText::new(format!("{} of {count}", current + 1)).weak());
    }
    ui.add(egui::Label::new(RichText::new(source.name()).strong()).truncate())
        .on_hover_text(source.path().display().to_string());
}
