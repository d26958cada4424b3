//! The parts of the best axis's error: a stacked bar, their numbers, the nearest candidate and the center's share.

use egui::{Color32, Id, Rect, Sense, Stroke, StrokeKind, Ui, vec2};

use super::memo::{ByAddress, memo};
use crate::app::{Command, PlaneChoice, State};
use crate::evaluate::ErrorBreakdown;

/// The length of the bar in points.
const LENGTH: f32 = 140.0;

/// The name of a part, its color, and its explanation.
const PARTS: [(&str, Color32, &str); 3] = [
    (
        "lean",
        Color32::from_rgb(0x8a, 0x8a, 0x8a),
        "The angle by which the true axis leans towards the camera or away from it. Eq. 16 gives only axes across the \
         view ray, so no plane has a smaller error.",
    ),
    (
        "grid",
        Color32::from_rgb(0xe6, 0xa8, 0x17),
        "The rest of the error of the nearest candidate, the plane of the grid whose axis is nearest to the true one",
    ),
    (
        "choice",
        Color32::from_rgb(0xc2, 0x45, 0x2d),
        "The rest of the error of the best plane, which has the lowest score and need not be the nearest candidate",
    ),
];

/// Shows the parts of the error against the chosen reference in two lines; nothing without a reference.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let (Some(walked), Some(reference)) = (&state.walked, state.reference()) else {
        return;
    };
    let key = (ByAddress(walked.clone()), reference.clone());
    let id = Id::unique("parts of the error");
    let parts = memo(ui.ctx(), id, key, || state.error_breakdown());
    let Some(parts) = &*parts else { return };
    ui.horizontal_wrapped(|ui| numbers(ui, parts));
    ui.horizontal_wrapped(|ui| comparisons(ui, parts, commands));
}

fn numbers(ui: &mut Ui, parts: &ErrorBreakdown) {
    let Some((error, choice)) = parts.error_deg.zip(parts.choice_part_deg) else {
        return;
    };
    let values = [parts.lean_part_deg, parts.grid_part_deg, choice];
    bar(ui, values, error);
    ui.label(format!("Axis error {error:.1}° ="));
    for (place, ((name, color, tip), value)) in PARTS.into_iter().zip(values).enumerate() {
        let (swatch, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
        ui.painter().rect_filled(swatch, 2.0, color);
        let plus = if place + 1 < PARTS.len() { " +" } else { "" };
        ui.label(format!("{value:.1}° {name}{plus}")).on_hover_text(tip);
    }
}

fn bar(ui: &mut Ui, values: [f64; 3], error: f64) {
    let (rect, _) = ui.allocate_exact_size(vec2(LENGTH, 10.0), Sense::hover());
    let mut left = rect.left();
    for ((_, color, _), value) in PARTS.into_iter().zip(values) {
        let width = rect.width() * (value / error.max(1e-9)) as f32;
        let part = Rect::from_min_size(egui::pos2(left, rect.top()), vec2(width, rect.height()));
        ui.painter().rect_filled(part, 0.0, color);
        left += width;
    }
    let outline = Stroke::new(1.0, ui.visuals().weak_text_color());
    ui.painter().rect_stroke(rect, 0.0, outline, StrokeKind::Outside);
}

fn comparisons(ui: &mut Ui, parts: &ErrorBreakdown, commands: &mut Vec<Command>) {
    let nearest = &parts.nearest_candidate;
    // Steps of a grid, 360 at most.
    let (g, h) = (nearest.g as usize, nearest.h as usize);
    let rank = nearest
        .rank
        .map_or("no score".into(), |rank| format!("rank {rank}"));
    ui.label("Nearest candidate:");
    let link = ui
        .link(format!("g {g}, h {h}"))
        .on_hover_text("The plane whose axis is nearest to the true one. A click looks at it.");
    if link.clicked() {
        commands.push(Command::LookAt(PlaneChoice::At { g, h }));
    }
    ui.label(format!("({rank}, {:.1}° off).", nearest.error_deg));
    if let Some(given) = &parts.true_center {
        let error = given
            .error_deg
            .map_or("no axis".into(), |error| format!("{error:.1}° off"));
        ui.label(format!("True center, {:.1} cm away: {error}.", given.distance_cm))
            .on_hover_text(
                "The distance of the true center from the computed one, and the error of the method with it",
            );
    }
}
