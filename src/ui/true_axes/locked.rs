//! The three locked views beside the large one, without perspective: front, side and end-on.

use egui::{
    Color32, FontId, Frame, Panel, Pos2, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

use super::stage::Stage;
use crate::app::true_axes::EditView;
use crate::app::{Command, State};
use crate::render::Viewport;
use crate::ui::inspector::paint::ViewCallback;

/// Shows them in edit mode; says whether the cursor is in one that takes clicks.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, is_gpu: bool, commands: &mut Vec<Command>) -> bool {
    if !state.true_axes.is_editing || state.true_axes.locked.is_none() {
        return false;
    }
    let room = ui.available_rect_before_wrap();
    // All three fit under one another, and the large view stays the largest.
    let width = (room.height() / 3.0).min(0.34 * room.width()).max(96.0);
    let panel = Panel::right("locked views")
        .resizable(true)
        .default_size(width)
        .size_range(80.0..=(0.5 * room.width()).max(80.0))
        .frame(Frame::new());
    panel
        .show(ui, |ui| {
            let all = ui.available_rect_before_wrap();
            let height = (all.height() - 4.0) / 3.0;
            let mut is_hovered = false;
            for (i, view) in EditView::LOCKED.into_iter().enumerate() {
                let min = pos2(all.left(), all.top() + i as f32 * (height + 2.0));
                let rect = Rect::from_min_size(min, vec2(all.width(), height));
                is_hovered |= one(ui, rect, i, view, state, is_gpu, commands);
            }
            ui.advance_cursor_after_rect(all);
            is_hovered
        })
        .inner
}

fn one(
    ui: &Ui,
    rect: Rect,
    i: usize,
    view: EditView,
    state: &State,
    is_gpu: bool,
    commands: &mut Vec<Command>,
) -> bool {
    let annotating = &state.true_axes;
    let (Some(cameras), Some(scene)) = (&annotating.locked, &annotating.small_scene) else {
        return false;
    };
    let response = ui.interact(rect, ui.scope_id().with(view.title()), Sense::click_and_drag());
    response
        .widget_info(|| WidgetInfo::labeled(Role::Canvas, true, format!("Locked view: {}", view.title())));
    let viewport = Viewport::new(rect.width().into(), rect.height().into());
    let stage = Stage {
        view,
        rect,
        camera: &cameras[i],
        viewport,
    };
    let is_hovered = stage.interact(ui, &response, state, commands);
    if is_gpu {
        let scale = ui.ctx().pixels_per_point();
        // At least a pixel, at most some thousand.
        let size_px = [rect.width(), rect.height()].map(|s| (s * scale).round().max(1.0) as u32);
        ui.painter().add(eframe::egui_wgpu::Callback::new_paint_callback(
            rect,
            ViewCallback {
                view: response.id,
                scene: scene.clone(),
                lines: Vec::new(),
                camera: cameras[i],
                size_px,
                is_software: state.is_software,
                ctx: ui.ctx().clone(),
            },
        ));
    }
    let quiet = ui.visuals().text_color();
    if view != EditView::EndOn {
        upright(ui, rect, quiet);
    }
    stage.paint(ui, &response, state);
    let stroke = Stroke::new(1.0, ui.visuals().widgets.noninteractive.bg_stroke.color);
    ui.painter().rect_stroke(rect, 0.0, stroke, StrokeKind::Inside);
    let at = rect.min + vec2(7.0, 5.0);
    title(ui, at, view.title(), quiet);
    let plate = Rect::from_min_size(at, vec2(44.0, 16.0));
    ui.interact(plate, response.id.with("title"), Sense::hover())
        .on_hover_text(tip(view));
    is_hovered
}

fn tip(view: EditView) -> &'static str {
    match view {
        EditView::Main => "",
        EditView::Front => "The axis upright, from the depth camera's side",
        EditView::Side => "The axis upright, from a right angle to the front",
        EditView::EndOn => "Along the axis, from the peduncle; what is away from the camera is up",
    }
}

/// A thin line in the middle, by which an eye judges symmetry.
fn upright(ui: &Ui, rect: Rect, color: Color32) {
    let x = rect.center().x;
    let stroke = Stroke::new(1.0, color.gamma_multiply(0.25));
    ui.painter()
        .line_segment([pos2(x, rect.top()), pos2(x, rect.bottom())], stroke);
}

fn title(ui: &Ui, at: Pos2, text: &str, color: Color32) {
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), FontId::proportional(11.5), color);
    let plate = Rect::from_min_size(at, galley.size()).expand2(vec2(3.0, 1.0));
    ui.painter()
        .rect_filled(plate, 2.0, ui.visuals().panel_fill.gamma_multiply(0.8));
    ui.painter().galley(at, galley, color);
}
