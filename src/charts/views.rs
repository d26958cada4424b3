//! A cloud from several sides: panels of one scale with colored points and lines, as the paper's Fig. 3 to 11 show clouds.

use super::{
    FigureError,
    canvas::{Align, Area, Canvas},
    legend::{Entry, Sign, draw_head},
    scale::Scale,
    style::{self, INK, LABEL_SIZE, PAGE_MARGIN, QUIET_INK, TICK_SIZE},
    text,
};

/// What points or lines of one kind stand for.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewKey {
    /// Its name in the legend.
    pub name: String,
    /// Its color, `#rrggbb`.
    pub color: &'static str,
    /// Whether it is a line rather than points, and the line's dashes.
    pub line: Option<Dashes>,
}

/// The stroke of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dashes {
    /// Unbroken.
    Solid,
    /// Dashed.
    Dashed,
}

/// A cloud from one side. Coordinates are of one length unit, x to the right and y **up**.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct View {
    /// The text above it.
    pub name: String,
    /// The points and the index of each one's key, drawn in this order: the farthest first. Those that are not
    /// finite are left out.
    pub points: Vec<((f64, f64), usize)>,
    /// Lines from end to end and the index of each one's key, drawn over the points.
    pub lines: Vec<([(f64, f64); 2], usize)>,
}

/// A grid of views, all of one scale, with a bar that shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct CloudViews {
    /// The title, in sentence case.
    pub title: String,
    /// The kinds of points and lines.
    pub keys: Vec<ViewKey>,
    /// The number of views in a row, at least 1.
    pub columns: usize,
    /// The views, row by row.
    pub views: Vec<View>,
    /// The unit of the coordinates, for the bar.
    pub unit: &'static str,
}

/// Between two views.
const BETWEEN: f64 = 16.0;
const NAME_HEIGHT: f64 = 24.0;
/// The room below all views, for the bar.
const BAR_ROOM: f64 = 30.0;

impl CloudViews {
    pub(super) fn draw(&self) -> Result<Canvas, FigureError> {
        for (index, view) in self.views.iter().enumerate() {
            let keys = view
                .points
                .iter()
                .map(|p| p.1)
                .chain(view.lines.iter().map(|l| l.1));
            if let Some(found) = keys.max().filter(|&key| key >= self.keys.len()) {
                let what = format!("keys of view {}", index + 1);
                return Err(FigureError::Mismatch {
                    what,
                    expected: self.keys.len(),
                    found: found + 1,
                });
            }
        }
        let frames = self
            .views
            .iter()
            .map(View::extent)
            .collect::<Result<Vec<_>, _>>()?;
        let frames: Vec<(Scale, Scale)> = frames
            .into_iter()
            .collect::<Option<_>>()
            .ok_or(FigureError::Empty)?;
        if frames.is_empty() {
            return Err(FigureError::Empty);
        }
        let mut canvas = Canvas::new();
        let entries: Vec<Entry> = self.keys.iter().map(ViewKey::entry).collect();
        let top = draw_head(&mut canvas, &self.title, &entries);
        let columns = self.columns.clamp(1, self.views.len());
        let rows = self.views.len().div_ceil(columns);
        let share = |room: f64, count: usize| (room - BETWEEN * (count as f64 - 1.0)) / count as f64;
        let width = share(style::WIDTH - 2.0 * PAGE_MARGIN, columns);
        let height = share(style::HEIGHT - PAGE_MARGIN - BAR_ROOM - top, rows);
        if width < 60.0 || height < NAME_HEIGHT + 60.0 {
            return Err(FigureError::NoRoom);
        }
        let pixels_a_unit = frames
            .iter()
            .map(|(x, y)| (width / (x.high - x.low)).min((height - NAME_HEIGHT) / (y.high - y.low)))
            .fold(f64::INFINITY, f64::min);
        for (index, (view, frame)) in self.views.iter().zip(&frames).enumerate() {
            let (left, top) = (
                PAGE_MARGIN + (index % columns) as f64 * (width + BETWEEN),
                top + (index / columns) as f64 * (height + BETWEEN),
            );
            let area = Area {
                left,
                top: top + NAME_HEIGHT,
                right: left + width,
                bottom: top + height,
            };
            let name = text::shortened(&view.name, TICK_SIZE, width);
            canvas.text(
                &name,
                (f64::midpoint(left, area.right), top + 17.0),
                TICK_SIZE,
                Align::Middle,
                INK,
            );
            self.draw_view(&mut canvas, view, frame, area, pixels_a_unit);
        }
        self.draw_bar(&mut canvas, pixels_a_unit);
        Ok(canvas)
    }

    fn draw_view(&self, canvas: &mut Canvas, view: &View, (x, y): &(Scale, Scale), area: Area, scale: f64) {
        let middle = (f64::midpoint(x.low, x.high), f64::midpoint(y.low, y.high));
        let place = |(x, y): (f64, f64)| {
            (
                f64::midpoint(area.left, area.right) + (x - middle.0) * scale,
                f64::midpoint(area.top, area.bottom) - (y - middle.1) * scale,
            )
        };
        canvas.rect(area, "none", Some((style::GRID, 1.0)));
        // Many small points, few large ones: about the room that each has.
        let radius = (area.width() * area.height() / (12.0 * view.points.len().max(1) as f64)).sqrt();
        let radius = radius.clamp(1.1, 3.0);
        canvas.within(area, |canvas| {
            for &(point, key) in view.drawn() {
                canvas.dot(place(point), radius, self.keys[key].color, 1.0);
            }
            for &([from, to], key) in &view.lines {
                let ViewKey { color, line, .. } = self.keys[key];
                // A pale seam keeps the line apart from points of its color.
                canvas.line(place(from), place(to), "#ffffff", 6.0, None);
                canvas.line(
                    place(from),
                    place(to),
                    color,
                    3.0,
                    line.unwrap_or(Dashes::Solid).pattern(),
                );
            }
        });
    }

    fn draw_bar(&self, canvas: &mut Canvas, scale: f64) {
        // The longest of 1, 2, 5, 10 … that is short beside the page.
        let longest = 160.0 / scale;
        let decade = 10f64.powf(longest.log10().floor());
        let length = [5.0, 2.0]
            .map(|m| m * decade)
            .into_iter()
            .find(|&l| l <= longest)
            .unwrap_or(decade);
        let y = style::HEIGHT - PAGE_MARGIN;
        let (left, right) = (PAGE_MARGIN, PAGE_MARGIN + length * scale);
        canvas.line((left, y), (right, y), QUIET_INK, 2.0, None);
        for x in [left, right] {
            canvas.line((x, y - 5.0), (x, y + 5.0), QUIET_INK, 2.0, None);
        }
        let label = format!("{length} {}", self.unit);
        canvas.text(
            &label,
            (right + 10.0, y + f64::from(LABEL_SIZE) * 0.3),
            TICK_SIZE,
            Align::Start,
            QUIET_INK,
        );
    }
}

impl View {
    /// The points that can be drawn.
    fn drawn(&self) -> impl Iterator<Item = &((f64, f64), usize)> {
        self.points
            .iter()
            .filter(|((x, y), _)| x.is_finite() && y.is_finite())
    }

    /// The ranges of its points; lines are cut off where they leave them.
    fn extent(&self) -> Result<Option<(Scale, Scale)>, FigureError> {
        let x = Scale::around(self.drawn().map(|(p, _)| p.0), 4)?;
        let y = Scale::around(self.drawn().map(|(p, _)| p.1), 4)?;
        Ok(x.zip(y))
    }
}

impl ViewKey {
    fn entry(&self) -> Entry {
        let sign = match self.line {
            Some(dashes) => Sign::Line {
                color: self.color,
                dash: dashes.pattern(),
            },
            None => Sign::Dot { color: self.color },
        };
        Entry {
            sign,
            name: self.name.clone(),
        }
    }
}

impl Dashes {
    fn pattern(self) -> Option<&'static str> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some("9 5"),
        }
    }
}
