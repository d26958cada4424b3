//! Coordinates in the file's unit and frame: their fields, and their text.

use egui::{DragValue, Label, Response, Ui};
use glam::DVec3;

use super::fields::is_edit;
use crate::geometry::Unit;

/// Returns the decimals of a coordinate, for tenths of a millimeter.
pub fn decimals(unit: Option<Unit>) -> usize {
    match unit {
        Some(Unit::Centimeter) => 2,
        Some(Unit::Millimeter) => 1,
        Some(Unit::Meter) | None => 4,
    }
}

/// Formats a position with its unit.
pub fn coordinates(place: DVec3, unit: Option<Unit>) -> String {
    let decimals = decimals(unit);
    let unit = unit.map_or(String::new(), |unit| format!(" {unit}"));
    let DVec3 { x, y, z } = place;
    format!("{x:.decimals$}, {y:.decimals$}, {z:.decimals$}{unit}")
}

/// Three fields for coordinates in the file's unit and frame.
pub struct Coordinates<'a> {
    /// The name before X, Y and Z.
    pub name: &'a str,
    /// The explanation.
    pub tip: &'a str,
    /// The file's unit, if it is known.
    pub unit: Option<Unit>,
}

impl Coordinates<'_> {
    /// Shows them; returns the union of their responses.
    pub fn show(&self, ui: &mut Ui, place: &mut DVec3) -> Response {
        let unit = self.unit.map_or("file's unit", Unit::symbol);
        ui.add(Label::new(format!("{} X, Y, Z ({unit})", self.name)).truncate())
            .on_hover_text(self.tip);
        ui.horizontal(|ui| {
            let width = (ui.available_width() - 2.0 * ui.spacing().item_spacing.x) / 3.0;
            let mut all: Option<Response> = None;
            for (value, axis) in [(&mut place.x, "X"), (&mut place.y, "Y"), (&mut place.z, "Z")] {
                let one = self.coordinate(ui, value, axis, width.max(40.0));
                all = Some(match all {
                    Some(others) => others | one,
                    None => one,
                });
            }
            all
        })
        .inner
        .unwrap_or_else(|| ui.label(""))
    }

    fn coordinate(&self, ui: &mut Ui, value: &mut f64, axis: &str, width: f32) -> Response {
        // Large coordinates keep to their field.
        let places = decimals(self.unit);
        let digits = if value.abs() >= 1.0 {
            value.abs().log10() as usize
        } else {
            0
        };
        let places = places.min(6_usize.saturating_sub(digits));
        let mut typed = *value;
        let field = DragValue::new(&mut typed)
            .range(-1e12..=1e12)
            .clamp_existing_to_range(false)
            .update_while_editing(false)
            .speed(0.05 / self.unit.map_or(100.0, Unit::in_cm))
            .max_decimals(places)
            .min_size(egui::vec2(width, ui.spacing().interact_size.y));
        let unit = self.unit.map_or("the file's unit", Unit::symbol);
        let response = ui
            .add(field)
            .on_hover_text(self.tip)
            .accessible_name(format!("{} {axis} in {unit}", self.name));
        if is_edit(&response, *value, typed, places) {
            *value = typed;
        }
        response
    }
}
