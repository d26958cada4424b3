//! The simulator: sliders for the fruit, its pose and its scan, and the error that follows from them.

use egui::{Color32, Label, RichText, Slider as Bar, SliderClamping, Ui, WidgetInfo, vec2};
use egui_plot::{Line, MarkerShape, Plot, PlotPoints, Points};

use crate::app::{Command, SimulatorCommand, Slider, SliderGroup, State};
use crate::simulate::PepperSettings;
use crate::ui::widgets::controls::{Number, hint, section};

/// The width of the labels, in logical pixels.
const LABEL_WIDTH: f32 = 104.0;
/// The width of the numbers, in logical pixels.
const NUMBER_WIDTH: f32 = 64.0;
/// The height of the chart, in logical pixels.
const CHART_HEIGHT: f32 = 132.0;
const LINE: Color32 = Color32::from_rgb(0x2b, 0x8c, 0xd6);
const NOW: Color32 = Color32::from_rgb(0xe6, 0x9f, 0x00);

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let mut say = |command| commands.push(Command::Simulate(command));
    let Some(settings) = &state.simulator.settings else {
        hint(
            ui,
            "A simulated pepper before a depth camera: change its pose, its shape or the scan, and see what the method \
             makes of it.",
        );
        ui.add_space(4.0);
        if ui.button("Simulate a pepper").clicked() {
            say(SimulatorCommand::Open);
        }
        return;
    };
    ui.spacing_mut().item_spacing.y = 4.0;
    ui.horizontal(|ui| {
        let tip = "Draws another fruit in another pose; the scan stays as it is.";
        if ui.button("Another pepper").on_hover_text(tip).clicked() {
            say(SimulatorCommand::Another);
        }
        let tip = "Goes back to the first pepper and the camera's own noise.";
        if ui.button("Reset").on_hover_text(tip).clicked() {
            say(SimulatorCommand::Reset);
        }
        if !state.shows_simulated() && ui.button("Show it").clicked() {
            say(SimulatorCommand::Open);
        }
    });
    result(ui, state);
    chart(ui, state, settings);
    for group in SliderGroup::ALL {
        section(ui, group.title(), true, false, |ui| {
            for &slider in group.sliders() {
                if let Some(value) = row(ui, slider, settings, commands) {
                    commands.push(Command::Simulate(SimulatorCommand::Move(slider, value)));
                }
            }
        });
    }
}

/// Shows the error of the cloud in the view.
fn result(ui: &mut Ui, state: &State) {
    let text = if !state.shows_simulated() {
        "Another cloud is shown.".to_owned()
    } else if let Some(walked) = &state.walked {
        let points = walked.fruit.cloud().len();
        let seen = walked.fruit.truth.as_ref().and_then(|truth| truth.coverage);
        let seen = seen.map(|share| format!(", {:.0} % of the surface seen", 100.0 * share));
        let seen = seen.unwrap_or_default();
        match state.simulated_error_deg() {
            Some(error) => format!("{error:.1}° off the true axis, {points} points{seen}"),
            None => format!("No axis from {points} points{seen}"),
        }
    } else {
        "No cloud yet.".to_owned()
    };
    ui.label(RichText::new(text).strong());
}

/// Draws the errors over the slider that was moved last.
fn chart(ui: &mut Ui, state: &State, settings: &PepperSettings) {
    let trail = &state.simulator.trail;
    let Some(slider) = trail.slider() else {
        hint(ui, "Drag a slider: the error over its values appears here.");
        return;
    };
    let known = || {
        trail
            .points()
            .iter()
            .filter_map(|p| Some([p.value, p.error_deg?]))
    };
    let now = slider.value(settings);
    let unit = slider.suffix().trim();
    let name = if unit.is_empty() {
        slider.label().to_owned()
    } else {
        format!("{} ({unit})", slider.label())
    };
    let range = slider.range();
    let grid = ui.visuals().text_color().gamma_multiply(0.3);
    let plot = Plot::new(("error over a slider", slider))
        .x_axis_label(name.clone())
        .y_axis_label("Error (°)")
        .y_axis_min_width(40.0)
        .include_x(*range.start())
        .include_x(*range.end())
        .include_y(0.0)
        .include_y(20.0)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_drag(false)
        .allow_zoom(false)
        .grid_color(grid)
        .label_formatter(|_| None)
        .show_x(false)
        .show_y(false)
        .height(CHART_HEIGHT);
    let answer = plot.show(ui, |plot| {
        plot.line(
            Line::new("", known().collect::<PlotPoints<'_>>())
                .color(LINE)
                .width(1.5),
        );
        plot.points(
            Points::new("", known().collect::<PlotPoints<'_>>())
                .color(LINE)
                .radius(2.0),
        );
        let here = now.and_then(|now| known().find(|[value, _]| *value == now));
        if let Some([x, y]) = here {
            let mark = Points::new("", [x, y])
                .color(NOW)
                .shape(MarkerShape::Circle)
                .radius(5.0);
            plot.points(mark);
        }
    });
    let count = known().count();
    answer.response.widget_info(|| {
        let label = format!("Chart: error over {name}, {count} values");
        WidgetInfo::labeled(egui::Role::Image, true, label)
    });
}

/// Shows a slider with its number; returns the value that it was moved to.
fn row(ui: &mut Ui, slider: Slider, settings: &PepperSettings, commands: &mut Vec<Command>) -> Option<f64> {
    let before = slider.value(settings)?;
    let mut value = before;
    let (range, tip) = (slider.range(), slider.tip());
    ui.horizontal(|ui| {
        let size = vec2(LABEL_WIDTH, ui.spacing().interact_size.y);
        let layout = egui::Layout::left_to_right(egui::Align::Center);
        ui.allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_width(LABEL_WIDTH);
            ui.add(Label::new(slider.label()).truncate()).on_hover_text(tip);
        });
        let spacing = ui.spacing().item_spacing.x;
        ui.spacing_mut().slider_width = (ui.available_width() - NUMBER_WIDTH - spacing).max(40.0);
        let bar = Bar::new(&mut value, range.clone())
            .show_value(false)
            .clamping(SliderClamping::Never)
            .step_by(slider.step())
            .trailing_fill(true);
        let bar = ui.add(bar).on_hover_text(tip).accessible_name(slider.label());
        let number = Number::new(slider.label(), range)
            .suffix(slider.suffix())
            .steps(slider.step(), slider.decimals())
            .width(NUMBER_WIDTH)
            .show(ui, &mut value, tip);
        if bar.drag_stopped() || number.drag_stopped() || bar.lost_focus() || number.lost_focus() {
            commands.push(Command::EndGesture);
        }
    });
    (value != before).then_some(value)
}
