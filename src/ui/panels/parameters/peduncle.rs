//! Where the peduncle is, which gives the reference axis.

use std::path::PathBuf;

use egui::Ui;

use crate::app::peduncle::PedunclePath;
use crate::app::{Command, PeduncleCommand, State, Tool};
use crate::fruit::PeduncleChoice;
use crate::peduncle::{HueRange, Peduncle, PeduncleSource};
use crate::ui::peduncle::{beside, hue_bar, references};
use crate::ui::widgets::controls::{
    Choice, Edit, Number, Slid, caution, choose, hint, row, section, text_field,
};

#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    Auto,
    None,
    Label,
    File,
    Removed,
    Hue,
    Picked,
}

/// Greens: where peduncles are found beside red and yellow fruits.
const GREENS: HueRange = HueRange {
    from_deg: 80.0,
    to_deg: 160.0,
};

impl Way {
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

pub(in crate::ui) fn show(ui: &mut Ui, state: &State, edit: &mut Edit<'_>, commands: &mut Vec<Command>) {
    let mut is_tried = false;
    let differs = edit.request.peduncle != PeduncleChoice::Auto || edit.request.without_peduncle;
    // A file or a folder is chosen before its name is known.
    let awaits_path = ui.make_persistent_id("peduncle awaits path");
    let is_reset = section(ui, "Peduncle", false, differs, |ui| {
        // It waits for one only as long as nothing else was chosen, here or by an undo.
        let now = edit.request.peduncle.to_string();
        let waits = ui.data(|data| data.get_temp::<(Way, String)>(awaits_path));
        let way = match waits {
            Some((way, then)) if then == now => way,
            _ => Way::of(&edit.request.peduncle),
        };
        let chosen = ways(ui, state, way);
        if let Some(chosen) = chosen {
            ui.data_mut(|data| match chosen {
                Way::File | Way::Removed => {
                    data.insert_temp(awaits_path, (chosen, now.clone()));
                }
                _ => data.remove::<(Way, String)>(awaits_path),
            });
            match chosen {
                Way::Auto => edit.request.peduncle = PeduncleChoice::Auto,
                Way::None => edit.request.peduncle = PeduncleChoice::None,
                Way::Label => edit.request.peduncle = PeduncleChoice::Label,
                Way::Hue => edit.request.peduncle = PeduncleChoice::Hue(GREENS),
                Way::File | Way::Removed => {}
                // It is picked with the first stroke.
                Way::Picked => commands.push(Command::Use(Tool::Lasso)),
            }
        }
        match chosen.unwrap_or(way) {
            way @ (Way::File | Way::Removed) => {
                if path(ui, edit, way, commands) {
                    ui.data_mut(|data| data.remove::<(Way, String)>(awaits_path));
                }
            }
            Way::Hue => is_tried |= hue(ui, state, edit),
            Way::Auto | Way::None | Way::Label | Way::Picked => {}
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
        ui.checkbox(&mut edit.request.without_peduncle, "Analyze without the peduncle")
            .on_hover_text(tip);
        beside(ui, state, commands);
    });
    if is_tried != state.peduncle.is_previewed {
        let preview = PeduncleCommand::Preview(is_tried);
        commands.push(Command::Peduncle(preview));
    }
    if is_reset {
        edit.request.peduncle = PeduncleChoice::Auto;
        edit.request.without_peduncle = false;
        ui.data_mut(|data| data.remove::<(Way, String)>(awaits_path));
    }
}

fn ways(ui: &mut Ui, state: &State, way: Way) -> Option<Way> {
    let cloud = state.walked.as_ref().map(|walked| walked.fruit.cloud());
    let no_labels = cloud
        .filter(|cloud| cloud.labels().is_none())
        .map(|_| "This file has no labels (a property named label, class or scalar_label).");
    let no_colors = cloud
        .filter(|cloud| cloud.colors().is_none())
        .map(|_| "This file has no colors to tell the peduncle by.");
    let tip = "Where the peduncle's points are. The reference axis runs from the fruit center through their \
               mean (§ 3.2).";
    row(ui, "Found by", tip, |ui| {
        choose(
            ui,
            "Where the peduncle is",
            &way,
            tip,
            vec![
                Choice::new(
                    Way::Auto,
                    "auto",
                    "Labels in the file, else NAME_peduncle.ply beside it, else none.",
                ),
                Choice::new(Way::None, "none", "There is no reference axis by a peduncle."),
                Choice::new(Way::Label, "labels", "The points that the file labels 1.").unless(no_labels),
                Choice::new(
                    Way::File,
                    "a file",
                    "A PLY file with the peduncle's points alone.",
                ),
                Choice::new(
                    Way::Removed,
                    "another folder",
                    "The points that are missing in the cloud of the same name in a folder of clouds without their \
                     peduncles, which is how the paper's data come.",
                ),
                Choice::new(
                    Way::Hue,
                    "color (hue)",
                    "The points whose color has a hue in a range.",
                )
                .unless(no_colors),
                Choice::new(
                    Way::Picked,
                    "picked in the view",
                    "The points that you go around or paint over in the view.",
                ),
            ],
        )
    })
}

/// The tools that pick points, and whether what was picked lies in a file.
fn pick(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Pick in the view:");
        for (text, tool, tip) in [
            ("Lasso", Tool::Lasso, "Go around the peduncle's points (K)"),
            ("Brush", Tool::Brush, "Paint over the peduncle's points (B)"),
        ] {
            let is_on = state.tool == tool;
            let button = egui::Button::selectable(is_on, text).frame_when_inactive(true);
            let button = ui.add_enabled(state.current_walked().is_some(), button);
            if button
                .on_hover_text(tip)
                .accessible_name(format!("Pick with the {}", text.to_lowercase()))
                .clicked()
            {
                commands.push(Command::Use(if is_on { Tool::Navigate } else { tool }));
            }
        }
    });
    if state.has_unsaved_peduncle() {
        caution(
            ui,
            "Picked, and not saved in a file yet: the command line does not know it.",
        );
        if ui
            .button("Save beside the cloud")
            .on_hover_text("As NAME_peduncle.ply, where the command line finds it (Ctrl + Shift + S)")
            .clicked()
        {
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

/// The peduncle's file, or the folder of clouds without it; says whether one was named.
fn path(ui: &mut Ui, edit: &mut Edit<'_>, way: Way, commands: &mut Vec<Command>) -> bool {
    let is_file = way == Way::File;
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
    // What is being typed belongs to what was there when typing began.
    let (of, mut typed) = ui
        .data(|data| data.get_temp::<(String, String)>(memory))
        .filter(|(of, _)| *of == now)
        .unwrap_or_else(|| (now.clone(), now.clone()));
    let response = ui
        .horizontal(|ui| {
            if ui.button("Choose …").on_hover_text(tip).clicked() {
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

/// The range of hues; says whether somebody is at it, and wants to see what it takes.
fn hue(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) -> bool {
    let PeduncleChoice::Hue(mut range) = edit.request.peduncle else {
        return false;
    };
    let mut is_tried = false;
    let bar = hue_bar(ui, &mut range, state.peduncle.hues.as_deref()).on_hover_text(
        "How many points have which hue (on a scale of roots). Drag either end of the range; the points in it show in \
         the view.",
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
        let (response, _) = Slid {
            label,
            tip: "A hue in degrees: red 0, yellow 60, green 120, blue 240. A range may run through red, as 350 \
                  to 20 does.",
            number: Number {
                name,
                suffix: "°",
                range: 0.0..=360.0,
                speed: 1.0,
                decimals: 0,
                width: 56.0,
            },
            usual: 0.0..=360.0,
            step: 1.0,
            logarithmic: false,
            differs: false,
        }
        .show(ui, value);
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
