//! The line with the filter of the table.

use egui::{Checkbox, ComboBox, DragValue, TextEdit, Ui};

use crate::app::many::{Filter, ManyCommand};
use crate::app::{Command, State};

/// Shows the line.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let mut filter = state.many.filter.clone();
    ui.horizontal_wrapped(|ui| {
        ui.scope(|ui| {
            ui.visuals_mut().weak_text_color = Some(ui.visuals().text_color());
            let field = TextEdit::singleline(&mut filter.search)
                .hint_text("Search names, tags, notes")
                .desired_width(170.0);
            ui.add(field)
                .on_hover_text("Only clouds with this in their name, tags or note")
                .accessible_name("Search names, tags and notes");
        });
        above(ui, &mut filter);
        for (is_on, text, tip) in [
            (
                &mut filter.only_failed,
                "no error",
                "Only clouds without an error against the chosen reference: unreadable, without an axis, or without a reference",
            ),
            (
                &mut filter.only_warned,
                "warnings",
                "Only clouds that there are warnings of",
            ),
            (
                &mut filter.only_unannotated,
                "not annotated",
                "Only clouds whose axis nobody has set by hand",
            ),
        ] {
            ui.add(Checkbox::new(is_on, text)).on_hover_text(tip);
        }
        tag(ui, state, &mut filter);
        let is_empty = state.many.filter.is_empty();
        if !is_empty {
            if ui.button("Show all").clicked() {
                filter = Filter::default();
            }
            let (shown, all) = (state.many.order.len(), state.many.rows.len());
            ui.label(format!("{shown} of {all} shown"));
        }
    });
    if filter != state.many.filter {
        commands.push(Command::Many(ManyCommand::Filter(Box::new(filter))));
    }
}

fn above(ui: &mut Ui, filter: &mut Filter) {
    let mut is_on = filter.above_deg.is_some();
    let tip = "Only clouds whose error against the chosen reference is larger";
    ui.add(Checkbox::new(&mut is_on, "error above"))
        .on_hover_text(tip);
    let mut limit = filter.above_deg.unwrap_or(10.0);
    let field = DragValue::new(&mut limit)
        .range(0.0..=90.0)
        .speed(0.2)
        .max_decimals(1)
        .suffix("°");
    let field = ui.add_enabled(is_on, field).on_hover_text(tip);
    field.accessible_name("Least error shown, in degrees");
    filter.above_deg = is_on.then_some(limit);
}

fn tag(ui: &mut Ui, state: &State, filter: &mut Filter) {
    if state.many.known_tags.is_empty() {
        return;
    }
    let text = filter.tag.clone().unwrap_or_else(|| "any tag or none".into());
    let shown = ComboBox::from_id_salt("tag")
        .selected_text(text)
        .width(120.0)
        .truncate()
        .show_ui(ui, |ui| {
            ui.selectable_value(&mut filter.tag, None, "any tag or none");
            for tag in state.many.known_tags.iter() {
                ui.selectable_value(&mut filter.tag, Some(tag.clone()), tag);
            }
        });
    shown
        .response
        .on_hover_text("Only clouds with this tag")
        .accessible_name("Tag to show");
}
