//! The 2-D primitives painted over a picture, positioned in pixels.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::render::{Background, Color};

/// The alignment of a text with its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The place is its start.
    Start,
    /// The place is its middle.
    Middle,
    /// The place is its end.
    End,
}

/// A line of text, a line, a box or a color ramp; positions in pixels from the upper left corner.
#[derive(Debug, Clone, PartialEq)]
pub enum Primitive {
    /// A line of text.
    Text {
        /// Its baseline's place.
        at: DVec2,
        /// Its alignment.
        anchor: Anchor,
        /// The size of its letters.
        size_px: f64,
        /// Their color.
        color: Color,
        /// The color around the letters, if they may be over points.
        halo: Option<Color>,
        /// Its content.
        text: String,
    },
    /// A straight line.
    Line {
        /// One end.
        from: DVec2,
        /// The other.
        to: DVec2,
        /// Its width.
        width_px: f64,
        /// Its color.
        color: Color,
    },
    /// A filled box.
    Box {
        /// The upper left corner.
        min: DVec2,
        /// The lower right one.
        max: DVec2,
        /// Its color.
        color: Color,
    },
    /// A ramp of colors from left to right.
    Ramp {
        /// The upper left corner.
        min: DVec2,
        /// The lower right one.
        max: DVec2,
        /// Its colors at equal steps.
        stops: Vec<Color>,
    },
}

/// Light on dark, or dark on light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Theme {
    /// A dark background.
    #[default]
    Dark,
    /// A light background, for print.
    Light,
}

impl Theme {
    /// The background of a picture.
    pub fn background(self) -> Background {
        match self {
            Self::Dark => Background {
                top: [0x26, 0x29, 0x30, 255],
                bottom: [0x14, 0x16, 0x1a, 255],
            },
            Self::Light => Background {
                top: [255; 4],
                bottom: [0xee, 0xef, 0xf2, 255],
            },
        }
    }

    /// The color of text.
    pub fn ink(self) -> Color {
        match self {
            Self::Dark => [0xf0, 0xf1, 0xf4, 255],
            Self::Light => [0x1a, 0x1c, 0x20, 255],
        }
    }

    /// The color of less important text.
    pub fn quiet_ink(self) -> Color {
        match self {
            Self::Dark => [0xb6, 0xba, 0xc2, 255],
            Self::Light => [0x55, 0x59, 0x61, 255],
        }
    }

    /// The color under a text that may cross points.
    pub fn paper(self) -> Color {
        match self {
            Self::Dark => [0x16, 0x18, 0x1c, 225],
            Self::Light => [255, 255, 255, 230],
        }
    }
}
