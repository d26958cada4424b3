//! The bar under the view, which steps through the candidate planes.

use egui::{
    DragValue, Id, Painter, Pos2, Rect, Response, Role, Sense, Shape, Slider, Stroke, Ui, WidgetInfo, vec2,
};

use crate::app::inspector::planes::{PlaneFacts, Planes};
use crate::app::{Command, PlaneChoice, State};
use crate::ui::widgets::{notice, plane_tip};

/// Draws the bar.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(planes) = plane_tip::planes_of(ui.ctx(), state) else {
        notice::nothing_to_show(ui, state, commands);
        return;
    };
    let mut by_rank = walks_by_rank(ui.ctx());
    let order = if by_rank {
        planes.in_rank_order()
    } else {
        (0..planes.facts.len()).collect()
    };
    ui.horizontal_wrapped(|ui| {
        buttons(ui, state, &planes, by_rank, commands);
        slider(ui, state, &planes, &order, by_rank, commands);
        let toggle = ui
            .checkbox(&mut by_rank, "by rank")
            .on_hover_text("Step through the planes from the best to the worst instead of through the grid.");
        if toggle.changed() {
            ui.data_mut(|data| data.insert_temp(by_rank_id(), by_rank));
        }
    });
    notice::if_no_plane(ui, &planes.analysis);
    if let Some(index) = state.plane_index() {
        let facts = &planes.facts[index];
        let is_preview = state.previewed.is_some() && state.previewed != state.chosen_plane_index();
        let mut line = plane_tip::line(&planes, index);
        if is_preview {
            line = format!("Previewed g {}, h {}: {line}", facts.g, facts.h);
        } else if let Some(first) = line.get_mut(0..1) {
            first.make_ascii_uppercase();
        }
        ui.label(line);
    }
    notice::if_stale(ui, state, commands);
}

fn buttons(ui: &mut Ui, state: &State, planes: &Planes, by_rank: bool, commands: &mut Vec<Command>) {
    let step = |by: isize| {
        if by_rank {
            Command::StepRank(by)
        } else {
            Command::Step(by)
        }
    };
    let order = if by_rank { "the ranking" } else { "the grid" };
    if icon_button(ui, Icon::Previous, "Previous plane")
        .on_hover_text(format!("The plane before this one in {order} (Left arrow)"))
        .clicked()
    {
        commands.push(step(-1));
    }
    let (icon, name, explained) = if state.is_playing {
        (Icon::Pause, "Pause", "Stay at this plane (Space)")
    } else {
        (Icon::Play, "Play", "Play through all planes of the grid (Space)")
    };
    if icon_button(ui, icon, name).on_hover_text(explained).clicked() {
        commands.push(Command::Play(!state.is_playing));
    }
    if icon_button(ui, Icon::Next, "Next plane")
        .on_hover_text(format!("The plane after this one in {order} (Right arrow)"))
        .clicked()
    {
        commands.push(step(1));
    }
    let is_best = state.settings.plane == PlaneChoice::Best;
    let best = ui
        .add_enabled(
            planes.best().is_some(),
            egui::Button::selectable(is_best, "Best").frame_when_inactive(true),
        )
        .on_hover_text("The plane with the lowest score, whichever it is (Home)")
        .on_disabled_hover_text("No plane has enough partners for a score");
    if best.clicked() {
        commands.push(Command::LookAt(PlaneChoice::Best));
    }
}

fn slider(
    ui: &mut Ui,
    state: &State,
    planes: &Planes,
    order: &[usize],
    by_rank: bool,
    commands: &mut Vec<Command>,
) {
    let count = order.len();
    let chosen = state.chosen_plane_index();
    let place = chosen.and_then(|index| order.iter().position(|&i| i == index));
    let before = place.map_or(1, |place| place + 1);
    let mut number = before;

    // The rest of the line, without the typed value and the checkbox after it.
    let beside = 300.0;
    let rest = ui.available_size_before_wrap().x - ui.spacing().item_spacing.x;
    // If hardly any space is left, these go to the next line.
    let width = if rest - beside < 120.0 {
        rest
    } else {
        rest - beside
    };
    ui.spacing_mut().slider_width = width.max(80.0);
    let explained = if by_rank {
        "The planes from the best to the worst (Left and Right arrow)"
    } else {
        "All planes, h fastest (Left and Right arrow)"
    };
    ui.add(Slider::new(&mut number, 1..=count).integer().show_value(false))
        .on_hover_text(explained)
        .accessible_name("Plane");

    let at = |n: f64| -> Option<&PlaneFacts> {
        // From 1 to the number of planes.
        let place = (n.round().max(1.0) as usize).min(count) - 1;
        order.get(place).and_then(|&i| planes.facts.get(i))
    };
    let place_of = |g: usize, h: usize| {
        let index = planes.analysis.planes.grid.index_of(g, h)?;
        order.iter().position(|&i| i == index)
    };
    ui.add(
        DragValue::new(&mut number)
            .range(1..=count)
            .speed(0.1)
            .prefix(if by_rank { "rank " } else { "plane " })
            .custom_formatter(|n, _| {
                let (g, h) = at(n).map_or((0, 0), |facts| (facts.g, facts.h));
                format!("{n:.0} of {count} (g {g}, h {h})")
            })
            .custom_parser(|typed| parse(typed, place_of)),
    )
    .on_hover_text("Type a number, or g and h, such as “3, 2”")
    .accessible_name("Plane by its number");
    if number != before
        && let Some(&index) = order.get(number - 1)
    {
        commands.push(Command::LookAt(planes.facts[index].choice()));
    }
}

/// Parses a plane's number, or its g and h; in the whole text as it is shown, the number counts.
fn parse(typed: &str, place_of: impl Fn(usize, usize) -> Option<usize>) -> Option<f64> {
    let numbers: Vec<usize> = typed
        .split(|letter: char| !letter.is_ascii_digit())
        .filter(|part| !part.is_empty())
        .map(str::parse)
        .collect::<Result<_, _>>()
        .ok()?;
    match numbers[..] {
        [g, h] => place_of(g, h).map(|place| (place + 1) as f64),
        [number] | [number, _, _, _] => Some(number as f64),
        _ => None,
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Icon {
    Previous,
    Next,
    Play,
    Pause,
}

fn icon_button(ui: &mut Ui, icon: Icon, name: &str) -> Response {
    let height = ui.spacing().interact_size.y;
    let (rect, response) = ui.allocate_exact_size(vec2(1.4 * height, height), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    let visuals = ui.style().interact(&response);
    let painter = ui.painter();
    painter.rect(
        rect.expand(visuals.expansion),
        visuals.corner_radius,
        visuals.weak_bg_fill,
        visuals.bg_stroke,
        egui::StrokeKind::Inside,
    );
    paint(
        painter,
        rect.center(),
        0.24 * height,
        icon,
        visuals.fg_stroke.color,
    );
    response
}

fn paint(painter: &Painter, middle: Pos2, half: f32, icon: Icon, color: egui::Color32) {
    let triangle = |middle: Pos2, way: f32| {
        let corners = vec![
            middle + vec2(-0.8 * half * way, -half),
            middle + vec2(0.8 * half * way, 0.0),
            middle + vec2(-0.8 * half * way, half),
        ];
        painter.add(Shape::convex_polygon(corners, color, Stroke::NONE));
    };
    let bar = |x: f32| {
        let size = vec2(0.55 * half, 2.0 * half);
        painter.rect_filled(Rect::from_center_size(middle + vec2(x, 0.0), size), 0.0, color);
    };
    match icon {
        Icon::Play => triangle(middle, 1.0),
        Icon::Pause => {
            bar(-0.6 * half);
            bar(0.6 * half);
        }
        Icon::Previous => {
            bar(-half);
            triangle(middle + vec2(0.3 * half, 0.0), -1.0);
        }
        Icon::Next => {
            triangle(middle - vec2(0.3 * half, 0.0), 1.0);
            bar(half);
        }
    }
}

fn by_rank_id() -> Id {
    Id::unique("planes are walked through by rank")
}

/// Whether previous and next follow the ranking instead of the grid, as the keys must then do, too.
pub fn walks_by_rank(ctx: &egui::Context) -> bool {
    ctx.data(|data| data.get_temp(by_rank_id())).unwrap_or_default()
}
