//! The bar over the view while the peduncle is picked.

use egui::{Button, DragValue, RichText, Ui};

use super::tools::{hint, picking_tools};
use crate::app::peduncle::PedunclePath;
use crate::app::{Command, PeduncleCommand, State, Tool};
use crate::ui::action::{Act, Action};
use crate::ui::widgets::controls::{self, warning_color};
use crate::view::PEDUNCLE_MARK;

/// Shows the bar while a tool is in hand.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, actions: &[Action], acts: &mut Vec<Act>) {
    if !state.is_picking() {
        return;
    }
    let picking = &state.peduncle;
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Peduncle:").strong());
        let tool = picking_tools(ui, state, str::to_owned);
        acts.extend(tool.map(|tool| Act::App(Command::Use(tool))));
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
        let tip = "Pick hidden points as well, through the whole cloud (Shift + H). Otherwise only visible points are \
                   picked.";
        if controls::checkbox(ui, &mut is_through, "Through", tip) {
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
        let tip = "The distance by which it grows or shrinks, in multiples of the median distance between neighboring \
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
        let tip = "Save the peduncle's points as a PLY file of their own, anywhere";
        if controls::button(ui, "Save as …", tip) {
            say(acts, PeduncleCommand::Ask(PedunclePath::SaveAs));
        }
        if controls::button(ui, "Done", "Put the tool away (Esc)") {
            acts.push(Act::App(Command::Use(Tool::Navigate)));
        }
    });
    // Not over the view, where the peduncle is often at the upper edge.
    ui.horizontal(|ui| {
        picked(ui, state);
        if let Some(text) = hint(state) {
            controls::hint(ui, text);
        }
    });
}

/// Shows the number of picked points, and whether they are saved in a file.
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
                "The window restores it at the next start, and it can be undone; the command line can use it once it is saved.",
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
