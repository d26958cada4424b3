//! Pictures of clouds without a window: `render`, the report's pictures, the gallery's thumbnails, and the window's
//! view saved to a file.

use glam::DVec3;

use super::coloring::ColoringError;
use super::compose::{Composition, SceneRequest, compose};
use super::layout::{insets, lay_out};
use super::page::{Page, PageFacts};
use super::picture::{PictureError, paint_primitives, text_width_px};
use super::preset::ViewPreset;
use super::scene::line_scale;
use super::shown::ShownPoints;
use super::style::Style;
use crate::geometry::{Cloud, Unit};
use crate::method::{Analysis, AxisEstimate};
use crate::parallel::{Cancelled, Watch};
use crate::render::{Camera, DrawError, Gpu, Image, Projection, Scene, Viewport, draw_image};

/// The settings of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// The style of the cloud.
    pub style: Style,
    /// The plane's steps g and h; `None` for the best plane.
    pub plane: Option<[usize; 2]>,
    /// The direction of the view.
    pub view: ViewPreset,
    /// An exact camera, which overrides `view`.
    pub camera: Option<Camera>,
    /// Whether parallel lines stay parallel.
    pub projection: Projection,
    /// Whether the angle between the axes is written beside them.
    pub has_angle: bool,
}

/// An analyzed cloud to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct DrawnCloud<'a> {
    /// The name in the caption.
    pub name: &'a str,
    /// The file's cloud.
    pub cloud: &'a Cloud,
    /// The unit of its coordinates.
    pub unit: Unit,
    /// Its analysis.
    pub analysis: &'a Analysis,
    /// All axes to compare the computed one with.
    pub references: &'a [AxisEstimate],
    /// The one of them that the computed axis is compared with.
    pub reference: Option<&'a AxisEstimate>,
}

/// The reason why a cloud was not drawn. A clause.
#[derive(Debug, thiserror::Error)]
pub enum DrawingError {
    /// The grid has no such plane.
    #[error("there is no plane {g},{h}: both numbers run from 1 to {u}")]
    NoSuchPlane {
        /// The requested step of α.
        g: usize,
        /// The requested step of β.
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
    /// The points lack the property that the coloring shows.
    #[error(transparent)]
    Coloring(#[from] ColoringError),
    /// The adapter failed.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The page could not be painted.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The watch called the work off.
    #[error("drawing was called off")]
    Cancelled(#[from] Cancelled),
}

/// Draws an analyzed cloud.
///
/// # Errors
/// Returns an error if the plane, axis, colors or labels that the drawing asks for do not exist, if the adapter
/// fails, or if the watch calls the work off.
pub fn draw_cloud(
    drawn: &DrawnCloud<'_>,
    drawing: &Drawing,
    gpu: &Gpu,
    watch: &dyn Watch,
) -> Result<Image, DrawingError> {
    let DrawnCloud {
        analysis, reference, ..
    } = *drawn;
    let shown = ShownPoints::new(drawn.cloud, analysis);
    let style = &drawing.style;
    let request = SceneRequest {
        shown: &shown,
        analysis: Some(analysis),
        plane: chosen_plane(analysis, drawing.plane)?,
        detail: None,
        reference,
        references: drawn.references,
        style,
        point_size_px: style.point_size_in_picture(shown.len(), drawing.size_px),
        labels: None,
        brush_cm: None,
    };
    let Composition {
        plane,
        colored,
        fallback,
        mut scene,
    } = compose(&request, watch)?;
    if let Some(why) = fallback {
        return Err(why.into());
    }
    let [width, height] = drawing.size_px;
    scene.scale_lines(line_scale(height));

    let axis = plane.as_ref().and_then(|plane| plane.axis.as_ref());
    let facts = PageFacts {
        unit: Some(drawn.unit),
        shown: &shown,
        analysis: Some(analysis),
        plane: request.plane,
        axis,
        reference,
        legend: &colored.legend,
    };
    let viewport = Viewport::new(width.into(), height.into());
    let mut page = Page::new(&facts, drawn.name, style, viewport);
    page.label = page.label.filter(|_| drawing.has_angle);
    let direction = match drawing.view {
        ViewPreset::Normal => plane.as_ref().ok_or(DrawingError::NoPlane)?.plane.normal,
        ViewPreset::Axis => axis.ok_or(DrawingError::NoAxis)?.direction,
        _ => DVec3::ZERO,
    };
    let preset_camera = || {
        drawing.view.camera(
            &request.framed_points(plane.as_ref()),
            analysis.params.viewpoint,
            direction,
            drawing.projection,
            viewport,
            insets(&page, &text_width_px),
        )
    };
    let camera = drawing.camera.unwrap_or_else(preset_camera);
    draw_page(gpu, &scene, &camera, &page, drawing.size_px)
}

/// Draws a scene with its page.
///
/// # Errors
/// Returns an error if the size is out of range, the adapter fails, or there is no memory for the page.
pub fn draw_page(
    gpu: &Gpu,
    scene: &Scene,
    camera: &Camera,
    page: &Page<'_>,
    [width_px, height_px]: [u32; 2],
) -> Result<Image, DrawingError> {
    let mut image = draw_image(gpu, scene, camera, width_px, height_px)?;
    paint_primitives(&mut image, &lay_out(page, camera, &text_width_px))?;
    Ok(image)
}

/// The index of a plane in the grid; `None` if there is no best plane.
fn chosen_plane(analysis: &Analysis, choice: Option<[usize; 2]>) -> Result<Option<usize>, DrawingError> {
    let grid = analysis.planes.grid;
    match choice {
        // A warning of the analysis gives the reason.
        None => Ok(analysis.ranking.best().ok()),
        Some([g, h]) => match grid.index_of(g, h) {
            Some(index) => Ok(Some(index)),
            None => Err(DrawingError::NoSuchPlane { g, h, u: grid.u() }),
        },
    }
}
