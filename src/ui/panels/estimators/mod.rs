//! The axis by several estimators: which one counts, how sure each is, and why the fitted body has the axis that it has.

mod charts;
mod reasons;

use egui::{Grid, Label, RichText, Ui};

use crate::app::estimators::{BodyPart, EstimatorsCommand};
use crate::app::{Command, State};
use crate::estimate::{Estimate, Estimator, Prior};
use crate::method::axis_error_rad;
use crate::ui::widgets::controls::{Choice, caution, checkbox, choice_row, hint, section, small};
use crate::ui::widgets::notice;

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let estimators = &state.estimators;
    let Some(paper) = estimators.paper.as_ref().filter(|_| state.walked.is_some()) else {
        notice::nothing_to_show(ui, state, commands);
        return;
    };
    notice::if_stale(ui, state, commands);
    let body = estimators.body.as_deref();
    ui.spacing_mut().item_spacing.y = 4.0;
    let columns = [
        (
            "axis",
            "The estimator whose axis counts in the view and in the bar below",
        ),
        ("error (°)", "The angle between the axis and the reference axis"),
        (
            "sure (%)",
            "The probability that the axis is within 15° of the true one, where the estimator states one",
        ),
        (
            "ms",
            "The time of the estimate; the paper's is the analysis itself",
        ),
    ];
    Grid::new("estimators")
        .num_columns(4)
        .spacing([14.0, 4.0])
        .show(ui, |ui| {
            for (title, tip) in columns {
                ui.label(RichText::new(title).font(small(ui))).on_hover_text(tip);
            }
            ui.end_row();
            row(ui, state, Estimator::Paper, Some(paper), None, commands);
            let estimate = body.map(|body| &body.estimate);
            row(
                ui,
                state,
                Estimator::Body,
                estimate,
                body.map(|body| body.ms),
                commands,
            );
        });
    if state.reference().is_none() {
        hint(ui, "There is no reference axis to measure errors against.");
    }
    if let Some(problem) = &estimators.problem {
        caution(ui, problem.as_str());
    } else if estimators.is_pending {
        hint(
            ui,
            match body {
                Some(_) => "The body is being fitted again; what stands here is of the settings before.",
                None => "The body is being fitted.",
            },
        );
    }
    for (name, estimate) in [
        ("Paper", Some(&**paper)),
        ("Body", body.map(|body| &body.estimate)),
    ] {
        for warning in estimate
            .map(|estimate| estimate.warnings.as_slice())
            .unwrap_or_default()
        {
            caution(ui, format!("{name}: {warning}"));
        }
    }
    prior(ui, state, commands);
    let Some((body, fitted)) = body.and_then(|body| Some((body, body.fitted.as_ref()?))) else {
        return;
    };
    parts(ui, state, commands);
    section(ui, "Why this axis?", true, false, |ui| {
        reasons::show(ui, body, fitted);
    });
    section(ui, "Profile", true, false, |ui| charts::profile(ui, fitted));
    section(ui, "Outline in the image", true, false, |ui| {
        charts::outline(ui, fitted);
    });
}

fn row(
    ui: &mut Ui,
    state: &State,
    estimator: Estimator,
    estimate: Option<&Estimate>,
    ms: Option<f64>,
    commands: &mut Vec<Command>,
) {
    let title = match estimator {
        Estimator::Body => "Body",
        _ => "Paper",
    };
    let counts = state.estimators.counts == estimator;
    let axis = estimate.and_then(|estimate| estimate.axis.as_ref());
    if ui
        .radio(counts, title)
        .on_hover_text("Let this axis count")
        .clicked()
        && !counts
    {
        commands.push(Command::Estimators(EstimatorsCommand::Count(estimator)));
    }
    let error = axis
        .zip(state.reference())
        .map(|(axis, reference)| axis_error_rad(axis, reference));
    let none = || "–".to_owned();
    ui.label(error.map_or_else(none, |error| format!("{:.1}", error.to_degrees())));
    let confidence = estimate.and_then(|estimate| estimate.confidence);
    let mut sure = confidence.map_or_else(none, |share| format!("{:.0}", 100.0 * share));
    if estimate.is_some_and(|estimate| estimate.ambiguous) {
        sure += ", ambiguous";
    }
    ui.label(sure);
    ui.label(ms.map_or_else(none, |ms| format!("{ms:.0}")));
    ui.end_row();
}

/// The choice of the assumption about the axis.
fn prior(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let chosen = state.settings.request.estimates.prior;
    let choices = vec![
        Choice::new(
            Prior::default(),
            "little lean",
            "The axis leans out of the image plane by up to 30° for free, and more at a cost",
        ),
        Choice::new(
            Prior::Up,
            "upright",
            "Axes that are upright in the image cost less",
        ),
        Choice::new(Prior::None, "none", "Nothing is assumed about the axis"),
    ];
    let tip = "What the body's fit assumes about the axis";
    if let Some(prior) = choice_row(ui, "Prior", "Prior of the body's axis", &chosen, tip, choices) {
        commands.push(Command::Estimators(EstimatorsCommand::Prior(prior)));
    }
}

/// The switches of what the view shows of the body.
fn parts(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let estimators = &state.estimators;
    let counts = estimators.counts == Estimator::Body;
    ui.horizontal_wrapped(|ui| {
        ui.add(Label::new("In the view:"));
        for (part, is_on, text, tip) in [
            (
                BodyPart::Axis,
                estimators.parts.axis || counts,
                "body's axis",
                "The axis of the fitted body; it is always shown where it counts",
            ),
            (
                BodyPart::Alternatives,
                estimators.parts.alternatives,
                "other axes",
                "The other axes that the fit considered, dashed",
            ),
            (
                BodyPart::Surface,
                estimators.parts.surface,
                "surface",
                "The fitted body: blue where points lie near it, gray where no point does",
            ),
        ] {
            let mut is_on = is_on;
            ui.add_enabled_ui(part != BodyPart::Axis || !counts, |ui| {
                if checkbox(ui, &mut is_on, text, tip) {
                    commands.push(Command::Estimators(EstimatorsCommand::Show(part, is_on)));
                }
            });
        }
    });
}
