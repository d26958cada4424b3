//! The simulator: sliders for the fruit, its pose and its scan, and the error that follows from them.

use egui::{Color32, Id, Label, RichText, Slider as Bar, SliderClamping, Ui, UiBuilder, WidgetInfo, vec2};
use egui_plot::{GridMark, Line, PlotBounds, Points};

use crate::app::{Command, SimulatorCommand, Slider, SliderGroup, State};
use crate::simulate::PepperSettings;
use crate::ui::action::WindowAct;
use crate::ui::widgets::controls::{Number, hint, section, small};
use crate::ui::widgets::plot;

/// The width of the labels, in logical pixels.
const LABEL_WIDTH: f32 = 104.0;
/// The width of the numbers, in logical pixels.
const NUMBER_WIDTH: f32 = 64.0;
/// The height of the chart, in logical pixels.
const CHART_HEIGHT: f32 = 132.0;
/// The text in the chart before a slider was moved.
const NO_SLIDER: &str = "Drag a slider: the error over its values appears here.";
const LINE: Color32 = Color32::from_rgb(0x2b, 0x8c, 0xd6);
const NOW: Color32 = Color32::from_rgb(0xe6, 0x9f, 0x00);

/// Draws the panel; returns what the window is to ask for.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<WindowAct> {
    let mut asked = None;
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
        return None;
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
        let tip = "Saves the cloud as a PLY file, and its truth beside it.";
        if state.shows_simulated() {
            if ui.button("Save …").on_hover_text(tip).clicked() {
                asked = Some(WindowAct::SaveCloud);
            }
        } else if ui.button("Show it").clicked() {
            say(SimulatorCommand::Open);
        }
    });
    result(ui, state);
    chart(ui, state, settings);
    // Names of their own: those made of the widgets before them change with the chart, and a slider that changes its name
    // while it is dragged is let go.
    let sliders = UiBuilder::new().scope_id(Id::unique("sliders of the simulator"));
    ui.scope_builder(sliders, |ui| {
        for group in SliderGroup::ALL {
            section(ui, group.title(), true, false, |ui| {
                for &slider in group.sliders() {
                    if let Some(value) = row(ui, slider, settings, commands) {
                        commands.push(Command::Simulate(SimulatorCommand::Move(slider, value)));
                    }
                }
            });
        }
    });
    asked
}

/// Shows the error of the cloud in the view, in two lines whose height never changes.
fn result(ui: &mut Ui, state: &State) {
    let walked = state.walked.as_ref().filter(|_| state.shows_simulated());
    let error = match (walked, state.simulated_error_deg()) {
        (_, Some(error)) => format!("{error:.1}° off the true axis"),
        (Some(_), None) => "No axis".to_owned(),
        (None, None) => "Another cloud is shown".to_owned(),
    };
    let scan = walked.map(|walked| {
        let points = walked.fruit.cloud().len();
        let seen = walked.fruit.truth.as_ref().and_then(|truth| truth.coverage);
        let seen = seen.map(|share| format!(" · {:.0} % of the surface seen", 100.0 * share));
        format!("{points} points{}", seen.unwrap_or_default())
    });
    ui.add(Label::new(RichText::new(error).strong()).truncate());
    let scan = RichText::new(scan.unwrap_or_else(|| " ".into())).font(small(ui));
    ui.add(Label::new(scan).truncate());
}

/// Draws the errors over the slider that was moved last. The room is the same before one was moved, so that no slider
/// moves away under the cursor.
fn chart(ui: &mut Ui, state: &State, settings: &PepperSettings) {
    let trail = &state.simulator.trail;
    let known: Vec<[f64; 2]> = (trail.points().iter())
        .filter_map(|point| Some([point.value, point.error_deg?]))
        .collect();
    let slider = trail.slider();
    let name = slider.map_or(String::new(), name_with_unit);
    let range = slider.map_or(0.0..=1.0, Slider::range);
    let (left, right) = (*range.start(), *range.end());
    let highest = known.iter().map(|[_, error]| *error).fold(0.0, f64::max);
    let top = [10.0, 20.0, 40.0]
        .into_iter()
        .find(|top| highest <= *top)
        .unwrap_or(90.0);
    let has_slider = slider.is_some();
    let plot = plot::still(ui, ("error over a slider", slider))
        .x_axis_label(name.clone())
        .y_axis_label("Error (°)")
        .y_axis_min_width(40.0)
        .show_axes([has_slider; 2])
        .show_grid(has_slider)
        .x_grid_spacer(move |_| marks(left, right, 2))
        .y_grid_spacer(move |_| marks(0.0, top, 2))
        .height(CHART_HEIGHT);
    let answer = plot.show(ui, |plot| {
        let margin = [0.03 * (right - left), 0.06 * top];
        let corners = (
            [left - margin[0], -margin[1]],
            [right + margin[0], top + margin[1]],
        );
        plot.set_plot_bounds(PlotBounds::from_min_max(corners.0, corners.1));
        plot.line(Line::new("", known.clone()).color(LINE).width(1.5));
        plot.points(Points::new("", known.clone()).color(LINE).radius(2.0));
        let now = slider.and_then(|slider| slider.value(settings));
        if let Some(here) = known.iter().find(|[value, _]| Some(*value) == now) {
            plot.points(Points::new("", *here).color(NOW).radius(5.0));
        }
    });
    let response = answer.response;
    if !has_slider {
        let hint = NO_SLIDER;
        let font = small(ui);
        let galley = ui.painter().layout(
            hint.to_owned(),
            font,
            ui.visuals().text_color(),
            response.rect.width() - 24.0,
        );
        let place = response.rect.center() - 0.5 * galley.size();
        ui.painter().galley(place, galley, ui.visuals().text_color());
    }
    response.widget_info(|| {
        let label = if has_slider {
            format!("Chart: error over {name}, {} values", known.len())
        } else {
            NO_SLIDER.to_owned()
        };
        WidgetInfo::labeled(egui::Role::Image, true, label)
    });
}

fn name_with_unit(slider: Slider) -> String {
    match slider.suffix().trim() {
        "" => slider.label().to_owned(),
        unit => format!("{} ({unit})", slider.label()),
    }
}

/// Divides an axis into so many equal parts.
fn marks(from: f64, to: f64, parts: u32) -> Vec<GridMark> {
    let step_size = (to - from) / f64::from(parts);
    let mark = |i| GridMark {
        value: from + f64::from(i) * step_size,
        step_size,
    };
    (0..=parts).map(mark).collect()
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
