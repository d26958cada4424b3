//! The grid of candidate planes, and how they are scored.

use egui::Ui;

use super::defaults;
use crate::method::{Aggregation, CandidateGrid, Preset, TAU_CM_PER_RAD};
use crate::ui::widgets::controls::{Choice, Edit, Number, SliderRow, choice_row, hint, section};

/// Shows the two numbers that are changed most: the steps of the grid, and τ.
pub(super) fn grid_and_weight(ui: &mut Ui, edit: &mut Edit<'_>) {
    let tip = "Steps of the candidate grid along each angle (Eq. 4–10): u × u planes. The paper uses 6. A \
               finer grid comes nearer to the true plane, and takes longer.";
    let mut u = edit.request.params.u as f64;
    let (response, is_reset) = SliderRow {
        label: "Grid steps u",
        tip,
        number: Number::new(
            "Grid steps u",
            CandidateGrid::MIN_U as f64..=CandidateGrid::MAX_U as f64,
        )
        .width(56.0),
        // More take minutes for a large cloud.
        usual: CandidateGrid::MIN_U as f64..=60.0,
        step: 1.0,
    }
    .show(ui, &mut u, edit.request.params.u != 6);
    edit.note(&response, "u");
    // Clamped by the field, and by the slider.
    edit.request.params.u = if is_reset { 6 } else { u.round() as usize };
    let u = edit.request.params.u;
    hint(
        ui,
        format!(
            "{} candidate planes, {:.1}° from step to step",
            u * u,
            180.0 / u as f64
        ),
    );
    ui.add_space(2.0);

    let tip = "The weight of an angle against a distance in S = d + τξ (Eq. 15), in centimeters per radian. \
               The paper found 3/π = 0.955 by trial. At 0 only distances count. Takes effect at once.";
    let tau = &mut edit.request.params.tau_cm_per_rad;
    let can_reset = *tau != TAU_CM_PER_RAD;
    let (response, is_reset) = SliderRow {
        label: "Angle weight τ",
        tip,
        number: Number::new("Angle weight τ in cm/rad", 0.0..=1000.0)
            .suffix(" cm/rad")
            .steps(0.01, 3)
            .width(92.0),
        usual: 0.0..=4.0,
        step: 0.0,
    }
    .show(ui, tau, can_reset);
    if is_reset {
        *tau = TAU_CM_PER_RAD;
    }
    edit.note(&response, "tau");
}

/// Shows how a plane's score is computed from those of its points.
pub(super) fn show(ui: &mut Ui, edit: &mut Edit<'_>) {
    let params = &edit.request.params;
    // The default in the reading that the center follows, so that a reset leads back to a preset.
    let default = defaults(params.center.preset().unwrap_or(Preset::AsIntended));
    let differs = params.aggregation != default.aggregation
        || params.min_partner_fraction != default.min_partner_fraction;
    let is_reset = section(ui, "Score of a plane", true, differs, |ui| {
        let tip = "How a plane's score is computed from its points' scores S (§ 2.5). Takes effect at once.";
        let params = &mut edit.request.params;
        let choices = vec![
            Choice::new(
                Aggregation::Mean,
                "mean",
                "The mean over the points with a partner.",
            ),
            Choice::new(
                Aggregation::Sum,
                "sum",
                "The sum over the points with a partner, as printed. A plane that leaves hardly a point with a \
                 partner wins.",
            ),
        ];
        let chosen = choice_row(ui, "Add up as", "Aggregation", &params.aggregation, tip, choices);
        if let Some(aggregation) = chosen {
            // The least share follows, unless it was set by hand.
            if params.min_partner_fraction == params.aggregation.default_min_partner_fraction() {
                params.min_partner_fraction = aggregation.default_min_partner_fraction();
            }
            params.aggregation = aggregation;
        }
        let mut percent = 100.0 * params.min_partner_fraction;
        let before = percent;
        let usual = 100.0 * params.aggregation.default_min_partner_fraction();
        let (response, _) = SliderRow {
            label: "Least partners",
            tip: "The least share of points with a visible partner (Eq. 14) with which a plane can win, in percent. \
                  Not in the paper, which amounts to 0 %. Takes effect at once.",
            number: Number::new("Least share of partners in percent", 0.0..=100.0)
                .suffix(" %")
                .steps(0.2, 1)
                .width(62.0),
            usual: 0.0..=100.0,
            step: 1.0,
        }
        .show(ui, &mut percent, false);
        if percent != before {
            // The default stays the exact number, by which the preset is recognized.
            params.min_partner_fraction = if (percent - usual).abs() < 1e-9 {
                params.aggregation.default_min_partner_fraction()
            } else {
                percent / 100.0
            };
        }
        edit.note(&response, "partners");
    });
    if is_reset {
        edit.request.params.aggregation = default.aggregation;
        edit.request.params.min_partner_fraction = default.min_partner_fraction;
    }
}
