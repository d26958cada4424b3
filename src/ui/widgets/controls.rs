//! What the panels of settings and lists are made of: rows, sections, fields for numbers.

use std::ops::RangeInclusive;

use egui::collapsing_header::{CollapsingState, paint_default_icon};
use egui::{
    Align, Color32, DragValue, FontId, Label, Layout, Response, RichText, Sense, Slider, SliderClamping,
    TextStyle, Ui, WidgetInfo, accesskit::Role, vec2,
};

use crate::app::Command;
use crate::fruit::Request;

/// The width of the labels of one-line rows, in logical pixels.
const LABEL_WIDTH: f32 = 92.0;
/// The width of a field for one number.
const FIELD_WIDTH: f32 = 78.0;

/// An edit of the request under way: what the controls of one frame made of it.
pub(in crate::ui) struct Edit<'a> {
    /// What is wanted, as the controls change it.
    pub(in crate::ui) request: Request,
    before: &'a Request,
    gesture: Option<&'static str>,
    ends: bool,
}

impl<'a> Edit<'a> {
    pub(in crate::ui) fn of(before: &'a Request) -> Self {
        Self {
            request: before.clone(),
            before,
            gesture: None,
            ends: false,
        }
    }

    /// Notes what a control that is dragged or stepped did.
    pub(in crate::ui) fn note(&mut self, response: &Response, control: &'static str) {
        if response.changed() {
            self.gesture = Some(control);
        }
        self.ends |= response.drag_stopped() || response.lost_focus();
    }

    /// Says what came of it.
    pub(in crate::ui) fn say(self, commands: &mut Vec<Command>) {
        if self.request != *self.before {
            commands.push(Command::Set {
                request: Box::new(self.request),
                gesture: self.gesture,
            });
        }
        if self.ends {
            commands.push(Command::EndGesture);
        }
    }
}

/// The color of a warning that is read as text: enough contrast on dark and on light.
pub(in crate::ui) fn warning_color(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode {
        Color32::from_rgb(0xf0, 0xb0, 0x40)
    } else {
        Color32::from_rgb(0x9a, 0x4a, 0x00)
    }
}

/// The letters of explanations: smaller than the rest, and still read without effort.
pub(in crate::ui) fn small(ui: &Ui) -> FontId {
    let body = TextStyle::Body.resolve(ui.style());
    FontId::new((0.88 * body.size).max(11.0), body.family)
}

/// A field for text, whose hint has as much contrast as other text.
pub(in crate::ui) fn text_field(ui: &mut Ui, typed: &mut String, hint: &'static str, name: &str) -> Response {
    ui.scope(|ui| {
        ui.visuals_mut().weak_text_color = Some(ui.visuals().text_color());
        let field = egui::TextEdit::singleline(typed)
            .hint_text(hint)
            .desired_width(f32::INFINITY);
        ui.add(field).accessible_name(name)
    })
    .inner
}

/// A small explanation over the whole width.
pub(in crate::ui) fn hint(ui: &mut Ui, text: impl Into<String>) -> Response {
    let text = RichText::new(text).font(small(ui));
    ui.add(Label::new(text).wrap())
}

/// A small warning over the whole width.
pub(in crate::ui) fn caution(ui: &mut Ui, text: impl Into<String>) -> Response {
    let text = RichText::new(text).font(small(ui)).color(warning_color(ui));
    ui.add(Label::new(text).wrap())
}

/// A section that opens and closes; says whether its reset was clicked, which is offered where
/// something `differs` from its defaults.
pub(in crate::ui) fn section(
    ui: &mut Ui,
    title: &str,
    is_open: bool,
    differs: bool,
    body: impl FnOnce(&mut Ui),
) -> bool {
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
        let icon =
            egui::Rect::from_center_size(egui::pos2(rect.left() + 7.0, rect.center().y), vec2(10.0, 10.0));
        paint_default_icon(
            ui,
            state.openness(ui.ctx()),
            &response.clone().with_new_rect(icon),
        );
        ui.painter().text(
            egui::pos2(rect.left() + 18.0, rect.center().y),
            egui::Align2::LEFT_CENTER,
            title,
            TextStyle::Button.resolve(ui.style()),
            ui.visuals().strong_text_color(),
        );
    });
    state.show_body_unindented(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        egui::Frame::new()
            .inner_margin(egui::Margin {
                left: 8,
                right: 0,
                top: 2,
                bottom: 6,
            })
            .show(ui, body);
    });
    is_reset
}

/// A small link that puts `what` back; says whether it was clicked.
pub(in crate::ui) fn reset(ui: &mut Ui, what: &str) -> bool {
    let text = RichText::new("reset").font(small(ui));
    ui.link(text)
        .on_hover_text(format!("{what}: back to the default"))
        .accessible_name(format!("Reset {what}"))
        .clicked()
}

/// One line: what it is, and its control.
pub(in crate::ui) fn row<R>(ui: &mut Ui, label: &str, tip: &str, control: impl FnOnce(&mut Ui) -> R) -> R {
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

/// A number that is typed, stepped with the arrow keys, or dragged.
pub(in crate::ui) struct Number<'a> {
    /// What it is, with its unit where that is not written behind it.
    pub(in crate::ui) name: &'a str,
    /// Its unit, written behind it.
    pub(in crate::ui) suffix: &'a str,
    /// What it may be.
    pub(in crate::ui) range: RangeInclusive<f64>,
    /// The change a logical pixel dragged, or a key pressed.
    pub(in crate::ui) speed: f64,
    /// The most decimals.
    pub(in crate::ui) decimals: usize,
    /// The width of its field.
    pub(in crate::ui) width: f32,
}

impl Number<'_> {
    pub(in crate::ui) const WIDTH: f32 = FIELD_WIDTH;

    pub(in crate::ui) fn show(&self, ui: &mut Ui, value: &mut f64, tip: &str) -> Response {
        let mut typed = *value;
        let size = vec2(self.width, ui.spacing().interact_size.y);
        let field = DragValue::new(&mut typed)
            .range(self.range.clone())
            .clamp_existing_to_range(false)
            .update_while_editing(false)
            .speed(self.speed)
            .max_decimals(self.decimals)
            .suffix(self.suffix)
            .min_size(size);
        let response = ui.add(field).on_hover_text(tip).accessible_name(self.name);
        // A field that was only visited gives back what it shows, which is rounded.
        let resolution = 0.5 * 0.1_f64.powi(i32::try_from(self.decimals).unwrap_or(0));
        if response.changed() && (response.dragged() || (typed - *value).abs() > resolution) {
            // Arrow keys and assistive technology know no range.
            *value = typed.clamp(*self.range.start(), *self.range.end());
        }
        response
    }
}

/// As [`Number`], for counts.
pub(in crate::ui) fn count(
    ui: &mut Ui,
    name: &str,
    value: &mut usize,
    range: RangeInclusive<usize>,
    tip: &str,
) -> Response {
    let size = vec2(FIELD_WIDTH, ui.spacing().interact_size.y);
    // An arrow key changes it by one at least, a large one by half a percent.
    let speed = (*value as f64 / 200.0).round().max(1.0);
    let field = DragValue::new(value)
        .range(range.clone())
        .clamp_existing_to_range(false)
        .update_while_editing(false)
        .speed(speed)
        .min_size(size);
    let response = ui.add(field).on_hover_text(tip).accessible_name(name);
    if response.changed() {
        // Arrow keys and assistive technology know no range.
        *value = (*value).clamp(*range.start(), *range.end());
    }
    response
}

/// A label, a field, and a slider under them over the whole width. The slider spans what is usual,
/// the field everything that is allowed. Says whether its reset was clicked.
pub(in crate::ui) struct Slid<'a> {
    pub(in crate::ui) label: &'a str,
    pub(in crate::ui) tip: &'a str,
    pub(in crate::ui) number: Number<'a>,
    /// What the slider spans.
    pub(in crate::ui) usual: RangeInclusive<f64>,
    /// The slider's steps; 0 for none.
    pub(in crate::ui) step: f64,
    /// Whether the slider gives more room to what is small.
    pub(in crate::ui) logarithmic: bool,
    /// Whether the value can be put back.
    pub(in crate::ui) differs: bool,
}

impl Slid<'_> {
    pub(in crate::ui) fn show(&self, ui: &mut Ui, value: &mut f64) -> (Response, bool) {
        let mut is_reset = false;
        let field = ui
            .horizontal(|ui| {
                ui.add(Label::new(self.label)).on_hover_text(self.tip);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let field = self.number.show(ui, value, self.tip);
                    if self.differs {
                        is_reset = reset(ui, self.number.name);
                    }
                    field
                })
                .inner
            })
            .inner;
        ui.spacing_mut().slider_width = ui.available_width();
        let slider = Slider::new(value, self.usual.clone())
            .show_value(false)
            .clamping(SliderClamping::Never)
            .logarithmic(self.logarithmic)
            .step_by(self.step)
            .trailing_fill(true);
        let slider = ui
            .add(slider)
            .on_hover_text(self.tip)
            .accessible_name(self.number.name);
        (slider | field, is_reset)
    }
}

/// One of a few choices.
pub(in crate::ui) struct Choice<'a, T> {
    pub(in crate::ui) value: T,
    pub(in crate::ui) text: String,
    pub(in crate::ui) tip: &'a str,
    /// Why it cannot be chosen.
    pub(in crate::ui) hindered: Option<&'a str>,
}

impl<'a, T> Choice<'a, T> {
    pub(in crate::ui) fn new(value: T, text: impl Into<String>, tip: &'a str) -> Self {
        Self {
            value,
            text: text.into(),
            tip,
            hindered: None,
        }
    }

    pub(in crate::ui) fn unless(mut self, hindered: Option<&'a str>) -> Self {
        self.hindered = hindered;
        self
    }
}

/// A drop-down list; gives what was chosen.
pub(in crate::ui) fn choose<T: PartialEq>(
    ui: &mut Ui,
    name: &str,
    chosen: &T,
    tip: &str,
    choices: Vec<Choice<'_, T>>,
) -> Option<T> {
    let text = choices
        .iter()
        .find(|choice| choice.value == *chosen)
        .map(|choice| choice.text.clone())
        .unwrap_or_default();
    let mut picked = None;
    let shown = egui::ComboBox::from_id_salt(name)
        .selected_text(text)
        .width(ui.available_width())
        .truncate()
        .show_ui(ui, |ui| {
            for choice in choices {
                let is_chosen = choice.value == *chosen;
                let button = egui::Button::selectable(is_chosen, choice.text);
                let response = ui
                    .add_enabled(choice.hindered.is_none(), button)
                    .on_hover_text(choice.tip);
                let response = match choice.hindered {
                    Some(why) => response.on_disabled_hover_text(why),
                    None => response,
                };
                if response.clicked() && !is_chosen {
                    picked = Some(choice.value);
                }
            }
        });
    shown.response.on_hover_text(tip).accessible_name(name);
    picked
}
