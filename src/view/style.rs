//! The style of a view, independent of the cloud.

use super::coloring::Coloring;
use super::overlays::{Overlay, Overlays};
use super::primitive::Theme;

/// The settings that every cloud is drawn with.
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    /// The meaning of the points' colors.
    pub coloring: Coloring,
    /// The overlays that are on.
    pub overlays: Overlays,
    /// Light on dark, or dark on light.
    pub theme: Theme,
    /// A point's diameter, in logical pixels in a window and in pixels in a picture; `None` for the one at which
    /// the points close up to a surface.
    pub point_size: Option<f32>,
    /// Whether eye-dome lighting darkens steps in depth.
    pub eye_dome: bool,
}

impl Default for Style {
    /// The window's style: it has no caption, since the window's panels hold the same facts.
    fn default() -> Self {
        let mut overlays = Overlays::default();
        overlays.set(Overlay::Caption, false);
        Self {
            coloring: Coloring::Side,
            overlays,
            theme: Theme::Dark,
            point_size: None,
            eye_dome: true,
        }
    }
}

impl Style {
    /// A point's diameter in logical pixels, in a window's view of usual size.
    pub fn point_size_in_window(&self, points: usize) -> f32 {
        let closing = || closing_diameter(points, 900.0 * 700.0).clamp(1.5, 9.0) as f32;
        self.point_size.unwrap_or_else(closing)
    }

    /// A point's diameter in pixels, in a picture of `width` by `height` pixels.
    pub fn point_size_in_picture(&self, points: usize, [width, height]: [u32; 2]) -> f32 {
        let area_px = f64::from(width) * f64::from(height);
        let closing = || closing_diameter(points, area_px).clamp(2.0, 12.0) as f32;
        self.point_size.unwrap_or_else(closing)
    }
}

/// The diameter in pixels at which so many points close up to a surface. A fruit fills about a fifth of the area.
fn closing_diameter(points: usize, area_px: f64) -> f64 {
    let fruit_px = 0.2 * area_px;
    1.7 * (fruit_px / points.max(1) as f64).sqrt()
}
