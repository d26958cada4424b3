//! A bar per category, or one for each of several series: the error per cloud of Fig. 12 and 13.

use super::{
    FigureError, Guide, Labels,
    canvas::{Area, Canvas},
    finite,
    frame::{Frame, Plot, Under, draw_stack},
    legend::{Entry, Sign, draw_head},
    scale::{Scale, Zero},
    style,
};

/// A named series: a value for each category.
#[derive(Debug, Clone, PartialEq)]
pub struct BarSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its values in the order of the categories; a missing one is drawn as a ×.
    pub values: Vec<Option<f64>>,
}

/// A bar chart.
#[derive(Debug, Clone, PartialEq)]
pub struct BarChart {
    /// Title and axes.
    pub labels: Labels,
    /// The names under the axis.
    pub categories: Vec<String>,
    /// The series, side by side in each category.
    pub series: Vec<BarSeries>,
    /// Values to compare the bars with.
    pub guides: Vec<Guide>,
}

/// The share of a category's room that its bars fill.
const FILLED: f64 = 0.76;

impl BarChart {
    pub(super) fn draw(&self) -> Result<Canvas, FigureError> {
        for series in &self.series {
            if series.values.len() != self.categories.len() {
                return Err(FigureError::Mismatch {
                    what: format!("bars of {}", series.name),
                    expected: self.categories.len(),
                    found: series.values.len(),
                });
            }
        }
        let values = || {
            self.series
                .iter()
                .flat_map(|series| &series.values)
                .filter_map(|&value| finite(value))
        };
        if values().next().is_none() {
            return Err(FigureError::Empty);
        }
        let guides = self.guides.iter().map(|guide| guide.value);
        let frame = Frame {
            x: Scale::categories(self.categories.len()),
            y: Scale::holding(values().chain(guides), Zero::Always, 6)?.ok_or(FigureError::Empty)?,
            x_label: &self.labels.x,
            y_label: &self.labels.y,
            under: Under::Categories(&self.categories),
            rows: None,
            guides: &self.guides,
            beside: 0.0,
        };
        let mut canvas = Canvas::new();
        let top = draw_head(&mut canvas, &self.labels.title, &self.entries());
        let plots = draw_stack(&mut canvas, std::slice::from_ref(&frame), top)?;
        for plot in &plots {
            self.draw_bars(&mut canvas, plot);
            frame.draw_guides(&mut canvas, plot);
        }
        Ok(canvas)
    }

    fn entries(&self) -> Vec<Entry> {
        let series = self.series.iter().enumerate();
        let mut entries: Vec<Entry> = series
            .map(|(index, series)| Entry {
                sign: Sign::Box {
                    color: style::series_color(index),
                },
                name: series.name.clone(),
            })
            .collect();
        let is_missing = |value: &Option<f64>| finite(*value).is_none();
        if self
            .series
            .iter()
            .flat_map(|series| &series.values)
            .any(is_missing)
        {
            entries.push(Entry {
                sign: Sign::Cross,
                name: "no result".to_owned(),
            });
        }
        entries
    }

    fn draw_bars(&self, canvas: &mut Canvas, plot: &Plot) {
        let width = FILLED / self.series.len() as f64;
        for (index, series) in self.series.iter().enumerate() {
            for (category, &value) in series.values.iter().enumerate() {
                let start = category as f64 + 1.0 - FILLED / 2.0 + index as f64 * width;
                let (left, right) = (plot.x(start), plot.x(start + width));
                let zero = plot.y(0.0);
                let Some(value) = finite(value) else {
                    let half = ((right - left) / 2.5).clamp(1.5, 6.0);
                    canvas.cross((f64::midpoint(left, right), zero - half - 5.0), half);
                    continue;
                };
                let end = plot.y(value);
                let bar = Area {
                    left,
                    top: end.min(zero),
                    right,
                    bottom: end.max(zero),
                };
                canvas.rect(bar, style::series_color(index), None);
            }
        }
    }
}
