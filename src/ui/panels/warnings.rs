//! What ought to be known about the result, as a compact list.

use egui::{Color32, Label, RichText, Shape, Stroke, Ui, pos2, vec2};

use crate::app::{Command, State};
use crate::ui::widgets::controls::warning_color;

/// Shows why there is no result, and what makes one less certain.
pub fn show(ui: &mut Ui, state: &State, _commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.y = 4.0;
    let unanalyzed = state.unanalyzed.as_ref().and_then(|(_, why)| why.as_ref());
    if let Some(why) = unanalyzed {
        line(ui, why, true);
    }
    for warning in &state.warnings {
        line(ui, warning, false);
    }
    if unanalyzed.is_none() && state.warnings.is_empty() {
        ui.label(if state.walked.is_some() {
            "There is nothing to warn of."
        } else {
            "There is no result yet."
        });
    }
}

/// How many lines there are: for a badge on the panel's title.
pub fn count(state: &State) -> usize {
    state.warnings.len() + usize::from(state.unanalyzed.as_ref().is_some_and(|(_, why)| why.is_some()))
}

fn line(ui: &mut Ui, text: &str, is_failure: bool) {
    ui.horizontal_top(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(14.0, 14.0), egui::Sense::hover());
        let color = warning_color(ui);
        let triangle = [
            pos2(rect.center().x, rect.top() + 1.0),
            pos2(rect.right() - 1.0, rect.bottom() - 1.0),
            pos2(rect.left() + 1.0, rect.bottom() - 1.0),
        ];
        // Filled where there is no result at all.
        let fill = if is_failure { color } else { Color32::TRANSPARENT };
        ui.painter().add(Shape::convex_polygon(
            triangle.to_vec(),
            fill,
            Stroke::new(1.5, color),
        ));
        let inside = if is_failure {
            ui.visuals().panel_fill
        } else {
            color
        };
        let x = rect.center().x;
        ui.painter().vline(
            x,
            (rect.top() + 5.5)..=(rect.top() + 9.0),
            Stroke::new(1.5, inside),
        );
        ui.painter()
            .circle_filled(pos2(x, rect.top() + 11.0), 0.8, inside);
        let text = RichText::new(text);
        ui.add(Label::new(if is_failure { text.strong() } else { text }).wrap());
    });
}
