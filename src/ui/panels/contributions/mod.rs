//! The histogram of the points' contributions to the score of a plane; its brush finds points in the view.

mod histogram;

use std::ops::RangeInclusive;
use std::sync::Arc;

use egui::{Key, RichText, Ui};

use crate::app::inspector::look::Look;
use crate::app::inspector::why::why;
use crate::app::{Command, State};
use crate::method::PlaneDetail;
use crate::ui::widgets::controls::{hint, small};
use crate::ui::widgets::memo::{ByAddress, memo};
use crate::view::grouped;
use histogram::Histogram;

/// Shows the histogram, and the brushed range in words.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.y = 4.0;
    let drawn = state
        .look
        .as_ref()
        .and_then(|look| Some((look, look.contributions.as_ref()?)));
    let Some((look, contributions)) = drawn else {
        empty(ui, state);
        return;
    };
    let is_old = state.is_stale || state.is_look_pending;
    let points: usize = contributions.counts.iter().sum();
    let plane = look
        .analysis
        .as_ref()
        .zip(look.plane_index)
        .map(|(analysis, index)| {
            let candidate = analysis.planes.grid.candidate(index);
            format!("Plane g {}, h {}: what its", candidate.g, candidate.h)
        });
    hint(
        ui,
        format!(
            "{} {} points with a partner add to the score, S = d + τξ (Eq. 15)",
            plane.as_deref().unwrap_or("What the"),
            grouped(points as u64),
        ),
    );
    let picked_cm = state
        .picked
        .and_then(|index| why(state, index))
        .and_then(|why| Some(why.steps.ok()?.partner?.score_cm));
    ui.scope(|ui| {
        if is_old {
            ui.set_opacity(0.5);
        }
        Histogram {
            contributions,
            brush_cm: state.brush_cm.as_ref(),
            picked_cm,
        }
        .show(ui, commands);
    });
    match &state.brush_cm {
        Some(brush_cm) => brushed(ui, look, brush_cm, commands),
        None => {
            hint(ui, "Drag over the bars to see in the view which points they are.");
        }
    }
}

fn empty(ui: &mut Ui, state: &State) {
    if state.shown().is_none() {
        ui.label("Open a cloud first.");
    } else if state.look.as_ref().is_some_and(|look| look.detail.is_some()) {
        ui.label("No point has a visible partner under this plane, so none adds anything to its score.");
    } else if state.analysis().is_none() {
        ui.label("This cloud was not analyzed.");
    } else {
        ui.label(
            "There is no plane to look at: none has enough partners. Lower the least share of partners.",
        );
    }
}

/// Shows the brushed range in words, and the button that clears it.
fn brushed(ui: &mut Ui, look: &Look, brush_cm: &RangeInclusive<f64>, commands: &mut Vec<Command>) {
    let Some(counted) = Counted::of(ui, look, brush_cm) else {
        return;
    };
    let range = if brush_cm.end().is_finite() {
        format!("{:.3} to {:.3} cm", brush_cm.start(), brush_cm.end())
    } else {
        format!("{:.3} cm and above", brush_cm.start())
    };
    ui.horizontal_wrapped(|ui| {
        let text = format!(
            "{range}: {} points, {:.0} % of the points and {:.0} % of the sum",
            grouped(counted.points as u64),
            100.0 * counted.points as f64 / counted.all_points.max(1) as f64,
            100.0 * counted.share_of_sum
        );
        let font = small(ui);
        ui.label(RichText::new(text).font(font));
        if ui
            .small_button("Clear")
            .on_hover_text("Shows all points again. Escape does too.")
            .clicked()
        {
            commands.push(Command::Brush(None));
        }
    });
    let no_field_has_focus = ui.memory(|memory| memory.focused().is_none());
    if no_field_has_focus && ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, Key::Escape)) {
        commands.push(Command::Brush(None));
    }
}

/// The points in the brush.
struct Counted {
    points: usize,
    all_points: usize,
    share_of_sum: f64,
}

impl Counted {
    /// Counts the points once for each brush, not for each frame.
    fn of(ui: &Ui, look: &Look, brush_cm: &RangeInclusive<f64>) -> Option<Arc<Self>> {
        let detail = look.detail.as_ref()?;
        let tau_cm_per_rad = look.analysis.as_ref()?.params.tau_cm_per_rad;
        let key = (ByAddress(detail.clone()), tau_cm_per_rad, brush_cm.clone());
        Some(memo(ui.ctx(), ui.make_persistent_id("counted"), key, || {
            Self::new(detail, tau_cm_per_rad, brush_cm)
        }))
    }

    fn new(detail: &PlaneDetail, tau_cm_per_rad: f64, brush_cm: &RangeInclusive<f64>) -> Self {
        let (mut points, mut all_points, mut sum, mut all) = (0, 0, 0.0, 0.0);
        for partner in detail.points.iter().filter_map(|point| point.partner) {
            let score_cm = partner.score_cm(tau_cm_per_rad);
            (all_points, all) = (all_points + 1, all + score_cm);
            if brush_cm.contains(&score_cm) {
                (points, sum) = (points + 1, sum + score_cm);
            }
        }
        Self {
            points,
            all_points,
            share_of_sum: if all > 0.0 { sum / all } else { 0.0 },
        }
    }
}
