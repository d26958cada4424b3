//! Guide lines of the charts, and their texts.

use egui::{Align2, Color32, Ui, pos2, vec2};
use egui_plot::{HLine, LineStyle, PlotUi};

use super::CURRENT;
use crate::ui::widgets::controls::small;

/// Draws guide lines, and collects their texts.
pub(in crate::ui) struct Guides<'a, 'b> {
    pub(in crate::ui) plot: &'a mut PlotUi<'b>,
    pub(in crate::ui) color: Color32,
    pub(in crate::ui) texts: Vec<Written>,
}

/// A text at the left or right edge of the chart, above or below the line at `y`.
pub(in crate::ui) struct Written {
    y: f64,
    text: String,
    align: Align2,
}

impl Guides<'_, '_> {
    /// Adds a dashed line at `y` with a text.
    pub(in crate::ui) fn at(&mut self, y: f64, text: &str, align: Align2) {
        self.line(
            y,
            text,
            self.color.gamma_multiply(0.75),
            LineStyle::dashed_dense(),
        );
        self.write(y, text, align);
    }

    /// Adds a line at the mean of the clouds, with a text at the right.
    pub(in crate::ui) fn mean(&mut self, y: f64) {
        let text = format!("mean {y:.1}°");
        self.line(y, &text, CURRENT, LineStyle::Solid);
        self.write(y, &text, Align2::RIGHT_BOTTOM);
    }

    fn line(&mut self, y: f64, name: &str, color: Color32, style: LineStyle) {
        let line = HLine::new(name, y).color(color).style(style).width(1.5);
        self.plot.hline(line.allow_hover(false));
    }

    /// Adds a text at the line at `y`.
    pub(in crate::ui) fn write(&mut self, y: f64, text: &str, align: Align2) {
        self.texts.push(Written {
            y,
            text: text.to_owned(),
            align,
        });
    }
}

impl Written {
    /// Draws the text above the chart on a background of its own, since bars may lie behind it. It does not affect the
    /// bounds of the plot.
    pub(in crate::ui) fn paint(&self, ui: &Ui, transform: &egui_plot::PlotTransform) {
        let frame = *transform.frame();
        let y = transform.position_from_point_y(self.y);
        let is_left = self.align.x() == egui::Align::Min;
        let x = if is_left {
            frame.left() + 6.0
        } else {
            frame.right() - 6.0
        };
        let painter = ui.painter().with_clip_rect(frame);
        let (font, color) = (small(ui), ui.visuals().text_color());
        let galley = painter.layout_no_wrap(self.text.clone(), font, color);
        let away = if self.align.y() == egui::Align::Max {
            -2.0
        } else {
            2.0
        };
        let place = self.align.anchor_size(pos2(x, y + away), galley.size());
        let ground = ui.visuals().extreme_bg_color.gamma_multiply(0.8);
        painter.rect_filled(place.expand2(vec2(3.0, 0.0)), 2.0, ground);
        painter.galley(place.min, galley, color);
    }
}
