//! The planes in the order of their scores: a row each, and above them the winner's lead and the parts of its error.

use egui::{Align2, Id, Rect, Response, ScrollArea, Sense, TextStyle, Ui, pos2, vec2};

use crate::app::inspector::planes::{PlaneFacts, Planes};
use crate::app::{Command, State};
use crate::ui::widgets::marks::color32;
use crate::ui::widgets::memo::{ByAddress, memo};
use crate::ui::widgets::rows::{ColumnHead, list, row, underline};
use crate::ui::widgets::{error_parts, notice, plane_tip};
use crate::view::lead_in_words;

/// A column of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Rank,
    G,
    H,
    Score,
    Partners,
    DistanceSum,
    AngleSum,
    Error,
}

impl Column {
    const ALL: [Self; 8] = [
        Self::Rank,
        Self::G,
        Self::H,
        Self::Score,
        Self::Error,
        Self::Partners,
        Self::DistanceSum,
        Self::AngleSum,
    ];

    fn title(self) -> &'static str {
        match self {
            Self::Rank => "rank",
            Self::G => "g",
            Self::H => "h",
            Self::Score => "score (cm)",
            Self::Partners => "n",
            Self::DistanceSum => "ΣD (cm)",
            Self::AngleSum => "ΣΞ (rad)",
            Self::Error => "error (°)",
        }
    }

    fn explained(self) -> &'static str {
        match self {
            Self::Rank => "The place in the order of the scores, lowest first",
            Self::G => "The plane's step of α, from 1",
            Self::H => "The plane's step of β, from 1",
            Self::Score => "The score: lower is better",
            Self::Partners => "The number of points with a visible symmetric partner",
            Self::DistanceSum => "The sum of the distances d of these points",
            Self::AngleSum => "The sum of the angles ξ of these points",
            Self::Error => "The angle between the plane's axis and the reference",
        }
    }

    /// Returns the width in letters.
    fn letters(self) -> f32 {
        match self {
            Self::Rank => 6.0,
            Self::G | Self::H => 4.0,
            Self::Partners => 8.0,
            Self::Score | Self::DistanceSum | Self::AngleSum | Self::Error => 10.5,
        }
    }

    fn value(self, facts: &PlaneFacts) -> Option<f64> {
        match self {
            Self::Rank => facts.rank.map(|rank| rank as f64),
            Self::G => Some(facts.g as f64),
            Self::H => Some(facts.h as f64),
            Self::Score => facts.score_cm,
            Self::Partners => Some(facts.partners as f64),
            Self::DistanceSum => Some(facts.distance_sum_cm),
            Self::AngleSum => Some(facts.angle_sum_rad),
            Self::Error => facts.error_deg,
        }
    }

    fn text(self, facts: &PlaneFacts) -> String {
        match self {
            Self::Rank => facts.rank.map(|rank| rank.to_string()).unwrap_or_default(),
            Self::G => facts.g.to_string(),
            Self::H => facts.h.to_string(),
            Self::Score => match facts.score_cm {
                Some(score) => format!("{score:.4}"),
                None => "too few".into(),
            },
            Self::Partners => facts.partners.to_string(),
            Self::DistanceSum => format!("{:.2}", facts.distance_sum_cm),
            Self::AngleSum => format!("{:.2}", facts.angle_sum_rad),
            Self::Error => match facts.error_deg {
                Some(error) => format!("{error:.1}"),
                None => "none".into(),
            },
        }
    }
}

/// The order of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Sorting {
    by: Column,
    is_descending: bool,
}

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(planes) = notice::planes_or_reason(ui, state, commands) else {
        return;
    };
    if planes.best().is_some() {
        let lead = lead_in_words(&planes.analysis);
        ui.label(lead.map_or_else(
            || "There is no runner-up to compare the best plane with.".into(),
            |lead| format!("{lead}."),
        ));
    }
    error_parts::show(ui, state, commands);
    let id = ui.scope_id().with("ranking");
    let letter = 0.54 * TextStyle::Body.resolve(ui.style()).size;
    let least: f32 = Column::ALL.iter().map(|c| c.letters() * letter).sum();
    let bar = ui.spacing().scroll.allocated_width() + 2.0;
    let width = (ui.available_width() - bar).max(least);
    ScrollArea::horizontal()
        .id_salt(id.with("across"))
        .show(ui, |ui| {
            ui.set_width(width + bar);
            ui.spacing_mut().item_spacing.y = 0.0;
            let sorting = header(ui, id, width);
            let key = (ByAddress(planes.clone()), sorting);
            let order = memo(ui.ctx(), id.with("order"), key, || sorted(&planes, sorting));
            table(ui, id, width, state, &planes, &order, commands);
        });
}

/// Returns the right edges of the columns.
fn edges(width: f32) -> [f32; 8] {
    let whole: f32 = Column::ALL.iter().map(|c| c.letters()).sum();
    let mut edge = 0.0;
    Column::ALL.map(|column| {
        edge += column.letters() / whole * width;
        edge
    })
}

/// Shows the columns' heads; returns the order that was chosen there.
fn header(ui: &mut Ui, id: Id, width: f32) -> Sorting {
    let mut sorting = ui.data(|data| data.get_temp(id)).unwrap_or(Sorting {
        by: Column::Rank,
        is_descending: false,
    });
    let height = ui.text_style_height(&TextStyle::Body) + 8.0;
    let (rect, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let mut place = rect;
    for (column, right) in Column::ALL.into_iter().zip(edges(width)) {
        place.max.x = rect.left() + right;
        let head = ColumnHead {
            title: column.title(),
            tip: format!("{}. A click sorts by it.", column.explained()),
            is_left: false,
            margin: 8.0,
            is_descending: (sorting.by == column).then_some(sorting.is_descending),
        };
        if head.show(ui, id, place).clicked() {
            let is_descending = sorting.by == column && !sorting.is_descending;
            sorting = Sorting {
                by: column,
                is_descending,
            };
            ui.data_mut(|data| data.insert_temp(id, sorting));
        }
        place.min.x = place.max.x;
    }
    underline(ui, rect);
    sorting
}

/// Returns the planes in order. Those without a score, then those without the value, come last in either direction.
fn sorted(planes: &Planes, sorting: Sorting) -> Vec<usize> {
    let mut order = planes.in_rank_order();
    let value = |index: usize| sorting.by.value(&planes.facts[index]);
    order.sort_by(|&a, &b| {
        let unscored = |index: usize| planes.facts[index].rank.is_none();
        let values = match (value(a), value(b)) {
            (Some(a), Some(b)) if sorting.is_descending => b.total_cmp(&a),
            (Some(a), Some(b)) => a.total_cmp(&b),
            (a, b) => a.is_none().cmp(&b.is_none()),
        };
        unscored(a).cmp(&unscored(b)).then(values)
    });
    order
}

fn table(
    ui: &mut Ui,
    id: Id,
    width: f32,
    state: &State,
    planes: &Planes,
    order: &[usize],
    commands: &mut Vec<Command>,
) {
    let size = vec2(width, ui.text_style_height(&TextStyle::Body) + 5.0);
    let chosen = state.chosen_plane_index();
    let memory = id.with("chosen");
    let before: Option<usize> = ui.data(|data| data.get_temp(memory)).flatten();
    ui.data_mut(|data| data.insert_temp(memory, chosen));
    // A plane that was chosen elsewhere comes into view.
    let wanted = chosen
        .filter(|_| chosen != before)
        .and_then(|index| order.iter().position(|&i| i == index));
    let mut hovered = None;
    list(ui, id, size.y, order.len(), wanted, |ui, place| {
        let index = order[place];
        // Known by its plane, so that the keyboard stays with it when the rows are sorted anew.
        let response = plane_row(ui, id.with(index), size, chosen == Some(index), planes, index);
        if response.hovered() {
            hovered = Some(index);
            plane_tip::explain_missing(&response, planes, index);
        }
        if response.clicked() {
            commands.push(Command::LookAt(planes.facts[index].choice()));
        }
    });
    plane_tip::preview(ui, id, hovered, commands);
}

fn plane_row(
    ui: &mut Ui,
    id: Id,
    size: egui::Vec2,
    is_chosen: bool,
    planes: &Planes,
    index: usize,
) -> Response {
    let facts = &planes.facts[index];
    let (response, color) = row(ui, id, size, is_chosen, || {
        let standing = plane_tip::standing(planes, facts);
        format!("Plane g {} h {}, {standing}", facts.g, facts.h)
    });
    let (rect, painter) = (response.rect, ui.painter());
    let font = TextStyle::Body.resolve(ui.style());
    for (column, right) in Column::ALL.into_iter().zip(edges(size.x)) {
        let place = pos2(rect.left() + right - 8.0, rect.center().y);
        let text = column.text(facts);
        painter.text(place, Align2::RIGHT_CENTER, text, font.clone(), color);
    }
    if let Some(color) = planes.color(index) {
        let chip = Rect::from_center_size(pos2(rect.left() + 8.0, rect.center().y), vec2(8.0, 8.0));
        painter.rect_filled(chip, 1.0, color32(color));
    }
    response
}
