//! The legend of a coloring, as plain data.

use crate::render::Color;

/// The meaning of the colors.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Legend {
    /// The quantity, with its unit.
    pub title: String,
    /// Values as a ramp of colors.
    pub ramp: Option<Ramp>,
    /// Single colors.
    pub swatches: Vec<Swatch>,
    /// Further notes, one line each.
    pub notes: Vec<String>,
}

/// A ramp of colors from low to high.
#[derive(Debug, Clone, PartialEq)]
pub struct Ramp {
    /// Colors at equal steps.
    pub stops: Vec<Color>,
    /// Ticks: places from 0 (low) to 1 (high), and their texts.
    pub ticks: Vec<(f64, String)>,
    /// The value at the ramp's upper end; it begins at zero.
    pub high: f64,
}

/// One color and its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Swatch {
    /// The color.
    pub color: Color,
    /// Its meaning.
    pub label: String,
    /// The number of points with it, and their share in percent; `None` for a color that only shows a direction.
    pub count: Option<(usize, f64)>,
}

impl Swatch {
    pub(super) fn counted(color: Color, label: impl Into<String>, count: usize, of: usize) -> Self {
        let percent = 100.0 * count as f64 / of.max(1) as f64;
        Self {
            color,
            label: label.into(),
            count: Some((count, percent)),
        }
    }

    /// The meaning with the count behind it.
    pub fn text(&self) -> String {
        match self.count {
            Some((count, percent)) if percent > 0.0 && percent < 1.0 => {
                format!("{} · {count} (<1 %)", self.label)
            }
            Some((count, percent)) => format!("{} · {count} ({percent:.0} %)", self.label),
            None => self.label.clone(),
        }
    }
}
