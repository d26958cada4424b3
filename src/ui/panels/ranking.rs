//! The planes in their order: a row a plane, best first, and the winner's lead above them.

use std::sync::Arc;

use egui::{Align2, Id, Rect, Response, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::app::{Command, State};
use crate::ui::widgets::planes::{PlaneFacts, Planes};
use crate::ui::widgets::rows::{arrow, into_view};
use crate::ui::widgets::{notice, plane_tip};
use crate::view::lead_in_words;

/// What the planes are sorted by.
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
            Self::Partners => "How many points have a visible symmetric partner",
            Self::DistanceSum => "The sum of the distances d of these points",
            Self::AngleSum => "The sum of the angles ξ of these points",
            Self::Error => "The angle between the plane's axis and the reference",
        }
    }

    /// The share of the width, in letters.
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

/// The order that was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Sorting {
    by: Column,
    is_descending: bool,
}

/// The rows of one analysis in one order.
#[derive(Clone)]
struct Rows {
    planes: Arc<Planes>,
    sorting: Sorting,
    order: Arc<Vec<usize>>,
}

/// What was on the screen a frame ago.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Seen {
    chosen: Option<usize>,
    top: f32,
    height: f32,
}

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(planes) = Planes::of(ui.ctx(), state) else {
        notice::nothing_to_show(ui, state, commands);
        return;
    };
    notice::if_stale(ui, state, commands);
    notice::if_no_plane(ui, &planes.analysis);
    if planes.best().is_some() {
        let lead = lead_in_words(&planes.analysis);
        ui.label(lead.map_or_else(
            || "There is no runner-up to compare the best plane with.".into(),
            |lead| format!("{lead}."),
        ));
    }
    let id = ui.scope_id().with("ranking");
    let letter = 0.54 * egui::TextStyle::Body.resolve(ui.style()).size;
    let least: f32 = Column::ALL.iter().map(|c| c.letters() * letter).sum();
    let bar = ui.spacing().scroll.allocated_width() + 2.0;
    let width = (ui.available_width() - bar).max(least);
    ScrollArea::horizontal()
        .id_salt(id.with("across"))
        .show(ui, |ui| {
            ui.set_width(width + bar);
            ui.spacing_mut().item_spacing.y = 0.0;
            let rows = header(ui, id, width, &planes);
            table(ui, id, width, state, &rows, commands);
        });
}

/// The right edges of the columns.
fn edges(width: f32) -> [f32; 8] {
    let whole: f32 = Column::ALL.iter().map(|c| c.letters()).sum();
    let mut edge = 0.0;
    Column::ALL.map(|column| {
        edge += column.letters() / whole * width;
        edge
    })
}

/// The columns' names; a click sorts by one. Gives the rows in the order that is asked for.
fn header(ui: &mut Ui, id: Id, width: f32, planes: &Arc<Planes>) -> Rows {
    let kept: Option<Rows> = ui.data(|data| data.get_temp(id));
    let mut sorting = kept.as_ref().map_or(
        Sorting {
            by: Column::Rank,
            is_descending: false,
        },
        |rows| rows.sorting,
    );
    let height = ui.text_style_height(&egui::TextStyle::Body) + 8.0;
    let (rect, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let mut left = 0.0;
    for (column, right) in Column::ALL.into_iter().zip(edges(width)) {
        let place = Rect::from_min_max(
            pos2(rect.left() + left, rect.top()),
            pos2(rect.left() + right, rect.bottom()),
        );
        left = right;
        let response = ui.interact(place, id.with(column.title()), Sense::click());
        let is_sorted_by = sorting.by == column;
        response.widget_info(|| {
            WidgetInfo::selected(
                Role::ColumnHeader,
                true,
                is_sorted_by,
                format!("Sort by {}", column.title()),
            )
        });
        if response.clicked() {
            sorting = Sorting {
                by: column,
                is_descending: is_sorted_by && !sorting.is_descending,
            };
        }
        let visuals = ui.style().interact(&response);
        if response.hovered() || response.has_focus() {
            ui.painter()
                .rect_filled(place.shrink(1.0), 3.0, visuals.weak_bg_fill);
        }
        let font = egui::TextStyle::Body.resolve(ui.style());
        let color = ui.visuals().strong_text_color();
        let end = place.right_center() - vec2(8.0, 0.0);
        let text = ui
            .painter()
            .text(end, Align2::RIGHT_CENTER, column.title(), font, color);
        if sorting.by == column {
            arrow(
                ui,
                pos2(text.left() - 7.0, place.center().y),
                sorting.is_descending,
            );
        }
        response.on_hover_text(format!("{}. A click sorts by it.", column.explained()));
    }
    ui.painter().hline(
        rect.x_range(),
        rect.bottom(),
        ui.visuals().widgets.noninteractive.bg_stroke,
    );
    let rows = match kept {
        Some(rows) if Arc::ptr_eq(&rows.planes, planes) && rows.sorting == sorting => return rows,
        _ => Rows {
            order: Arc::new(sorted(planes, sorting)),
            planes: planes.clone(),
            sorting,
        },
    };
    ui.data_mut(|data| data.insert_temp(id, rows.clone()));
    rows
}

/// Planes without a score, and then those without the value, come last whichever way.
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

fn table(ui: &mut Ui, id: Id, width: f32, state: &State, rows: &Rows, commands: &mut Vec<Command>) {
    let row_height = ui.text_style_height(&egui::TextStyle::Body) + 5.0;
    let chosen = state.chosen_plane_index();
    let seen_id = id.with("seen");
    let seen: Seen = ui.data(|data| data.get_temp(seen_id)).unwrap_or_default();
    let mut area = ScrollArea::vertical()
        .id_salt(id.with("rows"))
        .auto_shrink([false, false]);
    if seen.chosen != chosen {
        // Chosen elsewhere: into view with it, unless it is there already.
        let place = chosen.and_then(|index| rows.order.iter().position(|&i| i == index));
        let height = if seen.height > 0.0 {
            seen.height
        } else {
            ui.available_height()
        };
        if let Some(place) = place {
            area = into_view(area, place, row_height, seen.top, height);
        }
    }
    let mut hovered = None;
    let output = area.show_rows(ui, row_height, rows.order.len(), |ui, range| {
        for place in range {
            let index = rows.order[place];
            let response = row(ui, id, vec2(width, row_height), state, &rows.planes, index);
            if response.hovered() {
                hovered = Some(index);
                plane_tip::explain_missing(&response, &rows.planes, index);
            }
            if response.clicked() {
                commands.push(Command::LookAt(rows.planes.facts[index].choice()));
            }
        }
    });
    plane_tip::preview(ui, id, hovered, commands);
    let seen = Seen {
        chosen,
        top: output.state.clamped_offset().y,
        height: output.inner_rect.height(),
    };
    ui.data_mut(|data| data.insert_temp(seen_id, seen));
}

fn row(ui: &mut Ui, id: Id, size: egui::Vec2, state: &State, planes: &Planes, index: usize) -> Response {
    let facts = &planes.facts[index];
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    // Known by its plane, so that the keyboard stays with it when the rows are sorted anew.
    let response = ui.interact(rect, id.with(index), Sense::click());
    let is_chosen = state.chosen_plane_index() == Some(index);
    response.widget_info(|| {
        let (g, h) = (facts.g, facts.h);
        let label = format!("Plane g {g} h {h}, {}", plane_tip::standing(planes, facts));
        WidgetInfo::selected(Role::Row, true, is_chosen, label)
    });
    let visuals = ui.visuals();
    let (fill, color) = if is_chosen {
        (visuals.selection.bg_fill, visuals.selection.stroke.color)
    } else if response.hovered() || response.has_focus() {
        let hovered = &visuals.widgets.hovered;
        (hovered.weak_bg_fill, hovered.text_color())
    } else {
        (egui::Color32::TRANSPARENT, visuals.text_color())
    };
    let painter = ui.painter();
    painter.rect_filled(rect, 2.0, fill);
    let font = egui::TextStyle::Body.resolve(ui.style());
    for (column, right) in Column::ALL.into_iter().zip(edges(size.x)) {
        let place = pos2(rect.left() + right - 8.0, rect.center().y);
        painter.text(
            place,
            Align2::RIGHT_CENTER,
            column.text(facts),
            font.clone(),
            color,
        );
    }
    if let Some(color) = planes.color(index) {
        let chip = Rect::from_center_size(pos2(rect.left() + 8.0, rect.center().y), vec2(8.0, 8.0));
        painter.rect_filled(chip, 1.0, color);
    }
    response
}
