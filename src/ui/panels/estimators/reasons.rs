//! Why the fitted body has this axis: its costs, its rivals and its outline, in words and numbers.

use egui::{Grid, RichText, Ui};

use crate::app::estimators::{BodyResult, FittedBody};
use crate::estimate::{Estimate, Occlusion, SEEN_SHARE_SD};
use crate::geometry::angle_between_lines_rad;
use crate::ui::widgets::controls::{hint, small};

/// Shows the reasons, then the other axes.
pub(super) fn show(ui: &mut Ui, body: &BodyResult, fitted: &FittedBody) {
    for sentence in sentences(body, fitted) {
        hint(ui, sentence);
    }
    others(ui, &body.estimate, fitted);
}

fn sentences(body: &BodyResult, fitted: &FittedBody) -> Vec<String> {
    let estimate = &body.estimate;
    let mut sentences = vec![format!(
        "Cost {:.1}, the negative logarithm of the evidence with outline and prior. The points lie {:.2} cm from the body \
         (root mean square).",
        fitted.cost, fitted.rms_cm
    )];
    sentences.push(match (estimate.lead, rival_deg(estimate)) {
        (Some(lead), Some(rival_deg)) => {
            format!("The best axis more than 20° away costs {lead:.1} more; it lies {rival_deg:.0}° away.")
        }
        (Some(lead), None) => format!("The best axis more than 20° away costs {lead:.1} more."),
        (None, _) => "No axis more than 20° away was left to compare with.".into(),
    });
    sentences.push(match fitted.outline_misfit {
        Some(misfit) => format!(
            "The body's outline differs from the seen contour by {misfit:.2}: the mean over the sectors of the squared \
             excess, in standard deviations and bounded."
        ),
        None => "There is no outline to compare with.".into(),
    });
    sentences.push(format!(
        "The prior “{}” adds {:.1}.",
        body.prior, fitted.prior_cost
    ));
    sentences.extend(seen(estimate));
    sentences
}

fn seen(estimate: &Estimate) -> Option<String> {
    let (share, occlusion) = (estimate.seen_share?, estimate.occlusion?);
    let occluded = match occlusion {
        Occlusion::None => "hardly anything is hidden",
        Occlusion::Light => "the fruit is lightly hidden",
        Occlusion::Serious => "the fruit is seriously hidden",
    };
    Some(format!(
        "Of its cross-section {:.0} % ± {:.0} % is seen: {occluded}.",
        100.0 * share,
        100.0 * SEEN_SHARE_SD
    ))
}

/// The angle in degrees from the axis to the best other axis that the lead is measured against.
fn rival_deg(estimate: &Estimate) -> Option<f64> {
    let axis = estimate.axis.as_ref()?;
    let away = |direction| angle_between_lines_rad(axis.direction, direction).to_degrees();
    let mut away = estimate.alternatives.iter().map(|other| away(other.direction));
    away.find(|&away_deg| away_deg > 20.0)
}

/// The other axes: how far away each lies, and how much more it costs.
fn others(ui: &mut Ui, estimate: &Estimate, fitted: &FittedBody) {
    let Some(axis) = estimate
        .axis
        .as_ref()
        .filter(|_| !estimate.alternatives.is_empty())
    else {
        hint(ui, "The fit considered no other axis.");
        return;
    };
    Grid::new("other axes")
        .num_columns(2)
        .spacing([14.0, 2.0])
        .show(ui, |ui| {
            for title in ["other axes, away (°)", "cost above the best"] {
                ui.label(RichText::new(title).font(small(ui)));
            }
            ui.end_row();
            for other in &estimate.alternatives {
                let away_deg = angle_between_lines_rad(axis.direction, other.direction).to_degrees();
                ui.label(format!("{away_deg:.0}"));
                ui.label(format!("{:.1}", other.cost - fitted.cost));
                ui.end_row();
            }
        });
}
