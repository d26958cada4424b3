//! The selection of points by lasso or brush: regions of the view in pixels, and the points' projections.

mod brush;
mod lasso;
mod screen;

use glam::DVec2;

pub use brush::Brush;
pub use lasso::Lasso;
pub use screen::Screen;

/// A part of the view, in logical pixels.
#[derive(Debug, Clone)]
pub enum Region {
    /// The inside of a closed line.
    Lasso(Lasso),
    /// The trace of a disc.
    Brush(Brush),
}

impl Region {
    /// Whether a pixel lies in it.
    pub fn contains(&self, pixel: DVec2) -> bool {
        match self {
            Self::Lasso(lasso) => lasso.contains(pixel),
            Self::Brush(brush) => brush.contains(pixel),
        }
    }
}
