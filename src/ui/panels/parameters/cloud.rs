//! The cloud's unit, its normals, and the viewpoint of the camera.

use std::num::NonZeroUsize;

use egui::Ui;

use super::defaults;
use crate::app::State;
use crate::geometry::Unit;
use crate::method::{NormalSource, Preset};
use crate::ui::widgets::controls::{Choice, Coordinates, Edit, choice_row, count, row, section};

/// Returns the file's unit, once that is known.
pub(super) fn unit_of(state: &State) -> Option<Unit> {
    let walked = state.walked.as_ref().map(|walked| walked.fruit.unit);
    state.settings.request.unit.or(walked)
}

fn name(unit: Unit) -> &'static str {
    match unit {
        Unit::Meter => "meters",
        Unit::Centimeter => "centimeters",
        Unit::Millimeter => "millimeters",
    }
}

pub(super) fn show(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) {
    let default = defaults(Preset::AsIntended);
    let request = &edit.request;
    let differs = request.unit.is_some()
        || request.normals.is_some()
        || request.params.k != default.k
        || request.params.viewpoint != default.viewpoint;
    let is_reset = section(ui, "Unit, normals, viewpoint", false, differs, |ui| {
        unit(ui, state, edit);
        normals(ui, state, edit);
        let response = Coordinates {
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
    let tip = "The unit of the file's coordinates. Whatever it is, distances are scored in centimeters.";
    let came_to = state.walked.as_ref().map(|walked| walked.fruit.unit);
    let auto = match came_to.filter(|_| edit.request.unit.is_none()) {
        Some(unit) => format!("auto: {unit}"),
        None => "auto".into(),
    };
    let mut choices = vec![Choice::new(
        None,
        auto,
        "The unit that the file states, else guessed from its extent.",
    )];
    choices.extend(Unit::ALL.map(|unit| {
        Choice::new(
            Some(unit),
            name(unit),
            "Instead of the unit that the file states.",
        )
    }));
    let now = &edit.request.unit;
    let chosen = choice_row(ui, "File's unit", "Unit of the file", now, tip, choices);
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
    let hindrance = (has_normals == Some(false)).then_some("This file has no normals (nx, ny, nz).");
    let choices = vec![
        Choice::new(None, auto, "The file's normals if it has them, else estimates."),
        Choice::new(
            Some(NormalSource::Estimate),
            "estimate",
            "A plane is fitted to each point's neighborhood (Eq. 2).",
        ),
        Choice::new(
            Some(NormalSource::File),
            "file",
            "The file's normals, which are not turned towards the viewpoint.",
        )
        .unless(hindrance),
    ];
    let now = &edit.request.normals;
    let chosen = choice_row(ui, "Normals", "Source of the normals", now, tip, choices);
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
            count(ui, "Neighbors k of a normal", &mut k, 3..=100_000, tip)
        })
        .inner
    });
    edit.request.params.k = NonZeroUsize::new(k).unwrap_or(edit.request.params.k);
    edit.note(&response, "k");
}
