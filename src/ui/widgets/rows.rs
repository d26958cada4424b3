//! The parts of long tables: heads of columns that sort, rows to choose from, and the list that scrolls them.
//!
//! A row is one widget with one name, which a screen reader says and the keyboard reaches; tables of cells, such
//! as `egui_extras` has, are as many widgets as cells.

use std::ops::RangeInclusive;

use egui::{
    Align2, Color32, Id, Pos2, Rect, Response, Role, ScrollArea, Sense, Shape, Stroke, TextStyle, Ui, Vec2,
    WidgetInfo, vec2,
};

/// The head of a column, which sorts the rows.
pub struct ColumnHead<'a> {
    /// The column's name.
    pub title: &'a str,
    /// The explanation of the column, and of a click.
    pub tip: String,
    /// Whether the text stands at the left.
    pub is_left: bool,
    /// The distance of the text from the column's edge, in logical pixels.
    pub margin: f32,
    /// The order of the rows, if they are sorted by this column: whether values fall from row to row.
    pub is_descending: Option<bool>,
}

impl ColumnHead<'_> {
    /// Shows the head in the table `id`.
    pub fn show(self, ui: &Ui, id: Id, place: Rect) -> Response {
        let response = ui.interact(place, id.with(self.title), Sense::click());
        response.widget_info(|| {
            let label = format!("Sort by {}", self.title);
            WidgetInfo::selected(Role::ColumnHeader, true, self.is_descending.is_some(), label)
        });
        let painter = ui.painter();
        if response.hovered() || response.has_focus() {
            let fill = ui.style().interact(&response).weak_bg_fill;
            painter.rect_filled(place.shrink(1.0), 3.0, fill);
        }
        let (font, color) = (
            TextStyle::Body.resolve(ui.style()),
            ui.visuals().strong_text_color(),
        );
        let by = vec2(self.margin, 0.0);
        let text = if self.is_left {
            painter.text(
                place.left_center() + by,
                Align2::LEFT_CENTER,
                self.title,
                font,
                color,
            )
        } else {
            painter.text(
                place.right_center() - by,
                Align2::RIGHT_CENTER,
                self.title,
                font,
                color,
            )
        };
        if let Some(is_descending) = self.is_descending {
            let x = if self.is_left {
                text.right() + 8.0
            } else {
                text.left() - 7.0
            };
            arrow(ui, Pos2::new(x, place.center().y), is_descending);
        }
        response.on_hover_text(self.tip)
    }
}

/// Draws a small triangle beside the name of a sorted column: up where values grow downward.
fn arrow(ui: &Ui, middle: Pos2, is_descending: bool) {
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

/// Draws the line under the heads of the columns.
pub fn underline(ui: &Ui, heads: Rect) {
    let line = ui.visuals().widgets.noninteractive.bg_stroke;
    ui.painter().hline(heads.x_range(), heads.bottom(), line);
}

/// Shows the ground of a row, known by `id` wherever it stands; returns the color of its texts as well.
pub fn row(
    ui: &mut Ui,
    id: Id,
    size: Vec2,
    is_chosen: bool,
    name: impl Fn() -> String,
) -> (Response, Color32) {
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let response = ui.interact(rect, id, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Row, true, is_chosen, name()));
    let visuals = ui.visuals();
    let (fill, color) = if is_chosen {
        (visuals.selection.bg_fill, visuals.selection.stroke.color)
    } else if response.hovered() || response.has_focus() {
        let hovered = &visuals.widgets.hovered;
        (hovered.weak_bg_fill, hovered.text_color())
    } else {
        (Color32::TRANSPARENT, visuals.text_color())
    };
    ui.painter().rect_filled(rect, 2.0, fill);
    (response, color)
}

/// Shows the rows in sight of `count` rows; scrolls first so that the row `wanted` comes into view, unless it is
/// there already.
pub fn list(
    ui: &mut Ui,
    id: Id,
    row_height: f32,
    count: usize,
    wanted: Option<usize>,
    mut add_row: impl FnMut(&mut Ui, usize),
) {
    let mut area = ScrollArea::vertical()
        .id_salt(id.with("rows"))
        .auto_shrink([false, false]);
    let memory = id.with("in sight");
    if let Some(wanted) = wanted {
        let top = wanted as f32 * row_height;
        let seen: Option<RangeInclusive<f32>> = ui.data(|data| data.get_temp(memory));
        let seen = seen.unwrap_or(0.0..=ui.available_height());
        if top < *seen.start() || top + row_height > *seen.end() {
            let height = seen.end() - seen.start();
            area = area.vertical_scroll_offset((top - 0.4 * height).max(0.0));
        }
    }
    let output = area.show_rows(ui, row_height, count, |ui, rows| {
        rows.for_each(|row| add_row(ui, row));
    });
    let top = output.state.clamped_offset().y;
    let seen = top..=top + output.inner_rect.height();
    ui.data_mut(|data| data.insert_temp(memory, seen));
}
