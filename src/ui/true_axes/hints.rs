//! The bar over the view that says what the mouse does in edit mode, and that blind mode is on.

use egui::{Frame, Label, Margin, Panel, RichText, Stroke, Ui};

use super::OWN;
use crate::app::State;
use crate::app::true_axes::{Draft, Handle};
use crate::ui::widgets::marks::color32;

/// Shows it where there is something to say. It takes room of its own, so that it hides no points.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State) {
    let annotating = &state.true_axes;
    let lines: Vec<String> = blind(state).into_iter().chain(editing(state)).collect();
    if lines.is_empty() {
        return;
    }
    let edge = if annotating.is_editing {
        color32(OWN)
    } else {
        ui.visuals().warn_fg_color
    };
    let frame = Frame::new()
        .inner_margin(Margin::symmetric(8, 4))
        .fill(ui.visuals().faint_bg_color);
    Panel::top("annotating hints")
        .frame(frame)
        .show_separator_line(false)
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            for line in lines {
                ui.add(
                    Label::new(
                        RichText::new(line)
                            .size(12.5)
                            .color(ui.visuals().strong_text_color()),
                    )
                    .wrap(),
                );
            }
            let rect = ui.max_rect().expand2(egui::vec2(8.0, 0.0));
            let left = [rect.left_top(), rect.left_bottom()];
            ui.painter().line_segment(left, Stroke::new(4.0, edge));
        });
}

fn blind(state: &State) -> Option<String> {
    let annotating = &state.true_axes;
    annotating.is_blind.then(|| {
        if annotating.was_seen {
            "Blind, but this cloud was shown with its computed axis before: its axis is not recorded as blind."
                .into()
        } else {
            "Blind: everything computed is hidden (Shift+B).".into()
        }
    })
}

fn editing(state: &State) -> Vec<String> {
    let annotating = &state.true_axes;
    if !annotating.is_editing {
        return Vec::new();
    }
    let what = match (annotating.next_end(), annotating.draft) {
        _ if annotating.subject.is_none() => "Waiting for the cloud …",
        (Some(Handle::BlossomEnd), _) => {
            "Click the blossom end. The ring in the small views shows how deep it lands. Shift: on the surface. \
             Esc drops the base."
        }
        (Some(_), Draft::Anew) => "Set anew: click the peduncle's base. Esc keeps the axis as it is.",
        (Some(_), _) => {
            "Click the peduncle's base. It lands as deep as the fruit's middle, as the small views show; with \
             Shift on the surface."
        }
        (None, _) if annotating.set_ends().is_none() => {
            "Recorded: the axis cannot be told. Ctrl+Z takes it back, S sets an axis after all."
        }
        (None, _) => {
            "Drag an end or the middle, here or in a small view. Arrow keys turn by 1°, with Shift by 5°, with \
             Alt by 0.1°."
        }
    };
    vec![
        what.into(),
        "Left button: the axis alone. Right drag turns the view, middle drag moves it, the wheel zooms. T ends."
            .into(),
    ]
}
