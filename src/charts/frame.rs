//! The frame of a plot: axes, grid, labels, and guides with their texts beside the plot.

use std::sync::Arc;

use kuva::render::{
    axis::add_axes_and_grid,
    layout::{AxisLabelOverlap, ComputedLayout, Layout, TickFormat},
    theme::Theme,
};

use super::{
    FigureError, Guide,
    canvas::{Align, Area, Canvas},
    scale::Scale,
    style::{self, INK, LABEL_SIZE, LEGEND_SIZE, PAGE_MARGIN, QUIET_INK, TICK_SIZE},
    text,
};

/// Lines of one block of text lie this far apart, as a multiple of the size of the text.
const LEADING: f64 = 1.2;
/// The longest line of a guide's label.
const GUIDE_ROOM: f64 = 170.0;
/// From the plot to the labels of its guides.
const GUIDE_GAP: f64 = 14.0;
/// From an axis to the numbers at its ticks: the tick and a little air.
const TICK_GAP: f64 = 9.0;
/// The longest name beside a row.
const ROW_NAME_ROOM: f64 = 160.0;

/// The texts under the x axis.
pub(super) enum Under<'a> {
    /// Numbers at ticks.
    Numbers,
    /// No texts: the panel below has the same axis.
    Nothing,
    /// A text for each category; the categories lie at 1, 2, 3 …
    Categories(&'a [String]),
}

/// A plot's axes and the room they have.
pub(super) struct Frame<'a> {
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) x_label: &'a str,
    pub(super) y_label: &'a str,
    pub(super) under: Under<'a>,
    /// Names for 1, 2, 3 … along the y axis, in place of numbers.
    pub(super) rows: Option<&'a [String]>,
    pub(super) guides: &'a [Guide],
    /// Room that the chart itself needs right of the plot.
    pub(super) beside: f64,
}

/// The mapping of values to the canvas.
pub(super) struct Plot {
    pub(super) area: Area,
    computed: ComputedLayout,
}

impl Plot {
    pub(super) fn x(&self, value: f64) -> f64 {
        self.computed.map_x(value)
    }

    pub(super) fn y(&self, value: f64) -> f64 {
        self.computed.map_y(value)
    }

    pub(super) fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.x(x), self.y(y))
    }
}

impl Frame<'_> {
    /// The room left of the plot for numbers and the label.
    pub(super) fn left_room(&self) -> f64 {
        let labels = self.row_names().unwrap_or_else(|| self.y.tick_labels());
        let widest = labels
            .iter()
            .map(|label| text::width(label, TICK_SIZE))
            .fold(0.0, f64::max);
        PAGE_MARGIN + f64::from(LABEL_SIZE) * LEADING + 10.0 + widest + TICK_GAP
    }

    /// The room right of the plot for the labels of the guides.
    pub(super) fn right_room(&self) -> f64 {
        let lines = self.guides.iter().flat_map(|guide| guide_lines(&guide.label));
        let widest = lines
            .map(|line| text::width(&line, LEGEND_SIZE))
            .fold(0.0, f64::max);
        let room = if widest > 0.0 { GUIDE_GAP + widest } else { 14.0 };
        PAGE_MARGIN + room.max(self.beside)
    }

    /// The room below the plot, within a plot `width` wide.
    pub(super) fn bottom_room(&self, width: f64) -> f64 {
        let label = if self.x_label.is_empty() {
            0.0
        } else {
            f64::from(LABEL_SIZE) * LEADING + 8.0
        };
        match self.under {
            Under::Nothing => 0.0,
            Under::Numbers => PAGE_MARGIN + label + TICK_GAP + f64::from(TICK_SIZE),
            Under::Categories(names) => {
                PAGE_MARGIN + label + TICK_GAP + CategoryTexts::fit(names, width).height
            }
        }
    }

    /// Draws grid, axes, labels and guides into an area, and returns the mapping of values.
    pub(super) fn draw(&self, canvas: &mut Canvas, area: Area) -> Result<Plot, FigureError> {
        if area.height() < 40.0 || area.width() < 80.0 {
            return Err(FigureError::NoRoom);
        }
        let plot = self.axes(canvas, area);
        if let Under::Categories(names) = self.under {
            CategoryTexts::fit(names, area.width()).draw(canvas, names, &plot);
        }
        self.axis_labels(canvas, area);
        self.guide_texts(canvas, &plot);
        Ok(plot)
    }

    /// The names along the y axis, each on one line.
    fn row_names(&self) -> Option<Vec<String>> {
        self.rows.map(|rows| {
            rows.iter()
                .map(|name| text::shortened(name, TICK_SIZE, ROW_NAME_ROOM))
                .collect()
        })
    }

    fn axes(&self, canvas: &mut Canvas, area: Area) -> Plot {
        let mut layout = Layout::new((self.x.low, self.x.high), (self.y.low, self.y.high))
            .with_width(style::WIDTH)
            .with_height(style::HEIGHT)
            .with_tick_size(TICK_SIZE)
            .with_tick_length(6.0)
            .with_x_label_overlap(AxisLabelOverlap::Thin)
            .with_x_tick_format(TickFormat::Custom(Arc::new(self.x.format())))
            .with_y_tick_format(TickFormat::Custom(Arc::new(self.y.format())))
            .with_theme(Theme {
                axis_color: style::AXIS.to_owned(),
                grid_color: style::GRID.to_owned(),
                tick_color: style::AXIS.to_owned(),
                text_color: INK.to_owned(),
                ..Theme::light()
            });
        if let Under::Categories(names) = self.under {
            // Only so that there is no grid line under each of them: their texts are drawn here.
            layout = layout.with_x_categories(names.to_vec());
        }
        if let Some(names) = self.row_names() {
            layout = layout.with_y_categories(names);
        }
        layout.suppress_x_ticks = !matches!(self.under, Under::Numbers);
        let mut computed = ComputedLayout::from_layout(&layout);
        computed.margin_left = area.left;
        computed.margin_right = style::WIDTH - area.right;
        computed.margin_top = area.top;
        computed.margin_bottom = style::HEIGHT - area.bottom;
        (computed.x_range, computed.x_tick_step) = ((self.x.low, self.x.high), Some(self.x.step));
        (computed.y_range, computed.y_tick_step) = ((self.y.low, self.y.high), Some(self.y.step));
        computed.recompute_transforms();
        add_axes_and_grid(&mut canvas.scene, &computed, &layout);
        Plot { area, computed }
    }

    fn axis_labels(&self, canvas: &mut Canvas, area: Area) {
        let size = f64::from(LABEL_SIZE);
        if !matches!(self.under, Under::Nothing) {
            let middle = f64::midpoint(area.left, area.right);
            let label = text::shortened(self.x_label, LABEL_SIZE, style::WIDTH - 2.0 * PAGE_MARGIN);
            // Long labels move away from the edge of the page rather than over it.
            let half = text::width(&label, LABEL_SIZE) / 2.0;
            let x = middle.clamp(
                PAGE_MARGIN + half,
                (style::WIDTH - PAGE_MARGIN - half).max(PAGE_MARGIN + half),
            );
            canvas.text(
                &label,
                (x, style::HEIGHT - PAGE_MARGIN - 2.0),
                LABEL_SIZE,
                Align::Middle,
                INK,
            );
        }
        let label = text::shortened(self.y_label, LABEL_SIZE, area.height() + 20.0);
        let position = (PAGE_MARGIN + size * 0.8, f64::midpoint(area.top, area.bottom));
        canvas.turned_text(&label, position, LABEL_SIZE, Align::Middle, INK, Some(-90.0));
    }

    /// Draws the guides across the plot. Each chart calls it in its own turn: over bars, under lines.
    pub(super) fn draw_guides(&self, canvas: &mut Canvas, plot: &Plot) {
        for (index, guide) in self.shown_guides() {
            let y = plot.y(guide.value);
            let (left, right) = ((plot.area.left, y), (plot.area.right, y));
            // A pale seam keeps the line readable where it crosses bars.
            canvas.line(left, right, "#ffffff", 3.6, Some(style::guide_dash(index)));
            canvas.line(left, right, INK, 1.8, Some(style::guide_dash(index)));
        }
    }

    /// Guides that lie in the range of the axis.
    fn shown_guides(&self) -> impl Iterator<Item = (usize, &Guide)> {
        let range = self.y.low..=self.y.high;
        self.guides
            .iter()
            .enumerate()
            .filter(move |(_, guide)| range.contains(&guide.value))
    }

    /// Writes the label of each guide to the right of its end, moved so that texts do not meet.
    fn guide_texts(&self, canvas: &mut Canvas, plot: &Plot) {
        let Area {
            right, top, bottom, ..
        } = plot.area;
        let line_height = f64::from(LEGEND_SIZE) * LEADING;
        let mut blocks: Vec<(f64, Vec<String>)> = self
            .shown_guides()
            .map(|(_, guide)| (plot.y(guide.value), guide_lines(&guide.label)))
            .collect();
        blocks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let heights: Vec<f64> = blocks
            .iter()
            .map(|(_, lines)| lines.len() as f64 * line_height + 4.0)
            .collect();
        let wanted: Vec<f64> = blocks
            .iter()
            .zip(&heights)
            .map(|((y, _), height)| y - height / 2.0)
            .collect();
        let tops = moved_apart(&wanted, &heights, top - 10.0, bottom + 10.0);
        for (((y, lines), block_top), height) in blocks.iter().zip(tops).zip(heights) {
            let middle = block_top + height / 2.0;
            canvas.line(
                (right, *y),
                (right + GUIDE_GAP - 4.0, middle),
                QUIET_INK,
                1.0,
                None,
            );
            for (row, line) in lines.iter().enumerate() {
                let baseline = block_top + 2.0 + (row as f64 + 0.78) * line_height;
                canvas.text(
                    line,
                    (right + GUIDE_GAP, baseline),
                    LEGEND_SIZE,
                    Align::Start,
                    INK,
                );
            }
        }
    }
}

fn guide_lines(label: &str) -> Vec<String> {
    text::wrapped(label, LEGEND_SIZE, GUIDE_ROOM, 3)
}

/// Blocks at the tops wanted (in rising order), pushed down and then up until none meets another or leaves the room.
fn moved_apart(wanted: &[f64], heights: &[f64], low: f64, high: f64) -> Vec<f64> {
    let mut tops = wanted.to_vec();
    let mut free = low;
    for (top, height) in tops.iter_mut().zip(heights) {
        *top = top.max(free);
        free = *top + height;
    }
    let mut free = high;
    for (top, height) in tops.iter_mut().zip(heights).rev() {
        *top = top.min(free - height);
        free = *top;
    }
    tops
}

/// The arrangement of the names of categories under their axis.
struct CategoryTexts {
    turned: bool,
    height: f64,
    /// Only every so many have room for a name.
    every: usize,
}

impl CategoryTexts {
    /// The longest that a turned name may get.
    const LONGEST: f64 = 150.0;

    fn fit(names: &[String], width: f64) -> Self {
        let slot = width / names.len().max(1) as f64;
        let widest = names
            .iter()
            .map(|name| text::width(name, TICK_SIZE))
            .fold(0.0, f64::max);
        let line = f64::from(TICK_SIZE) * LEADING;
        if widest + 8.0 <= slot {
            return Self {
                turned: false,
                height: f64::from(TICK_SIZE),
                every: 1,
            };
        }
        // Short names (numbers) thin out before they turn; long ones turn first.
        let short = widest <= 45.0;
        let needed = if short { widest + 8.0 } else { line };
        let every = (needed / slot).ceil().max(1.0) as usize;
        Self {
            turned: !short,
            height: if short {
                f64::from(TICK_SIZE)
            } else {
                widest.min(Self::LONGEST)
            },
            every,
        }
    }

    fn draw(&self, canvas: &mut Canvas, names: &[String], plot: &Plot) {
        let y = plot.area.bottom + TICK_GAP;
        for (index, name) in names.iter().enumerate().step_by(self.every) {
            let x = plot.x(index as f64 + 1.0);
            let name = text::shortened(name, TICK_SIZE, Self::LONGEST);
            if self.turned {
                let position = (x + f64::from(TICK_SIZE) * 0.35, y);
                canvas.turned_text(&name, position, TICK_SIZE, Align::End, INK, Some(-90.0));
            } else {
                canvas.text(
                    &name,
                    (x, y + f64::from(TICK_SIZE) * 0.85),
                    TICK_SIZE,
                    Align::Middle,
                    INK,
                );
            }
        }
    }
}

/// Draws frames below each other, between `top` and the end of the page, their plots flush left and right.
pub(super) fn draw_stack(
    canvas: &mut Canvas,
    frames: &[Frame<'_>],
    top: f64,
) -> Result<Vec<Plot>, FigureError> {
    const BETWEEN: f64 = 30.0;
    let left = frames.iter().map(Frame::left_room).fold(0.0, f64::max);
    let right = style::WIDTH - frames.iter().map(Frame::right_room).fold(0.0, f64::max);
    let below = frames.last().map_or(0.0, |frame| frame.bottom_room(right - left));
    let count = frames.len().max(1) as f64;
    let height = (style::HEIGHT - below - top - BETWEEN * (count - 1.0)) / count;
    let place = |(row, frame): (usize, &Frame<'_>)| {
        let top = top + row as f64 * (height + BETWEEN);
        frame.draw(
            canvas,
            Area {
                left,
                top,
                right,
                bottom: top + height,
            },
        )
    };
    frames.iter().enumerate().map(place).collect()
}
