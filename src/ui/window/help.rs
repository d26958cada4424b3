//! The sheet of keys, made from the table of actions.

use egui::{Modal, RichText};

use crate::ui::action::{Action, Group};

/// The gestures of the mouse, and their effects.
const MOUSE: [(&str, &str); 10] = [
    ("Drag", "turn"),
    ("Right or middle drag, Shift + drag", "move"),
    ("Wheel, pinch", "zoom to the cursor"),
    ("Click", "pick a point"),
    ("Double click", "pick a point and turn about it"),
    ("Hover over the map or hemisphere", "preview a plane"),
    ("Drag over the histogram", "brush contributions"),
    ("Setting an axis: click", "set the next end"),
    ("Setting an axis: drag", "move an end or the axis"),
    ("Setting an axis: right drag", "turn the view"),
];

/// Shows the sheet; returns whether it stays open.
pub fn show(ctx: &egui::Context, actions: &[Action]) -> bool {
    let modal = Modal::new(egui::Id::unique("help")).show(ctx, |ui| {
        let room = ctx.content_rect().size();
        ui.set_max_width((room.x - 60.0).min(980.0));
        ui.heading("Keys");
        ui.add_space(4.0);
        egui::ScrollArea::vertical()
            .max_height(room.y - 120.0)
            .auto_shrink([false, true])
            .show(ui, |ui| {
                let columns = if room.x > 780.0 { 3 } else { 1 };
                // Space for the scroll bar.
                ui.set_max_width(ui.available_width() - 16.0);
                ui.spacing_mut().item_spacing.x = 24.0;
                ui.columns(columns, |columns| {
                    let count = columns.len();
                    let parts: [&[Group]; 3] = [
                        &[Group::File, Group::Edit, Group::TrueAxis],
                        &[Group::Plane, Group::View],
                        &[Group::Color, Group::Overlay, Group::Window],
                    ];
                    for (i, groups) in parts.iter().enumerate() {
                        let ui = &mut columns[i.min(count - 1)];
                        for &group in *groups {
                            section(ui, ctx, group, actions);
                        }
                        if i == 1 {
                            mouse(ui);
                        }
                    }
                });
            });
        ui.add_space(8.0);
        ui.button("Close").clicked()
    });
    !(modal.inner || modal.should_close())
}

fn section(ui: &mut egui::Ui, ctx: &egui::Context, group: Group, actions: &[Action]) {
    title(ui, group.title());
    for action in actions.iter().filter(|a| a.group == group && !a.keys.is_empty()) {
        row(ui, &action.title, &action.keys_text(ctx));
    }
    ui.add_space(8.0);
}

fn mouse(ui: &mut egui::Ui) {
    title(ui, "Mouse");
    for (gesture, effect) in MOUSE {
        row(ui, effect, gesture);
    }
    ui.add_space(8.0);
}

fn title(ui: &mut egui::Ui, text: &str) {
    ui.label(RichText::new(text).strong());
}

fn row(ui: &mut egui::Ui, title: &str, keys: &str) {
    ui.horizontal(|ui| {
        ui.label(title);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.label(RichText::new(keys).weak());
        });
    });
}
