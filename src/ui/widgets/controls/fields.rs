//! Fields for numbers, sliders, and drop-down lists.

use std::ops::RangeInclusive;

use egui::{Align, Button, ComboBox, DragValue, Label, Layout, Response, Slider, SliderClamping, Ui, vec2};

use super::section::{reset, row};

/// The width of a field for one number, in logical pixels.
const FIELD_WIDTH: f32 = 78.0;

/// A number that is typed, stepped with the arrow keys, or dragged.
pub struct Number<'a> {
    name: &'a str,
    suffix: &'a str,
    range: RangeInclusive<f64>,
    speed: f64,
    decimals: usize,
    width: f32,
}

impl<'a> Number<'a> {
    /// The usual width of a field, in logical pixels.
    pub const WIDTH: f32 = FIELD_WIDTH;

    /// A number with its name, which has the unit if none stands behind the number, and its valid range.
    pub fn new(name: &'a str, range: RangeInclusive<f64>) -> Self {
        Self {
            name,
            suffix: "",
            range,
            speed: 1.0,
            decimals: 0,
            width: FIELD_WIDTH,
        }
    }

    /// Sets the unit behind the number.
    pub fn suffix(self, suffix: &'a str) -> Self {
        Self { suffix, ..self }
    }

    /// Sets the change by a logical pixel dragged, or a key pressed, and the most decimals shown.
    pub fn steps(self, speed: f64, decimals: usize) -> Self {
        Self {
            speed,
            decimals,
            ..self
        }
    }

    /// Sets the width of the field, in logical pixels.
    pub fn width(self, width: f32) -> Self {
        Self { width, ..self }
    }

    /// Shows the field.
    pub fn show(&self, ui: &mut Ui, value: &mut f64, tip: &str) -> Response {
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
        if is_edit(&response, *value, typed, self.decimals) {
            // Arrow keys and assistive technology know no range.
            *value = typed.clamp(*self.range.start(), *self.range.end());
        }
        response
    }

    /// Shows the field behind a label.
    pub fn row(&self, ui: &mut Ui, label: &str, value: &mut f64, tip: &str) -> Response {
        row(ui, label, tip, |ui| self.show(ui, value, tip))
    }
}

/// Whether a field's number was edited. A field that only had the focus gives back the number that it shows, which is
/// rounded to its decimals.
pub fn is_edit(response: &Response, before: f64, typed: f64, decimals: usize) -> bool {
    let resolution = 0.5 * 0.1_f64.powi(i32::try_from(decimals).unwrap_or(0));
    response.changed() && (response.dragged() || (typed - before).abs() > resolution)
}

/// Shows a field for a count.
pub fn count(
    ui: &mut Ui,
    name: &str,
    value: &mut usize,
    range: RangeInclusive<usize>,
    tip: &str,
) -> Response {
    // An arrow key changes it by one at least, a large one by half a percent.
    let speed = (*value as f64 / 200.0).round().max(1.0);
    let field = DragValue::new(value)
        .range(range.clone())
        .clamp_existing_to_range(false)
        .update_while_editing(false)
        .speed(speed)
        .min_size(vec2(FIELD_WIDTH, ui.spacing().interact_size.y));
    let response = ui.add(field).on_hover_text(tip).on_disabled_hover_text(tip);
    if response.changed() {
        // Arrow keys and assistive technology know no range.
        *value = (*value).clamp(*range.start(), *range.end());
    }
    response.accessible_name(name)
}

/// A label, a field, and a slider under them over the whole width. The slider spans the usual values,
/// the field all valid ones.
pub struct SliderRow<'a> {
    /// The label.
    pub label: &'a str,
    /// The explanation.
    pub tip: &'a str,
    /// The field.
    pub number: Number<'a>,
    /// The range of the slider.
    pub usual: RangeInclusive<f64>,
    /// The step of the slider; 0 for none.
    pub step: f64,
}

impl SliderRow<'_> {
    /// Shows it, with a reset if `can_reset`; returns whether the reset was clicked as well.
    pub fn show(&self, ui: &mut Ui, value: &mut f64, can_reset: bool) -> (Response, bool) {
        let mut is_reset = false;
        let field = ui
            .horizontal(|ui| {
                ui.add(Label::new(self.label)).on_hover_text(self.tip);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let field = self.number.show(ui, value, self.tip);
                    if can_reset {
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
            // A range that begins above 0 gives small values more space.
            .logarithmic(*self.usual.start() > 0.0)
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
pub struct Choice<'a, T> {
    value: T,
    text: String,
    tip: &'a str,
    hindrance: Option<&'a str>,
}

impl<'a, T> Choice<'a, T> {
    /// A choice with its text and its explanation.
    pub fn new(value: T, text: impl Into<String>, tip: &'a str) -> Self {
        Self {
            value,
            text: text.into(),
            tip,
            hindrance: None,
        }
    }

    /// The same choice, disabled if there is a reason why it cannot be made.
    pub fn unless(mut self, hindrance: Option<&'a str>) -> Self {
        self.hindrance = hindrance;
        self
    }
}

/// Shows a drop-down list behind a label; returns the new choice.
pub fn choice_row<T: PartialEq>(
    ui: &mut Ui,
    label: &str,
    name: &str,
    chosen: &T,
    tip: &str,
    choices: Vec<Choice<'_, T>>,
) -> Option<T> {
    row(ui, label, tip, |ui| choose(ui, name, chosen, tip, choices))
}

/// Shows a drop-down list; returns the new choice.
fn choose<T: PartialEq>(
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
    let shown = ComboBox::from_id_salt(name)
        .selected_text(text)
        .width(ui.available_width())
        .truncate()
        .show_ui(ui, |ui| {
            for choice in choices {
                let is_chosen = choice.value == *chosen;
                let button = Button::selectable(is_chosen, choice.text);
                let response = ui
                    .add_enabled(choice.hindrance.is_none(), button)
                    .on_hover_text(choice.tip);
                let response = match choice.hindrance {
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
