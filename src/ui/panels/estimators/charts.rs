//! The body's profile beside the points, and its outline over the seen contour.

use egui::{Color32, Role, Ui, WidgetInfo};
use egui_plot::{Line, Plot, PlotPoints, Points};

use crate::app::estimators::{FittedBody, OutlineSector};
use crate::ui::widgets::controls::hint;
use crate::ui::widgets::marks::color32;
use crate::ui::widgets::plot;
use crate::view::BODY_AXIS_COLOR;

/// The height of a chart, in logical pixels.
const HEIGHT: f32 = 180.0;
const CONTOUR: Color32 = Color32::from_rgb(0x2b, 0x8c, 0xd6);
const HIDDEN: Color32 = Color32::from_rgb(0xe6, 0x9f, 0x00);

/// A chart whose axes have the same scale, in centimeters.
fn plot(ui: &Ui, name: &'static str) -> Plot<'static> {
    plot::still(ui, name).data_aspect(1.0).height(HEIGHT)
}

/// Shows ρ, the distance from the axis, against t, the place along it.
pub(super) fn profile(ui: &mut Ui, fitted: &FittedBody) {
    let points = ui.visuals().text_color().gamma_multiply(0.6);
    let response = plot(ui, "profile of the body")
        .x_axis_label("ρ (cm)")
        .y_axis_label("t (cm)")
        .show(ui, |plot| {
            let dots = PlotPoints::from(fitted.profile_points.clone());
            plot.points(Points::new("points", dots).color(points).radius(1.2));
            let line = PlotPoints::from(fitted.profile.clone());
            plot.line(Line::new("body", line).color(color32(BODY_AXIS_COLOR)).width(2.0));
        })
        .response;
    let count = fitted.profile_points.len();
    response.widget_info(|| {
        let label = format!("Chart: profile of the body and {count} points, ρ against t");
        WidgetInfo::labeled(Role::Image, true, label)
    });
    hint(
        ui,
        "The body's profile about its axis (red), and the points by their distance from the axis.",
    );
}

/// Shows the seen edge in each sector of the image, by whether it is contour, and the body's outline over it.
pub(super) fn outline(ui: &mut Ui, fitted: &FittedBody) {
    let sectors = &fitted.outline;
    if sectors.is_empty() {
        hint(
            ui,
            "There is no outline: it needs the view of one camera from outside.",
        );
        return;
    }
    let place = |sector: &OutlineSector, reach_cm: f64| {
        let (sin, cos) = sector.angle_rad.sin_cos();
        // The image's y points down, and the chart's up.
        [reach_cm * cos, -reach_cm * sin]
    };
    let seen = |is_contour: bool| -> Vec<[f64; 2]> {
        let chosen = sectors.iter().filter(|sector| sector.is_contour == is_contour);
        chosen.map(|sector| place(sector, sector.seen_cm)).collect()
    };
    let mut body: Vec<[f64; 2]> = sectors
        .iter()
        .filter_map(|sector| Some(place(sector, sector.body_cm?)))
        .collect();
    body.extend(body.first().copied());
    let (contour, hidden) = (seen(true), seen(false));
    let counts = (contour.len(), hidden.len());
    let response = plot(ui, "outline of the body")
        .x_axis_label("right (cm)")
        .y_axis_label("up (cm)")
        .show(ui, |plot| {
            plot.line(
                Line::new("body", PlotPoints::from(body))
                    .color(color32(BODY_AXIS_COLOR))
                    .width(2.0),
            );
            for (name, points, color) in [("contour", contour, CONTOUR), ("hidden", hidden, HIDDEN)] {
                plot.points(
                    Points::new(name, PlotPoints::from(points))
                        .color(color)
                        .radius(3.0),
                );
            }
        })
        .response;
    let (contour, hidden) = counts;
    response.widget_info(|| {
        let label = format!("Chart: outline, {contour} sectors of contour, {hidden} hidden");
        WidgetInfo::labeled(Role::Image, true, label)
    });
    hint(
        ui,
        format!(
            "The body's outline (red) over the seen edge: {contour} sectors are the fruit's own contour (blue), in {hidden} \
             something hides it (orange)."
        ),
    );
}
