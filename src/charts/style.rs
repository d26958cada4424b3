//! Sizes and colors that all figures share.

/// Width of every figure, in the units of the SVG.
pub const WIDTH: f64 = 1200.0;
/// Height of every figure, in the units of the SVG.
pub const HEIGHT: f64 = 700.0;

/// Free space around everything.
pub(super) const PAGE_MARGIN: f64 = 26.0;

// Sizes of text. The smallest is still 8 pixels high in a thumbnail of 600 pixels.
pub(super) const TITLE_SIZE: u32 = 26;
pub(super) const LABEL_SIZE: u32 = 20;
pub(super) const TICK_SIZE: u32 = 17;
pub(super) const LEGEND_SIZE: u32 = 17;

pub(super) const INK: &str = "#222222";
pub(super) const QUIET_INK: &str = "#555555";
pub(super) const AXIS: &str = "#888888";
pub(super) const GRID: &str = "#e4e4e4";
pub(super) const MISSING: &str = "#d9d9d9";

/// The colors of Okabe and Ito, told apart with every kind of color vision, in an order that keeps neighbors apart.
/// Their yellow is too faint for a line on white; a gray stands in for it.
const PALETTE: [&str; 8] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#8C8C8C",
];

/// The color of the series at `index`; colors repeat after eight.
pub(super) fn series_color(index: usize) -> &'static str {
    PALETTE[index % PALETTE.len()]
}

/// The dashes of the line at `index`: from the fifth on lines differ by more than their color.
pub(super) fn series_dash(index: usize) -> Option<&'static str> {
    match index / 4 {
        0 => None,
        1 => Some("9 4"),
        2 => Some("2 4"),
        _ => Some("9 4 2 4"),
    }
}

/// The dashes of the guide at `index`, so that two guides of one color stay apart in print.
pub(super) fn guide_dash(index: usize) -> &'static str {
    ["10 5", "3 4", "12 4 3 4"][index % 3]
}
