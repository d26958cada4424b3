//! The section of the axis that is being set: its coordinates, the buttons that change it, confidence and note.

use egui::{Button, ComboBox, Response, Role as Spoken, TextEdit, Ui, WidgetInfo};

use super::say;
use crate::annotate::{Confidence, Ends, Judgment, Method, NUDGES_DEG, Pivot};
use crate::app::true_axes::{Ghost, Turn};
use crate::app::{Command, State, TrueAxesCommand};
use crate::ui::widgets::controls::{Coordinates, Number, decimals, hint, row};

/// Shows the section in edit mode.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    if !annotating.can_edit() {
        return;
    }
    ui.separator();
    if let Some(ends) = annotating.ends() {
        numbers(ui, state, &ends, commands);
        turning(ui, state, commands);
    } else if annotating.judgment().is_some() {
        ui.strong("The axis cannot be told.");
    } else {
        hint(
            ui,
            "Click the peduncle's base in the view, then the blossom end. Or start from an axis:",
        );
    }
    changes(ui, state, commands);
    ghost(ui, state, commands);
    if let Some(judgment) = annotating.judgment() {
        said(ui, state, judgment, commands);
    }
}

/// Says the command of a field that was dragged, stepped or typed into: a preview during a drag, an edit otherwise.
fn edited(response: &Response, ends: Result<Ends, crate::annotate::EndsError>, commands: &mut Vec<Command>) {
    if response.changed()
        && let Ok(ends) = ends
    {
        say(
            commands,
            if response.dragged() {
                TrueAxesCommand::Preview(ends)
            } else {
                TrueAxesCommand::SetEnds(ends)
            },
        );
    }
    if response.drag_stopped() {
        say(commands, TrueAxesCommand::Drop);
    }
}

fn numbers(ui: &mut Ui, state: &State, ends: &Ends, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    let unit = annotating.subject.as_ref().map(|subject| subject.unit);
    let in_cm = unit.map_or(1.0, crate::geometry::Unit::in_cm);
    let (mut base, mut blossom) = (ends.peduncle_base(), ends.blossom_end());
    let tip = "In the file's unit and frame. Type it, or drag it sideways.";
    let name = |name| Coordinates { name, tip, unit };
    let response = name("Peduncle base").show(ui, &mut base);
    edited(&response, ends.with_peduncle_base(base), commands);
    let response = name("Blossom end").show(ui, &mut blossom);
    edited(&response, ends.with_blossom_end(blossom), commands);
    let before = ends.length();
    let mut length = before;
    let symbol = unit.map_or(String::new(), |unit| format!(" {}", unit.symbol()));
    let tip = "The distance between the ends. What is held stays where it is.";
    let response = row(ui, "Length", tip, |ui| {
        let number = Number::new("Length of the axis", 1e-9..=1e12)
            .suffix(&symbol)
            .steps(0.02 / in_cm, decimals(unit));
        number.show(ui, &mut length, tip)
    });
    edited(
        &response,
        ends.lengthened(length - before, annotating.pivot),
        commands,
    );
}

fn turning(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    row(ui, "Turn by", "As seen in the large view.", |ui| {
        for (i, degrees) in NUDGES_DEG.into_iter().enumerate() {
            let is_on = annotating.step == i;
            let keys = ["Alt + arrows", "arrow keys", "Shift + arrows"][i];
            let button = Button::selectable(is_on, format!("{degrees}°")).frame_when_inactive(true);
            if ui
                .add(button)
                .on_hover_text(format!("The step of the buttons below. By keys: {keys}"))
                .clicked()
            {
                say(commands, TrueAxesCommand::Step(i));
            }
        }
    });
    let step = annotating.step_deg();
    let each = 0.5 * (ui.available_width() - ui.spacing().item_spacing.x);
    let ways = [
        [("Left", Turn::Picture, -1.0), ("Right", Turn::Picture, 1.0)],
        [("Away", Turn::Lean, 1.0), ("Towards you", Turn::Lean, -1.0)],
    ];
    for pair in ways {
        ui.horizontal(|ui| {
            for (text, turn, sign) in pair {
                let button = Button::new(text).min_size(egui::vec2(each, ui.spacing().interact_size.y));
                let tip = match turn {
                    Turn::Picture => "Turns the axis within the picture",
                    Turn::Lean => "Leans the peduncle's base along the line of sight",
                };
                if ui
                    .add(button)
                    .on_hover_text(format!("{tip}, by {step}°"))
                    .clicked()
                {
                    say(commands, TrueAxesCommand::Nudge(turn, sign * step));
                }
            }
        });
    }
    let name = |pivot| match pivot {
        Pivot::Middle => "the middle",
        Pivot::PeduncleBase => "the peduncle base",
        Pivot::BlossomEnd => "the blossom end",
    };
    row(
        ui,
        "Hold",
        "What stays where it is while the axis turns (H).",
        |ui| {
            let combo = ComboBox::from_id_salt("hold")
                .selected_text(name(annotating.pivot))
                .width(ui.available_width())
                .show_ui(ui, |ui| {
                    for pivot in [Pivot::Middle, Pivot::PeduncleBase, Pivot::BlossomEnd] {
                        let is_on = annotating.pivot == pivot;
                        if ui.selectable_label(is_on, name(pivot)).clicked() {
                            say(commands, TrueAxesCommand::Hold(pivot));
                        }
                    }
                });
            combo
                .response
                .widget_info(|| WidgetInfo::labeled(Spoken::ComboBox, true, "Hold while turning"));
        },
    );
}

fn changes(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let annotating = &state.true_axes;
    let has_axis = annotating.set_ends().is_some();
    ui.horizontal_wrapped(|ui| {
        let mut button = |text: &str, tip: &str, is_enabled: bool, command| {
            if ui
                .add_enabled(is_enabled, Button::new(text))
                .on_hover_text(tip)
                .on_disabled_hover_text(tip)
                .clicked()
            {
                say(commands, command);
            }
        };
        let has_any = annotating.judgment().is_some();
        button("Set anew", "Both ends by two clicks (S)", has_any, TrueAxesCommand::Anew);
        button("Flip", "Exchange the ends (X)", has_axis, TrueAxesCommand::Flip);
        let is_free = !annotating.is_blind;
        button(
            "From peduncle",
            "Start from the peduncle's axis, § 3.2 (Shift+P). It is recorded, since it draws the hand; not in \
             blind mode.",
            is_free,
            TrueAxesCommand::Start(Method::FromPeduncle),
        );
        button(
            "From computed",
            "Start from the computed axis, Eq. 16 (Shift+A). It is recorded, since it draws the hand; not in \
             blind mode.",
            is_free,
            TrueAxesCommand::Start(Method::FromComputed),
        );
        button(
            "Cannot be told",
            "This cloud does not show its axis (U)",
            true,
            TrueAxesCommand::CannotTell,
        );
    });
    ui.horizontal(|ui| {
        let (undo, redo) = (annotating.history.undo_steps(), annotating.history.redo_steps());
        for (text, steps, tip, command) in [
            (
                format!("Undo ({undo})"),
                undo,
                "Take back the last edit of this axis (Ctrl+Z)",
                TrueAxesCommand::Undo,
            ),
            (
                format!("Redo ({redo})"),
                redo,
                "Do it again (Ctrl+Shift+Z)",
                TrueAxesCommand::Redo,
            ),
        ] {
            if ui
                .add_enabled(steps > 0, Button::new(text))
                .on_hover_text(tip)
                .clicked()
            {
                say(commands, command);
            }
        }
    });
}

fn ghost(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let tip = "The cloud once more in gray (G). Where the axis is true, it lies on the cloud, as far as both are \
               seen.";
    ui.horizontal_wrapped(|ui| {
        ui.label("Ghost").on_hover_text(tip);
        for (ghost, text, tip) in [
            (Ghost::Off, "off", "Only the cloud"),
            (Ghost::Turned, "turned", "Turned by 180° about the axis"),
            (
                Ghost::Mirrored,
                "mirrored",
                "Mirrored in the plane through the axis and the depth camera",
            ),
        ] {
            let is_on = state.true_axes.ghost == ghost;
            let button = Button::selectable(is_on, text).frame_when_inactive(true);
            if ui.add(button).on_hover_text(tip).clicked() {
                say(commands, TrueAxesCommand::Ghost(ghost));
            }
        }
    });
}

fn said(ui: &mut Ui, state: &State, judgment: &Judgment, commands: &mut Vec<Command>) {
    row(ui, "Confidence", "How sure you are (F2, F3, F4).", |ui| {
        for (value, text) in [
            (Confidence::LOW, "low"),
            (Confidence::MEDIUM, "medium"),
            (Confidence::HIGH, "high"),
        ] {
            let is_on = judgment.confidence == Some(value);
            let button = Button::selectable(is_on, text).frame_when_inactive(true);
            if ui.add(button).clicked() {
                // A second click clears the confidence.
                let wanted = (!is_on).then_some(value);
                say(commands, TrueAxesCommand::Confidence(wanted));
            }
        }
    });
    let cloud = state
        .true_axes
        .subject
        .as_ref()
        .map(|subject| subject.path.clone());
    let memory = ui.make_persistent_id(("note", cloud));
    let mut typed = ui
        .data(|data| data.get_temp::<String>(memory))
        .unwrap_or_else(|| judgment.note.clone());
    let response = row(ui, "Note", "Anything else about this axis.", |ui| {
        let field = TextEdit::singleline(&mut typed).desired_width(f32::INFINITY);
        ui.add(field).accessible_name("Note")
    });
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(memory, typed));
    } else if response.lost_focus() {
        ui.data_mut(|data| data.remove::<String>(memory));
        if typed != judgment.note {
            say(commands, TrueAxesCommand::Note(typed));
        }
    }
    let began = match judgment.method {
        Method::ByHand => "Set by hand",
        Method::FromPeduncle => "Begun from the peduncle's axis",
        Method::FromComputed => "Begun from the computed axis",
        Method::Imported => "Begun from another program's axis",
    };
    let blind = if judgment.blind { ", blind" } else { "" };
    hint(ui, format!("{began}{blind}."));
}
