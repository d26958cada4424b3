//! Sections that open and close, and the labeled rows in them.

use egui::collapsing_header::{CollapsingState, paint_default_icon};
use egui::{
    Align, Align2, Frame, Label, Layout, Margin, Rect, RichText, Sense, TextStyle, Ui, WidgetInfo,
    accesskit::Role, pos2, vec2,
};

use super::text::small;

/// The width of the labels of rows, in logical pixels.
const LABEL_WIDTH: f32 = 92.0;

/// Shows a section that opens and closes; returns whether its reset was clicked, which is offered if
/// something `differs` from its defaults.
pub fn section(ui: &mut Ui, title: &str, is_open: bool, differs: bool, body: impl FnOnce(&mut Ui)) -> bool {
    let id = ui.make_persistent_id(("section", title));
    let mut state = CollapsingState::load_with_default_open(ui.ctx(), id, is_open);
    ui.add_space(2.0);
    let mut is_reset = false;
    let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
        if differs {
            is_reset = reset(ui, title);
        }
        let size = vec2(ui.available_width(), row.y);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        if response.clicked() {
            state.toggle(ui);
        }
        response.widget_info(|| WidgetInfo::labeled(Role::DisclosureTriangle, ui.is_enabled(), title));
        let is_expanded = state.is_open();
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_expanded(is_expanded);
        });
        let visuals = ui.style().interact(&response);
        if response.hovered() || response.has_focus() {
            ui.painter().rect_filled(rect, 3.0, visuals.weak_bg_fill);
        }
        let icon = Rect::from_center_size(pos2(rect.left() + 7.0, rect.center().y), vec2(10.0, 10.0));
        paint_default_icon(
            ui,
            state.openness(ui.ctx()),
            &response.clone().with_new_rect(icon),
        );
        ui.painter().text(
            pos2(rect.left() + 18.0, rect.center().y),
            Align2::LEFT_CENTER,
            title,
            TextStyle::Button.resolve(ui.style()),
            ui.visuals().strong_text_color(),
        );
    });
    state.show_body_unindented(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        Frame::new()
            .inner_margin(Margin {
                left: 8,
                right: 0,
                top: 2,
                bottom: 6,
            })
            .show(ui, body);
    });
    is_reset
}

/// Shows a small link that resets `what`; returns whether it was clicked.
pub fn reset(ui: &mut Ui, what: &str) -> bool {
    let text = RichText::new("reset").font(small(ui));
    ui.link(text)
        .on_hover_text(format!("{what}: back to the default"))
        .accessible_name(format!("Reset {what}"))
        .clicked()
}

/// Shows a labeled control in one line.
pub fn row<R>(ui: &mut Ui, label: &str, tip: &str, control: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| {
        let size = vec2(LABEL_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(LABEL_WIDTH);
            ui.add(Label::new(label).truncate()).on_hover_text(tip);
        });
        control(ui)
    })
    .inner
}
