//! The scene of an analysis.

use std::sync::Arc;

use glam::DVec3;

use super::coloring::{Colored, Subject};
use super::overlays::Overlay;
use super::palette::{ORANGE, PINK, SKY};
use super::primitive::Theme;
use super::shown::ShownPoints;
use super::style::Style;
use crate::geometry::{Extent, Plane};
use crate::method::{AxisEstimate, AxisSource};
use crate::render::{Color, EyeDome, Line, Points, Polygon, Scene};

/// The settings of a scene.
#[derive(Debug, Clone, Copy)]
pub struct SceneSettings<'a> {
    /// The style of the cloud.
    pub style: &'a Style,
    /// A point's diameter in physical pixels.
    pub point_size_px: f32,
    /// The plane.
    pub plane: Option<Plane>,
    /// The plane's axis.
    pub axis: Option<&'a AxisEstimate>,
    /// The axis that it is compared with.
    pub reference: Option<&'a AxisEstimate>,
    /// All axes to compare with.
    pub references: &'a [AxisEstimate],
}

impl SceneSettings<'_> {
    fn has(&self, overlay: Overlay) -> bool {
        self.style.overlays.has(overlay)
    }

    fn theme(&self) -> Theme {
        self.style.theme
    }
}

/// The computed axis is green, as in the paper's figures.
pub const AXIS_COLOR: Color = [0x2f, 0xd0, 0x68, 255];
/// The color of a further reference, so that several can be told apart.
pub fn reference_color(source: &AxisSource) -> Color {
    match source {
        AxisSource::Peduncle => [0xf0, 0xe4, 0x42, 255],
        AxisSource::PeduncleDirection => ORANGE,
        AxisSource::Simulation => SKY,
        _ => PINK,
    }
}

const WHITE: Color = [255; 4];
const PLANE: Color = [0x8f, 0xb8, 0xde, 255];
/// Numbers of lines that can still be told apart.
const PARTNER_LINES: usize = 120;
const NORMAL_LINES: usize = 400;

/// Builds the scene of an analysis. `colored` comes from [`super::color_points`]. Generations are zero: a caller that
/// draws several scenes after each other sets them.
pub fn build_scene(subject: Subject<'_>, colored: &Colored, settings: &SceneSettings<'_>) -> Scene {
    let extent = subject.shown.extent;
    let size = extent.size().length().max(1e-9);
    let has = |overlay| settings.has(overlay);
    let local = |p: DVec3| (p - extent.center()).as_vec3();
    let mut colors = colored.colors.clone();
    if let Some(plane) = settings.plane.filter(|_| has(Overlay::Plane)) {
        let positions = &subject.shown.positions;
        brighten_cut(positions, &mut colors, &plane, 0.006 * size, settings.theme());
    }
    let mut scene = points_alone(subject.shown, colors.into(), settings);
    if let Some(plane) = settings.plane.filter(|_| has(Overlay::Ghost)) {
        let used = subject.analysis.surface.points();
        scene.points.push(Points {
            positions: used.iter().map(|&p| local(plane.reflect_point(p))).collect(),
            colors: vec![PINK; used.len()].into(),
            size_px: 0.6 * settings.point_size_px,
            ..Points::default()
        });
    }
    if let Some(plane) = settings.plane {
        add_plane(&mut scene, subject, &plane, settings, size);
    }
    add_center_and_viewpoint(&mut scene, subject, settings);
    let outline = [0x10, 0x12, 0x14, 255];
    let drawn = settings.reference.filter(|_| has(Overlay::Reference));
    let others = settings.references.iter().filter(|&other| Some(other) != drawn);
    for other in others.filter(|_| has(Overlay::References)) {
        let [from, to] = axis_ends(other, size);
        scene.lines.push(
            Line::new(from, to, reference_color(&other.source), 2.2)
                .outlined(outline, 1.0)
                .dashed()
                .shining_through(0.7),
        );
    }
    for (estimate, overlay, color) in [
        (settings.reference, Overlay::Reference, WHITE),
        (settings.axis, Overlay::Axis, AXIS_COLOR),
    ] {
        if let Some(axis) = estimate.filter(|_| has(overlay)) {
            let [from, to] = axis_ends(axis, size);
            scene.lines.push(
                Line::new(from, to, color, 3.0)
                    .outlined(outline, 1.2)
                    .shining_through(0.55),
            );
        }
    }
    if has(Overlay::Partners) {
        add_partner_lines(&mut scene, subject);
    }
    if has(Overlay::Normals) {
        add_normals(&mut scene, subject, 0.05 * size, settings.theme());
    }
    scene.fit_bounds();
    scene
}

/// Builds the scene of a cloud that was not analyzed: its points and nothing else.
pub fn build_bare_scene(shown: &ShownPoints, colored: &Colored, settings: &SceneSettings<'_>) -> Scene {
    let mut scene = points_alone(shown, colored.colors.clone().into(), settings);
    scene.fit_bounds();
    scene
}

fn points_alone(shown: &ShownPoints, colors: Arc<[Color]>, settings: &SceneSettings<'_>) -> Scene {
    let mut scene = Scene::empty(settings.theme().background());
    scene.origin_in_world = shown.extent.center();
    scene.eye_dome = EyeDome {
        strength: if settings.style.eye_dome { 1.0 } else { 0.0 },
        scale: (0.5 * shown.extent.size().length().max(1e-9)) as f32,
    };
    scene.points.push(Points {
        positions: shown.local_positions.clone(),
        colors,
        size_px: settings.point_size_px,
        ..Points::default()
    });
    scene
}

/// A sample of the points, large enough to locate their bulk.
fn bulk_sample(shown: &ShownPoints) -> impl Iterator<Item = DVec3> {
    let step = (shown.len() / 20_000).max(1);
    shown.positions.iter().step_by(step).copied()
}

/// The bulk of the points, without strays.
pub fn framed_cloud(shown: &ShownPoints) -> Vec<DVec3> {
    let extent = shown.extent;
    let margin = 0.2 * extent.size() + DVec3::splat(1e-3 * extent.size().length());
    let (min, max) = (extent.min - margin, extent.max + margin);
    bulk_sample(shown)
        .filter(|p| p.cmpge(min).all() && p.cmple(max).all())
        .collect()
}

/// The points that must be in the picture: the bulk of the cloud (without strays), the plane and the axes.
pub fn framed_points(shown: &ShownPoints, settings: &SceneSettings<'_>) -> Vec<DVec3> {
    let mut framed = framed_cloud(shown);
    let size = shown.extent.size().length();
    if let Some(plane) = settings.plane.filter(|_| settings.has(Overlay::Plane)) {
        framed.extend(plane_corners(shown, &plane, settings.axis));
    }
    for (estimate, overlay) in [
        (settings.axis, Overlay::Axis),
        (settings.reference, Overlay::Reference),
    ] {
        if let Some(axis) = estimate.filter(|_| settings.has(overlay)) {
            framed.extend(axis_ends(axis, size));
        }
    }
    framed
}

/// The ends of a drawn axis, which runs through the fruit and a little beyond. The upper end comes second.
pub(super) fn axis_ends(axis: &AxisEstimate, size: f64) -> [DVec3; 2] {
    let upward = if axis.direction.y > 0.0 {
        -axis.direction
    } else {
        axis.direction
    };
    let (below, above) = match axis.source {
        // It starts in the peduncle, and is drawn through the fruit as well.
        AxisSource::PeduncleDirection => (0.95, 0.3),
        _ => (0.5, 0.62),
    };
    [
        axis.origin - below * size * upward,
        axis.origin + above * size * upward,
    ]
}

/// The factor for the widths of lines in a picture of so many rows.
pub fn line_scale(height_px: u32) -> f32 {
    (height_px as f32 / 900.0).max(1.0)
}

fn mixed(a: Color, b: Color, share_of_b: f64) -> Color {
    std::array::from_fn(|i| {
        let (a, b) = (f64::from(a[i]), f64::from(b[i]));
        (a + share_of_b * (b - a)).round() as u8
    })
}

/// Brightens the points that the plane cuts through.
fn brighten_cut(positions: &[DVec3], colors: &mut [Color], plane: &Plane, half_width: f64, theme: Theme) {
    for (p, color) in positions.iter().zip(colors) {
        if plane.signed_distance(*p).abs() <= half_width {
            *color = mixed(*color, theme.ink(), 0.75);
        }
    }
}

/// A rectangle in the plane, along the axis if there is one, around the bulk of the points.
fn plane_corners(shown: &ShownPoints, plane: &Plane, axis: Option<&AxisEstimate>) -> [DVec3; 4] {
    let along = axis
        .map(|a| a.direction - a.direction.dot(plane.normal) * plane.normal)
        .and_then(DVec3::try_normalize)
        .unwrap_or_else(|| plane.normal.any_orthonormal_vector());
    let across = plane.normal.cross(along);
    let in_plane = |p: DVec3| {
        let q = p - plane.point;
        DVec3::new(q.dot(along), q.dot(across), 0.0)
    };
    let flat: Vec<DVec3> = bulk_sample(shown).map(in_plane).collect();
    let extent = Extent::robust(&flat).unwrap_or(Extent {
        min: DVec3::NEG_ONE,
        max: DVec3::ONE,
    });
    let margin = 0.12 * extent.size().length();
    let (low, high) = (extent.min - margin, extent.max + margin);
    let corner = |u: f64, v: f64| plane.point + u * along + v * across;
    [
        corner(low.x, low.y),
        corner(high.x, low.y),
        corner(high.x, high.y),
        corner(low.x, high.y),
    ]
}

fn add_plane(
    scene: &mut Scene,
    subject: Subject<'_>,
    plane: &Plane,
    settings: &SceneSettings<'_>,
    size: f64,
) {
    let corners = plane_corners(subject.shown, plane, settings.axis);
    if settings.has(Overlay::Plane) {
        let edge = match settings.theme() {
            Theme::Dark => PLANE,
            Theme::Light => [0x3a, 0x6e, 0xa5, 255],
        };
        let opacity = if settings.theme() == Theme::Dark { 52 } else { 64 };
        scene.polygons.push(Polygon {
            corners_in_world: corners.to_vec(),
            color: [edge[0], edge[1], edge[2], opacity],
        });
        for i in 0..4 {
            scene
                .lines
                .push(Line::new(corners[i], corners[(i + 1) % 4], edge, 1.4).shining_through(0.3));
        }
    }
    if settings.has(Overlay::Normal) {
        let tip = plane.point + 0.4 * size * plane.normal;
        let (a, b) = plane.normal.any_orthonormal_pair();
        let line = |from, to| Line::new(from, to, SKY, 2.2).shining_through(0.5);
        scene.lines.push(line(plane.point, tip));
        for side in [a, -a, b, -b] {
            scene
                .lines
                .push(line(tip, tip - 0.05 * size * plane.normal + 0.02 * size * side));
        }
    }
}

fn add_center_and_viewpoint(scene: &mut Scene, subject: Subject<'_>, settings: &SceneSettings<'_>) {
    let (center, viewpoint) = (subject.analysis.center, subject.analysis.params.viewpoint);
    let dark = [0x10, 0x12, 0x14, 255];
    let yellow = [0xf0, 0xe4, 0x42, 255];
    if settings.has(Overlay::Viewpoint) {
        let quiet = settings.theme().quiet_ink();
        scene.lines.push(
            Line::new(viewpoint, center, quiet, 1.4)
                .dashed()
                .shining_through(0.6),
        );
        scene.lines.push(
            Line::new(viewpoint, viewpoint, WHITE, 9.0)
                .outlined(dark, 1.5)
                .shining_through(1.0),
        );
    }
    if settings.has(Overlay::Center) {
        scene.lines.push(
            Line::new(center, center, yellow, 8.0)
                .outlined(dark, 1.5)
                .shining_through(0.9),
        );
    }
}

/// At most `most` of `count` indices, spread evenly.
fn sample(count: usize, most: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(count.div_ceil(most).max(1))
}

fn add_partner_lines(scene: &mut Scene, subject: Subject<'_>) {
    let Some(detail) = subject.detail else {
        return;
    };
    let surface = subject.analysis.surface.points();
    let with_partner: Vec<(usize, usize)> = (0..detail.points.len())
        .filter_map(|i| Some((i, detail.points[i].partner?.index)))
        .collect();
    for at in sample(with_partner.len(), PARTNER_LINES) {
        let (i, partner) = with_partner[at];
        let line = Line::new(surface[i], surface[partner], [0xcc, 0x79, 0xa7, 200], 1.2);
        scene.lines.push(line.shining_through(0.45));
    }
}

fn add_normals(scene: &mut Scene, subject: Subject<'_>, length: f64, theme: Theme) {
    let surface = &subject.analysis.surface;
    for i in sample(surface.len(), NORMAL_LINES) {
        let (p, normal) = (surface.points()[i], surface.normals()[i]);
        scene
            .lines
            .push(Line::new(p, p + length * normal, theme.quiet_ink(), 1.1));
    }
}
