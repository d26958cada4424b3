//! The 3-D view: the picture, its page, and the mouse.

use egui::{
    Align2, Color32, CursorIcon, FontId, PointerButton, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, vec2,
};
use glam::DVec2;

use super::paint::ViewCallback;
use crate::app::inspector::why::{why, why_lines};
use crate::app::true_axes::EditView;
use crate::app::{Command, State, Tool, dragged, page};
use crate::render::{Line, Viewport};
use crate::ui::peduncle;
use crate::ui::true_axes::AxisView;
use crate::view::{Anchor, Primitive, lay_out};

/// Radians a logical pixel of dragging.
pub(in crate::ui) const ORBIT_RAD_PER_PX: f64 = 0.008;

/// The view's report to the window.
pub(in crate::ui) struct ViewAnswer {
    /// Its size in logical pixels.
    pub(in crate::ui) viewport: Viewport,
    /// Whether the cursor is in it while clicks set an axis.
    pub(in crate::ui) is_hovered: bool,
}

/// Draws the view into all of the room that is left.
pub(in crate::ui) fn show(
    ui: &mut egui::Ui,
    state: &State,
    is_gpu: bool,
    commands: &mut Vec<Command>,
) -> ViewAnswer {
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, description(state)));
    let viewport = Viewport::new(rect.width().into(), rect.height().into());
    let mut answer = ViewAnswer {
        viewport,
        is_hovered: false,
    };
    let Some(look) = state.look.as_ref() else {
        empty(ui, rect, state);
        return answer;
    };
    if state.is_picking() {
        peduncle::drag(ui, &response, rect, state, viewport, commands);
    } else {
        navigate(ui, &response, rect, state, viewport, commands);
    }
    let axis_view = AxisView {
        view: EditView::Main,
        rect,
        camera: &state.camera,
        viewport,
    };
    answer.is_hovered = axis_view.interact(ui, &response, state, commands);

    let pixels_per_point = ui.ctx().pixels_per_point();
    if is_gpu {
        // At least a pixel, at most some thousand.
        let size_px = [rect.width(), rect.height()].map(|s| (s * pixels_per_point).round().max(1.0) as u32);
        ui.painter().add(eframe::egui_wgpu::Callback::new_paint_callback(
            rect,
            ViewCallback {
                view: response.id,
                scene: state
                    .true_axes
                    .ghost_scene
                    .clone()
                    .or_else(|| state.drawn_scene())
                    .unwrap_or_else(|| look.scene.clone()),
                lines: cursor_lines(state, pixels_per_point),
                camera: state.camera,
                size_px,
                is_software: state.is_software,
                ctx: ui.ctx().clone(),
            },
        ));
    }
    let page = page(state, look, viewport);
    let font = |size: f64| FontId::proportional(size as f32);
    let measure = |text: &str, size: f64| {
        let galley = ui
            .painter()
            .layout_no_wrap(text.to_owned(), font(size), Color32::WHITE);
        f64::from(galley.size().x)
    };
    let painter = ui.painter().with_clip_rect(rect);
    for primitive in lay_out(&page, &state.camera, &measure) {
        paint(&painter, rect, &primitive);
    }
    axis_view.paint(ui, &response, state);
    notices(ui, rect, state, commands);
    peduncle::paint(ui, &response, rect, state);
    answer
}

/// The description of the view for screen readers.
fn description(state: &State) -> String {
    match (state.source(), state.look.as_ref()) {
        (Some(source), Some(look)) => format!(
            "3-D view of {}, {} points, colored by {}",
            source.name(),
            look.shown.len(),
            look.legend.title
        ),
        _ => "3-D view, empty".into(),
    }
}

fn navigate(
    ui: &egui::Ui,
    response: &egui::Response,
    rect: Rect,
    state: &State,
    viewport: Viewport,
    commands: &mut Vec<Command>,
) {
    let local = |p: Pos2| DVec2::new((p.x - rect.min.x).into(), (p.y - rect.min.y).into());
    let delta = response.drag_delta();
    let by_px = DVec2::new(delta.x.into(), delta.y.into());
    let shift = ui.input(|i| i.modifiers.shift);
    let mut camera = state.camera;
    let is_primary = response.dragged_by(PointerButton::Primary);
    let is_primary = is_primary && !state.true_axes.is_editing;
    // Where the left button sets the axis, the right one turns.
    let turns = state.true_axes.is_editing && response.dragged_by(PointerButton::Secondary) && !shift;
    let pans = (response.dragged_by(PointerButton::Secondary) && !turns)
        || response.dragged_by(PointerButton::Middle)
        || (is_primary && shift);
    let center = state.analysis().map(|a| a.center);
    if pans {
        camera.pan(by_px, viewport);
    } else if is_primary && state.tool == Tool::MoveCenter {
        if let Some(center) = center.filter(|_| by_px != DVec2::ZERO) {
            commands.push(Command::MoveCenter(dragged(center, by_px, &camera, viewport)));
        }
    } else if is_primary || turns {
        camera.orbit(ORBIT_RAD_PER_PX * by_px.x, ORBIT_RAD_PER_PX * by_px.y);
    }
    if response.drag_stopped() && state.tool == Tool::MoveCenter {
        commands.push(Command::EndGesture);
    }
    let hover = response.hover_pos();
    if let Some(at) = hover {
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = f64::from(-0.0025 * scroll).exp() / f64::from(pinch);
        if factor != 1.0 {
            camera.zoom_at_pixel(local(at), factor, viewport);
        }
    }
    if camera != state.camera {
        commands.push(Command::Camera(Box::new(camera)));
    }
    if state.tool == Tool::MoveCenter && response.hovered() {
        ui.ctx().set_cursor_icon(CursorIcon::Move);
    }
    if state.true_axes.is_editing {
        return;
    }
    if let Some(at) = response.interact_pointer_pos() {
        if response.double_clicked() {
            commands.extend([Command::PickAt(local(at)), Command::PivotOnPicked]);
        } else if response.clicked() {
            commands.push(Command::PickAt(local(at)));
        }
    }
    // Only when the cursor has moved: finding a point takes a walk over all of them.
    let moved = ui.input(|i| i.pointer.delta() != egui::Vec2::ZERO);
    match hover {
        Some(at) if moved && !response.dragged() => commands.push(Command::PointAt(Some(local(at)))),
        None if state.pointed_at.is_some() => commands.push(Command::PointAt(None)),
        _ => {}
    }
}

/// The picked point and the one under the cursor, and why the picked one scores as it does.
fn cursor_lines(state: &State, pixels_per_point: f32) -> Vec<Line> {
    let Some(shown) = state.look.as_ref().map(|look| &look.shown) else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    let disc = |index: usize, color, width: f32| {
        let place = shown.positions.get(index).copied()?;
        Some(
            Line::new(place, place, color, width * pixels_per_point)
                .outlined([0x10, 0x12, 0x14, 255], 1.5 * pixels_per_point)
                .shining_through(0.8),
        )
    };
    if let Some(pointed) = state.pointed_at.filter(|&p| Some(p) != state.picked) {
        lines.extend(disc(pointed, [255, 255, 255, 200], 6.0));
    }
    let explained = state.picked.and_then(|picked| why(state, picked));
    if let Some(why) = explained {
        let mut steps = why_lines(&why, shown.extent.size().length(), state.style.theme);
        for line in &mut steps {
            line.width_px *= pixels_per_point;
            line.outline_px *= pixels_per_point;
        }
        lines.extend(steps);
    }
    lines
}

/// Shows what has to be said about the view in its upper left corner, with the way out where there is one.
fn notices(ui: &mut egui::Ui, rect: Rect, state: &State, commands: &mut Vec<Command>) {
    let mut lines: Vec<String> = Vec::new();
    if let Some((_, why)) = &state.unanalyzed {
        lines.push(why.clone().unwrap_or_else(|| "Not analyzed yet …".into()));
    }
    if let Some(why) = state.look.as_ref().and_then(|look| look.fallback) {
        let why = why.to_string();
        lines.push(crate::text::sentence(&why));
    }
    if state.is_stale {
        lines.push(if state.was_cancelled {
            "This is the result of the settings before: the analysis was called off.".into()
        } else {
            match (&state.walked, state.source()) {
                (Some(walked), Some(source)) if walked.fruit.file.path != source.path() => {
                    format!(
                        "This is still the cloud before; {} is being read …",
                        source.name()
                    )
                }
                _ => "This is still the result of the settings before …".into(),
            }
        });
    }
    if state.tool == Tool::MoveCenter {
        lines.push("Drag to move the fruit center; Esc ends it.".into());
    }
    let mut at = rect.min + vec2(12.0, 12.0);
    for line in lines {
        let color = ui.visuals().strong_text_color();
        let galley = ui.painter().layout(
            line,
            FontId::proportional(13.0),
            color,
            (rect.width() - 40.0).max(60.0),
        );
        let size = galley.size();
        let background = Rect::from_min_size(at, size).expand2(vec2(8.0, 5.0));
        ui.painter().rect(
            background,
            4.0,
            ui.visuals().window_fill,
            Stroke::new(1.0, ui.visuals().warn_fg_color),
            StrokeKind::Inside,
        );
        ui.painter().galley(at, galley, color);
        at.y += size.y + 16.0;
    }
    if state.is_viewpoint_inside {
        let look = "Look from here";
        let tip = "Takes the eye of this view as the viewpoint: the place of a camera that saw these points. For a whole \
                   scan no place is right for all of them; turn it so that the side you want faces you.";
        let scan = "Scan from here";
        let scan_tip = "Makes a cloud of the points that a depth camera in the place of this view would see. The cloud before \
                        stays in the list.";
        for (text, tip, command) in [
            (look, tip, Command::LookFromHere),
            (scan, scan_tip, Command::ScanFromHere),
        ] {
            let place = Rect::from_min_size(at, vec2(124.0, ui.spacing().interact_size.y));
            let response = ui.put(place, egui::Button::new(text)).on_hover_text(tip);
            if response.clicked() {
                commands.push(command);
            }
            at.x += 132.0;
        }
    }
}

fn empty(ui: &egui::Ui, rect: Rect, state: &State) {
    let text = if state.current.is_none() {
        "Drop PLY files or a folder here, or open one with Ctrl+O."
    } else if state.progress.is_some() {
        "Reading …"
    } else {
        "There is nothing to show of this file."
    };
    ui.painter().text(
        rect.center(),
        Align2::CENTER_CENTER,
        text,
        FontId::proportional(16.0),
        ui.visuals().text_color(),
    );
}

fn paint(painter: &egui::Painter, rect: Rect, primitive: &Primitive) {
    let place = |p: DVec2| rect.min + vec2(p.x as f32, p.y as f32);
    let color = |c: [u8; 4]| Color32::from_rgba_unmultiplied(c[0], c[1], c[2], c[3]);
    match primitive {
        Primitive::Text {
            at,
            anchor,
            size_px,
            color: ink,
            halo,
            text,
        } => {
            let galley =
                painter.layout_no_wrap(text.clone(), FontId::proportional(*size_px as f32), color(*ink));
            let shift = match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
            // Their place is that of the baseline.
            let ascent = galley.rows.first().map_or(0.0, |row| {
                row.glyphs.first().map_or(0.0, |glyph| glyph.font_ascent)
            });
            let at = place(*at) - vec2(shift * galley.size().x, ascent);
            if let Some(halo) = halo {
                let halo = color(*halo);
                for (x, y) in [(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)] {
                    painter.galley_with_override_text_color(at + vec2(x, y), galley.clone(), halo);
                }
            }
            painter.galley(at, galley, color(*ink));
        }
        Primitive::Line {
            from,
            to,
            width_px,
            color: ink,
        } => {
            painter.line_segment(
                [place(*from), place(*to)],
                Stroke::new(*width_px as f32, color(*ink)),
            );
        }
        Primitive::Box {
            min,
            max,
            color: fill,
        } => {
            painter.rect_filled(Rect::from_min_max(place(*min), place(*max)), 2.0, color(*fill));
        }
        Primitive::Ramp { min, max, stops } => {
            let mut mesh = egui::Mesh::default();
            let (min, max) = (place(*min), place(*max));
            let last = stops.len().saturating_sub(1).max(1) as f32;
            for (i, stop) in stops.iter().enumerate() {
                let x = min.x + (max.x - min.x) * i as f32 / last;
                mesh.colored_vertex(Pos2::new(x, min.y), color(*stop));
                mesh.colored_vertex(Pos2::new(x, max.y), color(*stop));
                if i > 0 {
                    // Two triangles a step; there are few steps.
                    let v = 2 * i as u32;
                    mesh.add_triangle(v - 2, v - 1, v);
                    mesh.add_triangle(v - 1, v, v + 1);
                }
            }
            painter.add(Shape::mesh(mesh));
        }
    }
}
