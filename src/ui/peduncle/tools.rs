//! Lasso and brush in the view. Only the primary button edits, and only the others move the camera.

use egui::{Button, Color32, CursorIcon, PointerButton, Pos2, Rect, Shape, Stroke, vec2};
use glam::DVec2;

use crate::app::{Command, PeduncleCommand, State, Tool};
use crate::render::Viewport;
use crate::ui::inspector::view3d::ORBIT_RAD_PER_PX;

/// Shows the buttons of both tools, named by `name` for a screen reader; returns the tool that was clicked.
pub(in crate::ui) fn picking_tools(
    ui: &mut egui::Ui,
    state: &State,
    name: impl Fn(&str) -> String,
) -> Option<Tool> {
    let tools = [
        ("Lasso", Tool::Lasso, "Draw around the peduncle's points (K)"),
        ("Brush", Tool::Brush, "Paint over the peduncle's points (B)"),
    ];
    let clicked = tools.map(|(text, tool, tip)| {
        let button = Button::selectable(state.tool == tool, text).frame_when_inactive(true);
        let response = ui.add(button).on_hover_text(tip).accessible_name(name(text));
        response.clicked().then_some(tool)
    });
    clicked.into_iter().flatten().next()
}

/// Carries out a drag in the view while one of the tools is in hand.
pub(in crate::ui) fn drag(
    ui: &egui::Ui,
    response: &egui::Response,
    rect: Rect,
    state: &State,
    viewport: Viewport,
    commands: &mut Vec<Command>,
) {
    let local = |p: Pos2| DVec2::new((p.x - rect.min.x).into(), (p.y - rect.min.y).into());
    let is_drawing = state.peduncle.strokes.back().is_some_and(|s| !s.is_ended);
    stroke(ui, response, is_drawing, local, commands);
    if state.pointed_at.is_some() {
        commands.push(Command::PointAt(None));
    }
    if response.hovered() {
        let is_brush = state.tool == Tool::Brush;
        let cursor = if is_brush {
            CursorIcon::None
        } else {
            CursorIcon::Crosshair
        };
        ui.ctx().set_cursor_icon(cursor);
    }
    // A stroke belongs to the view that it is drawn over.
    if is_drawing {
        return;
    }
    let delta = response.drag_delta();
    let by_px = DVec2::new(delta.x.into(), delta.y.into());
    let mut camera = state.camera;
    let shift = ui.input(|i| i.modifiers.shift);
    let turns = response.dragged_by(PointerButton::Secondary);
    if response.dragged_by(PointerButton::Middle) || (turns && shift) {
        camera.pan(by_px, viewport);
    } else if turns {
        camera.orbit(ORBIT_RAD_PER_PX * by_px.x, ORBIT_RAD_PER_PX * by_px.y);
    }
    if let Some(at) = response.hover_pos() {
        let (scroll, pinch, ctrl) = ui.input(|i| {
            (
                i.smooth_scroll_delta().y,
                f64::from(i.zoom_delta()),
                i.modifiers.command,
            )
        });
        if ctrl && state.tool == Tool::Brush {
            if pinch != 1.0 {
                let radius = state.peduncle.brush_radius_px * pinch;
                commands.push(Command::Peduncle(PeduncleCommand::BrushRadius(radius)));
            }
        } else {
            let factor = f64::from(-0.0025 * scroll).exp() / pinch;
            if factor != 1.0 {
                camera.zoom_at_pixel(local(at), factor, viewport);
            }
        }
    }
    if camera != state.camera {
        commands.push(Command::Camera(Box::new(camera)));
    }
}

/// Draws by the primary button, from the very place where it was pressed.
fn stroke(
    ui: &egui::Ui,
    response: &egui::Response,
    is_drawing: bool,
    local: impl Fn(Pos2) -> DVec2,
    commands: &mut Vec<Command>,
) {
    let is_ours = response.is_pointer_button_down_on();
    ui.input(|i| {
        let mut removes = false;
        let (mut is_open, mut is_ended) = (is_drawing, false);
        let mut draw = |pos: Pos2, removes: bool| {
            let at_px = local(pos);
            commands.push(Command::Peduncle(PeduncleCommand::Draw { at_px, removes }));
        };
        // Every position of a quick hand, not only the last one of the frame.
        for event in &i.events {
            match event {
                egui::Event::PointerButton {
                    pos,
                    button: PointerButton::Primary,
                    pressed: true,
                    modifiers,
                } if is_ours => {
                    is_open = true;
                    removes = is_removing(*modifiers);
                    draw(*pos, removes);
                }
                egui::Event::PointerMoved(pos) if is_open => draw(*pos, removes),
                egui::Event::PointerButton {
                    pos,
                    button: PointerButton::Primary,
                    pressed: false,
                    ..
                } if is_open => {
                    draw(*pos, removes);
                    (is_open, is_ended) = (false, true);
                }
                _ => {}
            }
        }
        // The button may be released outside of the window, where no event comes.
        if is_ended || (is_open && !i.pointer.primary_down()) {
            commands.push(Command::Peduncle(PeduncleCommand::EndStroke));
        }
    });
}

fn is_removing(modifiers: egui::Modifiers) -> bool {
    modifiers.shift || modifiers.alt
}

/// Draws the line of the lasso, or the brush under the cursor.
pub(in crate::ui) fn paint(ui: &egui::Ui, response: &egui::Response, rect: Rect, state: &State) {
    if !state.is_picking() {
        return;
    }
    let painter = ui.painter().with_clip_rect(rect);
    let place = |p: DVec2| rect.min + vec2(p.x as f32, p.y as f32);
    let drawn = state.peduncle.strokes.back().filter(|s| !s.is_ended);
    let removes = match drawn {
        Some(stroke) => stroke.removes,
        None => ui.input(|i| is_removing(i.modifiers)),
    };
    let color = if removes {
        Color32::from_rgb(0xff, 0xb0, 0x30)
    } else {
        Color32::WHITE
    };
    // Light over dark, so that it is visible on every color.
    let strokes = [
        Stroke::new(3.5, Color32::from_black_alpha(170)),
        Stroke::new(1.5, color),
    ];
    if let Some(stroke) = drawn.filter(|s| s.tool == Tool::Lasso) {
        let line: Vec<Pos2> = stroke.path_px.iter().copied().map(place).collect();
        for stroke in strokes {
            painter.add(Shape::line(line.clone(), stroke));
        }
        if let [first, .., last] = line[..] {
            painter.extend(Shape::dashed_line(&[last, first], strokes[1], 5.0, 4.0));
        }
    }
    let at = response
        .hover_pos()
        .or(response.interact_pointer_pos())
        .filter(|_| state.tool == Tool::Brush);
    if let Some(at) = at {
        let radius = state.peduncle.brush_radius_px as f32;
        for stroke in strokes {
            painter.circle_stroke(at, radius, stroke);
        }
        // A plus or a minus as well: not everybody tells the colors apart.
        for stroke in strokes {
            painter.line_segment([at - vec2(4.0, 0.0), at + vec2(4.0, 0.0)], stroke);
            if !removes {
                painter.line_segment([at - vec2(0.0, 4.0), at + vec2(0.0, 4.0)], stroke);
            }
        }
    }
}

/// Returns the instructions for the tool in hand; `None` without one.
pub(in crate::ui) fn hint(state: &State) -> Option<&'static str> {
    match state.tool {
        Tool::Lasso => Some(
            "Drag around the peduncle to add its points, with Shift to take some away. Right drag turns the view, \
             middle drag moves it, the wheel zooms. Esc ends it.",
        ),
        Tool::Brush => Some(
            "Drag over the peduncle to add its points, with Shift to take some away; [ and ] or Ctrl + wheel size the \
             brush. Right drag turns the view, middle drag moves it. Esc ends it.",
        ),
        Tool::Navigate | Tool::MoveCenter => None,
    }
}
