//! Marks on candidate planes, the same in every drawing of planes, and their key.

use egui::{
    Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, TextStyle, Ui, Vec2, vec2,
};

use crate::app::State;
use crate::app::inspector::planes::Planes;
use crate::render::Color;
use crate::view::value_color;

/// An entry of the key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// The best plane: a ring.
    Best,
    /// The runner-up: a broken ring.
    RunnerUp,
    /// The chosen plane: a frame.
    Chosen,
    /// A plane without a score, as a cell.
    Hatched,
    /// A plane without a score, as a dot.
    Gray,
    /// Two dots, the larger with more partners.
    Sizes,
    /// The ray to the camera.
    ViewRay,
    /// A line in a color.
    Line(Color),
}

const HALO: Color32 = Color32::from_rgb(0x10, 0x12, 0x14);

/// Returns a color of the renderer as one of the interface.
pub fn color32([r, g, b, a]: Color) -> Color32 {
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

/// Returns the color of the program's ramp at `t`, 0 to 1.
pub fn ramp_color(t: f64) -> Color32 {
    color32(value_color(t))
}

/// Returns the font of the labels in and around drawings.
pub fn label_font(ui: &Ui) -> FontId {
    let body = TextStyle::Body.resolve(ui.style());
    FontId::new((0.86 * body.size).max(10.5), body.family)
}

/// Draws a ring that stands out on every color: whole for the best plane, broken for the runner-up.
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

/// Draws a frame around the chosen plane, a thinner one around a previewed plane.
pub fn frame(painter: &Painter, rect: Rect, is_chosen: bool) {
    let (outer, inner) = if is_chosen { (4.0, 2.0) } else { (3.0, 1.0) };
    let around = StrokeKind::Middle;
    painter.rect_stroke(rect, 1.0, Stroke::new(outer, HALO), around);
    painter.rect_stroke(rect, 1.0, Stroke::new(inner, Color32::WHITE), around);
}

/// Marks the drawn planes: frames around the previewed and the chosen one, rings around the runner-up and the best.
/// `frame_of` and `ring_of` give their places by the plane's index.
pub fn paint_planes(
    painter: &Painter,
    state: &State,
    planes: &Planes,
    frame_of: impl Fn(usize) -> Option<Rect>,
    ring_of: impl Fn(usize) -> Option<(Pos2, f32)>,
) {
    let chosen = state.chosen_plane_index();
    let previewed = state.previewed.filter(|_| state.previewed != chosen);
    for (index, is_chosen) in [(previewed, false), (chosen, true)] {
        if let Some(rect) = index.and_then(&frame_of) {
            frame(painter, rect, is_chosen);
        }
    }
    for (index, is_best) in [(planes.runner_up(), false), (planes.best(), true)] {
        if let Some((center, radius)) = index.and_then(&ring_of) {
            ring(painter, center, radius, is_best);
        }
    }
}

/// Draws the diamond that stands for the direction to the camera.
pub fn diamond(painter: &Painter, center: Pos2, radius: f32) {
    let corners = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]
        .map(|(x, y)| center + radius * vec2(x, y))
        .to_vec();
    painter.add(Shape::closed_line(corners.clone(), Stroke::new(3.5, HALO)));
    painter.add(Shape::closed_line(corners, Stroke::new(1.5, Color32::WHITE)));
}

/// Draws a line that stands out on dark and on light.
pub fn outlined_line(painter: &Painter, ends: [Pos2; 2], color: Color) {
    painter.line_segment(ends, Stroke::new(4.0, HALO));
    painter.line_segment(ends, Stroke::new(2.0, color32(color)));
}

/// Returns the stroke of hatches.
pub fn hatch_stroke(ui: &Ui) -> Stroke {
    Stroke::new(1.0, ui.visuals().text_color().gamma_multiply(0.5))
}

/// Returns the entries of the key for the marks in a drawing, where planes without a score are marked by `without`.
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

/// Shows the key of the marks, in as many lines as it needs.
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
