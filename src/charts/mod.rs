//! Charts for reports: typed descriptions in, SVG text and PNG bytes out.
//!
//! The same description gives the same bytes on every run and every machine: all texts are measured and rasterized
//! with the bundled font, never with one of the system. A value that does not exist is `None`; it and a value that is
//! not finite leave a gap or a mark of their own and are never drawn as zero.

mod bars;
mod canvas;
mod frame;
mod heatmap;
mod histogram;
mod legend;
mod lines;
pub(super) mod raster;
mod scale;
mod scatter;
mod style;
pub(super) mod text;
mod views;

pub use bars::{BarChart, BarSeries};
pub use heatmap::Heatmap;
pub use histogram::Histogram;
pub use lines::{LineChart, LinePanel, LinePoint, LineSeries};
pub use scatter::{Scatter, ScatterSeries};
pub use style::{HEIGHT, WIDTH};
pub use views::{CloudViews, Dashes, View, ViewKey};

use thiserror::Error;

/// The reason why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is no finite value in the whole description.
    #[error("the figure has nothing to draw: it holds no finite value")]
    Empty,
    /// Two lists that belong together differ in length.
    #[error("{what}: {found} values for {expected} places")]
    Mismatch {
        /// The list that does not fit.
        what: String,
        /// The length that it should have.
        expected: usize,
        /// The length that it has.
        found: usize,
    },
    /// A value so large that no axis can hold it.
    #[error("{0:e} is too large to be drawn")]
    TooLarge(f64),
    /// A range whose ends are equal, reversed or not finite.
    #[error("an axis cannot run from {0} to {1}")]
    Range(f64, f64),
    /// A scale that gives no picture, or one of more than 16,384 pixels a side.
    #[error("a PNG cannot be drawn at scale {0}")]
    Scale(f64),
    /// So many series or so long names that they leave no room for the plot itself.
    #[error("the legend and the labels leave no room for the plot")]
    NoRoom,
    /// The picture could not be rasterized or encoded.
    #[error("the PNG could not be made: {0}")]
    Raster(String),
}

/// A horizontal line at a value to compare with. Its label is beside the plot, clear of all data.
#[derive(Debug, Clone, PartialEq)]
pub struct Guide {
    /// The value of the line, in the unit of the y axis.
    pub value: f64,
    /// Its text, with number and unit.
    pub label: String,
}

impl Guide {
    /// A guide at `value` that says `label`.
    pub fn new(value: f64, label: impl Into<String>) -> Self {
        Self {
            value,
            label: label.into(),
        }
    }
}

/// The texts around a chart. Units belong into the axis labels, in parentheses.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Labels {
    /// The title, in sentence case.
    pub title: String,
    /// The quantity along the x axis.
    pub x: String,
    /// The quantity along the y axis.
    pub y: String,
}

impl Labels {
    /// The three texts, in the order in which they are read.
    pub fn new(title: impl Into<String>, x: impl Into<String>, y: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            x: x.into(),
            y: y.into(),
        }
    }
}

/// A chart of any kind, ready to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Figure {
    /// Series over a numeric axis.
    Lines(LineChart),
    /// One or more bars per category.
    Bars(BarChart),
    /// The distribution of values.
    Histogram(Histogram),
    /// Points with two coordinates.
    Scatter(Scatter),
    /// A map of values over two settings.
    Heatmap(Heatmap),
    /// A cloud from several sides.
    Views(CloudViews),
}

impl Figure {
    /// The figure as an SVG document of [`WIDTH`] × [`HEIGHT`] units. Its texts stay texts.
    ///
    /// # Errors
    /// Returns an error if the figure holds no finite value, lists of different lengths, values beyond any axis, or too
    /// many series.
    pub fn svg(&self) -> Result<String, FigureError> {
        let canvas = match self {
            Self::Lines(chart) => chart.draw(),
            Self::Bars(chart) => chart.draw(),
            Self::Histogram(chart) => chart.draw(),
            Self::Scatter(chart) => chart.draw(),
            Self::Heatmap(chart) => chart.draw(),
            Self::Views(chart) => chart.draw(),
        }?;
        Ok(canvas.into_svg())
    }

    /// The figure as a PNG of `scale` × [`WIDTH`] by `scale` × [`HEIGHT`] pixels; 0.5 makes a thumbnail, 2 suits print.
    ///
    /// # Errors
    /// Returns the errors of [`svg`](Self::svg), and an error if the scale gives no picture.
    pub fn png(&self, scale: f64) -> Result<Vec<u8>, FigureError> {
        raster::png_from_svg(&self.svg()?, scale)
    }
}

macro_rules! figure_from {
    ($($kind:ident($chart:ty)),*) => {
        $(impl From<$chart> for Figure {
            fn from(chart: $chart) -> Self {
                Self::$kind(chart)
            }
        })*
    };
}
figure_from!(
    Lines(LineChart),
    Bars(BarChart),
    Histogram(Histogram),
    Scatter(Scatter),
    Heatmap(Heatmap),
    Views(CloudViews)
);

/// A value that exists and is finite.
fn finite(value: Option<f64>) -> Option<f64> {
    value.filter(|v| v.is_finite())
}
