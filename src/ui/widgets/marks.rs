//! Marks on candidate planes, the same wherever planes are drawn, and their key.

use egui::{
    Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, TextStyle, Ui, Vec2, vec2,
};

use super::planes::{Planes, ramp_color};
use crate::app::State;
use crate::render::Color;

/// Whatever is marked, and explained in the key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// The best plane: a ring.
    Best,
    /// The runner-up: a broken ring.
    RunnerUp,
    /// The plane that is looked at: a frame.
    Chosen,
    /// A plane without a score, as a cell.
    Hatched,
    /// A plane without a score, as a dot.
    Gray,
    /// That larger dots have more partners.
    Sizes,
    /// The ray to the camera.
    ViewRay,
    /// A line in a color.
    Line(Color),
}

const HALO: Color32 = Color32::from_rgb(0x10, 0x12, 0x14);

/// A color of the renderer's as one of the interface's.
pub fn color32([r, g, b, a]: Color) -> Color32 {
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

/// The font of labels in and about drawings.
pub fn label_font(ui: &Ui) -> FontId {
    let body = TextStyle::Body.resolve(ui.style());
    FontId::new((0.86 * body.size).max(10.5), body.family)
}

/// A ring that stands out on every color: whole for the best plane, broken for the runner-up.
pub fn ring(painter: &Painter, center: Pos2, radius: f32, is_best: bool) {
    if is_best {
        painter.circle_stroke(center, radius, Stroke::new(4.0, HALO));
        painter.circle_stroke(center, radius, Stroke::new(2.0, Color32::WHITE));
        return;
    }
    // Four arcs.
    for quarter in 0..4 {
        let arc = |reach: f32| -> Vec<Pos2> {
            (0..=6)
                .map(|i| {
                    let turn = (quarter as f32 + 0.5 + reach * (i as f32 / 6.0 - 0.5)) / 4.0;
                    center + radius * Vec2::angled(std::f32::consts::TAU * turn)
                })
                .collect()
        };
        painter.line(arc(0.72), Stroke::new(4.0, HALO));
        painter.line(arc(0.60), Stroke::new(2.0, Color32::WHITE));
    }
}

/// A frame about the plane that is looked at, and a thinner one about a previewed one.
pub fn frame(painter: &Painter, rect: Rect, is_chosen: bool) {
    let (outer, inner) = if is_chosen { (4.0, 2.0) } else { (3.0, 1.0) };
    let around = StrokeKind::Middle;
    painter.rect_stroke(rect, 1.0, Stroke::new(outer, HALO), around);
    painter.rect_stroke(rect, 1.0, Stroke::new(inner, Color32::WHITE), around);
}

/// The diamond that stands for the direction to the camera.
pub fn diamond(painter: &Painter, center: Pos2, radius: f32) {
    let corners = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]
        .map(|(x, y)| center + radius * vec2(x, y))
        .to_vec();
    painter.add(Shape::closed_line(corners.clone(), Stroke::new(3.5, HALO)));
    painter.add(Shape::closed_line(corners, Stroke::new(1.5, Color32::WHITE)));
}

/// A line that stands out on dark and on light.
pub fn outlined_line(painter: &Painter, ends: [Pos2; 2], color: Color) {
    painter.line_segment(ends, Stroke::new(4.0, HALO));
    painter.line_segment(ends, Stroke::new(2.0, color32(color)));
}

/// What hatches are drawn with.
pub fn hatch_stroke(ui: &Ui) -> Stroke {
    Stroke::new(1.0, ui.visuals().text_color().gamma_multiply(0.5))
}

/// The marks of planes that there are to explain; those without a score are marked as `without`.
pub fn entries(state: &State, planes: &Planes, without: Mark) -> Vec<(Mark, &'static str)> {
    let marks = [
        (planes.best().is_some(), (Mark::Best, "best")),
        (planes.runner_up().is_some(), (Mark::RunnerUp, "runner-up")),
        (state.chosen_plane_index().is_some(), (Mark::Chosen, "looked at")),
        (
            planes.ranked() < planes.facts.len(),
            (without, "too few partners"),
        ),
    ];
    let shown = marks.into_iter().filter(|(is_there, _)| *is_there);
    shown.map(|(_, entry)| entry).collect()
}

/// Says what marks mean, in as many lines as they need.
pub fn key(ui: &mut Ui, entries: &[(Mark, &str)]) {
    let font = label_font(ui);
    let color = ui.visuals().text_color();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(12.0, 2.0);
        for (mark, text) in entries {
            let galley = ui
                .painter()
                .layout_no_wrap((*text).to_owned(), font.clone(), color);
            let symbol = vec2(14.0, 14.0);
            let size = vec2(symbol.x + 5.0 + galley.size().x, galley.size().y.max(symbol.y));
            let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, *text));
            let place = Rect::from_center_size(rect.left_center() + vec2(0.5 * symbol.x, 0.0), symbol);
            paint(ui, place, *mark);
            let at = egui::pos2(place.right() + 5.0, rect.center().y - 0.5 * galley.size().y);
            ui.painter().galley(at, galley, color);
        }
    });
}

fn paint(ui: &Ui, place: Rect, mark: Mark) {
    let painter = ui.painter();
    let middle = place.center();
    match mark {
        Mark::Best => ring(painter, middle, 5.0, true),
        Mark::RunnerUp => ring(painter, middle, 5.0, false),
        Mark::Chosen => frame(painter, place.shrink(2.0), true),
        Mark::Hatched => {
            let square = place.shrink(1.0);
            let stroke = hatch_stroke(ui);
            painter.rect_stroke(square, 0.0, stroke, StrokeKind::Inside);
            let painter = painter.with_clip_rect(square.intersect(painter.clip_rect()));
            for shift in [-6.0, 0.0, 6.0] {
                let by = vec2(shift, 0.0);
                painter.line_segment([square.left_bottom() + by, square.right_top() + by], stroke);
            }
        }
        Mark::Gray => {
            painter.circle_filled(middle, 3.0, ui.visuals().text_color().gamma_multiply(0.65));
        }
        Mark::Sizes => {
            painter.circle_filled(middle - vec2(4.0, 0.0), 2.0, ramp_color(0.45));
            painter.circle_filled(middle + vec2(3.0, 0.0), 4.5, ramp_color(0.45));
        }
        Mark::ViewRay => diamond(painter, middle, 5.0),
        Mark::Line(color) => outlined_line(painter, [place.left_center(), place.right_center()], color),
    }
}
