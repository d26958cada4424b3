//! The axis in one view: how it is drawn, and what the left button does there in edit mode.

use egui::{Align2, Color32, CursorIcon, FontId, Painter, PointerButton, Pos2, Rect, Shape, Stroke, vec2};
use glam::{DVec2, DVec3};

use super::{OTHERS, OWN, say};
use crate::annotate::{Annotation, Role};
use crate::app::true_axes::{Draft, EditView, Grab, Handle};
use crate::app::{Command, State, TrueAxesCommand};
use crate::render::{Camera, Viewport};
use crate::ui::widgets::marks::color32;

const HALO: Color32 = Color32::from_rgb(0x10, 0x12, 0x14);

/// One view.
pub(in crate::ui) struct Stage<'a> {
    pub(in crate::ui) view: EditView,
    pub(in crate::ui) rect: Rect,
    pub(in crate::ui) camera: &'a Camera,
    pub(in crate::ui) viewport: Viewport,
}

impl Stage<'_> {
    fn local(&self, at: Pos2) -> DVec2 {
        let from = at - self.rect.min;
        DVec2::new(from.x.into(), from.y.into())
    }

    fn place(&self, point_in_world: DVec3) -> Option<Pos2> {
        let at = self.camera.project(point_in_world, self.viewport)?;
        Some(self.rect.min + vec2(at.x as f32, at.y as f32))
    }

    /// What the left button and the cursor do; whether the cursor is here.
    pub(in crate::ui) fn interact(
        &self,
        ui: &egui::Ui,
        response: &egui::Response,
        state: &State,
        commands: &mut Vec<Command>,
    ) -> bool {
        let annotating = &state.true_axes;
        if !annotating.can_edit() {
            return false;
        }
        let hover = response.hover_pos().map(|at| self.local(at));
        // With Shift on the surface under the cursor, else inside the fruit.
        let on_surface = self.view == EditView::Main && ui.input(|i| i.modifiers.shift);
        let surface = on_surface.then(|| {
            let shown = state.look.as_ref().map(|look| &look.shown);
            state
                .pointed_at
                .zip(shown)
                .and_then(|(i, shown)| shown.positions.get(i).copied())
        });
        let landing_at = |pixel| {
            let inside = annotating.landing_at(pixel, self.camera, self.viewport);
            surface.unwrap_or(inside)
        };
        if annotating.next_end().is_some() {
            let landing = hover.and_then(landing_at);
            if landing.is_some() && landing != annotating.landing {
                say(commands, TrueAxesCommand::Hover(landing));
            }
            if hover.is_some() {
                ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
            }
            if self.view == EditView::Main {
                ask_for_surface(ui, response.id, hover.filter(|_| on_surface), state, commands);
            }
            let clicked = response.interact_pointer_pos().filter(|_| response.clicked());
            if let Some(landing) = clicked.and_then(|at| landing_at(self.local(at))) {
                say(commands, TrueAxesCommand::Place(landing));
            }
            return hover.is_some();
        }
        self.drag(ui, response, state, commands);
        hover.is_some()
    }

    fn drag(&self, ui: &egui::Ui, response: &egui::Response, state: &State, commands: &mut Vec<Command>) {
        let annotating = &state.true_axes;
        let mut grab = annotating.grabbed.filter(|grab| grab.view == self.view);
        if response.drag_started_by(PointerButton::Primary)
            && let Some(at) = ui.input(|i| i.pointer.press_origin())
            && let Some(handle) = annotating.handle_at(self.local(at), self.camera, self.viewport)
            && let Some(ends) = annotating.ends()
        {
            let at_px = self.local(at);
            let view = self.view;
            say(commands, TrueAxesCommand::Grab { handle, view, at_px });
            grab = Some(Grab {
                handle,
                view,
                place: handle.place(&ends),
                at_px,
            });
        }
        if let Some(grab) = grab {
            let moved = ui.input(|i| i.pointer.delta() != egui::Vec2::ZERO);
            if let Some(at) = response
                .interact_pointer_pos()
                .filter(|_| moved && response.dragged_by(PointerButton::Primary))
            {
                let place = annotating.held_at(&grab, self.local(at), self.camera, self.viewport);
                say(commands, TrueAxesCommand::Drag(place));
            }
            if response.drag_stopped() {
                say(commands, TrueAxesCommand::Drop);
            }
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        } else if self.hovered(response, state).is_some() {
            ui.ctx().set_cursor_icon(CursorIcon::Grab);
        }
    }

    /// The handle that a press would grab, or that is held.
    fn hovered(&self, response: &egui::Response, state: &State) -> Option<Handle> {
        let annotating = &state.true_axes;
        if let Some(grab) = annotating.grabbed {
            return Some(grab.handle);
        }
        let at = response.hover_pos()?;
        annotating.handle_at(self.local(at), self.camera, self.viewport)
    }

    /// Draws everybody's axes, the own one, and where a click would land.
    pub(in crate::ui) fn paint(&self, ui: &egui::Ui, response: &egui::Response, state: &State) {
        let annotating = &state.true_axes;
        let painter = ui.painter().with_clip_rect(self.rect);
        if annotating.shows_all {
            self.others(&painter, state);
        }
        if !annotating.is_editing {
            return;
        }
        if let (Some(ends), Draft::None) = (annotating.ends(), annotating.draft) {
            let (base, blossom) = (ends.peduncle_base(), ends.blossom_end());
            let beyond = 0.25 * (base - blossom);
            self.line(&painter, base + beyond, blossom - beyond, OWN, 1.0);
            self.line(&painter, base, blossom, OWN, 2.5);
            let hovered = self.hovered(response, state);
            for handle in [Handle::Middle, Handle::BlossomEnd, Handle::PeduncleBase] {
                self.handle(&painter, handle, handle.place(&ends), hovered == Some(handle));
            }
            self.labels(
                &painter,
                &[Handle::PeduncleBase, Handle::BlossomEnd].map(|h| (h, h.place(&ends))),
            );
            if let Some(Handle::Middle) = hovered {
                self.label(&painter, Handle::Middle.title(), ends.middle());
            }
        }
        if let Draft::Base(base) = annotating.draft {
            if let Some(landing) = annotating.landing {
                self.line(&painter, base, landing, OWN, 2.0);
            }
            self.handle(&painter, Handle::PeduncleBase, base, false);
            self.labels(&painter, &[(Handle::PeduncleBase, base)]);
        }
        if let (Some(end), Some(landing)) = (annotating.next_end(), annotating.landing) {
            self.handle(&painter, end, landing, true);
            self.labels(&painter, &[(end, landing)]);
        }
    }

    fn line(&self, painter: &Painter, from: DVec3, to: DVec3, color: crate::render::Color, width: f32) {
        if let (Some(from), Some(to)) = (self.place(from), self.place(to)) {
            painter.line_segment([from, to], Stroke::new(width + 2.0, HALO));
            painter.line_segment([from, to], Stroke::new(width, color32(color)));
        }
    }

    /// A disc for the base, a ring for the blossom end, a small diamond for the whole.
    fn handle(&self, painter: &Painter, handle: Handle, place: DVec3, stands_out: bool) {
        let Some(at) = self.place(place) else { return };
        let scale = if self.view == EditView::Main { 1.0 } else { 0.8 };
        let radius = scale * if stands_out { 8.5 } else { 6.5 };
        let color = color32(OWN);
        let edge = if stands_out { Color32::WHITE } else { HALO };
        match handle {
            Handle::PeduncleBase => {
                painter.circle(at, radius, color, Stroke::new(2.0, edge));
            }
            Handle::BlossomEnd => {
                painter.circle_stroke(at, radius, Stroke::new(5.0, edge));
                painter.circle_stroke(at, radius, Stroke::new(2.5, color));
            }
            Handle::Middle => {
                let corners = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]
                    .map(|(x, y)| at + 0.8 * radius * vec2(x, y))
                    .to_vec();
                painter.add(Shape::convex_polygon(corners, color, Stroke::new(1.5, edge)));
            }
        }
    }

    /// The ends' names, in the large view.
    fn labels(&self, painter: &Painter, ends: &[(Handle, DVec3)]) {
        if self.view == EditView::Main {
            for (handle, place) in ends {
                self.label(painter, handle.title(), *place);
            }
        }
    }

    fn label(&self, painter: &Painter, text: &str, place: DVec3) {
        if let Some(at) = self.place(place) {
            write(painter, self.rect, text, at + vec2(13.0, 0.0), color32(OWN));
        }
    }

    /// Everybody else's axes, and in the large view whose they are.
    fn others(&self, painter: &Painter, state: &State) {
        let annotating = &state.true_axes;
        let own = annotating.author().ok().filter(|_| annotating.is_editing);
        let mut names = Vec::new();
        for (i, annotation) in annotating.annotations.iter().enumerate() {
            let is_own = own.as_ref().is_some_and(|author| annotation.is_by(author));
            let Some(ends) = annotation.ends().filter(|_| !is_own) else {
                continue;
            };
            let color = other_color(annotation, i);
            self.line(painter, ends.peduncle_base(), ends.blossom_end(), color, 2.0);
            if let (Some(at), EditView::Main) = (self.place(ends.peduncle_base()), self.view) {
                painter.circle(at, 4.0, color32(color), Stroke::new(1.5, HALO));
                let name = match annotation.role {
                    Role::Annotator => annotation.annotator.clone(),
                    Role::Adjudicator => format!("{}, adjudicated", annotation.annotator),
                };
                names.push((at, name, color32(color)));
            }
        }
        let mean = annotating
            .agreement
            .as_ref()
            .and_then(|agreement| agreement.mean.as_ref());
        if let (Some(mean), Some(subject)) = (mean.filter(|mean| mean.count > 1), &annotating.subject) {
            let half = 0.5 * subject.extent.size().length() * mean.direction;
            let ends = [mean.origin - half, mean.origin + half].map(|p| self.place(p));
            if let [Some(from), Some(to)] = ends {
                for (width, color) in [(4.0, HALO), (2.0, Color32::WHITE)] {
                    painter.extend(Shape::dashed_line(
                        &[from, to],
                        Stroke::new(width, color),
                        7.0,
                        5.0,
                    ));
                }
                if self.view == EditView::Main {
                    names.push((to, "mean".into(), Color32::WHITE));
                }
            }
        }
        // Above the ends, and above one another where they lie close.
        names.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        let mut taken: Vec<Rect> = Vec::new();
        for (at, name, color) in names {
            let mut place = at - vec2(0.0, 18.0);
            let size = vec2(7.0 * name.chars().count() as f32 + 12.0, 18.0);
            let around = |place: Pos2| Rect::from_min_size(place - vec2(4.0, 9.0), size);
            while taken.iter().any(|other| other.intersects(around(place))) {
                place.y -= 19.0;
            }
            taken.push(around(place));
            painter.line_segment([at, place], Stroke::new(1.0, color));
            write(painter, self.rect, &name, place, color);
        }
    }
}

/// The color of somebody's axis.
pub(in crate::ui) fn other_color(annotation: &Annotation, i: usize) -> crate::render::Color {
    match annotation.role {
        Role::Annotator => OTHERS[i % OTHERS.len()],
        Role::Adjudicator => [255; 4],
    }
}

/// Text on a plate that stays within the view.
fn write(painter: &Painter, within: Rect, text: &str, at: Pos2, color: Color32) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.5), color);
    let mut plate = Align2::LEFT_CENTER
        .anchor_size(at, galley.size())
        .expand2(vec2(4.0, 2.0));
    let inside = within.shrink(2.0);
    let over = vec2(
        (plate.right() - inside.right()).max(0.0) - (inside.left() - plate.left()).max(0.0),
        (plate.bottom() - inside.bottom()).max(0.0) - (inside.top() - plate.top()).max(0.0),
    );
    plate = plate.translate(-over);
    painter.rect_filled(plate, 3.0, Color32::from_black_alpha(200));
    painter.galley(plate.min + vec2(4.0, 2.0), galley, color);
}

/// Asks which point is under the cursor, where that has changed: finding it takes a walk over all of them.
fn ask_for_surface(
    ui: &egui::Ui,
    view: egui::Id,
    at: Option<DVec2>,
    state: &State,
    commands: &mut Vec<Command>,
) {
    let memory = view.with("asked for the surface");
    let asked = ui.data(|data| data.get_temp::<Option<DVec2>>(memory)).flatten();
    if asked != at {
        ui.data_mut(|data| data.insert_temp(memory, at));
        commands.push(Command::PointAt(at));
    } else if at.is_none() && state.pointed_at.is_some() {
        commands.push(Command::PointAt(None));
    }
}
