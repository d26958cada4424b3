//! A map of values over two settings: the error over u and τ.

use kuva::plot::ColorMap;

use super::{
    FigureError, Labels,
    canvas::{Align, Area, Canvas},
    finite,
    frame::{Frame, Plot, Under, draw_stack},
    legend::{Entry, Sign, draw_head},
    scale::{Scale, Zero},
    style::{self, INK, LEGEND_SIZE, MISSING, TICK_SIZE},
    text,
};

/// A map of cells, each colored by its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Heatmap {
    /// Title and axes.
    pub labels: Labels,
    /// The quantity that the colors show, with its unit.
    pub value_label: String,
    /// The settings along x, from left to right.
    pub columns: Vec<String>,
    /// The settings along y, from bottom to top.
    pub rows: Vec<String>,
    /// A row of values for each of `rows`; cells without a value are gray with a ×.
    pub cells: Vec<Vec<Option<f64>>>,
}

const BAR_WIDTH: f64 = 22.0;
/// From the plot to the color bar, and from there to its numbers.
const BAR_GAP: f64 = 24.0;
const NUMBER_GAP: f64 = 8.0;

impl Heatmap {
    pub(super) fn draw(&self) -> Result<Canvas, FigureError> {
        self.check()?;
        let values = || self.cells.iter().flatten().filter_map(|&cell| finite(cell));
        let colors = Scale::holding(values(), Zero::Never, 6)?.ok_or(FigureError::Empty)?;
        let numbers = colors.tick_labels();
        let widest = numbers
            .iter()
            .map(|number| text::width(number, TICK_SIZE))
            .fold(0.0, f64::max);
        let label_room = f64::from(LEGEND_SIZE) * 1.5;
        let frame = Frame {
            x: Scale::categories(self.columns.len()),
            y: Scale::categories(self.rows.len()),
            x_label: &self.labels.x,
            y_label: &self.labels.y,
            under: Under::Categories(&self.columns),
            rows: Some(&self.rows),
            guides: &[],
            beside: BAR_GAP + BAR_WIDTH + NUMBER_GAP + widest + label_room,
        };
        let mut canvas = Canvas::new();
        let has_gaps = values().count() < self.columns.len() * self.rows.len();
        let entries = [Entry {
            sign: Sign::Cross,
            name: "no result".to_owned(),
        }];
        let top = draw_head(
            &mut canvas,
            &self.labels.title,
            if has_gaps { &entries } else { &[] },
        );
        for plot in draw_stack(&mut canvas, &[frame], top)? {
            self.draw_cells(&mut canvas, &plot, colors);
            self.draw_color_bar(&mut canvas, plot.area, colors, widest);
        }
        Ok(canvas)
    }

    fn check(&self) -> Result<(), FigureError> {
        let mismatch = |what: String, expected, found| {
            Err(FigureError::Mismatch {
                what,
                expected,
                found,
            })
        };
        if self.cells.len() != self.rows.len() {
            return mismatch("rows of the map".to_owned(), self.rows.len(), self.cells.len());
        }
        for (name, row) in self.rows.iter().zip(&self.cells) {
            if row.len() != self.columns.len() {
                return mismatch(format!("cells of row {name}"), self.columns.len(), row.len());
            }
        }
        Ok(())
    }

    fn draw_cells(&self, canvas: &mut Canvas, plot: &Plot, colors: Scale) {
        let cell_at = |column: usize, row: usize| {
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            let (left, bottom) = plot.at((x, y));
            let (right, top) = plot.at((x + 1.0, y + 1.0));
            Area {
                left,
                top,
                right,
                bottom,
            }
        };
        // The cells hold numbers if every one of them fits.
        let write = one_decimal;
        let texts = self
            .cells
            .iter()
            .flatten()
            .filter_map(|&cell| finite(cell))
            .map(write);
        let widest = texts
            .map(|number| text::width(&number, TICK_SIZE))
            .fold(0.0, f64::max);
        let room = cell_at(0, 0);
        let with_numbers = widest + 8.0 <= room.width() && f64::from(TICK_SIZE) * 1.3 <= room.height();
        for (row, cells) in self.cells.iter().enumerate() {
            for (column, &cell) in cells.iter().enumerate() {
                let area = cell_at(column, row);
                let middle = (
                    f64::midpoint(area.left, area.right),
                    f64::midpoint(area.top, area.bottom),
                );
                let Some(value) = finite(cell) else {
                    canvas.rect(area, MISSING, Some(("#ffffff", 0.8)));
                    canvas.cross(middle, (area.width().min(area.height()) / 5.0).clamp(1.5, 6.0));
                    continue;
                };
                let share = share_of(value, colors);
                canvas.rect(area, &color_of(share), Some(("#ffffff", 0.8)));
                if with_numbers {
                    let ink = if share > 0.55 { INK } else { "#ffffff" };
                    let baseline = (middle.0, middle.1 + f64::from(TICK_SIZE) * 0.36);
                    canvas.text(&write(value), baseline, TICK_SIZE, Align::Middle, ink);
                }
            }
        }
    }

    fn draw_color_bar(&self, canvas: &mut Canvas, plot: Area, colors: Scale, widest: f64) {
        const STEPS: usize = 64;
        let (left, right) = (plot.right + BAR_GAP, plot.right + BAR_GAP + BAR_WIDTH);
        let y_at = |share: f64| plot.bottom - share * plot.height();
        // Each step reaches down to the end and the next one covers it: no background shines through between steps.
        for step in (0..STEPS).rev() {
            let share = |edge: f64| edge / STEPS as f64;
            let area = Area {
                left,
                top: y_at(share(step as f64 + 1.0)),
                right,
                bottom: plot.bottom,
            };
            canvas.rect(area, &color_of(share(step as f64 + 0.5)), None);
        }
        let number_x = right + NUMBER_GAP;
        for (value, number) in colors.labeled_ticks() {
            let y = y_at(share_of(value, colors));
            canvas.line((right - 5.0, y), (right, y), "#ffffff", 1.2, None);
            canvas.text(
                &number,
                (number_x, y + f64::from(TICK_SIZE) * 0.36),
                TICK_SIZE,
                Align::Start,
                INK,
            );
        }
        let label = text::shortened(&self.value_label, LEGEND_SIZE, plot.height() + 20.0);
        let x = number_x + widest + f64::from(LEGEND_SIZE) * 1.25;
        let position = (x, f64::midpoint(plot.top, plot.bottom));
        canvas.turned_text(
            &label,
            position,
            LEGEND_SIZE,
            Align::Middle,
            style::INK,
            Some(-90.0),
        );
    }
}

fn one_decimal(value: f64) -> String {
    format!("{value:.1}").replace('-', "−")
}

fn share_of(value: f64, colors: Scale) -> f64 {
    ((value - colors.low) / (colors.high - colors.low)).clamp(0.0, 1.0)
}

/// Dark violet to yellow, rising evenly in lightness for every kind of color vision.
fn color_of(share: f64) -> String {
    ColorMap::Viridis.map(share)
}
