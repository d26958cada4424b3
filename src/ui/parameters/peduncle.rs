//! Where the peduncle is, which gives the reference axis.

use std::path::PathBuf;

use egui::{Color32, Mesh, Sense, Ui, ecolor::Hsva, pos2, vec2};

use super::super::controls::{Choice, Edit, Number, Slid, choose, hint, row, section, text_field};
use crate::app::State;
use crate::io::PeduncleChoice;
use crate::reference::{HueRange, Peduncle, PeduncleSource};

#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    Auto,
    None,
    Label,
    File,
    Hue,
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
            // There is no control yet for a folder of clouds without their peduncles.
            PeduncleChoice::File(_) | PeduncleChoice::Removed(_) | PeduncleChoice::Points(_) => Self::File,
            PeduncleChoice::Hue(_) => Self::Hue,
        }
    }
}

pub(super) fn show(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) {
    let differs = edit.request.peduncle != PeduncleChoice::Auto || edit.request.without_peduncle;
    // A file is chosen before its name is known.
    let awaits_file = ui.make_persistent_id("peduncle awaits file");
    let is_reset = section(ui, "Peduncle", false, differs, |ui| {
        let waits = ui.data(|data| data.get_temp(awaits_file).unwrap_or(false));
        let way = if waits {
            Way::File
        } else {
            Way::of(&edit.request.peduncle)
        };
        let chosen = ways(ui, state, way);
        if let Some(chosen) = chosen {
            ui.data_mut(|data| data.insert_temp(awaits_file, chosen == Way::File));
            match chosen {
                Way::Auto => edit.request.peduncle = PeduncleChoice::Auto,
                Way::None => edit.request.peduncle = PeduncleChoice::None,
                Way::Label => edit.request.peduncle = PeduncleChoice::Label,
                Way::Hue => edit.request.peduncle = PeduncleChoice::Hue(GREENS),
                Way::File => {}
            }
        }
        match chosen.unwrap_or(way) {
            Way::File => {
                if file(ui, edit) {
                    ui.data_mut(|data| data.insert_temp(awaits_file, false));
                }
            }
            Way::Hue => hue(ui, edit),
            Way::Auto | Way::None | Way::Label => {}
        }
        let found = state.walked.as_ref().map(|walked| walked.fruit.peduncle.as_ref());
        if let Some(found) = found.filter(|_| !state.is_stale) {
            hint(ui, found_in_words(found));
        }
        let tip = "Leave the peduncle's points out of the analysis: the paper's second variant of its data \
                   (§ 2.1). Otherwise the cloud is analyzed as it stands.";
        ui.checkbox(&mut edit.request.without_peduncle, "Analyze without the peduncle")
            .on_hover_text(tip);
    });
    if is_reset {
        edit.request.peduncle = PeduncleChoice::Auto;
        edit.request.without_peduncle = false;
        ui.data_mut(|data| data.remove::<bool>(awaits_file));
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
                    Way::Hue,
                    "color (hue)",
                    "The points whose color has a hue in a range.",
                )
                .unless(no_colors),
            ],
        )
    })
}

fn found_in_words(found: Option<&Peduncle>) -> String {
    let Some(peduncle) = found else {
        return "No peduncle: there is no reference axis by it.".into();
    };
    let by = match peduncle.source {
        PeduncleSource::Label => "by the file's labels",
        PeduncleSource::Companion => "in a file of its own",
        PeduncleSource::Removal => "by the cloud without it",
        PeduncleSource::Hue(_) => "by color",
        PeduncleSource::Picked => "by hand",
    };
    format!("Found {by}: {} points", peduncle.points)
}

/// The peduncle's file; says whether one was named.
fn file(ui: &mut Ui, edit: &mut Edit<'_>) -> bool {
    let tip = "A PLY file with the peduncle's points, in the cloud's unit and frame. Enter ends typing.";
    let now = match &edit.request.peduncle {
        PeduncleChoice::File(path) => path.display().to_string(),
        _ => String::new(),
    };
    let memory = ui.make_persistent_id("peduncle file typed");
    // What is being typed belongs to what was there when typing began.
    let (of, mut typed) = ui
        .data(|data| data.get_temp::<(String, String)>(memory))
        .filter(|(of, _)| *of == now)
        .unwrap_or_else(|| (now.clone(), now.clone()));
    let response =
        text_field(ui, &mut typed, "path of a PLY file", "File of the peduncle").on_hover_text(tip);
    let path = typed.trim().to_owned();
    ui.data_mut(|data| data.insert_temp(memory, (of, typed)));
    let is_named = response.lost_focus() && !path.is_empty() && path != now;
    if is_named {
        edit.request.peduncle = PeduncleChoice::File(PathBuf::from(path));
    }
    is_named
}

fn hue(ui: &mut Ui, edit: &mut Edit<'_>) {
    let PeduncleChoice::Hue(mut range) = edit.request.peduncle else {
        return;
    };
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
        edit.note(&response, "hue");
    }
    hue_strip(ui, range);
    edit.request.peduncle = PeduncleChoice::Hue(range);
}

/// The hues from 0° to 360°, with a line under those in the range.
fn hue_strip(ui: &mut Ui, range: HueRange) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 14.0), Sense::hover());
    let at = |deg: f64| rect.left() + rect.width() * (deg / 360.0) as f32;
    let mut mesh = Mesh::default();
    for step in 0..=36_u8 {
        let deg = 10.0 * f64::from(step);
        let color = Color32::from(Hsva::new(f32::from(step) / 36.0, 0.85, 0.9, 1.0));
        mesh.colored_vertex(pos2(at(deg), rect.top()), color);
        mesh.colored_vertex(pos2(at(deg), rect.top() + 8.0), color);
        if step > 0 {
            let first = 2 * u32::from(step) - 2;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    ui.painter().add(mesh);
    let pieces = if range.from_deg <= range.to_deg {
        vec![range.from_deg..=range.to_deg]
    } else {
        vec![0.0..=range.to_deg, range.from_deg..=360.0]
    };
    for piece in pieces {
        let stroke = egui::Stroke::new(3.0, ui.visuals().strong_text_color());
        ui.painter()
            .hline(at(*piece.start())..=at(*piece.end()), rect.top() + 11.5, stroke);
    }
}
