//! The peduncle, which gives the reference axis.

use std::path::PathBuf;

use egui::Ui;

use crate::app::peduncle::PedunclePath;
use crate::app::{Command, PeduncleCommand, State, Tool};
use crate::fruit::PeduncleChoice;
use crate::peduncle::{HueRange, Peduncle, PeduncleSource};
use crate::ui::peduncle::{beside, hue_bar, picking_tools, references};
use crate::ui::widgets::controls::{
    Choice, Edit, Number, SliderRow, button, caution, checkbox, choice_row, hint, section, text_field,
};

/// A method of finding the peduncle.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    Auto,
    None,
    Label,
    File,
    Removed,
    Hue,
    Picked,
}

/// The greens, which tell peduncles from red and yellow fruits.
const GREENS: HueRange = HueRange {
    from_deg: 80.0,
    to_deg: 160.0,
};

impl Method {
    fn of(choice: &PeduncleChoice) -> Self {
        match choice {
            PeduncleChoice::Auto => Self::Auto,
            PeduncleChoice::None => Self::None,
            PeduncleChoice::Label => Self::Label,
            PeduncleChoice::File(_) => Self::File,
            PeduncleChoice::Removed(_) => Self::Removed,
            PeduncleChoice::Hue(_) => Self::Hue,
            PeduncleChoice::Points(_) => Self::Picked,
        }
    }
}

pub(super) fn show(ui: &mut Ui, state: &State, edit: &mut Edit<'_>, commands: &mut Vec<Command>) {
    let mut is_tried = false;
    let differs = edit.request.peduncle != PeduncleChoice::Auto || edit.request.without_peduncle;
    // A file or a folder is chosen before its name is known.
    let awaits_path = ui.make_persistent_id("peduncle awaits path");
    let is_reset = section(ui, "Peduncle", false, differs, |ui| {
        // It waits for one only as long as nothing else is chosen, here or by an undo.
        let now = edit.request.peduncle.to_string();
        let waits = ui.data(|data| data.get_temp::<(Method, String)>(awaits_path));
        let method = match waits {
            Some((method, then)) if then == now => method,
            _ => Method::of(&edit.request.peduncle),
        };
        let chosen = methods(ui, state, method);
        if let Some(chosen) = chosen {
            ui.data_mut(|data| match chosen {
                Method::File | Method::Removed => {
                    data.insert_temp(awaits_path, (chosen, now.clone()));
                }
                _ => data.remove::<(Method, String)>(awaits_path),
            });
            match chosen {
                Method::Auto => edit.request.peduncle = PeduncleChoice::Auto,
                Method::None => edit.request.peduncle = PeduncleChoice::None,
                Method::Label => edit.request.peduncle = PeduncleChoice::Label,
                Method::Hue => edit.request.peduncle = PeduncleChoice::Hue(GREENS),
                Method::File | Method::Removed => {}
                // The choice comes with the first stroke.
                Method::Picked => commands.push(Command::Use(Tool::Lasso)),
            }
        }
        match chosen.unwrap_or(method) {
            method @ (Method::File | Method::Removed) => {
                if path(ui, edit, method, commands) {
                    ui.data_mut(|data| data.remove::<(Method, String)>(awaits_path));
                }
            }
            Method::Hue => is_tried |= hue(ui, state, edit),
            Method::Auto | Method::None | Method::Label | Method::Picked => {}
        }
        let found = state.walked.as_ref().map(|walked| &walked.fruit);
        if let Some(fruit) = found.filter(|_| !state.is_stale) {
            if let Some(problem) = &fruit.peduncle_problem {
                caution(ui, problem);
            } else {
                let found = found_in_words(fruit.peduncle.as_ref(), &edit.request.peduncle);
                is_tried |= hint(ui, found).hovered() && fruit.peduncle.is_some();
            }
        }
        pick(ui, state, commands);
        if state.walked.is_some() && !state.is_stale {
            references(ui, state, commands);
        }
        ui.add_space(2.0);
        let tip = "Leave the peduncle's points out of the analysis: the paper's second variant of its data \
                   (§ 2.1). Otherwise the cloud is analyzed as it stands.";
        let without = &mut edit.request.without_peduncle;
        checkbox(ui, without, "Analyze without the peduncle", tip);
        beside(ui, state, commands);
    });
    if is_tried != state.peduncle.is_previewed {
        let preview = PeduncleCommand::Preview(is_tried);
        commands.push(Command::Peduncle(preview));
    }
    if is_reset {
        edit.request.peduncle = PeduncleChoice::Auto;
        edit.request.without_peduncle = false;
        ui.data_mut(|data| data.remove::<(Method, String)>(awaits_path));
    }
}

fn methods(ui: &mut Ui, state: &State, method: Method) -> Option<Method> {
    let cloud = state.walked.as_ref().map(|walked| walked.fruit.cloud());
    let no_labels = cloud
        .filter(|cloud| cloud.labels().is_none())
        .map(|_| "This file has no labels (a property named label, class or scalar_label).");
    let no_colors = cloud
        .filter(|cloud| cloud.colors().is_none())
        .map(|_| "This file has no colors to tell the peduncle by.");
    let tip = "Where the peduncle's points are. The reference axis runs from the fruit center through their \
               mean (§ 3.2).";
    let choices = vec![
        Choice::new(
            Method::Auto,
            "auto",
            "Labels in the file, else NAME_peduncle.ply beside it, else none.",
        ),
        Choice::new(Method::None, "none", "There is no reference axis by a peduncle."),
        Choice::new(
            Method::Label,
            "labels",
            "The points with the label 1 in the file.",
        )
        .unless(no_labels),
        Choice::new(
            Method::File,
            "a file",
            "A PLY file of the peduncle's points alone.",
        ),
        Choice::new(
            Method::Removed,
            "another folder",
            "The points that are missing in the cloud of the same name in a folder of clouds without their \
             peduncles. The paper's data come in this form.",
        ),
        Choice::new(
            Method::Hue,
            "color (hue)",
            "The points whose color has a hue within a range.",
        )
        .unless(no_colors),
        Choice::new(
            Method::Picked,
            "picked in the view",
            "The points that you circle or paint over in the view.",
        ),
    ];
    choice_row(ui, "Found by", "Where the peduncle is", &method, tip, choices)
}

/// Shows the tools that pick points, and whether the picked points are saved in a file.
fn pick(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Pick in the view:");
        ui.add_enabled_ui(state.current_walked().is_some(), |ui| {
            let name = |text: &str| format!("Pick with the {}", text.to_lowercase());
            if let Some(tool) = picking_tools(ui, state, name) {
                let is_on = state.tool == tool;
                commands.push(Command::Use(if is_on { Tool::Navigate } else { tool }));
            }
        });
    });
    if state.has_unsaved_peduncle() {
        caution(
            ui,
            "Picked, and not saved in a file yet: the command line cannot use it.",
        );
        let tip = "As NAME_peduncle.ply, where the command line finds it (Ctrl + Shift + S)";
        if button(ui, "Save beside the cloud", tip) {
            commands.push(Command::Peduncle(PeduncleCommand::Save));
        }
    } else if let Some(path) = state.saved_peduncle() {
        hint(ui, format!("Saved as {}", path.display()));
    }
}

fn found_in_words(found: Option<&Peduncle>, choice: &PeduncleChoice) -> String {
    let Some(peduncle) = found else {
        let how = match choice {
            PeduncleChoice::None => "it is not looked for",
            PeduncleChoice::Points(_) => "no point is picked",
            _ => "neither labels nor a file tell it. Choose a file, a color, or pick its points",
        };
        return format!("This cloud has no peduncle yet: {how}.");
    };
    let by = match peduncle.source {
        PeduncleSource::Label => "by the file's labels",
        PeduncleSource::Companion => "in a file of its own",
        PeduncleSource::Removal => "by the cloud without it",
        PeduncleSource::Hue(_) => "by color",
        PeduncleSource::Picked => "by hand",
    };
    let points = match peduncle.points {
        1 => "1 point".into(),
        points => format!("{points} points"),
    };
    format!("Found {by}: {points}")
}

/// Shows the field for the peduncle's file, or for the folder of clouds without it; returns whether one was named.
fn path(ui: &mut Ui, edit: &mut Edit<'_>, method: Method, commands: &mut Vec<Command>) -> bool {
    let is_file = method == Method::File;
    let (tip, empty, name, wanted) = if is_file {
        (
            "A PLY file with the peduncle's points, in the cloud's unit and frame. Enter ends typing.",
            "path of a PLY file",
            "File of the peduncle",
            PedunclePath::File,
        )
    } else {
        (
            "A folder with the same clouds without their peduncles, under the same names, in the same unit and frame. \
             Enter ends typing.",
            "path of a folder",
            "Folder of the clouds without their peduncles",
            PedunclePath::Removed,
        )
    };
    let now = match &edit.request.peduncle {
        PeduncleChoice::File(path) if is_file => path.display().to_string(),
        PeduncleChoice::Removed(path) if !is_file => path.display().to_string(),
        _ => String::new(),
    };
    let memory = ui.make_persistent_id(("peduncle path typed", is_file));
    // A text being typed belongs to the path that was there when typing began.
    let (of, mut typed) = ui
        .data(|data| data.get_temp::<(String, String)>(memory))
        .filter(|(of, _)| *of == now)
        .unwrap_or_else(|| (now.clone(), now.clone()));
    let response = ui
        .horizontal(|ui| {
            if button(ui, "Choose …", tip) {
                let ask = PeduncleCommand::Ask(wanted);
                commands.push(Command::Peduncle(ask));
            }
            text_field(ui, &mut typed, empty, name).on_hover_text(tip)
        })
        .inner;
    let path = typed.trim().to_owned();
    ui.data_mut(|data| data.insert_temp(memory, (of, typed)));
    let is_named = response.lost_focus() && !path.is_empty() && path != now;
    if is_named {
        let path = PathBuf::from(path);
        edit.request.peduncle = if is_file {
            PeduncleChoice::File(path)
        } else {
            PeduncleChoice::Removed(path)
        };
    }
    is_named
}

/// Shows the range of hues; returns whether the cursor or the focus is there, so that its points are to be shown.
fn hue(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) -> bool {
    let PeduncleChoice::Hue(mut range) = edit.request.peduncle else {
        return false;
    };
    let mut is_tried = false;
    let bar = hue_bar(ui, &mut range, state.peduncle.hues.as_deref()).on_hover_text(
        "The number of points of each hue (on a square-root scale). Drag either end of the range; its points show in the \
         view.",
    );
    is_tried |= bar.hovered() || bar.dragged();
    edit.note(&bar, "hue");
    for (value, label, name) in [
        (
            &mut range.from_deg,
            "From hue",
            "Least hue of the peduncle in degrees",
        ),
        (
            &mut range.to_deg,
            "To hue",
            "Greatest hue of the peduncle in degrees",
        ),
    ] {
        let (response, _) = SliderRow {
            label,
            tip: "A hue in degrees: red 0, yellow 60, green 120, blue 240. A range may run through red, as 350 \
                  to 20 does.",
            number: Number::new(name, 0.0..=360.0).suffix("°").width(56.0),
            usual: 0.0..=360.0,
            step: 1.0,
        }
        .show(ui, value, false);
        is_tried |= response.hovered() || response.dragged() || response.has_focus();
        edit.note(&response, "hue");
    }
    if let Some(gray) = state
        .peduncle
        .hues
        .as_ref()
        .map(|hues| hues.gray)
        .filter(|&gray| gray > 0)
    {
        hint(ui, format!("{gray} points are too gray to have a hue."));
    }
    edit.request.peduncle = PeduncleChoice::Hue(range);
    is_tried
}
