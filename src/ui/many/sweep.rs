//! The map of the mean error over u and τ. A click on a cell opens its setting.

use egui::{
    Align2, Button, Checkbox, DragValue, Mesh, Rect, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2,
};

use super::{PanelRequest, bar};
use crate::app::many::{ManyCommand, SweepState};
use crate::app::{Command, State};
use crate::evaluate::Sweep;
use crate::method::CandidateGrid;
use crate::ui::widgets::controls::hint;
use crate::ui::widgets::marks::ramp_color;
use crate::ui::widgets::marks::{self, Mark};

/// Draws the panel.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    let asked = bar::show(ui, state, commands);
    if asked.is_some() {
        return asked;
    }
    ranges(ui, state, commands);
    let sweep = &state.many.sweep;
    let Some(map) = &sweep.map else {
        ui.add_space(8.0);
        hint(
            ui,
            "The mean error of the axis for every u and τ of these ranges, all else as it is. A cell of the map opens \
             its setting.",
        );
        return None;
    };
    about(ui, sweep);
    let Some(range) = extremes(map) else {
        let text = if sweep.progress.is_some() {
            "The first clouds are being swept."
        } else {
            "No cloud has an error against this reference."
        };
        ui.label(text);
        return None;
    };
    draw(ui, state, map, range, commands);
    None
}

/// Shows the fields of the ranges, and the button that starts the sweep.
fn ranges(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let sweep = &state.many.sweep;
    let mut ranges = sweep.ranges.clone();
    let mut say = |command| commands.push(Command::Many(command));
    ui.horizontal_wrapped(|ui| {
        let of_u = CandidateGrid::MIN_U..=60;
        ui.label("u from");
        ui.add(DragValue::new(&mut ranges.u[0]).range(of_u.clone()))
            .accessible_name("Least u");
        ui.label("to");
        ui.add(DragValue::new(&mut ranges.u[1]).range(of_u))
            .accessible_name("Most u");
        ui.label("by");
        ui.add(DragValue::new(&mut ranges.u_step).range(1..=10))
            .accessible_name("Step of u");
        ui.add_space(10.0);
        ui.label("τ from");
        ui.add(tau_field(&mut ranges.tau_cm_per_rad[0]))
            .accessible_name("Least τ, in cm/rad");
        ui.label("to");
        ui.add(tau_field(&mut ranges.tau_cm_per_rad[1]))
            .accessible_name("Most τ, in cm/rad");
        ui.label("by");
        let step = DragValue::new(&mut ranges.tau_step_cm_per_rad)
            .range(0.01..=5.0)
            .speed(0.01)
            .max_decimals(3);
        ui.add(step).accessible_name("Step of τ, in cm/rad");
        ui.label("cm/rad");
        ui.add_space(10.0);
        ui.add(Checkbox::new(&mut ranges.only_current, "this cloud only"))
            .on_hover_text("Sweep the current cloud instead of all that the table shows");
    });
    ui.horizontal_wrapped(|ui| {
        if let Some(progress) = sweep.progress {
            if ui
                .button("Cancel")
                .on_hover_text("Stop. The map stays as far as it came.")
                .clicked()
            {
                say(ManyCommand::CancelSweep);
            }
            bar::progress_bar(ui, progress);
            return;
        }
        let settings = ranges.settings();
        let count = settings
            .as_ref()
            .map_or(0, |s| s.u.len() * s.tau_cm_per_rad.len());
        let clouds = if ranges.only_current {
            1
        } else {
            state.many.order.len()
        };
        let noun = if clouds == 1 { "cloud" } else { "clouds" };
        let button = Button::new(format!("Sweep {count} settings over {clouds} {noun}"));
        let button = ui
            .add_enabled(count > 0 && clouds > 0, button)
            .on_hover_text("In the background. Each u is computed once for all its τ.")
            .on_disabled_hover_text("These ranges hold no settings, or too many.");
        if button.clicked() {
            say(ManyCommand::Sweep);
        }
    });
    if ranges != sweep.ranges {
        say(ManyCommand::SweepRanges(Box::new(ranges)));
    }
}

fn tau_field(value: &mut f64) -> DragValue<'_> {
    DragValue::new(value)
        .range(0.0..=20.0)
        .speed(0.02)
        .max_decimals(3)
}

/// Says how many clouds the map contains, and whether it belongs to the current parameters.
fn about(ui: &mut Ui, sweep: &SweepState) {
    let [done, asked] = sweep.clouds;
    let mut text = match (done, asked) {
        (1, 1) => "Of 1 cloud.".to_owned(),
        _ if done == asked => format!("Mean over {done} clouds."),
        _ => format!("Mean over {done} of {asked} clouds."),
    };
    if sweep.is_stale {
        text += " Of other parameters, or against another reference, than those in force.";
    }
    hint(ui, text);
}

/// Returns the smallest and the largest mean, and the cell of the smallest.
#[derive(Debug, Clone, Copy)]
struct Extremes {
    low_deg: f64,
    high_deg: f64,
    best: (usize, usize),
}

fn extremes(map: &Sweep) -> Option<Extremes> {
    let mut found: Option<Extremes> = None;
    for i in 0..map.settings.u.len() {
        for j in 0..map.settings.tau_cm_per_rad.len() {
            let Some(mean) = map.cell(i, j).0 else { continue };
            let e = found.get_or_insert(Extremes {
                low_deg: mean,
                high_deg: mean,
                best: (i, j),
            });
            if mean < e.low_deg {
                (e.low_deg, e.best) = (mean, (i, j));
            }
            e.high_deg = e.high_deg.max(mean);
        }
    }
    found
}

/// The geometry of the map: u to the right, τ upward.
struct Cells {
    place: Rect,
    across: usize,
    up: usize,
}

impl Cells {
    fn of(&self, i: usize, j: usize) -> Rect {
        let size = vec2(
            self.place.width() / self.across as f32,
            self.place.height() / self.up as f32,
        );
        let corner = pos2(
            self.place.left() + size.x * i as f32,
            self.place.bottom() - size.y * (j + 1) as f32,
        );
        Rect::from_min_size(corner, size)
    }

    fn at(&self, place: egui::Pos2) -> Option<(usize, usize)> {
        if !self.place.contains(place) {
            return None;
        }
        let share = (place - self.place.left_bottom()) / vec2(self.place.width(), -self.place.height());
        // The position is within the map, so both shares are between 0 and 1.
        let step = |share: f32, count: usize| ((share * count as f32) as usize).min(count - 1);
        Some((step(share.x, self.across), step(share.y, self.up)))
    }
}

fn draw(ui: &mut Ui, state: &State, map: &Sweep, range: Extremes, commands: &mut Vec<Command>) {
    let key = [(Mark::Best, "least error"), (Mark::Chosen, "in force")];
    marks::key(ui, &key);
    let font = marks::label_font(ui);
    let (whole, _) = ui.allocate_exact_size(ui.available_size().max(vec2(160.0, 140.0)), Sense::hover());
    let line = font.size;
    let scale_height = 2.0 * line + 22.0;
    let cells = Cells {
        place: Rect::from_min_max(
            whole.min + vec2(4.2 * line, 1.6 * line),
            whole.max - vec2(8.0, 3.2 * line + scale_height),
        ),
        across: map.settings.u.len(),
        up: map.settings.tau_cm_per_rad.len(),
    };
    let response = ui.interact(cells.place, ui.scope_id().with("map of settings"), Sense::click());
    response.widget_info(|| {
        let label = format!(
            "Map of the mean error, {:.1} to {:.1}°, least at u {}, τ {:.2} cm/rad",
            range.low_deg,
            range.high_deg,
            map.settings.u[range.best.0],
            map.settings.tau_cm_per_rad[range.best.1]
        );
        WidgetInfo::labeled(Role::Image, true, label)
    });
    paint_cells(ui, map, &cells, range);
    paint_marks(ui, state, map, &cells, range);
    paint_labels(ui, map, &cells);
    let scale = Rect::from_min_max(
        pos2(cells.place.left(), whole.bottom() - scale_height),
        pos2(cells.place.right(), whole.bottom()),
    );
    paint_scale(ui, scale, range);
    let hovered = response.hover_pos().and_then(|place| cells.at(place));
    if let Some((i, j)) = hovered {
        explain(&response, map, i, j);
        if response.clicked() {
            commands.push(Command::Many(ManyCommand::OpenSetting {
                u: map.settings.u[i],
                tau_cm_per_rad: map.settings.tau_cm_per_rad[j],
            }));
        }
    }
}

fn shade(mean: f64, range: Extremes) -> f64 {
    let span = range.high_deg - range.low_deg;
    if span > 0.0 {
        1.0 - (mean - range.low_deg) / span
    } else {
        1.0
    }
}

fn paint_cells(ui: &Ui, map: &Sweep, cells: &Cells, range: Extremes) {
    let mut mesh = Mesh::default();
    let missing = ui.visuals().faint_bg_color;
    for i in 0..cells.across {
        for j in 0..cells.up {
            let mean = map.cell(i, j).0;
            let color = mean.map_or(missing, |mean| ramp_color(shade(mean, range)));
            let mut cell = cells.of(i, j);
            let size = cell.size();
            cell.max -= vec2(f32::from(size.x > 8.0), f32::from(size.y > 8.0));
            mesh.add_colored_rect(cell, color);
        }
    }
    ui.painter().add(mesh);
    // The number, if there is room for it.
    let font = marks::label_font(ui);
    let size = cells.of(0, 0).size();
    if size.x < 2.6 * font.size || size.y < 1.3 * font.size {
        return;
    }
    for i in 0..cells.across {
        for j in 0..cells.up {
            let Some(mean) = map.cell(i, j).0 else { continue };
            let ink = if shade(mean, range) > 0.55 {
                egui::Color32::BLACK
            } else {
                egui::Color32::WHITE
            };
            let (at, text) = (cells.of(i, j).center(), format!("{mean:.1}"));
            ui.painter()
                .text(at, Align2::CENTER_CENTER, text, font.clone(), ink);
        }
    }
}

fn paint_marks(ui: &Ui, state: &State, map: &Sweep, cells: &Cells, range: Extremes) {
    let params = &state.settings.request.params;
    let i = map.settings.u.iter().position(|&u| u == params.u);
    let taus = &map.settings.tau_cm_per_rad;
    // The default τ, 3/π, is seldom one of the steps: the nearest cell, if it is close, counts as current.
    let step = taus.windows(2).map(|w| w[1] - w[0]).next().unwrap_or(0.1);
    let off = |tau: f64| (tau - params.tau_cm_per_rad).abs();
    let nearest = (0..taus.len()).min_by(|&a, &b| off(taus[a]).total_cmp(&off(taus[b])));
    let j = nearest.filter(|&j| off(taus[j]) <= 0.5 * step + 1e-9);
    if let (Some(i), Some(j)) = (i, j) {
        marks::frame(ui.painter(), cells.of(i, j).shrink(1.0), true);
    }
    let best = cells.of(range.best.0, range.best.1);
    let radius = (0.46 * best.width().min(best.height())).clamp(4.5, 16.0);
    marks::ring(ui.painter(), best.center(), radius, true);
}

fn paint_labels(ui: &Ui, map: &Sweep, cells: &Cells) {
    let font = marks::label_font(ui);
    let color = ui.visuals().text_color();
    let painter = ui.painter();
    let size = cells.of(0, 0).size();
    // Only every n-th label, so that labels do not overlap.
    let every = |cell: f32, least: f32| ((least / cell).ceil() as usize).max(1);
    for i in (0..cells.across).step_by(every(size.x, 2.2 * font.size)) {
        let cell = cells.of(i, 0);
        let at = pos2(cell.center().x, cells.place.bottom() + 3.0);
        painter.text(
            at,
            Align2::CENTER_TOP,
            map.settings.u[i].to_string(),
            font.clone(),
            color,
        );
    }
    for j in (0..cells.up).step_by(every(size.y, 1.3 * font.size)) {
        let cell = cells.of(0, j);
        let at = pos2(cells.place.left() - 5.0, cell.center().y);
        let text = format!("{:.2}", map.settings.tau_cm_per_rad[j]);
        painter.text(at, Align2::RIGHT_CENTER, text, font.clone(), color);
    }
    let below = pos2(cells.place.center().x, cells.place.bottom() + font.size + 7.0);
    painter.text(below, Align2::CENTER_TOP, "Grid steps u", font.clone(), color);
    let above = cells.place.left_top() - vec2(4.0 * font.size, 4.0);
    painter.text(above, Align2::LEFT_BOTTOM, "τ (cm/rad)", font, color);
}

fn paint_scale(ui: &Ui, rect: Rect, range: Extremes) {
    let font = marks::label_font(ui);
    let color = ui.visuals().text_color();
    let painter = ui.painter();
    painter.text(
        rect.left_top(),
        Align2::LEFT_TOP,
        "Mean error of the axis (°)",
        font.clone(),
        color,
    );
    let bar = Rect::from_min_max(
        pos2(rect.left(), rect.top() + font.size + 6.0),
        pos2(rect.right(), rect.top() + font.size + 14.0),
    );
    let mut mesh = Mesh::default();
    let steps = 24_u32;
    for i in 0..steps {
        let share = |i: u32| i as f32 / steps as f32;
        let part = Rect::from_x_y_ranges(
            egui::lerp(bar.x_range(), share(i))..=egui::lerp(bar.x_range(), share(i + 1)),
            bar.y_range(),
        );
        mesh.add_colored_rect(part, ramp_color(f64::from(1.0 - share(i))));
    }
    painter.add(mesh);
    let below = bar.bottom() + 2.0;
    let low = format!("{:.1}", range.low_deg);
    let high = format!("{:.1}", range.high_deg);
    painter.text(
        pos2(bar.left(), below),
        Align2::LEFT_TOP,
        low,
        font.clone(),
        color,
    );
    painter.text(pos2(bar.right(), below), Align2::RIGHT_TOP, high, font, color);
}

fn explain(response: &Response, map: &Sweep, i: usize, j: usize) {
    let (mean, count) = map.cell(i, j);
    let (u, tau) = (map.settings.u[i], map.settings.tau_cm_per_rad[j]);
    let noun = if count == 1 { "cloud" } else { "clouds" };
    let what = match mean {
        Some(mean) => format!("{mean:.2}° in the mean of {count} {noun}"),
        None => "no cloud has an error".into(),
    };
    response.clone().on_hover_text_at_pointer(format!(
        "u {u}, τ {tau:.3} cm/rad: {what}\nA click analyzes with this setting."
    ));
}
