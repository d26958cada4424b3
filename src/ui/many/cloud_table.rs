//! The table of the open clouds: only the rows in sight are drawn, from texts and an order that are made
//! when something changes.

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{
    Color32, EventFilter, FontId, Id, Key, Modifiers, Panel, Rect, Response, Role, ScrollArea, Sense,
    TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::{PanelRequest, bar, filters, tagging};
use crate::app::many::{Column, ManyCommand, Sort, TableRow};
use crate::app::{Command, State};
use crate::ui::widgets::arrows::take_arrows;
use crate::ui::widgets::controls::warning_color;
use crate::ui::widgets::rows::{ColumnHead, list, row, underline};

impl Column {
    fn title(self) -> &'static str {
        match self {
            Self::Opened => "#",
            Self::Name => "name",
            Self::Points => "points",
            Self::PeduncleError => "peduncle °",
            Self::DirectionError => "its own °",
            Self::TrueError => "truth °",
            Self::ManualError => "by hand °",
            Self::Lead => "lead %",
            Self::Warnings => "warnings",
            Self::Annotators => "annotated by",
            Self::Tags => "tags",
        }
    }

    fn explained(self) -> &'static str {
        match self {
            Self::Opened => "The order in which the clouds were opened",
            Self::Name => "The file's name",
            Self::Points => "Points in the file",
            Self::PeduncleError => "The angle between the computed axis and the peduncle's",
            Self::DirectionError => {
                "The angle between the computed axis and the direction in which the peduncle itself runs"
            }
            Self::TrueError => "The angle between the computed axis and the simulator's",
            Self::ManualError => "The angle between the computed axis and the one set by hand",
            Self::Lead => {
                "How much higher the runner-up's score is than the best: little where two planes are nearly as good"
            }
            Self::Warnings => "How many warnings there are; point at a row to read them",
            Self::Annotators => "Who has set an axis by hand",
            Self::Tags => "What the cloud was tagged with",
        }
    }

    fn letters(self) -> f32 {
        match self {
            Self::Opened => 6.0,
            Self::Name => 16.0,
            Self::Annotators => 13.0,
            Self::Points | Self::TrueError | Self::Lead => 7.5,
            Self::PeduncleError => 10.0,
            Self::ManualError | Self::DirectionError => 9.0,
            Self::Warnings => 9.5,
            Self::Tags => 12.0,
        }
    }

    fn is_text(self) -> bool {
        matches!(self, Self::Name | Self::Annotators | Self::Tags)
    }
}

/// The rows that were on the screen a frame ago.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Seen {
    current: Option<usize>,
    frame: u64,
}

/// Draws the panel.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    let asked = bar::show(ui, state, commands);
    if asked.is_some() {
        return asked;
    }
    filters::show(ui, state, commands);
    Panel::bottom("tags of a cloud")
        .show_separator_line(true)
        .show(ui, |ui| tagging::show(ui, state, commands));
    if state.many.rows.is_empty() {
        ui.label("No cloud is open. Drop PLY files or a folder on the window.");
        return None;
    }
    let id = ui.scope_id().with("table of clouds");
    let letter = 0.54 * TextStyle::Body.resolve(ui.style()).size;
    let least: f32 = Column::ALL.iter().map(|c| c.letters() * letter).sum();
    let scroll = ui.spacing().scroll.allocated_width() + 2.0;
    let width = (ui.available_width() - scroll).max(least);
    let mut answer = None;
    ScrollArea::horizontal()
        .id_salt(id.with("across"))
        .show(ui, |ui| {
            ui.set_width(width + scroll);
            ui.spacing_mut().item_spacing.y = 0.0;
            header(ui, id, width, state, commands);
            if state.many.order.is_empty() {
                ui.add_space(8.0);
                ui.label("No cloud passes the filter.");
            } else {
                answer = body(ui, id, width, state, commands);
            }
        });
    answer
}

/// The columns' left and right edges; the name has what the others leave.
fn columns(width: f32, letter: f32) -> [(f32, f32); 11] {
    let others: f32 = Column::ALL
        .iter()
        .filter(|c| **c != Column::Name)
        .map(|c| c.letters() * letter)
        .sum();
    let mut edge = 0.0;
    Column::ALL.map(|column| {
        let from = edge;
        edge += if column == Column::Name {
            width - others
        } else {
            column.letters() * letter
        };
        (from, edge)
    })
}

fn header(ui: &mut Ui, id: Id, width: f32, state: &State, commands: &mut Vec<Command>) {
    let font = TextStyle::Body.resolve(ui.style());
    let height = ui.text_style_height(&TextStyle::Body) + 8.0;
    let (rect, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let sort = state.many.sort;
    for (column, (from, to)) in Column::ALL.into_iter().zip(columns(width, 0.54 * font.size)) {
        let place = Rect::from_min_max(
            pos2(rect.left() + from, rect.top()),
            pos2(rect.left() + to, rect.bottom()),
        );
        let is_sorted_by = sort.by == column;
        let head = ColumnHead {
            title: column.title(),
            tip: format!(
                "{}. A click sorts by it, another turns the order.",
                column.explained()
            ),
            is_left: column.is_text(),
            margin: 6.0,
            is_descending: is_sorted_by.then_some(sort.is_descending),
        };
        if head.show(ui, id, place).clicked() {
            let sort = Sort {
                by: column,
                is_descending: is_sorted_by && !sort.is_descending,
            };
            commands.push(Command::Many(ManyCommand::Sort(sort)));
        }
    }
    underline(ui, rect);
}

fn body(ui: &mut Ui, id: Id, width: f32, state: &State, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    let folder = &state.many;
    let row_height = ui.text_style_height(&TextStyle::Body) + 6.0;
    let seen_id = id.with("seen");
    let seen: Seen = ui.data(|data| data.get_temp(seen_id)).unwrap_or_default();
    let frame = ui.ctx().cumulative_frame_nr();
    let keyboard = keyboard(ui, id, seen, frame);
    let mut answer = by_keys(ui, &keyboard, commands);
    let was_hidden = frame > seen.frame + 1;
    // A cloud that was chosen elsewhere comes into view.
    let wanted = state
        .current
        .filter(|_| seen.current != state.current || was_hidden)
        .and_then(|current| folder.order.iter().position(|&place| place == current));
    list(ui, id, row_height, folder.order.len(), wanted, |ui, row| {
        let place = folder.order[row];
        let response = cloud_row(ui, id, vec2(width, row_height), state, place);
        if response.clicked() {
            commands.push(Command::Show(place));
            ui.memory_mut(|memory| memory.request_focus(keyboard.id));
        }
        if response.double_clicked() {
            answer = Some(PanelRequest::ShowView);
        }
        if response.hovered() {
            explain(response, &folder.rows[place]);
        }
    });
    let seen = Seen {
        current: state.current,
        frame,
    };
    ui.data_mut(|data| data.insert_temp(seen_id, seen));
    answer
}

/// The widget that has the keyboard for the whole table. It takes the focus when the table comes to the front and no other
/// widget has it.
fn keyboard(ui: &mut Ui, id: Id, seen: Seen, frame: u64) -> Response {
    let rect = ui.available_rect_before_wrap();
    let keyboard = ui.interact(rect, id.with("keyboard"), Sense::focusable_noninteractive());
    keyboard.widget_info(|| WidgetInfo::labeled(Role::Table, true, "Table of clouds"));
    let nobody = ui.memory(egui::Memory::focused).is_none();
    if frame > seen.frame + 1 && nobody {
        keyboard.request_focus();
    }
    keyboard
}

/// Arrow keys go from row to row while the table has the keyboard, Enter looks at the cloud.
fn by_keys(ui: &Ui, keyboard: &Response, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    if !keyboard.has_focus() {
        return None;
    }
    let arrows = EventFilter {
        vertical_arrows: true,
        ..EventFilter::default()
    };
    take_arrows(ui, keyboard, arrows);
    let pressed = |key| {
        let count = ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
        count.cast_signed()
    };
    let by = pressed(Key::ArrowDown) - pressed(Key::ArrowUp);
    if by != 0 {
        commands.push(Command::Go(by));
    }
    (pressed(Key::Enter) > 0).then_some(PanelRequest::ShowView)
}

fn cloud_row(ui: &mut Ui, id: Id, size: Vec2, state: &State, place: usize) -> Response {
    let cloud = &state.many.rows[place];
    let is_current = state.current == Some(place);
    let (response, color) = row(ui, id.with(("row", place)), size, is_current, || {
        let error = cloud.error_deg(state.many.against);
        let error = error.map_or(String::new(), |error| format!(", {error:.1}° off"));
        format!("{}{error}", cloud.name)
    });
    let rect = response.rect;
    let font = TextStyle::Body.resolve(ui.style());
    let edges = columns(size.x, 0.54 * font.size);
    let cell = |from: usize, to: usize| {
        let (left, right) = (edges[from].0 + 6.0, edges[to].1 - 6.0);
        Rect::from_min_max(
            pos2(rect.left() + left, rect.top()),
            pos2(rect.left() + right, rect.bottom()),
        )
    };
    let unusable = cloud.outcome.as_ref().filter(|o| o.row().sha256.is_none());
    for (i, (column, text)) in Column::ALL.into_iter().zip(cloud.cells.iter()).enumerate() {
        let is_covered = unusable.is_some() && (2..=7).contains(&i);
        if !text.is_empty() && !is_covered {
            write(
                ui,
                cell(i, i),
                text,
                column.is_text(),
                cloud.is_stale,
                &font,
                color,
            );
        }
    }
    if let Some(failure) = unusable.and_then(|o| o.row().failure.as_ref()) {
        // On the current row's ground the warning's color has too little contrast.
        let color = if is_current { color } else { warning_color(ui) };
        write(ui, cell(2, 7), failure, true, cloud.is_stale, &font, color);
    }
    response
}

/// Writes one line into a cell, cut off where it is too long.
fn write(ui: &Ui, cell: Rect, text: &str, is_text: bool, is_italic: bool, font: &FontId, color: Color32) {
    let format = TextFormat {
        italics: is_italic,
        ..TextFormat::simple(font.clone(), color)
    };
    let mut job = LayoutJob::single_section(text.to_owned(), format);
    job.wrap = TextWrapping::truncate_at_width(cell.width());
    let galley = ui.painter().layout_job(job);
    let x = if is_text {
        cell.left()
    } else {
        cell.right() - galley.size().x
    };
    let y = cell.center().y - 0.5 * galley.size().y;
    ui.painter().galley(pos2(x, y), galley, color);
}

/// The facts of a row that its columns have no room for.
fn explain(response: Response, row: &TableRow) {
    response.on_hover_ui_at_pointer(|ui| {
        ui.set_max_width(440.0);
        if let Some(path) = &row.path {
            ui.label(path.display().to_string());
        }
        let Some(outcome) = &row.outcome else {
            ui.label("Not evaluated yet.");
            return;
        };
        if row.is_stale {
            ui.label("Of other parameters than those in force.");
        }
        if let Some(failure) = &outcome.row().failure {
            ui.label(crate::text::sentence(failure));
        }
        if !outcome.row().warnings.is_empty() {
            ui.label(&outcome.row().warnings);
        }
        if !row.tagged.note.is_empty() {
            ui.label(format!("Note: {}", row.tagged.note));
        }
        ui.label("Double-click to look at it.");
    });
}
