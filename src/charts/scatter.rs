//! Points with two coordinates: the error against the winner's lead, say.

use super::{
    FigureError, Guide, Labels,
    canvas::Canvas,
    frame::{Frame, Under, draw_stack},
    legend::{Entry, Sign, draw_head},
    scale::{Scale, Zero},
    style,
};

/// A named set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct ScatterSeries {
    /// Its name in the legend.
    pub name: String,
    /// The points (x, y); those that are not finite are left out.
    pub points: Vec<(f64, f64)>,
}

/// A scatter plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Scatter {
    /// Title and axes.
    pub labels: Labels,
    /// The sets of points.
    pub series: Vec<ScatterSeries>,
    /// Values of y to compare them with.
    pub guides: Vec<Guide>,
}

impl Scatter {
    pub(super) fn draw(&self) -> Result<Canvas, FigureError> {
        let drawn = |series: &ScatterSeries| {
            let points = series
                .points
                .iter()
                .copied()
                .filter(|(x, y)| x.is_finite() && y.is_finite());
            points.collect::<Vec<_>>()
        };
        let drawn: Vec<Vec<(f64, f64)>> = self.series.iter().map(drawn).collect();
        let points = || drawn.iter().flatten();
        if points().next().is_none() {
            return Err(FigureError::Empty);
        }
        let guides = self.guides.iter().map(|guide| guide.value);
        let frame = Frame {
            x: Scale::holding(points().map(|point| point.0), Zero::WhenNear, 8)?.ok_or(FigureError::Empty)?,
            y: Scale::holding(points().map(|point| point.1).chain(guides), Zero::WhenNear, 6)?
                .ok_or(FigureError::Empty)?,
            x_label: &self.labels.x,
            y_label: &self.labels.y,
            under: Under::Numbers,
            rows: None,
            guides: &self.guides,
            beside: 0.0,
        };
        let entries: Vec<Entry> = (self.series.iter().enumerate())
            .map(|(index, series)| Entry {
                sign: Sign::Dot {
                    color: style::series_color(index),
                },
                name: series.name.clone(),
            })
            .collect();
        // Dense clouds show where they are densest only if dots shine through each other.
        let opacity = if points().count() > 300 { 0.35 } else { 0.75 };
        let mut canvas = Canvas::new();
        let top = draw_head(&mut canvas, &self.labels.title, &entries);
        for plot in draw_stack(&mut canvas, std::slice::from_ref(&frame), top)? {
            frame.draw_guides(&mut canvas, &plot);
            for (index, points) in drawn.iter().enumerate() {
                for &point in points {
                    canvas.dot(plot.at(point), 5.5, style::series_color(index), opacity);
                }
            }
        }
        Ok(canvas)
    }
}
