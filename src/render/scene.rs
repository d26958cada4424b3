//! The scene as plain data: points, lines, planes, background.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::geometry::Extent;

/// Red, green, blue, opacity, 0 to 255 (sRGB).
pub type Color = [u8; 4];

/// A ball that holds everything that is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its center.
    pub center_in_world: DVec3,
    /// Its radius, in the world's unit.
    pub radius: f64,
}

impl Bounds {
    /// The ball around a box.
    pub fn around(extent: &Extent) -> Self {
        Self {
            center_in_world: extent.center(),
            radius: 0.5 * extent.size().length(),
        }
    }
}

/// Round points, all of one size.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Points {
    /// Positions less the scene's origin. Shared, so that a scene can be copied and given other lines
    /// without a copy of its points.
    pub positions: Arc<[Vec3]>,
    /// One color per point; the opacity is not used.
    pub colors: Arc<[Color]>,
    /// A number that changes with `positions`: the renderer then sends them to the GPU again.
    pub positions_generation: u64,
    /// A number that changes with `colors`.
    pub colors_generation: u64,
    /// Diameter in pixels.
    pub size_px: f32,
}

/// Whether a line is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    /// In one piece.
    #[default]
    Solid,
    /// Eight pixels of line, six of gap.
    Dashed,
}

/// A straight piece of line. With both ends at one place it is a disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// One end.
    pub from_in_world: DVec3,
    /// The other.
    pub to_in_world: DVec3,
    /// Its color.
    pub color: Color,
    /// Its width in pixels, without the outline.
    pub width_px: f32,
    /// The color of the outline.
    pub outline_color: Color,
    /// The width of the outline on each side, in pixels; zero for none.
    pub outline_px: f32,
    /// Whether it is broken.
    pub dash: Dash,
    /// The opacity of the parts that points hide, from 0 (hidden) to 1 (as if in front).
    pub hidden_opacity: f32,
}

impl Line {
    /// A solid line without outline that points hide.
    pub fn new(from_in_world: DVec3, to_in_world: DVec3, color: Color, width_px: f32) -> Self {
        Self {
            from_in_world,
            to_in_world,
            color,
            width_px,
            outline_color: [0; 4],
            outline_px: 0.0,
            dash: Dash::Solid,
            hidden_opacity: 0.0,
        }
    }

    /// The line with `color` around it.
    #[must_use]
    pub fn outlined(self, color: Color, outline_px: f32) -> Self {
        Self {
            outline_color: color,
            outline_px,
            ..self
        }
    }

    /// The line broken into dashes.
    #[must_use]
    pub fn dashed(self) -> Self {
        Self {
            dash: Dash::Dashed,
            ..self
        }
    }

    /// The line shining through what hides it.
    #[must_use]
    pub fn shining_through(self, hidden_opacity: f32) -> Self {
        Self {
            hidden_opacity,
            ..self
        }
    }
}

/// A flat convex polygon, usually translucent.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Its corners in order.
    pub corners_in_world: Vec<DVec3>,
    /// Its color and opacity.
    pub color: Color,
}

/// The background: a gradient from top to bottom. The opacity is not used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Background {
    /// At the upper edge.
    pub top: Color,
    /// At the lower edge.
    pub bottom: Color,
}

/// Eye-dome lighting: darkens what lies behind its neighbors in the picture, which makes shape
/// visible without normals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EyeDome {
    /// 0 is off, 1 the usual strength.
    pub strength: f32,
    /// The length that counts as a deep step, in the world's unit: about the fruit's radius.
    pub scale: f32,
}

/// Everything that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The origin of the points' `f32` positions: somewhere in the cloud.
    pub origin_in_world: DVec3,
    /// Clouds of points.
    pub points: Vec<Points>,
    /// Lines.
    pub lines: Vec<Line>,
    /// A number that changes with `lines`.
    pub lines_generation: u64,
    /// Planes.
    pub polygons: Vec<Polygon>,
    /// The background.
    pub background: Background,
    /// Shading by depth.
    pub eye_dome: EyeDome,
    /// A ball around the whole content.
    pub bounds: Bounds,
}

impl Scene {
    /// A scene without content.
    pub fn empty(background: Background) -> Self {
        Self {
            origin_in_world: DVec3::ZERO,
            points: Vec::new(),
            lines: Vec::new(),
            lines_generation: 0,
            polygons: Vec::new(),
            background,
            eye_dome: EyeDome {
                strength: 0.0,
                scale: 1.0,
            },
            bounds: Bounds {
                center_in_world: DVec3::ZERO,
                radius: 1.0,
            },
        }
    }

    /// Widens every line by a factor: for a picture of many pixels.
    pub fn scale_lines(&mut self, factor: f32) {
        for line in &mut self.lines {
            line.width_px *= factor;
            line.outline_px *= factor;
        }
    }

    /// Fits the bounds to the content, in time linear in the points.
    pub fn fit_bounds(&mut self) {
        let origin = self.origin_in_world;
        // The corners of each cloud's own bounds, which take a tenth of the time that its points would.
        let points = self.points.iter().flat_map(|p| {
            let (min, max) = p
                .positions
                .iter()
                .filter(|p| p.is_finite())
                .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), &p| {
                    (min.min(p), max.max(p))
                });
            [min, max].map(|corner| origin + corner.as_dvec3())
        });
        let lines = self.lines.iter().flat_map(|l| [l.from_in_world, l.to_in_world]);
        let corners = self
            .polygons
            .iter()
            .flat_map(|p| p.corners_in_world.iter().copied());
        let mut extent: Option<Extent> = None;
        for p in points.chain(lines).chain(corners).filter(|p| p.is_finite()) {
            let e = extent.get_or_insert(Extent { min: p, max: p });
            (e.min, e.max) = (e.min.min(p), e.max.max(p));
        }
        if let Some(extent) = extent {
            self.bounds = Bounds::around(&extent);
        }
    }
}
