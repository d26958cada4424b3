//! The bar over the view: coloring, overlays, usual places to look from.

use egui::{ComboBox, RichText};

use crate::app::{Command, State};
use crate::ui::action::{Act, Action, Group};
use crate::ui::widgets::reference;
use crate::view::ViewPreset;

/// Bars of less width have the places to look from in a menu.
const WIDE: f32 = 860.0;

/// The usual places to look from, by short names.
const PLACES: [(&str, ViewPreset); 6] = [
    ("Camera", ViewPreset::Camera),
    ("Front", ViewPreset::Front),
    ("Side", ViewPreset::Side),
    ("Top", ViewPreset::Top),
    ("Normal", ViewPreset::Normal),
    ("Axis", ViewPreset::Axis),
];

/// Shows the bar.
pub fn show(ui: &mut egui::Ui, state: &State, actions: &[Action], acts: &mut Vec<Act>) {
    let is_wide = ui.available_width() >= WIDE;
    ui.horizontal_wrapped(|ui| {
        colorings(ui, actions, acts);
        overlays(ui, actions, acts);
        if is_wide {
            ui.separator();
            for (text, preset) in PLACES {
                button(ui, text, &Act::App(Command::View(preset)), actions, acts);
            }
            button(ui, "Fit", &Act::App(Command::Frame), actions, acts);
        } else {
            button(ui, "Fit", &Act::App(Command::Frame), actions, acts);
            ui.menu_button("Look from", |ui| {
                ui.set_min_width(210.0);
                for action in actions
                    .iter()
                    .filter(|a| a.group == Group::View && a.is_on.is_none())
                {
                    let keys = action.keys_text(ui.ctx());
                    let button = egui::Button::new(action.title.as_str()).shortcut_text(keys);
                    if ui.add_enabled(action.is_enabled, button).clicked() {
                        acts.push(action.act.clone());
                        ui.close();
                    }
                }
            });
        }
        let parallel = actions
            .iter()
            .find(|a| matches!(a.act, Act::App(Command::Project(_))));
        if let Some(action) = parallel {
            let is_on = action.is_on == Some(true);
            let button = egui::Button::new("Parallel").selected(is_on);
            if ui.add(button).on_hover_text(tip(ui.ctx(), action)).clicked() {
                acts.push(action.act.clone());
            }
        }
        if !state.true_axes.is_blind
            && let Some(choice) = reference::choose(ui, state)
        {
            acts.push(Act::App(Command::Compare(choice)));
        }
    });
}

fn colorings(ui: &mut egui::Ui, actions: &[Action], acts: &mut Vec<Act>) {
    let colorings = || actions.iter().filter(|action| action.group == Group::Color);
    let current = colorings().find(|action| action.is_on == Some(true));
    let response = ComboBox::from_id_salt("coloring")
        .selected_text(current.map_or("", |action| action.title.as_str()))
        .width(146.0)
        .show_ui(ui, |ui| {
            for action in colorings() {
                let is_on = action.is_on == Some(true);
                let keys = action.keys_text(ui.ctx());
                let button = egui::Button::selectable(is_on, action.title.as_str()).shortcut_text(keys);
                if action.is_enabled && ui.add(button).clicked() {
                    acts.push(action.act.clone());
                }
            }
        })
        .response;
    response
        .on_hover_text("What the points' colors show")
        .widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, "Color by"));
}

fn overlays(ui: &mut egui::Ui, actions: &[Action], acts: &mut Vec<Act>) {
    ui.menu_button("Show", |ui| {
        ui.set_min_width(210.0);
        for action in actions.iter().filter(|a| a.group == Group::Overlay) {
            let Some(mut is_on) = action.is_on else { continue };
            ui.horizontal(|ui| {
                let checkbox = egui::Checkbox::new(&mut is_on, action.title.as_str());
                if ui.add_enabled(action.is_enabled, checkbox).clicked() {
                    acts.push(action.act.clone());
                }
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    ui.label(RichText::new(action.keys_text(ui.ctx())).weak());
                });
            });
        }
    })
    .response
    .on_hover_text("What is drawn over the points");
}

fn button(ui: &mut egui::Ui, text: &str, act: &Act, actions: &[Action], acts: &mut Vec<Act>) {
    let Some(action) = actions.iter().find(|a| a.act == *act) else {
        return;
    };
    let button = ui.add_enabled(action.is_enabled, egui::Button::new(text));
    if button.on_hover_text(tip(ui.ctx(), action)).clicked() {
        acts.push(act.clone());
    }
}

fn tip(ctx: &egui::Context, action: &Action) -> String {
    format!("{} ({})", action.title, action.keys_text(ctx))
}
