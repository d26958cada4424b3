//! The bars, their axes and marks, and the brush that is dragged over them.

use std::ops::RangeInclusive;

use egui::{
    Align2, Color32, FontId, Rect, Response, Sense, Stroke, Ui, WidgetInfo, accesskit::Role, pos2, vec2,
};

use crate::app::Command;
use crate::app::inspector::look::Contributions;
use crate::ui::widgets::controls::small;
use crate::view::{grouped, round_step};

const BARS: Color32 = Color32::from_rgb(0x2b, 0x8c, 0xd6);
const PICKED: Color32 = Color32::from_rgb(0xe6, 0x9f, 0x00);

/// The histogram itself.
pub(in crate::ui) struct Histogram<'a> {
    pub(in crate::ui) contributions: &'a Contributions,
    pub(in crate::ui) brush_cm: Option<&'a RangeInclusive<f64>>,
    pub(in crate::ui) picked_cm: Option<f64>,
}

/// The place of the bars, and the scales of their axes.
struct Frame {
    bars: Rect,
    most_cm: f64,
    most_points: usize,
}

impl Frame {
    fn x(&self, cm: f64) -> f32 {
        self.bars.left() + self.bars.width() * (cm / self.most_cm).clamp(0.0, 1.0) as f32
    }

    fn cm(&self, x: f32) -> f64 {
        let part = (x - self.bars.left()) / self.bars.width();
        f64::from(part.clamp(0.0, 1.0)) * self.most_cm
    }

    fn y(&self, points: f64) -> f32 {
        self.bars.bottom() - self.bars.height() * (points / self.most_points.max(1) as f64) as f32
    }
}

impl Histogram<'_> {
    pub(in crate::ui) fn show(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        // One or two lines of text stand below.
        let height = (ui.available_height() - 44.0).clamp(130.0, 260.0);
        let (rect, response) =
            ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click_and_drag());
        response.widget_info(|| {
            WidgetInfo::labeled(
                Role::Image,
                ui.is_enabled(),
                "Histogram of the contributions S in centimeters",
            )
        });
        let small = small(ui);
        let most_points = self.contributions.counts.iter().copied().max().unwrap_or(0);
        let widest = ui
            .painter()
            .layout_no_wrap(grouped(most_points as u64), small.clone(), Color32::PLACEHOLDER)
            .size()
            .x;
        let mut bars = rect;
        bars.min.x += widest + 8.0;
        bars.min.y += 18.0;
        bars.max.x -= 2.0;
        bars.max.y -= 32.0;
        let frame = Frame {
            bars,
            most_cm: self.contributions.bin_cm * self.contributions.counts.len() as f64,
            most_points,
        };
        self.drag(ui, &response, &frame, commands);
        self.paint_bars(ui, &frame);
        paint_axes(ui, &frame, &small, rect);
        self.paint_last_bin(ui, &frame, &small);
        self.paint_marks(ui, &frame, &small);
        if let Some(at) = response.hover_pos().filter(|_| !response.dragged()) {
            self.explain(response, frame.cm(at.x));
        }
    }

    /// Brushes while dragging; a click clears.
    fn drag(&self, ui: &Ui, response: &Response, frame: &Frame, commands: &mut Vec<Command>) {
        let begin = response.id.with("begin");
        if response.drag_started() {
            let at = ui.input(|input| input.pointer.press_origin());
            let at = at.or(response.interact_pointer_pos());
            if let Some(at) = at {
                ui.data_mut(|data| data.insert_temp(begin, frame.cm(at.x)));
            }
        }
        if response.dragged()
            && let Some(at) = response.interact_pointer_pos()
            && let Some(from) = ui.data(|data| data.get_temp::<f64>(begin))
        {
            let to = frame.cm(at.x);
            let (low, high) = (from.min(to), from.max(to));
            // The last bin holds all higher contributions as well.
            let is_in_last_bin = high > frame.most_cm - self.contributions.bin_cm;
            let high = if is_in_last_bin { f64::INFINITY } else { high };
            let wanted = low..=high;
            if high > low && self.brush_cm != Some(&wanted) {
                commands.push(Command::Brush(Some(wanted)));
            }
        }
        if response.clicked() && self.brush_cm.is_some() {
            commands.push(Command::Brush(None));
        }
    }

    fn paint_bars(&self, ui: &Ui, frame: &Frame) {
        let painter = ui.painter();
        if let Some(brush) = self.brush_cm {
            let range = frame.x(*brush.start())..=frame.x(*brush.end());
            let rect = Rect::from_x_y_ranges(range, frame.bars.y_range());
            painter.rect_filled(rect, 0.0, BARS.gamma_multiply(0.22));
            for x in [rect.left(), rect.right()] {
                painter.vline(x, frame.bars.y_range(), Stroke::new(1.0, BARS));
            }
        }
        let dim = ui.visuals().text_color().gamma_multiply(0.45);
        for (bin, &points) in self.contributions.counts.iter().enumerate() {
            if points == 0 {
                continue;
            }
            let (from, to) = self.span(bin);
            let middle = 0.5 * (from + to);
            let color = match self.brush_cm {
                Some(brush) if !brush.contains(&middle) => dim,
                _ => BARS,
            };
            // Even a single point is visible.
            let top = frame.y(points as f64).min(frame.bars.bottom() - 1.0);
            let gap = if frame.bars.width() > 144.0 { 0.5 } else { 0.0 };
            let rect = Rect::from_min_max(
                pos2(frame.x(from) + gap, top),
                pos2(frame.x(to) - gap, frame.bars.bottom()),
            );
            painter.rect_filled(rect, 0.0, color);
        }
    }

    /// Returns the range of contributions in a bin; the last one holds those above as well.
    fn span(&self, bin: usize) -> (f64, f64) {
        let width = self.contributions.bin_cm;
        (bin as f64 * width, (bin + 1) as f64 * width)
    }

    fn holds_more(&self, frame: &Frame) -> bool {
        self.contributions.most_cm > frame.most_cm
    }

    fn paint_last_bin(&self, ui: &Ui, frame: &Frame, font: &FontId) {
        let last = self.contributions.counts.len().saturating_sub(1);
        if !self.holds_more(frame) {
            return;
        }
        let color = ui.visuals().text_color();
        let (from, _) = self.span(last);
        let x = 0.5 * (frame.x(from) + frame.bars.right());
        let top = frame.y(self.contributions.counts[last] as f64) - 3.0;
        let text = format!("and above, to {:.2} cm", self.contributions.most_cm);
        let galley = ui.painter().layout_no_wrap(text, font.clone(), color);
        let above = (top - galley.size().y - 6.0).max(frame.bars.top());
        let place = pos2(frame.bars.right() - galley.size().x, above);
        ui.painter().galley(place, galley, color);
        ui.painter().vline(x, (top - 6.0)..=top, Stroke::new(1.0, color));
    }

    fn paint_marks(&self, ui: &Ui, frame: &Frame, font: &FontId) {
        let ink = ui.visuals().strong_text_color();
        let x = frame.x(self.contributions.mean_cm);
        let from = frame.bars.top() - 4.0;
        ui.painter()
            .vline(x, from..=frame.bars.bottom(), Stroke::new(1.5, ink));
        let text = format!("mean {:.3} cm", self.contributions.mean_cm);
        let galley = ui.painter().layout_no_wrap(text, font.clone(), ink);
        // To the right of its line, where there is room.
        let left = (x - 1.0).min(frame.bars.right() - galley.size().x);
        ui.painter()
            .galley(pos2(left, from - galley.size().y), galley, ink);
        if let Some(picked_cm) = self.picked_cm {
            let x = frame.x(picked_cm);
            let y = frame.bars.bottom();
            let corners = vec![pos2(x, y - 1.0), pos2(x - 5.0, y + 8.0), pos2(x + 5.0, y + 8.0)];
            ui.painter().add(egui::Shape::convex_polygon(
                corners,
                PICKED,
                Stroke::new(1.0, ink),
            ));
        }
    }

    /// Shows the contents of the bin under the cursor.
    fn explain(&self, response: Response, cm: f64) {
        let last = self.contributions.counts.len().saturating_sub(1);
        // Not negative.
        let bin = ((cm / self.contributions.bin_cm) as usize).min(last);
        let (from, to) = self.span(bin);
        let points = grouped(self.contributions.counts[bin] as u64);
        let is_open = bin == last && self.contributions.most_cm > to;
        let range = if is_open {
            format!("{from:.3} cm and above")
        } else {
            format!("{from:.3} to {to:.3} cm")
        };
        let picked = self.picked_cm.map_or(String::new(), |cm| {
            format!("\nThe triangle marks the picked point: {cm:.3} cm")
        });
        let text = format!("{range}: {points} points{picked}");
        response.on_hover_text_at_pointer(text);
    }
}

fn paint_axes(ui: &Ui, frame: &Frame, font: &FontId, rect: Rect) {
    let (painter, color) = (ui.painter(), ui.visuals().text_color());
    let stroke = Stroke::new(1.0, color);
    painter.hline(frame.bars.x_range(), frame.bars.bottom(), stroke);
    let step = round_step(
        frame.most_cm,
        f64::from(frame.bars.width() / 60.0).clamp(2.0, 8.0),
    );
    let decimals = usize::try_from((-step.log10().floor()) as i64).unwrap_or(0);
    let mut tick = 0.0;
    while tick <= frame.most_cm * (1.0 + 1e-9) {
        let x = frame.x(tick);
        painter.vline(x, frame.bars.bottom()..=frame.bars.bottom() + 3.0, stroke);
        let text = format!("{tick:.decimals$}");
        let galley = painter.layout_no_wrap(text, font.clone(), color);
        let left = (x - 0.5 * galley.size().x).min(rect.right() - galley.size().x);
        painter.galley(pos2(left, frame.bars.bottom() + 4.0), galley, color);
        tick += step;
    }
    painter.text(
        pos2(frame.bars.center().x, rect.bottom()),
        Align2::CENTER_BOTTOM,
        "S (cm)",
        font.clone(),
        color,
    );
    let most = grouped(frame.most_points as u64);
    let left = frame.bars.left() - 4.0;
    painter.text(
        pos2(left, frame.bars.top()),
        Align2::RIGHT_CENTER,
        most,
        font.clone(),
        color,
    );
    painter.text(
        pos2(left, frame.bars.bottom()),
        Align2::RIGHT_CENTER,
        "0",
        font.clone(),
        color,
    );
    painter.text(
        pos2(rect.left(), rect.top()),
        Align2::LEFT_TOP,
        "points",
        font.clone(),
        color,
    );
}
