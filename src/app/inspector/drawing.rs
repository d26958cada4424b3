//! One examined cloud as a picture, without a window: what `render`, the report's pictures and the gallery's
//! thumbnails are.

use glam::DVec3;

use crate::evaluate::{Examined, TruthChoice, reference_of};
use crate::geometry::Plane;
use crate::method::axis_error_rad;
use crate::method::{Analysis, AxisEstimate, PlaneDetail, plane_detail};
use crate::render::{Camera, DrawError, Gpu, Image, Projection, Viewport, draw_image};
use crate::view::caption;
use crate::view::{
    Coloring, ColoringError, Overlay, Overlays, Page, SceneSettings, ShownPoints, Subject, Theme, ViewPreset,
    annotate, build_scene, color_points, framed_points, insets, line_scale,
};
use crate::view::{PictureError, paint_annotations, text_width_px};

/// What is drawn of a cloud, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// What the points' colors show.
    pub coloring: Coloring,
    /// The plane that is looked at, by g and h; the best one where there is none.
    pub plane: Option<[usize; 2]>,
    /// Where it is looked from.
    pub view: ViewPreset,
    /// The very camera, whatever the view.
    pub camera: Option<Camera>,
    /// The axis that the computed one is compared with; the first that is known where this one is not.
    pub reference: TruthChoice,
    /// What is drawn over the points.
    pub overlays: Overlays,
    /// Light on dark, or dark on light.
    pub theme: Theme,
    /// A point's diameter in pixels; by the number of points and pixels where there is none.
    pub point_size_px: Option<f64>,
    /// Whether parallel lines stay parallel.
    pub projection: Projection,
    /// Whether depth is shaded.
    pub is_shaded: bool,
    /// Whether the angle between the axes stands beside them.
    pub has_angle: bool,
}

/// Why a cloud was not drawn. A clause.
#[derive(Debug, thiserror::Error)]
pub enum DrawingError {
    /// The grid has no such plane.
    #[error("there is no plane {g},{h}: both numbers run from 1 to {u}")]
    NoSuchPlane {
        /// The step of α that was asked for.
        g: usize,
        /// The step of β that was asked for.
        h: usize,
        /// The grid's steps.
        u: usize,
    },
    /// There is no plane to look along.
    #[error("there is no plane to look along the normal of")]
    NoPlane,
    /// There is no axis to look along.
    #[error("there is no axis to look along")]
    NoAxis,
    /// The points have not what is to be shown.
    #[error(transparent)]
    Coloring(#[from] ColoringError),
    /// The adapter failed.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// Texts could not be written over it.
    #[error(transparent)]
    Picture(#[from] PictureError),
}

/// The plane that is looked at, and what follows from it.
struct Looked {
    plane: Plane,
    index: usize,
    detail: PlaneDetail,
    axis: Option<AxisEstimate>,
}

/// Draws a cloud that the caption calls `name`.
///
/// # Errors
/// Where what is asked for is not there, or the adapter fails.
pub fn draw(examined: &Examined, drawing: &Drawing, name: &str, gpu: &Gpu) -> Result<Image, DrawingError> {
    let Examined {
        fruit,
        analysis,
        references,
        ..
    } = examined;
    let looked = looked_at(analysis, drawing.plane)?;
    let reference = reference_of(references, drawing.reference).or(references.first());
    let shown = ShownPoints::new(fruit.cloud(), analysis);
    let subject = Subject {
        shown: &shown,
        analysis,
        detail: looked.as_ref().map(|l| &l.detail),
    };
    let colored = color_points(subject, drawing.coloring)?;

    let overlays = &drawing.overlays;
    let has = |overlay| overlays.has(overlay);
    let axis = looked.as_ref().and_then(|l| l.axis.as_ref());
    let settings = SceneSettings {
        overlays,
        theme: drawing.theme,
        point_size_px: drawing
            .point_size_px
            .unwrap_or_else(|| default_point_size(shown.len(), drawing.size_px))
            as f32,
        eye_dome_strength: if drawing.is_shaded { 1.0 } else { 0.0 },
        plane: looked.as_ref().map(|l| l.plane),
        axis,
        reference,
        references,
    };
    let mut scene = build_scene(subject, &colored, &settings);
    let [width, height] = drawing.size_px;
    scene.scale_lines(line_scale(height));

    let index = looked.as_ref().map(|l| l.index);
    let caption = caption(name, analysis, index, axis, reference);
    let both = axis
        .zip(reference)
        .filter(|_| drawing.has_angle && has(Overlay::Axis) && has(Overlay::Reference));
    // Where the drawn line ends: 0.62 of the fruit's size, which is twice the shading's length.
    let reach = 1.24 * f64::from(scene.eye_dome.scale);
    let angle = both.map(|(axis, reference)| angle_label(axis, reference, reach));
    let viewport = Viewport::new(width.into(), height.into());
    let page = Page {
        viewport,
        theme: drawing.theme,
        legend: has(Overlay::Legend).then_some(&colored.legend),
        scale_unit: has(Overlay::Scale).then(|| fruit.unit.symbol()),
        has_triad: has(Overlay::Triad),
        caption: if has(Overlay::Caption) { &caption } else { &[] },
        label: angle.as_ref().map(|(place, text)| (*place, text.as_str())),
    };
    let direction = match drawing.view {
        ViewPreset::Normal => looked.as_ref().ok_or(DrawingError::NoPlane)?.plane.normal,
        ViewPreset::Axis => axis.ok_or(DrawingError::NoAxis)?.direction,
        _ => DVec3::ZERO,
    };
    let preset_camera = || {
        drawing.view.camera(
            &framed_points(subject, &settings),
            analysis.params.viewpoint,
            direction,
            drawing.projection,
            viewport,
            insets(&page, &text_width_px),
        )
    };
    let camera = drawing.camera.unwrap_or_else(preset_camera);
    let mut image = draw_image(gpu, &scene, &camera, width, height)?;
    paint_annotations(&mut image, &annotate(&page, &camera, &text_width_px))?;
    Ok(image)
}

/// The angle between two axes in words, and its place: `reach` from the axis' origin, at its upper end.
fn angle_label(axis: &AxisEstimate, reference: &AxisEstimate, reach: f64) -> (DVec3, String) {
    let text = format!("{:.1}° apart", axis_error_rad(axis, reference).to_degrees());
    let upward = if axis.direction.y > 0.0 {
        -axis.direction
    } else {
        axis.direction
    };
    (axis.origin + reach * upward, text)
}

fn looked_at(analysis: &Analysis, choice: Option<[usize; 2]>) -> Result<Option<Looked>, DrawingError> {
    let grid = analysis.planes.grid;
    let index = match choice {
        None => match analysis.ranking.best() {
            Ok(index) => index,
            // Why there is none, a warning has told.
            Err(_) => return Ok(None),
        },
        Some([g, h]) => grid
            .index_of(g, h)
            .ok_or(DrawingError::NoSuchPlane { g, h, u: grid.u() })?,
    };
    let (plane, params) = (analysis.plane(index), &analysis.params);
    // Nobody calls it off.
    let Ok(detail) = plane_detail(&analysis.surface, params.unit, plane, params.viewpoint, &()) else {
        return Ok(None);
    };
    Ok(Some(Looked {
        plane,
        index,
        detail,
        axis: analysis.axis_of(index).ok(),
    }))
}

/// So large that the points of a fruit close up to a surface, within reason.
fn default_point_size(points: usize, [width, height]: [u32; 2]) -> f64 {
    let fruit_px = 0.2 * f64::from(width) * f64::from(height);
    (1.7 * (fruit_px / points.max(1) as f64).sqrt()).clamp(2.0, 12.0)
}
