//! A fitted body as it is drawn over the points: its axis, the other axes that were considered, its translucent surface.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::legend::{Legend, Swatch};
use super::palette::{NEUTRAL, SKY, VERMILION};
use super::scene::axis_ends;
use crate::estimate::Surface;
use crate::estimate::body::Body;
use crate::method::AxisEstimate;
use crate::render::{Color, Line, Polygon, Scene};

/// The color of the body's axis, wherever it is shown.
pub const BODY_AXIS_COLOR: Color = VERMILION;
/// The color of the body's surface near the points.
const SEEN: Color = SKY;
/// The color of the body's surface that no point shows.
const UNSEEN: Color = NEUTRAL;
/// The opacity of the surface, of 255. Front and back add up.
const OPACITY: u8 = 76;

/// The facets of a surface from pole to pole, and around.
const FACETS: (usize, usize) = (24, 40);
/// The distance from the nearest of the sampled points, in units of the fruit's size, up to which the surface is seen.
const NEAR: f64 = 0.16;

/// The parts of a fitted body that are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BodyParts {
    /// Its axis.
    pub axis: bool,
    /// The other axes that were considered.
    pub alternatives: bool,
    /// Its surface, seen and unseen.
    pub surface: bool,
}

/// One flat piece of a body's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet {
    /// Its corners in order, in the file's unit and frame.
    pub corners: [DVec3; 4],
    /// Whether points lie near it.
    pub is_seen: bool,
    /// The cosine between its normal and the ray from the viewpoint, 0 to 1.
    pub facing: f64,
}

/// A fitted body, ready to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyDrawing {
    /// Its axis.
    pub axis: AxisEstimate,
    /// The other axes that were considered, the best first.
    pub alternatives: Vec<AxisEstimate>,
    /// Its surface.
    pub facets: Vec<Facet>,
}

impl BodyDrawing {
    /// Cuts a body that was fitted to `surface` into facets.
    pub fn new(body: &Body, surface: &Surface, axis: AxisEstimate, alternatives: Vec<AxisEstimate>) -> Self {
        let (rings, around) = FACETS;
        let corner = |ring: usize, step: usize| {
            let polar_rad = ring as f64 / rings as f64 * PI;
            body.point(polar_rad, (step % around) as f64 / around as f64 * TAU)
        };
        let corners: Vec<Vec<DVec3>> = (0..=rings)
            .map(|ring| (0..around).map(|step| corner(ring, step)).collect())
            .collect();
        let near = (NEAR * surface.size_cm).powi(2);
        let facet = |(ring, step): (usize, usize)| {
            let next = (step + 1) % around;
            let four = [
                corners[ring][step],
                corners[ring][next],
                corners[ring + 1][next],
                corners[ring + 1][step],
            ];
            let middle = 0.25 * four.iter().sum::<DVec3>();
            let normal = (four[2] - four[0]).cross(four[3] - four[1]).normalize_or_zero();
            let nearby = |point: &DVec3| point.distance_squared(middle) < near;
            Facet {
                corners: four.map(|corner| surface.in_file(corner)),
                is_seen: surface.fine.points.iter().any(nearby),
                facing: normal.dot(middle.normalize_or_zero()).abs(),
            }
        };
        let places = (0..rings).flat_map(|ring| (0..around).map(move |step| (ring, step)));
        Self {
            axis,
            alternatives,
            facets: places.map(facet).collect(),
        }
    }

    /// Adds the chosen parts to a scene, whose fruit has the given size in its own unit, and their colors to its legend.
    pub fn add_to(&self, scene: &mut Scene, legend: &mut Legend, parts: BodyParts, size: f64) {
        let outline = [0x10, 0x12, 0x14, 255];
        let swatch = |color: Color, label: &str| Swatch {
            color,
            label: label.into(),
            count: None,
        };
        if parts.surface {
            scene.polygons.extend(self.facets.iter().map(Facet::polygon));
            legend.swatches.push(swatch(SEEN, "fitted body, seen"));
            legend.swatches.push(swatch(UNSEEN, "fitted body, not seen"));
        }
        if parts.alternatives && !self.alternatives.is_empty() {
            let faint = [BODY_AXIS_COLOR[0], BODY_AXIS_COLOR[1], BODY_AXIS_COLOR[2], 110];
            for axis in &self.alternatives {
                let [from, to] = axis_ends(axis, 0.8 * size);
                let line = Line::new(from, to, faint, 1.6).dashed().shining_through(0.5);
                scene.lines.push(line);
            }
            legend.swatches.push(swatch(faint, "body's other axes"));
        }
        if parts.axis {
            let [from, to] = axis_ends(&self.axis, size);
            scene.lines.push(
                Line::new(from, to, BODY_AXIS_COLOR, 3.0)
                    .outlined(outline, 1.2)
                    .shining_through(0.55),
            );
            legend.swatches.push(swatch(BODY_AXIS_COLOR, "body's axis"));
        }
    }
}

impl Facet {
    /// Its polygon, darker where it is turned away from the viewpoint.
    fn polygon(&self) -> Polygon {
        let [r, g, b, _] = if self.is_seen { SEEN } else { UNSEEN };
        let light = 0.5 + 0.5 * self.facing.clamp(0.0, 1.0);
        // At most the color's own value.
        let shaded = |value: u8| (light * f64::from(value)).round() as u8;
        Polygon {
            corners_in_world: self.corners.to_vec(),
            color: [shaded(r), shaded(g), shaded(b), OPACITY],
        }
    }
}
