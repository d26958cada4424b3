//! Every candidate normal on a hemisphere: one dot per plane, seen from the camera's side unless turned.

use std::borrow::Cow;

use egui::{Color32, Pos2, Rect, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use glam::DVec3;

use crate::app::inspector::planes::Planes;
use crate::app::{Command, State};
use crate::ui::widgets::marks::{self, Mark, color32};
use crate::ui::widgets::{color_scale, notice, plane_tip};
use crate::view::AXIS_COLOR;

const REFERENCE_COLOR: crate::render::Color = [255; 4];

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(planes) = notice::planes_or_reason(ui, state, commands) else {
        return;
    };
    if ui.available_height() > 270.0 {
        marks::key(ui, &entries(state, &planes));
    }
    let opacity = notice::opacity(state);
    let size = ui.available_size().max(vec2(120.0, 120.0));
    let (whole, _) = ui.allocate_exact_size(size, Sense::hover());
    let scale_height = color_scale::height(ui, &planes);
    let mut room = whole;
    room.max.y -= scale_height;
    let response = ui.interact(room, ui.scope_id().with("hemisphere"), Sense::click_and_drag());
    response.widget_info(|| {
        let label = format!("Hemisphere of normals, {}", plane_tip::spoken(state, &planes));
        WidgetInfo::labeled(Role::Image, true, label)
    });

    let radius = 0.5 * room.width().min(room.height()) - 18.0;
    let turn = turned(ui, &response, radius);
    let view = View::new(&planes, turn, room.center(), radius.max(20.0));
    let dots = dots(&planes, &view);

    let hovered = response
        .hover_pos()
        .filter(|_| !response.dragged())
        .and_then(|place| nearest(&dots, place));
    plane_tip::interact(ui, &response, &planes, hovered, commands);
    if hovered.is_none() && !response.dragged() {
        let hint = "Drag turns the hemisphere, a double click turns it back.";
        response.clone().on_hover_text_at_pointer(hint);
    }

    paint_sphere(ui, &view);
    paint_lines(ui, state, &planes, &view);
    // Filled discs are cheap by the thousand, circles are not.
    let gray = ui.visuals().text_color().gamma_multiply(0.65);
    for dot in &dots {
        let color = dot.color.map_or(gray, |color| color.gamma_multiply(opacity));
        ui.painter().circle_filled(dot.place, dot.radius, color);
    }
    paint_marks(ui, state, &planes, &dots);
    if view.toward_viewpoint.z >= 0.0 {
        marks::diamond(ui.painter(), view.place(view.toward_viewpoint), 5.5);
    }
    if response.has_focus() {
        let stroke = ui.visuals().selection.stroke;
        ui.painter().circle_stroke(view.middle, view.radius + 8.0, stroke);
    }
    if let Some(scale) = &planes.scale {
        let margin = vec2(8.0, 0.0);
        let rect = Rect::from_min_max(
            pos2(whole.left(), room.bottom() + 4.0) + margin,
            whole.max - margin,
        );
        color_scale::paint(ui, rect, scale, opacity);
    }
}

fn entries(state: &State, planes: &Planes) -> Vec<(Mark, &'static str)> {
    let mut entries = marks::entries(state, planes, Mark::Gray);
    entries.push((Mark::Sizes, "larger: more partners"));
    entries.push((Mark::ViewRay, "view ray"));
    if chosen_axis(state, planes).is_some() {
        entries.push((Mark::Line(AXIS_COLOR), "axis"));
    }
    if let Some(reference) = state.reference() {
        let name = match reference.source.in_words() {
            Cow::Borrowed(words) => words.strip_prefix("the ").unwrap_or(words),
            Cow::Owned(_) => "reference",
        };
        entries.push((Mark::Line(REFERENCE_COLOR), name));
    }
    entries
}

fn chosen_axis(state: &State, planes: &Planes) -> Option<DVec3> {
    planes.facts.get(state.plane_index()?)?.axis
}

/// The rotation of the hemisphere: about its upright, then forward.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Turn {
    yaw_rad: f32,
    pitch_rad: f32,
}

/// The rotation by one press of an arrow key.
const KEY_STEP_RAD: f32 = 0.175;

/// Returns the rotation after this frame's drag, arrow keys, or double click.
fn turned(ui: &Ui, response: &Response, radius: f32) -> Turn {
    let id = response.id.with("turn");
    let before: Turn = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let mut turn = before;
    if response.dragged() {
        let by = response.drag_delta() / radius.max(20.0);
        turn.yaw_rad += by.x;
        turn.pitch_rad += by.y;
    }
    let [right, down] = plane_tip::arrow_presses(ui, response);
    turn.yaw_rad += right as f32 * KEY_STEP_RAD;
    turn.pitch_rad += down as f32 * KEY_STEP_RAD;
    turn.pitch_rad = turn
        .pitch_rad
        .clamp(-std::f32::consts::FRAC_PI_2, std::f32::consts::FRAC_PI_2);
    if response.double_clicked() {
        turn = Turn::default();
    }
    if turn != before {
        ui.data_mut(|data| data.insert_temp(id, turn));
    }
    turn
}

/// The view of the hemisphere. In its frame x points right, y up, and z to the viewer.
struct View {
    right: DVec3,
    up: DVec3,
    toward: DVec3,
    middle: Pos2,
    radius: f32,
    /// The direction from the fruit center to the camera, in this frame.
    toward_viewpoint: DVec3,
}

impl View {
    fn new(planes: &Planes, turn: Turn, middle: Pos2, radius: f32) -> Self {
        let analysis = &planes.analysis;
        let viewpoint = (analysis.params.viewpoint - analysis.center)
            .try_normalize()
            .unwrap_or(DVec3::NEG_Z);
        // Up in a camera's frame is −y; where that is the view ray itself, −z does as well.
        let right = DVec3::NEG_Y.cross(viewpoint).try_normalize().unwrap_or(DVec3::X);
        let up = viewpoint.cross(right);
        let (sin, cos) = f64::from(turn.yaw_rad).sin_cos();
        let (toward, right) = (cos * viewpoint - sin * right, cos * right + sin * viewpoint);
        let (sin, cos) = f64::from(turn.pitch_rad).sin_cos();
        let (toward, up) = (cos * toward + sin * up, cos * up - sin * toward);
        let mut view = Self {
            right,
            up,
            toward,
            middle,
            radius,
            toward_viewpoint: DVec3::Z,
        };
        view.toward_viewpoint = view.seen(viewpoint);
        view
    }

    fn seen(&self, direction: DVec3) -> DVec3 {
        DVec3::new(
            direction.dot(self.right),
            direction.dot(self.up),
            direction.dot(self.toward),
        )
    }

    fn place(&self, seen: DVec3) -> Pos2 {
        self.middle + self.radius * vec2(seen.x as f32, -seen.y as f32)
    }
}

struct Dot {
    index: usize,
    place: Pos2,
    radius: f32,
    color: Option<Color32>,
}

/// Returns a dot for each plane, those without a score first and the best last, so that it lies on top.
fn dots(planes: &Planes, view: &View) -> Vec<Dot> {
    let most = (0.34 * view.radius * std::f32::consts::PI / planes.u() as f32).clamp(2.5, 10.0);
    let order = planes.in_rank_order();
    let dots = order.into_iter().rev().map(|index| {
        let facts = &planes.facts[index];
        let seen = view.seen(facts.normal);
        // n and −n are the same plane.
        let seen = if seen.z < 0.0 { -seen } else { seen };
        let share = facts.partners as f32 / planes.points().max(1) as f32;
        Dot {
            index,
            place: view.place(seen),
            // Small enough to leave room for those that count.
            radius: match facts.score_cm {
                Some(_) => (most * share.sqrt()).max(1.5),
                None => (0.6 * most * share.sqrt()).clamp(1.2, 4.0),
            },
            color: planes.color(index).map(color32),
        }
    });
    dots.collect()
}

fn nearest(dots: &[Dot], place: Pos2) -> Option<usize> {
    // The topmost dot comes last.
    let reach = |dot: &Dot| place.distance(dot.place) - dot.radius;
    let nearest = dots.iter().rev().min_by(|a, b| reach(a).total_cmp(&reach(b)))?;
    (reach(nearest) < 5.0).then_some(nearest.index)
}

fn paint_sphere(ui: &Ui, view: &View) {
    let visuals = ui.visuals();
    let line = egui::Stroke::new(1.0, visuals.text_color().gamma_multiply(0.25));
    ui.painter()
        .circle_filled(view.middle, view.radius, visuals.faint_bg_color);
    ui.painter().circle_stroke(view.middle, view.radius, line);
    // The circles of x = 0, y = 0 and z = 0: half of each is visible.
    for (a, b) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z), (DVec3::Z, DVec3::X)] {
        let (a, b) = (view.seen(a), view.seen(b));
        // Highest where the circle is nearest.
        let phase = b.z.atan2(a.z);
        let half: Vec<Pos2> = (0..=48)
            .map(|i| {
                let angle = phase + std::f64::consts::PI * (f64::from(i) / 48.0 - 0.5);
                view.place(angle.cos() * a + angle.sin() * b)
            })
            .collect();
        ui.painter().line(half, line);
    }
}

fn paint_lines(ui: &Ui, state: &State, planes: &Planes, view: &View) {
    let reference = state.reference().map(|r| (r.direction, REFERENCE_COLOR));
    let axis = chosen_axis(state, planes).map(|axis| (axis, AXIS_COLOR));
    for (direction, color) in [reference, axis].into_iter().flatten() {
        let seen = 1.1 * view.seen(direction);
        marks::outlined_line(ui.painter(), [view.place(-seen), view.place(seen)], color);
    }
}

fn paint_marks(ui: &Ui, state: &State, planes: &Planes, dots: &[Dot]) {
    let dot = |index: usize| dots.iter().find(|dot| dot.index == index);
    let frame = |dot: &Dot| Rect::from_center_size(dot.place, egui::Vec2::splat(2.0 * dot.radius + 9.0));
    marks::paint_planes(
        ui.painter(),
        state,
        planes,
        |index| dot(index).map(frame),
        |index| dot(index).map(|dot| (dot.place, dot.radius + 1.5)),
    );
}
