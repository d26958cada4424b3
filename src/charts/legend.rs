//! The head of a figure: its title and, in rows below it, the legend.

use super::{
    canvas::{Align, Area, Canvas},
    style::{INK, LEGEND_SIZE, PAGE_MARGIN, QUIET_INK, TITLE_SIZE, WIDTH},
    text,
};

/// The sign before a name in the legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sign {
    Line {
        color: &'static str,
        dash: Option<&'static str>,
    },
    Box {
        color: &'static str,
    },
    Dot {
        color: &'static str,
    },
    Cross,
}

impl Sign {
    fn width(self) -> f64 {
        match self {
            // Long enough to show the dashes.
            Self::Line { .. } => 34.0,
            Self::Box { .. } | Self::Dot { .. } | Self::Cross => 17.0,
        }
    }
}

/// A name and its sign.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) sign: Sign,
    pub(super) name: String,
}

const SIGN_GAP: f64 = 9.0;
const ENTRY_GAP: f64 = 30.0;
const ROW_HEIGHT: f64 = 27.0;

/// Draws the head and returns the start of the room below it.
pub(super) fn draw_head(canvas: &mut Canvas, title: &str, entries: &[Entry]) -> f64 {
    let room = WIDTH - 2.0 * PAGE_MARGIN;
    let mut y = PAGE_MARGIN;
    for line in text::wrapped(title, TITLE_SIZE, room, 2) {
        y += f64::from(TITLE_SIZE);
        canvas.text(&line, (PAGE_MARGIN, y - 4.0), TITLE_SIZE, Align::Start, INK);
        y += 6.0;
    }
    let mut x = PAGE_MARGIN;
    for (index, entry) in entries.iter().enumerate() {
        let sign_width = entry.sign.width();
        let name = text::shortened(&entry.name, LEGEND_SIZE, room - sign_width - SIGN_GAP);
        let width = sign_width + SIGN_GAP + text::width(&name, LEGEND_SIZE);
        if index == 0 {
            y += ROW_HEIGHT;
        } else if x + width > WIDTH - PAGE_MARGIN {
            x = PAGE_MARGIN;
            y += ROW_HEIGHT;
        }
        draw_sign(canvas, entry.sign, x, y - 6.0);
        canvas.text(
            &name,
            (x + sign_width + SIGN_GAP, y),
            LEGEND_SIZE,
            Align::Start,
            INK,
        );
        x += width + ENTRY_GAP;
    }
    y + 20.0
}

fn draw_sign(canvas: &mut Canvas, sign: Sign, x: f64, y: f64) {
    let middle = x + sign.width() / 2.0;
    match sign {
        Sign::Line { color, dash } => canvas.line((x, y), (x + sign.width(), y), color, 3.5, dash),
        Sign::Box { color } => {
            let half = 8.0;
            let area = Area {
                left: middle - half,
                top: y - half,
                right: middle + half,
                bottom: y + half,
            };
            canvas.rect(area, color, Some((QUIET_INK, 0.5)));
        }
        Sign::Dot { color } => canvas.dot((middle, y), 6.0, color, 1.0),
        Sign::Cross => canvas.cross((middle, y), 6.0),
    }
}
