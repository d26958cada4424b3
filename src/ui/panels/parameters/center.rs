//! The fruit center p_c: its method and the method's settings.

use egui::Ui;
use glam::DVec3;

use super::cloud::unit_of;
use super::defaults;
use crate::app::{Command, State, Tool};
use crate::method::{Aggregation, CenterMethod, Preset, RandomSearch};
use crate::ui::widgets::controls::{
    Choice, Coordinates, Edit, Number, choice_row, coordinates, count, hint, row, section, toggle,
};

#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    Equidistant,
    MeanRms,
    Sphere,
    Given,
}

impl Method {
    fn of(center: &CenterMethod) -> Self {
        match center {
            CenterMethod::Equidistant(_) => Self::Equidistant,
            CenterMethod::MeanRms(_) => Self::MeanRms,
            CenterMethod::Sphere => Self::Sphere,
            CenterMethod::Given(_) => Self::Given,
        }
    }

    /// Returns its explanation, with the place in the paper.
    fn tip(self) -> &'static str {
        match self {
            Self::Equidistant => {
                "The random point whose distances to the surface deviate least from their mean: Eq. 3 as \
                 intended."
            }
            Self::MeanRms => {
                "The random point with the least RMS distance to the points: Eq. 3 as printed. It finds the \
                 points' mean, which lies too near to the camera."
            }
            Self::Sphere => "The center of the sphere that fits the points best. Not in the paper.",
            Self::Given => "Typed, or moved in the view. Not in the paper.",
        }
    }
}

pub(super) fn show(ui: &mut Ui, state: &State, edit: &mut Edit<'_>, commands: &mut Vec<Command>) {
    let params = &edit.request.params;
    // The default in the reading that the score follows, so that a reset leads back to a preset.
    let default = defaults(match params.aggregation {
        Aggregation::Mean => Preset::AsIntended,
        Aggregation::Sum => Preset::AsPrinted,
    })
    .center;
    let differs = params.center != default;
    let is_reset = section(ui, "Fruit center", true, differs, |ui| {
        method(ui, state, edit);
        settings(ui, state, edit);
        let moves = state.tool == Tool::MoveCenter;
        let tip = "Dragging in the view then moves the fruit center instead of the camera, in the plane of \
                   the screen.";
        if toggle(ui, moves, "Move in the view", tip) {
            commands.push(Command::Use(if moves {
                Tool::Navigate
            } else {
                Tool::MoveCenter
            }));
        }
        if moves {
            hint(
                ui,
                "Drag in the view to move the center. Click here again to turn the camera.",
            );
        }
    });
    if is_reset {
        edit.request.params.center = default;
    }
}

fn method(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) {
    let tip = "How p_c is found, the point that every candidate plane goes through (§ 2.4, Eq. 3).";
    let center = &mut edit.request.params.center;
    let choice = |method: Method, text: &str| Choice::new(method, text, method.tip());
    let choices = vec![
        choice(Method::Equidistant, "equidistant"),
        choice(Method::MeanRms, "mean-rms"),
        choice(Method::Sphere, "sphere"),
        choice(Method::Given, "given by X, Y, Z"),
    ];
    let now = Method::of(center);
    let chosen = choice_row(ui, "Method", "Method of the fruit center", &now, tip, choices);
    // The settings of the random search outlive a look at the other methods.
    let memory = ui.make_persistent_id("random search");
    if let Some(search) = center.search() {
        ui.data_mut(|data| data.insert_temp(memory, search));
    }
    let search = || {
        ui.data(|data| data.get_temp::<RandomSearch>(memory))
            .unwrap_or_default()
    };
    match chosen {
        Some(Method::Equidistant) => *center = CenterMethod::Equidistant(search()),
        Some(Method::MeanRms) => *center = CenterMethod::MeanRms(search()),
        Some(Method::Sphere) => *center = CenterMethod::Sphere,
        // A given center begins where the computed one is.
        Some(Method::Given) => {
            *center = CenterMethod::Given(state.analysis().map_or(DVec3::ZERO, |a| a.center));
        }
        None => {}
    }
}

fn settings(ui: &mut Ui, state: &State, edit: &mut Edit<'_>) {
    let mut center = edit.request.params.center;
    match &mut center {
        CenterMethod::Equidistant(search) | CenterMethod::MeanRms(search) => {
            let default = RandomSearch::default();
            let tip = format!(
                "The number of random points that the center is picked from (§ 2.4). {} unless changed; with more it \
                 is found more closely.",
                default.count
            );
            let response = row(ui, "Random points", &tip, |ui| {
                count(ui, "Random points", &mut search.count, 1..=10_000_000, &tip)
            });
            edit.note(&response, "center samples");
            let tip = "How widely the random points are scattered about the cloud's mean, in multiples of the \
                       cloud's own spread.";
            let number = Number::new(
                "Spread of the random points, in multiples of the cloud's",
                0.01..=100.0,
            )
            .suffix(" × cloud")
            .steps(0.01, 2);
            let response = number.row(ui, "Spread", &mut search.spread, tip);
            edit.note(&response, "center spread");
            let tip = "The seed of the random points: the same seed gives the same points on every machine.";
            let response = row(ui, "Seed", tip, |ui| {
                let size = egui::vec2(Number::WIDTH, ui.spacing().interact_size.y);
                let field = egui::DragValue::new(&mut search.seed)
                    .clamp_existing_to_range(false)
                    .update_while_editing(false)
                    .speed(1.0)
                    .min_size(size);
                ui.add(field).on_hover_text(tip).accessible_name("Seed")
            });
            edit.note(&response, "seed");
        }
        CenterMethod::Sphere => {}
        CenterMethod::Given(place) => {
            let response = Coordinates {
                name: "Center",
                tip: "p_c in the file's unit and frame.",
                unit: unit_of(state),
            }
            .show(ui, place);
            edit.note(&response, "center");
        }
    }
    edit.request.params.center = center;
    if let Some(analysis) = state
        .analysis()
        .filter(|_| !matches!(center, CenterMethod::Given(_)) && !state.true_axes.is_blind)
    {
        let found = format!("Found at {}", coordinates(analysis.center, unit_of(state)));
        hint(
            ui,
            if state.is_stale {
                format!("{found} (with older settings)")
            } else {
                found
            },
        );
    }
}
