//! Series over a numeric axis, each with a band for its spread: the error per distance of Fig. 8.

use super::{
    FigureError, Guide, Labels,
    canvas::Canvas,
    finite,
    frame::{Frame, Plot, Under, draw_stack},
    legend::{Entry, Sign, draw_head},
    scale::{Scale, Zero},
    style,
};

/// One position of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePoint {
    /// The position along the x axis.
    pub x: f64,
    /// The value there; a missing one breaks the line.
    pub y: Option<f64>,
    /// Half the height of the band, a standard deviation say.
    pub spread: Option<f64>,
}

/// A named series. Its points are drawn in the order given.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its positions, in rising x.
    pub points: Vec<LinePoint>,
}

/// Series that share a y axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LinePanel {
    /// The series.
    pub series: Vec<LineSeries>,
    /// Values to compare them with.
    pub guides: Vec<Guide>,
    /// The range of the y axis, beyond which lines are cut off; `None` holds all values.
    pub y_range: Option<(f64, f64)>,
}

/// A line chart of one panel or of several below each other that share their x axis.
#[derive(Debug, Clone, PartialEq)]
pub struct LineChart {
    /// Title and axes; every panel has the same y label.
    pub labels: Labels,
    /// The panels, from top to bottom.
    pub panels: Vec<LinePanel>,
}

/// Up to this many positions each gets a dot; beyond it the dots would hide the line.
const MOST_DOTS: usize = 60;

impl LineChart {
    /// A chart with all series and guides in one panel.
    pub fn new(labels: Labels, series: Vec<LineSeries>, guides: Vec<Guide>) -> Self {
        Self {
            labels,
            panels: vec![LinePanel {
                series,
                guides,
                y_range: None,
            }],
        }
    }

    pub(super) fn draw(&self) -> Result<Canvas, FigureError> {
        let all_series = || self.panels.iter().flat_map(|panel| &panel.series);
        let positions = all_series().flat_map(LineSeries::drawn).map(|(x, ..)| x);
        let x = Scale::around(positions, 10)?.ok_or(FigureError::Empty)?;
        let tick_count = if self.panels.len() > 1 { 4 } else { 6 };
        let last = self.panels.len().saturating_sub(1);
        let frames = (self.panels.iter().enumerate())
            .map(|(index, panel)| {
                Ok(Frame {
                    x,
                    y: panel.y_scale(tick_count)?,
                    x_label: &self.labels.x,
                    y_label: &self.labels.y,
                    under: if index == last {
                        Under::Numbers
                    } else {
                        Under::Nothing
                    },
                    rows: None,
                    guides: &panel.guides,
                    beside: 0.0,
                })
            })
            .collect::<Result<Vec<_>, FigureError>>()?;

        let mut canvas = Canvas::new();
        // Colors run through all panels, dashes start anew in each: there, few lines need them.
        let in_panels = self
            .panels
            .iter()
            .flat_map(|panel| panel.series.iter().enumerate());
        let entries: Vec<Entry> = (in_panels.enumerate())
            .map(|(index, (index_in_panel, series))| Entry {
                sign: Sign::Line {
                    color: style::series_color(index),
                    dash: style::series_dash(index_in_panel),
                },
                name: series.name.clone(),
            })
            .collect();
        let top = draw_head(&mut canvas, &self.labels.title, &entries);
        let plots = draw_stack(&mut canvas, &frames, top)?;
        let mut first_index = 0;
        for ((panel, plot), frame) in self.panels.iter().zip(&plots).zip(&frames) {
            frame.draw_guides(&mut canvas, plot);
            // Dots on the edge stay whole if nothing has to be cut off.
            let bleed = if panel.y_range.is_some() { 0.0 } else { 5.0 };
            canvas.within(plot.area.grown(bleed), |canvas| {
                panel.draw(canvas, plot, first_index);
            });
            first_index += panel.series.len();
        }
        Ok(canvas)
    }
}

impl LinePanel {
    fn y_scale(&self, tick_count: usize) -> Result<Scale, FigureError> {
        if let Some((low, high)) = self.y_range {
            return Scale::given(low, high, tick_count);
        }
        let floor = self.floor();
        let reach = |(_, y, spread): (f64, f64, f64)| [(y - spread).max(floor), y + spread];
        let values = self.series.iter().flat_map(LineSeries::drawn).flat_map(reach);
        let guides = self.guides.iter().map(|guide| guide.value);
        Scale::holding(values.chain(guides), Zero::WhenNear, tick_count)?.ok_or(FigureError::Empty)
    }

    /// The value below which bands are cut off: zero for a quantity that is never negative.
    fn floor(&self) -> f64 {
        let never_negative = self
            .series
            .iter()
            .flat_map(LineSeries::drawn)
            .all(|(_, y, _)| y >= 0.0);
        if never_negative { 0.0 } else { f64::NEG_INFINITY }
    }

    /// Draws all bands, then all lines: no band hides the line of another series.
    fn draw(&self, canvas: &mut Canvas, plot: &Plot, first_index: usize) {
        let floor = self.floor();
        for (index, series) in self.series.iter().enumerate() {
            for run in series.runs() {
                let upper = run.iter().map(|&(x, y, spread)| plot.at((x, y + spread)));
                let lower = run
                    .iter()
                    .rev()
                    .map(|&(x, y, spread)| plot.at((x, (y - spread).max(floor))));
                if run.len() > 1 && run.iter().any(|&(.., spread)| spread > 0.0) {
                    let outline: Vec<_> = upper.chain(lower).collect();
                    canvas.polygon(&outline, style::series_color(first_index + index), 0.13);
                }
            }
        }
        for (index, series) in self.series.iter().enumerate() {
            let color = style::series_color(first_index + index);
            let with_dots = series.points.len() <= MOST_DOTS;
            for run in series.runs() {
                let points: Vec<_> = run.iter().map(|&(x, y, _)| plot.at((x, y))).collect();
                if with_dots || points.len() == 1 {
                    for &point in &points {
                        canvas.dot(point, 3.4, color, 1.0);
                    }
                }
                // A lone point has no line to show its spread on: it gets a bar.
                if let [(x, y, spread)] = run[..]
                    && spread > 0.0
                {
                    let (low, high) = (plot.at((x, (y - spread).max(floor))), plot.at((x, y + spread)));
                    canvas.line(low, high, color, 1.5, None);
                }
                if points.len() > 1 {
                    canvas.polyline(points, color, 2.6, style::series_dash(index));
                }
            }
        }
    }
}

impl LineSeries {
    /// A series of values without a spread.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = (f64, Option<f64>)>) -> Self {
        let points = points
            .into_iter()
            .map(|(x, y)| LinePoint { x, y, spread: None })
            .collect();
        Self {
            name: name.into(),
            points,
        }
    }

    /// Position, value and spread (0 if it is missing) of the points that can be drawn.
    fn drawn(&self) -> impl Iterator<Item = (f64, f64, f64)> {
        self.points.iter().filter_map(LinePoint::drawn)
    }

    /// The points that can be drawn, in runs without a gap.
    fn runs(&self) -> Vec<Vec<(f64, f64, f64)>> {
        let broken = self.points.split(|point| point.drawn().is_none());
        broken
            .filter(|run| !run.is_empty())
            .map(|run| run.iter().filter_map(LinePoint::drawn).collect())
            .collect()
    }
}

impl LinePoint {
    fn drawn(&self) -> Option<(f64, f64, f64)> {
        let y = finite(self.y)?;
        self.x
            .is_finite()
            .then_some((self.x, y, finite(self.spread).map_or(0.0, f64::abs)))
    }
}
