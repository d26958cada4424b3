//! Charts of the errors of the clouds that the table shows. A click on a bar or a point opens its cloud.

mod data;
mod guides;

use egui::{Align2, Color32, Id, Key, Response, RichText, Role, Stroke, Ui, WidgetInfo, vec2};
use egui_plot::{Bar, BarChart, Line, LineStyle, MarkerShape, Plot, PlotPoint, PlotPoints, PlotUi, Points};

use super::{PanelRequest, bar};
use crate::app::{Command, State};
use crate::ui::widgets::controls::{hint, small, warning_color};
use data::{DISTANCE_BIN_CM, Data, FIG_8_DEG, FIG_12_DEG, FIG_13_DEG, Mark};
use guides::Guides;

/// The charts of the panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Chart {
    #[default]
    Clouds,
    Histogram,
    Distance,
    Lead,
    Lean,
    Coverage,
}

impl Chart {
    const ALL: [Self; 6] = [
        Self::Clouds,
        Self::Histogram,
        Self::Distance,
        Self::Lead,
        Self::Lean,
        Self::Coverage,
    ];

    fn title(self) -> &'static str {
        match self {
            Self::Clouds => "Each cloud",
            Self::Histogram => "Histogram",
            Self::Distance => "By distance",
            Self::Lead => "By lead",
            Self::Lean => "By lean",
            Self::Coverage => "By coverage",
        }
    }

    fn explained(self) -> &'static str {
        match self {
            Self::Clouds => {
                "The error of each cloud, in the order of the table, as in Fig. 12 and 13 of the paper"
            }
            Self::Histogram => "How often an error occurs",
            Self::Distance => {
                "The error against the distance of the fruit from the camera, as in Fig. 8 of the paper"
            }
            Self::Lead => {
                "The error against the winner's lead over the runner-up: is an ambiguous fruit a missed one?"
            }
            Self::Lean => {
                "The error against the lean of the reference axis out of the plane across the line of sight, below which no error can \
                 be (Eq. 16)"
            }
            Self::Coverage => {
                "The error against the share of the surface that the camera saw, which the truth of a simulated cloud tells"
            }
        }
    }

    fn axes(self) -> (&'static str, &'static str) {
        match self {
            Self::Clouds => ("Clouds, in the order of the table", "Error of the axis (°)"),
            Self::Histogram => ("Error of the axis (°)", "Clouds"),
            Self::Distance => ("Distance of the fruit center (cm)", "Error of the axis (°)"),
            Self::Lead => (
                "Lead of the best plane over the runner-up (% of its score)",
                "Error of the axis (°)",
            ),
            Self::Lean => ("Lean of the reference axis (°)", "Error of the axis (°)"),
            Self::Coverage => ("Surface seen (%)", "Error of the axis (°)"),
        }
    }
}

impl Chart {
    /// The clouds that it shows.
    fn marks(self, data: &Data) -> &[Mark] {
        match self {
            Self::Clouds => &data.bars,
            Self::Histogram => &data.histogram,
            Self::Distance => &data.by_distance,
            Self::Lead => &data.by_lead,
            Self::Lean => &data.by_lean,
            Self::Coverage => &data.by_coverage,
        }
    }

    /// The reason why it shows no cloud, if none has its value.
    fn missing(self) -> &'static str {
        match self {
            Self::Lean => "None of these clouds has a reference axis whose lean is known.",
            Self::Coverage => {
                "None of these clouds says how much of its surface was seen; the truths of simulated clouds do."
            }
            _ => "None of these clouds has this value.",
        }
    }
}

const BAR: Color32 = Color32::from_rgb(0x2b, 0x8c, 0xd6);
const CURRENT: Color32 = Color32::from_rgb(0xe6, 0x9f, 0x00);

/// Draws the panel.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    let asked = bar::show(ui, state, commands);
    if asked.is_some() {
        return asked;
    }
    let id = Id::unique("chart of clouds");
    let mut chart: Chart = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    ui.horizontal_wrapped(|ui| {
        for choice in Chart::ALL {
            ui.selectable_value(&mut chart, choice, choice.title())
                .on_hover_text(choice.explained());
        }
        if !state.many.filter.is_empty() {
            let (shown, all) = (state.many.order.len(), state.many.rows.len());
            ui.label(
                RichText::new(format!("{shown} of {all} clouds, as the table is filtered")).font(small(ui)),
            );
        }
    });
    ui.data_mut(|data| data.insert_temp(id, chart));
    let data = Data::of(ui, state);
    let mut chosen = None;
    if !data.failures.is_empty() {
        chosen = failures(ui, state, &data);
    }
    if data.bars.is_empty() {
        bar::nothing_yet(ui, state);
    } else if chart.marks(&data).is_empty() {
        hint(ui, chart.missing());
    } else {
        chosen = plot(ui, state, chart, &data).or(chosen);
    }
    let place = chosen?;
    commands.push(Command::Show(place));
    Some(PanelRequest::ShowView)
}

/// Lists the clouds without an error, each as a link.
fn failures(ui: &mut Ui, state: &State, data: &Data) -> Option<usize> {
    const NAMED: usize = 4;
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        let count = data.failures.len();
        let text = match count {
            1 => "1 cloud without an error:".to_owned(),
            _ => format!("{count} clouds without an error:"),
        };
        ui.label(RichText::new(text).font(small(ui)).color(warning_color(ui)));
        for mark in data.failures.iter().take(NAMED) {
            let row = &state.many.rows[mark.place];
            let why = row
                .failure(state.many.against)
                .unwrap_or("there is no axis to compare with");
            let link = ui.link(RichText::new(&row.name).font(small(ui)));
            if link.on_hover_text(crate::text::sentence(why)).clicked() {
                chosen = Some(mark.place);
            }
        }
        if count > NAMED {
            ui.label(RichText::new(format!("and {} more", count - NAMED)).font(small(ui)));
        }
    });
    chosen
}

/// Draws one chart; returns the cloud that was clicked.
fn plot(ui: &mut Ui, state: &State, chart: Chart, data: &Data) -> Option<usize> {
    let (x, y) = chart.axes();
    // For another chart or another set of clouds, the zoomed part is meaningless.
    let salt = (chart.title(), state.entries.len());
    let plot = Plot::new(salt)
        .x_axis_label(x)
        .y_axis_label(y)
        // Without this width, the axis' name covers the numbers in the first frame.
        .y_axis_min_width(46.0)
        .include_y(0.0)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .set_margin_fraction(vec2(0.02, 0.05))
        .show_grid([!matches!(chart, Chart::Clouds | Chart::Histogram), true])
        .grid_color(ui.visuals().text_color().gamma_multiply(0.3))
        .label_formatter(|_| None)
        .show_x(false)
        .show_y(false)
        .height((ui.available_height() - 2.0).max(120.0));
    let (text_color, ground) = (ui.visuals().text_color(), ui.visuals().extreme_bg_color);
    let current = state.current;
    let answer = plot.show(ui, |plot| {
        let mut guides = Guides {
            plot,
            color: text_color,
            texts: Vec::new(),
        };
        match chart {
            Chart::Clouds => clouds(&mut guides, data, current, state),
            Chart::Histogram => histogram(guides.plot, data, current, ground),
            Chart::Distance => distance(&mut guides, data, current),
            Chart::Lead => by_value(&mut guides, &data.by_lead, data.mean_deg, current),
            Chart::Lean => lean(&mut guides, data, current),
            Chart::Coverage => by_value(&mut guides, &data.by_coverage, data.mean_deg, current),
        }
        guides.texts
    });
    for text in &answer.inner {
        text.paint(ui, &answer.transform);
    }
    let response = answer.response;
    response.widget_info(|| {
        let mean = data
            .mean_deg
            .map(|m| format!(", {m:.1}° in the mean"))
            .unwrap_or_default();
        let count = chart.marks(data).len();
        let label = format!("Chart: {}, {count} clouds{mean}", chart.title());
        WidgetInfo::labeled(Role::Image, true, label)
    });
    let pointed = response.hover_pos().and_then(|at| {
        let value = answer.transform.value_from_position(at);
        match chart {
            Chart::Clouds => slot_at(data, value),
            Chart::Histogram => unit_at(data, value),
            _ => nearest(chart.marks(data), &answer.transform, at),
        }
    });
    let mark = pointed?;
    explain(&response, state, mark);
    let by_key = response.has_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    (response.clicked() || by_key).then_some(mark)
}

/// Shows a tooltip about the cloud under the cursor.
fn explain(response: &Response, state: &State, place: usize) {
    let row = &state.many.rows[place];
    let off = match (row.error_deg(state.many.against), row.failure(state.many.against)) {
        (Some(error), _) => format!(": {error:.1}° off"),
        (None, Some(why)) => format!(": {why}"),
        (None, None) => String::new(),
    };
    let facts = [
        row.lead_percent().map(|lead| format!("lead {lead:.1} %")),
        row.distance_cm().map(|distance| format!("{distance:.0} cm away")),
        row.lean_deg(state.many.against)
            .map(|lean| format!("leaning {lean:.0}°")),
        row.coverage_percent().map(|seen| format!("{seen:.0} % seen")),
    ];
    let stale = if row.is_stale {
        "Of other parameters than those in force."
    } else {
        ""
    };
    let lines = [
        row.name.clone() + &off,
        facts.into_iter().flatten().collect::<Vec<_>>().join(", "),
        row.tagged.tags.join(", "),
        stale.to_owned(),
        "A click opens it.".to_owned(),
    ];
    let lines: Vec<String> = lines.into_iter().filter(|line| !line.is_empty()).collect();
    response.clone().on_hover_text_at_pointer(lines.join("\n"));
}

fn slot_at(data: &Data, value: PlotPoint) -> Option<usize> {
    let is_there = |mark: &&Mark| (mark.x - value.x).abs() <= 0.5;
    let mark = data
        .bars
        .iter()
        .find(is_there)
        .or_else(|| data.failures.iter().find(is_there))?;
    Some(mark.place)
}

fn unit_at(data: &Data, value: PlotPoint) -> Option<usize> {
    let is_there = |mark: &&Mark| {
        (mark.x - value.x).abs() <= 0.5 * data.bin_deg && (mark.y..mark.y + 1.0).contains(&value.y)
    };
    Some(data.histogram.iter().find(is_there)?.place)
}

fn nearest(marks: &[Mark], transform: &egui_plot::PlotTransform, at: egui::Pos2) -> Option<usize> {
    const REACH: f32 = 12.0;
    let distance = |mark: &Mark| {
        transform
            .position_from_point(&PlotPoint::new(mark.x, mark.y))
            .distance(at)
    };
    let of = marks.iter().map(|mark| (distance(mark), mark.place));
    let near = of.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (near.0 <= REACH).then_some(near.1)
}

fn clouds(guides: &mut Guides<'_, '_>, data: &Data, current: Option<usize>, state: &State) {
    // Many bars leave no room for gaps.
    let width = if data.bars.len() > 120 { 1.0 } else { 0.8 };
    let bar = |mark: &Mark| {
        let color = if current == Some(mark.place) {
            CURRENT
        } else if state.many.rows[mark.place].is_stale {
            BAR.gamma_multiply(0.45)
        } else {
            BAR
        };
        Bar::new(mark.x, mark.y).width(width).fill(color)
    };
    let bars = data.bars.iter().map(bar).collect();
    guides
        .plot
        .bar_chart(BarChart::new("errors", bars).allow_hover(false));
    crosses(guides.plot, data);
    guides.at(
        FIG_12_DEG,
        "7.4° in Fig. 12, without peduncles",
        Align2::LEFT_BOTTOM,
    );
    guides.at(FIG_13_DEG, "6.9° in Fig. 13, with peduncles", Align2::LEFT_TOP);
    if let Some(mean) = data.mean_deg {
        guides.mean(mean);
    }
}

/// Marks clouds without an error at the bottom of the chart.
fn crosses(plot: &mut PlotUi<'_>, data: &Data) {
    let marks: Vec<[f64; 2]> = data.failures.iter().map(|mark| [mark.x, 0.0]).collect();
    let color = if plot.ctx().global_style().visuals.dark_mode {
        Color32::from_rgb(0xf0, 0xb0, 0x40)
    } else {
        Color32::from_rgb(0x9a, 0x4a, 0x00)
    };
    let points = Points::new("without an error", PlotPoints::from(marks))
        .shape(MarkerShape::Cross)
        .radius(5.0)
        .color(color);
    plot.points(points.allow_hover(false));
}

fn histogram(plot: &mut PlotUi<'_>, data: &Data, current: Option<usize>, ground: Color32) {
    let unit = |mark: &Mark| {
        let color = if current == Some(mark.place) { CURRENT } else { BAR };
        Bar::new(mark.x, 1.0)
            .base_offset(mark.y)
            .width(data.bin_deg)
            .fill(color)
            .stroke(Stroke::new(1.0, ground))
    };
    let bars = data.histogram.iter().map(unit).collect();
    plot.bar_chart(BarChart::new("histogram", bars).allow_hover(false));
}

fn scatter(plot: &mut PlotUi<'_>, marks: &[Mark], current: Option<usize>) {
    let (now, others): (Vec<&Mark>, Vec<&Mark>) = marks.iter().partition(|mark| current == Some(mark.place));
    for (name, marks, color, radius) in [
        ("clouds", others, BAR, 3.5),
        ("the current cloud", now, CURRENT, 5.0),
    ] {
        let points: Vec<[f64; 2]> = marks.iter().map(|mark| [mark.x, mark.y]).collect();
        let points = Points::new(name, PlotPoints::from(points))
            .radius(radius)
            .color(color);
        plot.points(points.allow_hover(false));
    }
}

fn distance(guides: &mut Guides<'_, '_>, data: &Data, current: Option<usize>) {
    scatter(guides.plot, &data.by_distance, current);
    if data.distance_means.len() > 1 {
        let line = Line::new("means", PlotPoints::from(data.distance_means.clone()));
        guides
            .plot
            .line(line.color(CURRENT).width(2.0).allow_hover(false));
        let last = data.distance_means[data.distance_means.len() - 1];
        let text = format!("mean of each {DISTANCE_BIN_CM:.0} cm");
        guides.write(last[1], &text, Align2::RIGHT_BOTTOM);
    }
    guides.at(FIG_8_DEG, "6.5° in Fig. 8, simulated", Align2::LEFT_TOP);
}

/// Draws the clouds over a value, and the mean of all errors.
fn by_value(guides: &mut Guides<'_, '_>, marks: &[Mark], mean_deg: Option<f64>, current: Option<usize>) {
    scatter(guides.plot, marks, current);
    if let Some(mean) = mean_deg {
        guides.mean(mean);
    }
}

/// Draws the clouds over the lean, and the line below which Eq. 16 allows no error.
fn lean(guides: &mut Guides<'_, '_>, data: &Data, current: Option<usize>) {
    let farthest = data.by_lean.iter().map(|mark| mark.x).fold(0.0, f64::max);
    let line = Line::new(
        "least error",
        PlotPoints::from(vec![[0.0, 0.0], [farthest, farthest]]),
    );
    let line = line
        .color(guides.color.gamma_multiply(0.75))
        .style(LineStyle::dashed_dense());
    guides.plot.line(line.width(1.5).allow_hover(false));
    by_value(guides, &data.by_lean, data.mean_deg, current);
}
