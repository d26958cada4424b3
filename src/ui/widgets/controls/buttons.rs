//! Buttons and checkboxes with tooltips, which return whether they were clicked.

use egui::{Button, Checkbox, Ui};

/// Shows a button.
pub fn button(ui: &mut Ui, text: &str, tip: &str) -> bool {
    ui.button(text).on_hover_text(tip).clicked()
}

/// Shows a button that stays pressed while it is on.
pub fn toggle(ui: &mut Ui, is_on: bool, text: &str, tip: &str) -> bool {
    let button = Button::selectable(is_on, text).frame_when_inactive(true);
    ui.add(button).on_hover_text(tip).clicked()
}

/// Shows a checkbox, and sets its value by a click.
pub fn checkbox(ui: &mut Ui, is_on: &mut bool, text: &str, tip: &str) -> bool {
    ui.add(Checkbox::new(is_on, text)).on_hover_text(tip).changed()
}
