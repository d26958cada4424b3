//! How the cloud is read: its unit, its normals, and where the camera stood.

use std::num::NonZeroUsize;

use egui::{DragValue, Label, Response, Ui};
use glam::DVec3;

use super::defaults;
use crate::app::State;
use crate::geometry::Unit;
use crate::method::{NormalSource, Preset};
use crate::ui::widgets::controls::{Choice, Edit, choose, count, row, section};

/// The file's unit, once that is known.
pub(in crate::ui) fn unit_of(state: &State) -> Option<Unit> {
    let walked = state.walked.as_ref().map(|walked| walked.fruit.unit);
    state.settings.request.unit.or(walked)
}

/// Decimals of a coordinate: tenths of a millimeter.
pub(in crate::ui) fn decimals(unit: Option<Unit>) -> usize {
    match unit {
        Some(Unit::Centimeter) => 2,
        Some(Unit::Millimeter) => 1,
        Some(Unit::Meter) | None => 4,
    }
}

fn name(unit: Unit) -> &'static str {
    match unit {
        Unit::Meter => "meters",
        Unit::Centimeter => "centimeters",
        Unit::Millimeter => "millimeters",
    }
}

pub(in crate::ui) fn show(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) {
    let default = defaults(Preset::AsIntended);
    let request = &edit.request;
    let differs = request.unit.is_some()
        || request.normals.is_some()
        || request.params.k != default.k
        || request.params.viewpoint != default.viewpoint;
    let is_reset = section(ui, "Unit, normals, viewpoint", false, differs, |ui| {
        unit(ui, state, edit);
        normals(ui, state, edit);
        let response = Triple {
            name: "Viewpoint",
            tip: "Where the camera was, p_v, in the file's unit and frame. Normals are turned towards it, and \
                  it decides which partners were visible (Eq. 14). The paper takes the origin.",
            unit: unit_of(state),
        }
        .show(ui, &mut edit.request.params.viewpoint);
        edit.note(&response, "viewpoint");
    });
    if is_reset {
        let request = &mut edit.request;
        (request.unit, request.normals) = (None, None);
        (request.params.k, request.params.viewpoint) = (default.k, default.viewpoint);
    }
}

fn unit(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) {
    let tip = "The unit of the file's coordinates. Distances are scored in centimeters, whatever it is.";
    let came_to = state.walked.as_ref().map(|walked| walked.fruit.unit);
    let auto = match came_to.filter(|_| edit.request.unit.is_none()) {
        Some(unit) => format!("auto: {unit}"),
        None => "auto".into(),
    };
    let chosen = row(ui, "File's unit", tip, |ui| {
        let mut choices = vec![Choice::new(
            None,
            auto,
            "As the file states, else guessed from its extent.",
        )];
        choices.extend(
            Unit::ALL.map(|unit| Choice::new(Some(unit), name(unit), "Instead of what the file states.")),
        );
        choose(ui, "Unit of the file", &edit.request.unit, tip, choices)
    });
    if let Some(chosen) = chosen {
        edit.request.unit = chosen;
    }
}

fn normals(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) {
    let tip = "Where the points' normals come from (§ 2.3, Eq. 2).";
    let has_normals = state
        .walked
        .as_ref()
        .map(|walked| walked.fruit.cloud().normals().is_some());
    let auto = match has_normals {
        Some(true) => "auto: file",
        Some(false) => "auto: estimate",
        None => "auto",
    };
    let hindered = (has_normals == Some(false)).then_some("This file has no normals (nx, ny, nz).");
    let chosen = row(ui, "Normals", tip, |ui| {
        choose(
            ui,
            "Source of the normals",
            &edit.request.normals,
            tip,
            vec![
                Choice::new(None, auto, "The file's where it has them, else estimated."),
                Choice::new(
                    Some(NormalSource::Estimate),
                    "estimate",
                    "A plane is fitted to each point's neighborhood (Eq. 2).",
                ),
                Choice::new(
                    Some(NormalSource::File),
                    "file",
                    "As they stand there; they are not turned towards the viewpoint.",
                )
                .unless(hindered),
            ],
        )
    });
    if let Some(chosen) = chosen {
        edit.request.normals = chosen;
    }
    let are_estimated = match edit.request.normals {
        Some(source) => source == NormalSource::Estimate,
        None => has_normals != Some(true),
    };
    let tip = if are_estimated {
        "k of Eq. 2: the neighbors that a normal is fitted to, the point itself among them; at least 3. More \
         give smoother normals."
    } else {
        "Not used: the normals come from the file."
    };
    let mut k = edit.request.params.k.get();
    let response = row(ui, "Neighbors k", tip, |ui| {
        ui.add_enabled_ui(are_estimated, |ui| {
            count(ui, "Neighbors k of a normal", &mut k, 3..=100_000, tip).on_disabled_hover_text(tip)
        })
        .inner
    });
    edit.request.params.k = NonZeroUsize::new(k).unwrap_or(edit.request.params.k);
    edit.note(&response, "k");
}

/// Three coordinates in the file's unit and frame.
pub(in crate::ui) struct Triple<'a> {
    pub(in crate::ui) name: &'a str,
    pub(in crate::ui) tip: &'a str,
    pub(in crate::ui) unit: Option<Unit>,
}

impl Triple<'_> {
    pub(in crate::ui) fn show(&self, ui: &mut Ui, place: &mut DVec3) -> Response {
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
        // A field that was only visited gives back what it shows, which is rounded.
        let resolution = 0.5 * 0.1_f64.powi(i32::try_from(places).unwrap_or(0));
        if response.changed() && (response.dragged() || (typed - *value).abs() > resolution) {
            *value = typed;
        }
        response
    }
}
