//! Long tables, of which only the rows in sight are drawn.

use egui::{Pos2, ScrollArea, Shape, Stroke, Ui, vec2};

/// Scrolls so that the row at `place` comes into view, unless it is there already. `top` and `height` are
/// what was in sight in the last frame, in logical pixels.
pub(in crate::ui) fn into_view(
    area: ScrollArea,
    place: usize,
    row_height: f32,
    top: f32,
    height: f32,
) -> ScrollArea {
    let of_row = place as f32 * row_height;
    if of_row >= top && of_row + row_height <= top + height {
        area
    } else {
        area.vertical_scroll_offset((of_row - 0.4 * height).max(0.0))
    }
}

/// A small triangle beside the name of a sorted column: up where values grow downward.
pub(in crate::ui) fn arrow(ui: &Ui, middle: Pos2, is_descending: bool) {
    let way = if is_descending { 1.0 } else { -1.0 };
    let corners = vec![
        middle + vec2(-3.5, -2.0 * way),
        middle + vec2(3.5, -2.0 * way),
        middle + vec2(0.0, 3.0 * way),
    ];
    let color = ui.visuals().strong_text_color();
    ui.painter()
        .add(Shape::convex_polygon(corners, color, Stroke::NONE));
}
