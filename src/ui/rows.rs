//! Long tables, of which only the rows in sight are drawn.

use egui::ScrollArea;

/// Scrolls so that the row at `place` comes into view, unless it is there already. `top` and `height` are
/// what was in sight in the last frame, in logical pixels.
pub(super) fn into_view(
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
