//! The bar over the view while the peduncle is picked.

use egui::{Button, DragValue, RichText, Ui};

use super::tools::hint;
use crate::app::peduncle::PedunclePath;
use crate::app::{Command, PeduncleCommand, State, Tool};
use crate::ui::action::{Act, Action};
use crate::ui::widgets::controls::{self, warning_color};
use crate::view::PEDUNCLE_MARK;

/// Shows the bar, where a tool is in hand.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, actions: &[Action], acts: &mut Vec<Act>) {
    if !state.is_picking() {
        return;
    }
    let picking = &state.peduncle;
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Peduncle:").strong());
        for (text, tool, tip) in [
            ("Lasso", Tool::Lasso, "Go around its points (K)"),
            ("Brush", Tool::Brush, "Paint over its points (B)"),
        ] {
            let button = Button::selectable(state.tool == tool, text).frame_when_inactive(true);
            if ui.add(button).on_hover_text(tip).clicked() {
                acts.push(Act::App(Command::Use(tool)));
            }
        }
        if state.tool == Tool::Brush {
            let mut radius = picking.brush_radius_px;
            let field = DragValue::new(&mut radius)
                .range(2.0..=250.0)
                .speed(0.5)
                .max_decimals(0)
                .prefix("radius ")
                .suffix(" px");
            let response = ui
                .add(field)
                .on_hover_text("The brush's radius in pixels of the screen ([ and ], or Ctrl + wheel)")
                .accessible_name("Radius of the brush in pixels");
            if response.changed() {
                say(acts, PeduncleCommand::BrushRadius(radius));
            }
        }
        let mut is_through = picking.is_through;
        let tip = "Take points that others hide as well, through the whole cloud (Shift + H). Otherwise only what \
                   is seen is taken.";
        if ui.checkbox(&mut is_through, "Through").on_hover_text(tip).changed() {
            say(acts, PeduncleCommand::Through(is_through));
        }
        ui.separator();
        button(ui, "Grow", PeduncleCommand::Grow, actions, acts);
        button(ui, "Shrink", PeduncleCommand::Shrink, actions, acts);
        let mut reach = picking.reach_spacings;
        let field = DragValue::new(&mut reach)
            .range(0.5..=20.0)
            .speed(0.05)
            .max_decimals(1)
            .prefix("by ")
            .suffix(" ×");
        let tip = "How far it grows or shrinks at a time, in multiples of the median distance between neighboring \
                   points";
        let response = ui
            .add(field)
            .on_hover_text(tip)
            .accessible_name("Reach in spacings of the points");
        if response.changed() {
            say(acts, PeduncleCommand::Reach(reach));
        }
        ui.separator();
        button(ui, "Invert", PeduncleCommand::Invert, actions, acts);
        button(ui, "Clear", PeduncleCommand::Clear, actions, acts);
        ui.separator();
        button(ui, "Save", PeduncleCommand::Save, actions, acts);
        let tip = "Save the peduncle's points as a PLY file of their own, wherever you like";
        if ui.button("Save as …").on_hover_text(tip).clicked() {
            say(acts, PeduncleCommand::Ask(PedunclePath::SaveAs));
        }
        if ui
            .button("Done")
            .on_hover_text("Put the tool away (Esc)")
            .clicked()
        {
            acts.push(Act::App(Command::Use(Tool::Navigate)));
        }
    });
    // Not over the view: the peduncle is often at its upper edge.
    ui.horizontal(|ui| {
        picked(ui, state);
        if let Some(text) = hint(state) {
            controls::hint(ui, text);
        }
    });
}

/// How many points are picked, and whether they lie in a file.
fn picked(ui: &mut Ui, state: &State) {
    if state.peduncle.is_working {
        ui.spinner();
    }
    let (swatch, _) = ui.allocate_exact_size(egui::vec2(10.0, 10.0), egui::Sense::hover());
    let [r, g, b, _] = PEDUNCLE_MARK;
    ui.painter()
        .rect_filled(swatch, 2.0, egui::Color32::from_rgb(r, g, b));
    let count = state.peduncle.marked.as_ref().map(|marked| marked.points);
    let count = count.map_or(String::new(), |points| match points {
        0 => "no point is picked".into(),
        1 => "1 point".into(),
        points => format!("{points} points"),
    });
    if let Some(path) = state.saved_peduncle() {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        ui.label(format!("{count}, saved as {name}"))
            .on_hover_text(path.display().to_string());
    } else if state.has_unsaved_peduncle() {
        ui.label(count);
        ui.label(RichText::new("not saved in a file yet").color(warning_color(ui)))
            .on_hover_text(
                "It comes back with the window, and can be undone; the command line knows it once it is saved.",
            );
    } else {
        ui.label(count);
    }
}

fn button(ui: &mut Ui, text: &str, command: PeduncleCommand, actions: &[Action], acts: &mut Vec<Act>) {
    let act = Act::App(Command::Peduncle(command));
    let action = actions.iter().find(|action| action.act == act);
    let Some(action) = action else { return };
    let keys = action.keys_text(ui.ctx());
    let tip = if keys.is_empty() {
        action.title.clone()
    } else {
        format!("{} ({keys})", action.title)
    };
    let response = ui.add_enabled(action.is_enabled, Button::new(text));
    if response.on_hover_text(tip).clicked() {
        acts.push(act);
    }
}

fn say(acts: &mut Vec<Act>, command: PeduncleCommand) {
    acts.push(Act::App(Command::Peduncle(command)));
}
