//! “Why this score?”: the steps of the method for one point, as numbers.

use egui::{Button, Color32, Label, RichText, Ui};
use glam::DVec3;

use crate::app::inspector::why::{NEIGHBOR_COLOR, POINT_COLOR, REFLECTION_COLOR, Why, why};
use crate::app::{Command, State};
use crate::geometry::Unit;
use crate::method::{PartnerSteps, PointSteps, Side};
use crate::render::Color;
use crate::text::sentence;
use crate::ui::widgets::controls::{button, caution, coordinates, hint, small};

/// Shows the steps of the picked point, or else of the point under the cursor.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.y = 3.0;
    let picked = state.picked.and_then(|index| why(state, index));
    let is_picked = picked.is_some();
    let pointed = || state.pointed_at.and_then(|index| why(state, index));
    let Some(explained) = picked.or_else(pointed) else {
        empty(ui, state);
        return;
    };
    heading(ui, state, &explained, is_picked, commands);
    point(ui, &explained);
    match &explained.steps {
        Ok(steps) => {
            let unit = explained.unit;
            reflection(ui, unit, steps);
            visibility(ui, steps);
            if let Some(partner) = &steps.partner {
                neighbor(ui, unit, partner, explained.share_below);
            } else {
                title(ui, 4, "No partner", "Eq. 14", None);
                let why = "d and ξ do not exist: the camera could not have seen a partner of this point, so \
                           it adds nothing to the plane's score.";
                ui.add(Label::new(why).wrap());
            }
        }
        Err(why_not) => {
            ui.add_space(4.0);
            caution(ui, sentence(&why_not.to_string()));
        }
    }
    if state.is_stale || state.is_look_pending {
        hint(ui, "Of older settings; the newer result is on its way.");
    }
}

fn empty(ui: &mut Ui, state: &State) {
    if state.shown().is_none() {
        ui.label("Open a cloud first.");
        return;
    }
    ui.label("No point is picked.");
    hint(
        ui,
        "Click a point in the 3-D view to see, step by step, what it adds to the score of the plane: its \
         reflection, whether a partner could be seen, and how far the surface there differs. While the cursor \
         is on a point, its steps are previewed here.",
    );
}

fn heading(ui: &mut Ui, state: &State, why: &Why, is_picked: bool, commands: &mut Vec<Command>) {
    if !is_picked {
        hint(ui, "Under the cursor. Click the point to keep it.");
        return;
    }
    ui.horizontal_wrapped(|ui| {
        let partner = why.steps.as_ref().ok().and_then(|steps| steps.partner.as_ref());
        let go = ui
            .add_enabled(partner.is_some(), Button::new("Go to partner"))
            .on_hover_text("Picks the nearest neighbor of this point's reflection.")
            .on_disabled_hover_text("This point has no visible partner.");
        if let Some(partner) = partner.filter(|_| go.clicked()) {
            // This searches all points, but only on a click.
            let place = state.look.as_ref().and_then(|look| {
                let wanted = Some(partner.surface_index);
                look.shown.in_surface.iter().position(|at| at == wanted)
            });
            if place.is_some() {
                commands.push(Command::Pick(place));
            }
        }
        if button(ui, "Turn about it", "Makes the camera turn about this point.") {
            commands.push(Command::PivotOnPicked);
        }
        if button(ui, "Clear", "Clears the picked point.") {
            commands.push(Command::Pick(None));
        }
    });
}

/// Shows the title of a step, with its place in the paper and its color in the view.
fn title(ui: &mut Ui, number: usize, text: &str, place: &str, color: Option<Color>) {
    ui.add_space(6.0);
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("{number}  {text}")).strong());
        if let Some([r, g, b, _]) = color {
            let (rect, _) = ui.allocate_exact_size(egui::vec2(10.0, 10.0), egui::Sense::hover());
            let outline = egui::Stroke::new(1.0, ui.visuals().text_color());
            ui.painter()
                .circle(rect.center(), 4.5, Color32::from_rgb(r, g, b), outline);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let font = small(ui);
            ui.label(RichText::new(place).font(font));
        });
    });
}

/// Shows a value with its name.
fn value(ui: &mut Ui, name: &str, value: String, tip: &str) {
    ui.horizontal(|ui| {
        ui.add_space(12.0);
        ui.label(name).on_hover_text(tip);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let color = ui.visuals().strong_text_color();
            ui.add(Label::new(RichText::new(value).color(color)).truncate())
                .on_hover_text(tip);
        });
    });
}

fn direction(n: DVec3) -> String {
    format!("{:.3}, {:.3}, {:.3}", n.x, n.y, n.z)
}

fn point(ui: &mut Ui, why: &Why) {
    title(ui, 1, "The point p", "Fig. 6", Some(POINT_COLOR));
    value(
        ui,
        "Index",
        why.shown_index.to_string(),
        "Its place among the points that are shown, from 0.",
    );
    value(
        ui,
        "Position",
        coordinates(why.position, why.unit),
        "X, Y, Z in the file's unit and frame.",
    );
    if let Ok(steps) = &why.steps {
        value(
            ui,
            "Normal n",
            direction(steps.normal),
            "Its normal (Eq. 2), of unit length, in the file's frame.",
        );
        let side = match steps.side {
            Side::Front => "in front",
            Side::Back => "behind",
        };
        value(
            ui,
            "Side of the plane",
            format!("{side}, {:.3} cm", steps.plane_distance_cm.abs()),
            "In front is the side that the plane's normal points to. Behind it: its distance from the plane.",
        );
    }
}

fn reflection(ui: &mut Ui, unit: Option<Unit>, steps: &PointSteps) {
    title(ui, 2, "Its reflection", "Eq. 12, 13", Some(REFLECTION_COLOR));
    value(
        ui,
        "Position",
        coordinates(steps.reflection, unit),
        "The point's mirror image in the plane (Eq. 12).",
    );
    value(
        ui,
        "Normal ñ",
        direction(steps.reflected_normal),
        "The mirror image of the point's normal (Eq. 13).",
    );
}

fn visibility(ui: &mut Ui, steps: &PointSteps) {
    title(ui, 3, "Could it be seen?", "Eq. 14", None);
    let tip = "The inner product of the reflected normal ñ and the vector from the reflection to the viewpoint \
               p_v. Above 0 the surface there would face the camera.";
    value(
        ui,
        "ñ · (viewpoint − reflection)",
        format!("{:.2} cm", steps.visibility_cm),
        tip,
    );
    let verdict = if steps.visibility_cm > 0.0 {
        "above 0: a partner would be visible"
    } else {
        "not above 0: a partner would face away"
    };
    value(ui, "", verdict.into(), tip);
}

fn neighbor(ui: &mut Ui, unit: Option<Unit>, partner: &PartnerSteps, share_below: Option<f64>) {
    title(ui, 4, "Nearest neighbor", "Fig. 6a", Some(NEIGHBOR_COLOR));
    value(
        ui,
        "Index among used points",
        partner.surface_index.to_string(),
        "Its place among the points that the method uses, from 0.",
    );
    value(
        ui,
        "Position",
        coordinates(partner.position, unit),
        "The point of the cloud that is nearest to the reflection.",
    );
    value(
        ui,
        "Normal",
        direction(partner.normal),
        "Its normal (Eq. 2), of unit length, in the file's frame.",
    );
    title(ui, 5, "What it adds", "Eq. 15", None);
    value(
        ui,
        "Distance d",
        format!("{:.4} cm", partner.distance_cm),
        "From the reflection to its nearest neighbor.",
    );
    value(
        ui,
        "Angle ξ",
        format!(
            "{:.2}° = {:.4} rad",
            partner.angle_rad.to_degrees(),
            partner.angle_rad
        ),
        "Between the reflected normal and the neighbor's.",
    );
    value(
        ui,
        "Weighted angle τξ",
        format!("{:.4} cm", partner.weighted_angle_cm),
        "The angle in radians times τ.",
    );
    value(
        ui,
        "S = d + τξ",
        format!("{:.4} cm", partner.score_cm),
        "The contribution of the point to the plane's score.",
    );
    let tau = partner.tau_cm_per_rad;
    hint(
        ui,
        format!("With τ = {tau:.3} cm/rad. At τ = 0 it would be d alone."),
    );
    shares(ui, partner);
    if let Some(share) = share_below {
        let percent = (100.0 * share).round().clamp(0.0, 100.0);
        hint(
            ui,
            format!("Larger than the scores of about {percent:.0} % of the plane's points."),
        );
    }
}

/// Shows the shares of d and τξ in S.
fn shares(ui: &mut Ui, partner: &PartnerSteps) {
    if partner.score_cm <= 0.0 {
        return;
    }
    let (rect, response) =
        ui.allocate_exact_size(egui::vec2(ui.available_width(), 16.0), egui::Sense::hover());
    let share = (partner.distance_cm / partner.score_cm) as f32;
    let middle = rect.left() + share * rect.width();
    // White is readable on both.
    let (of_d, of_angle) = (
        Color32::from_rgb(0x1f, 0x6f, 0xb0),
        Color32::from_rgb(0xa8, 0x49, 0x00),
    );
    let painter = ui.painter_at(rect);
    let parts = [
        (rect.with_max_x(middle), of_d, "d"),
        (rect.with_min_x(middle), of_angle, "τξ"),
    ];
    for (part, color, name) in parts {
        painter.rect_filled(part, 0.0, color);
        if part.width() > 20.0 {
            let (at, font) = (part.center(), small(ui));
            painter.text(at, egui::Align2::CENTER_CENTER, name, font, Color32::WHITE);
        }
    }
    response.on_hover_text(format!(
        "d is {:.0} % of S, τξ {:.0} %.",
        100.0 * share,
        100.0 * (1.0 - share)
    ));
}
