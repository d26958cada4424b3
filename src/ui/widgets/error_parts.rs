//! The parts of the best axis's error: a bar and a line of numbers, and under the cursor what they mean.

use egui::{Color32, Grid, Id, Label, Rect, Sense, Stroke, StrokeKind, Ui, pos2, vec2};

use super::memo::{ByAddress, memo};
use crate::app::{Command, PlaneChoice, State};
use crate::evaluate::ErrorBreakdown;

/// The height of the bar in points.
const HEIGHT: f32 = 6.0;

/// The name of a part, its color, and its explanation.
const PARTS: [(&str, Color32, &str); 3] = [
    (
        "lean",
        Color32::from_rgb(0x8a, 0x8a, 0x8a),
        "Eq. 16 gives only axes across the view ray, and the true axis leans out of that plane.",
    ),
    (
        "grid",
        Color32::from_rgb(0xe6, 0xa8, 0x17),
        "No candidate plane has an axis nearer to the true one than the nearest candidate.",
    ),
    (
        "choice",
        Color32::from_rgb(0xc2, 0x45, 0x2d),
        "The plane with the lowest score need not be the nearest candidate.",
    ),
];

/// Shows the parts of the error against the chosen reference; nothing without an error. A click on them looks at the
/// nearest candidate.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let (Some(walked), Some(reference)) = (&state.walked, state.reference()) else {
        return;
    };
    let key = (ByAddress(walked.clone()), reference.clone());
    let id = Id::unique("parts of the error");
    let parts = memo(ui.ctx(), id, key, || state.error_breakdown());
    let Some(parts) = &*parts else { return };
    let Some((error, choice)) = parts.error_deg.zip(parts.choice_part_deg) else {
        return;
    };
    let values = [parts.lean_part_deg, parts.grid_part_deg, choice];
    bar(ui, values, error);
    let words: Vec<String> = PARTS
        .iter()
        .zip(values)
        .map(|((name, ..), value)| format!("{value:.1}° {name}"))
        .collect();
    let against = reference.source.in_words();
    let text = format!("Error {error:.1}° against {against} = {}", words.join(" + "));
    let label = ui.add(Label::new(text).sense(Sense::click()));
    if label.on_hover_ui(|ui| details(ui, parts, values)).clicked() {
        let nearest = &parts.nearest_candidate;
        // Steps of a grid, 360 at most.
        let (g, h) = (nearest.g as usize, nearest.h as usize);
        commands.push(Command::LookAt(PlaneChoice::At { g, h }));
    }
}

fn bar(ui: &mut Ui, values: [f64; 3], error: f64) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    let mut left = rect.left();
    for ((_, color, _), value) in PARTS.into_iter().zip(values) {
        let width = rect.width() * (value / error.max(1e-9)) as f32;
        let part = Rect::from_min_size(pos2(left, rect.top()), vec2(width, HEIGHT));
        ui.painter().rect_filled(part, 0.0, color);
        left += width;
    }
    let outline = Stroke::new(1.0, ui.visuals().weak_text_color());
    ui.painter().rect_stroke(rect, 0.0, outline, StrokeKind::Inside);
}

fn details(ui: &mut Ui, parts: &ErrorBreakdown, values: [f64; 3]) {
    ui.set_max_width(2.0 * ui.spacing().tooltip_width);
    ui.strong("Where the error of the best axis comes from");
    Grid::new("parts of the error").num_columns(3).show(ui, |ui| {
        for ((name, color, text), value) in PARTS.into_iter().zip(values) {
            ui.horizontal(|ui| {
                let (swatch, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
                ui.painter().rect_filled(swatch, 2.0, color);
                ui.label(name);
            });
            ui.label(format!("{value:.1}°"));
            ui.label(text);
            ui.end_row();
        }
    });
    let nearest = &parts.nearest_candidate;
    let rank = nearest
        .rank
        .map_or("without a score".into(), |rank| format!("rank {rank}"));
    ui.label(format!(
        "Nearest candidate: g {}, h {}, {rank}, {:.1}° off. A click looks at it.",
        nearest.g, nearest.h, nearest.error_deg
    ));
    if let Some(given) = &parts.true_center {
        let error = given
            .error_deg
            .map_or("no axis".into(), |error| format!("{error:.1}° off"));
        let distance = given.distance_cm;
        ui.label(format!(
            "With the true center, {distance:.1} cm from the computed one: {error}."
        ));
    }
}
