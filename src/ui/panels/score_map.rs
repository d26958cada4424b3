//! The map of scores: one cell per candidate plane, g across and h down.

use egui::{Align2, Mesh, Painter, Pos2, Rect, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::app::inspector::planes::Planes;
use crate::app::{Command, PlaneChoice, State};
use crate::ui::widgets::marks::{self, Mark, color32};
use crate::ui::widgets::{color_scale, notice, plane_tip};

/// The narrowest cell with a gap to the next, in logical pixels.
const LEAST_CELL_WITH_GAP: f32 = 9.0;

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(planes) = notice::planes_or_reason(ui, state, commands) else {
        return;
    };
    if ui.available_height() > 250.0 {
        marks::key(ui, &marks::entries(state, &planes, Mark::Hatched));
    }
    let size = ui.available_size().max(vec2(140.0, 120.0));
    let (whole, _) = ui.allocate_exact_size(size, Sense::hover());
    let layout = Layout::new(ui, whole, &planes);
    let response = ui.interact(layout.cells, ui.scope_id().with("score map"), Sense::click());
    response.widget_info(|| {
        let label = format!("Score map, {}", plane_tip::spoken(state, &planes));
        WidgetInfo::labeled(Role::Image, true, label)
    });

    let hovered = response.hover_pos().and_then(|place| layout.index_at(place));
    plane_tip::interact(ui, &response, &planes, hovered, commands);
    move_by_keys(ui, &response, state, &planes, commands);

    let opacity = notice::opacity(state);
    layout.paint_cells(ui, &planes, opacity);
    layout.paint_marks(ui.painter(), state, &planes);
    layout.paint_labels(ui);
    if let Some(scale) = &planes.scale {
        color_scale::paint(ui, layout.scale, scale, opacity);
    }
    if response.has_focus() {
        let stroke = ui.visuals().selection.stroke;
        ui.painter()
            .rect_stroke(layout.cells, 0.0, stroke, egui::StrokeKind::Outside);
    }
}

/// Moves from cell to cell by the arrow keys while the map has the focus.
fn move_by_keys(ui: &Ui, response: &Response, state: &State, planes: &Planes, commands: &mut Vec<Command>) {
    let [across, down] = plane_tip::arrow_presses(ui, response);
    if across == 0 && down == 0 {
        return;
    }
    let from = state.chosen_plane_index().and_then(|i| planes.facts.get(i));
    let last = planes.u().cast_signed();
    let (g, h) = from.map_or((1, 1), |f| (f.g.cast_signed(), f.h.cast_signed()));
    let step = |from: isize, by: isize| (from + by).clamp(1, last).cast_unsigned();
    commands.push(Command::LookAt(PlaneChoice::At {
        g: step(g, across),
        h: step(h, down),
    }));
}

/// The places of the cells, their labels and the color scale.
struct Layout {
    u: usize,
    cells: Rect,
    scale: Rect,
    /// The cells' edges, on physical pixels.
    columns: Vec<f32>,
    rows: Vec<f32>,
}

impl Layout {
    fn new(ui: &Ui, whole: Rect, planes: &Planes) -> Self {
        let line = marks::label_font(ui).size;
        let scale_height = color_scale::height(ui, planes);
        let cells = Rect::from_min_max(
            whole.min + vec2(2.1 * line, line + 6.0),
            whole.max - vec2(3.9 * line, line + 8.0 + scale_height),
        );
        let u = planes.u();
        let edges = |from: f32, to: f32| -> Vec<f32> {
            let ppp = ui.pixels_per_point();
            let place = |i: usize| egui::lerp(from..=to, i as f32 / u as f32);
            (0..=u).map(|i| (place(i) * ppp).round() / ppp).collect()
        };
        let (columns, rows) = (
            edges(cells.left(), cells.right()),
            edges(cells.top(), cells.bottom()),
        );
        Self {
            u,
            cells,
            scale: Rect::from_min_max(
                pos2(cells.left(), whole.bottom() - scale_height + 4.0),
                pos2(cells.right(), whole.bottom()),
            ),
            columns,
            rows,
        }
    }

    fn index_at(&self, place: Pos2) -> Option<usize> {
        let step = |edges: &[f32], at: f32| {
            let step = edges.partition_point(|&edge| edge <= at);
            (1..=self.u).contains(&step).then(|| step - 1)
        };
        Some(step(&self.columns, place.x)? * self.u + step(&self.rows, place.y)?)
    }

    fn cell(&self, index: usize) -> Rect {
        let (column, row) = (index / self.u, index % self.u);
        Rect::from_min_max(
            pos2(self.columns[column], self.rows[row]),
            pos2(self.columns[column + 1], self.rows[row + 1]),
        )
    }

    fn cell_size(&self) -> f32 {
        self.cells.width().min(self.cells.height()) / self.u as f32
    }

    fn paint_cells(&self, ui: &Ui, planes: &Planes, opacity: f32) {
        let mut mesh = Mesh::default();
        mesh.reserve_triangles(2 * planes.facts.len());
        mesh.reserve_vertices(4 * planes.facts.len());
        let gap = if self.cell_size() >= LEAST_CELL_WITH_GAP {
            1.0
        } else {
            0.0
        };
        let missing = ui.visuals().faint_bg_color;
        for index in 0..planes.facts.len() {
            let color = planes
                .color(index)
                .map_or(missing, |color| color32(color).gamma_multiply(opacity));
            let mut cell = self.cell(index);
            cell.max -= vec2(gap, gap);
            mesh.add_colored_rect(cell, color);
        }
        ui.painter().add(mesh);
        if planes.ranked() < planes.facts.len() {
            self.paint_hatch(ui, planes);
        }
    }

    /// Hatches the cells without a score with as few lines as possible.
    fn paint_hatch(&self, ui: &Ui, planes: &Planes) {
        let stroke = marks::hatch_stroke(ui);
        let line = |[from, to]: [f32; 2], sum: f32| {
            let ends = [pos2(from, sum - from), pos2(to, sum - to)];
            ui.painter().line_segment(ends, stroke);
        };
        let spacing = 6.0;
        let (left, right) = (self.columns[0], self.columns[self.u]);
        let (top, bottom) = (self.rows[0], self.rows[self.u]);
        let mut sum = left + top + spacing;
        // A line of the hatch is x + y = sum. It is cut where it crosses the edges of the cells, and drawn through
        // neighboring cells without a score in one piece.
        while sum < right + bottom {
            let (from, to) = ((sum - bottom).max(left), (sum - top).min(right));
            let mut places: Vec<f32> = self.columns.clone();
            places.extend(self.rows.iter().map(|y| sum - y));
            places.retain(|x| (from..=to).contains(x));
            places.sort_unstable_by(f32::total_cmp);
            let mut begun: Option<f32> = None;
            for pair in places.windows(2) {
                let middle = 0.5 * (pair[0] + pair[1]);
                let index = self.index_at(pos2(middle, sum - middle));
                let is_missing = index.is_some_and(|i| planes.facts[i].score_cm.is_none());
                match (begun, is_missing) {
                    (None, true) => begun = Some(pair[0]),
                    (Some(start), false) => {
                        begun = None;
                        line([start, pair[0]], sum);
                    }
                    _ => {}
                }
            }
            if let (Some(start), Some(&end)) = (begun, places.last()) {
                line([start, end], sum);
            }
            sum += spacing;
        }
    }

    fn paint_marks(&self, painter: &Painter, state: &State, planes: &Planes) {
        let painter = painter.with_clip_rect(self.cells.expand(6.0).intersect(painter.clip_rect()));
        let radius = (0.3 * self.cell_size()).clamp(4.5, 11.0);
        let exists = |index: usize| index < planes.facts.len();
        let frame = |index| {
            let cell = self.cell(index);
            let least = vec2(9.0, 9.0).max(cell.size() - vec2(1.0, 1.0));
            Rect::from_center_size(cell.center(), least)
        };
        let ring = |index| (self.cell(index).center(), radius);
        marks::paint_planes(
            &painter,
            state,
            planes,
            |index| exists(index).then(|| frame(index)),
            |index| exists(index).then(|| ring(index)),
        );
    }

    fn paint_labels(&self, ui: &Ui) {
        let font = marks::label_font(ui);
        let color = ui.visuals().text_color();
        let write = |place: Pos2, align: Align2, text: String| {
            ui.painter().text(place, align, text, font.clone(), color);
        };
        let step = |cell: f32, least: f32| {
            let fits = |step: &&usize| **step as f32 * cell >= least;
            [1, 2, 5, 10, 20, 50].iter().find(fits).copied().unwrap_or(100)
        };
        let is_labeled = |number: usize, step: usize| {
            number == 1 || (number.is_multiple_of(step) && (number - 1) as f32 > 0.6 * step as f32)
        };
        let named = |name: &str, number: usize| {
            if number == 1 {
                format!("{name} 1")
            } else {
                number.to_string()
            }
        };
        let (across, down) = (
            step(self.cells.width() / self.u as f32, 1.9 * font.size),
            step(self.cells.height() / self.u as f32, 1.4 * font.size),
        );
        for number in 1..=self.u {
            let cell = self.cell((number - 1) * self.u + number - 1);
            if is_labeled(number, across) {
                let place = pos2(cell.center().x, self.cells.bottom() + 2.0);
                write(place, Align2::CENTER_TOP, named("g", number));
            }
            if is_labeled(number, down) {
                let place = pos2(self.cells.left() - 4.0, cell.center().y);
                write(place, Align2::RIGHT_CENTER, named("h", number));
            }
        }
        // α runs from 0° to 180°, β from −90° to 90°: round angles at their true places.
        let parts = |length: f32, least: f32| if length / 4.0 > least { 4 } else { 2 };
        let count = parts(self.cells.width(), 3.4 * font.size);
        for i in 0..=count {
            let degrees = 180 / count * i;
            let x = egui::lerp(self.cells.x_range(), i as f32 / count as f32);
            let place = pos2(x, self.cells.top() - 3.0);
            match i {
                0 => write(place, Align2::LEFT_BOTTOM, "α 0°".into()),
                _ if i == count => write(place, Align2::RIGHT_BOTTOM, format!("{degrees}°")),
                _ => write(place, Align2::CENTER_BOTTOM, format!("{degrees}°")),
            }
        }
        let count = parts(self.cells.height(), 2.2 * font.size);
        for i in 0..=count {
            let degrees = 180 / count * i - 90;
            let y = egui::lerp(self.cells.y_range(), i as f32 / count as f32);
            let place = pos2(self.cells.right() + 5.0, y);
            let text = match degrees {
                ..0 => format!("−{}°", -degrees),
                _ => format!("{degrees}°"),
            };
            match i {
                0 => write(place, Align2::LEFT_TOP, format!("β {text}")),
                _ if i == count => write(place, Align2::LEFT_BOTTOM, text),
                _ => write(place, Align2::LEFT_CENTER, text),
            }
        }
    }
}
