//! Histograms with steps of equal width.

use kuva::render::render_utils::compute_tick_step;

use super::{
    FigureError, Labels,
    canvas::{Area, Canvas},
    frame::{Frame, Under, draw_stack},
    legend::draw_head,
    scale::{Scale, Zero},
    style,
};

/// A histogram.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    /// Title and axes.
    pub labels: Labels,
    /// The values in any order; those that are not finite are left out.
    pub values: Vec<f64>,
    /// The width of a step; `None` takes a round width that gives about twenty steps.
    pub step: Option<f64>,
}

/// More steps than pixels can tell apart.
const MOST_STEPS: f64 = 2000.0;

impl Histogram {
    pub(super) fn draw(&self) -> Result<Canvas, FigureError> {
        let finite = || self.values.iter().copied().filter(|value| value.is_finite());
        let x = Scale::holding(finite(), Zero::WhenNear, 10)?.ok_or(FigureError::Empty)?;
        let step = self.step.unwrap_or_else(|| compute_tick_step(x.low, x.high, 20));
        let steps = ((x.high - x.low) / step).ceil();
        // Written so that a step of NaN is refused as well.
        if !(step > 0.0 && steps <= MOST_STEPS) {
            return Err(FigureError::Range(0.0, step));
        }
        let first = (x.low / step).floor() * step;
        let mut counts = vec![0_usize; steps as usize + 2];
        for value in finite() {
            // In range by the bounds above; the clamp covers the rounding of the division.
            let index = (((value - first) / step) as usize).min(counts.len() - 1);
            counts[index] += 1;
        }
        let frame = Frame {
            x,
            y: Scale::holding(counts.iter().map(|&count| count as f64), Zero::Always, 5)?
                .ok_or(FigureError::Empty)?,
            x_label: &self.labels.x,
            y_label: &self.labels.y,
            under: Under::Numbers,
            rows: None,
            guides: &[],
            beside: 0.0,
        };
        let mut canvas = Canvas::new();
        let top = draw_head(&mut canvas, &self.labels.title, &[]);
        for plot in draw_stack(&mut canvas, &[frame], top)? {
            canvas.within(plot.area, |canvas| {
                for (index, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
                    let start = first + index as f64 * step;
                    let (left, top) = plot.at((start, count as f64));
                    let bar = Area {
                        left,
                        top,
                        right: plot.x(start + step),
                        bottom: plot.y(0.0),
                    };
                    canvas.rect(bar, style::series_color(0), Some(("#ffffff", 1.2)));
                }
            });
        }
        Ok(canvas)
    }
}
