//! The charts that stand still: no zoom, no drag, no text at the cursor.

use egui::{AsIdSalt, Ui};
use egui_plot::Plot;

/// Makes a chart that does not move, with a grid that is quiet in every theme.
pub fn still(ui: &Ui, id: impl AsIdSalt) -> Plot<'static> {
    Plot::new(id)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_drag(false)
        .allow_zoom(false)
        .grid_color(ui.visuals().text_color().gamma_multiply(0.3))
        .label_formatter(|_| None)
        .show_x(false)
        .show_y(false)
}
