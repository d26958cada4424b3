//! The view as a picture of any size.

use super::look::Look;
use crate::app::source::Source;
use crate::app::state::State;
use crate::render::{Image, Viewport};
use crate::view::{Page, PageFacts};

/// Draws what the window shows, as `render` does; points keep their size relative to the picture.
pub(in crate::app) fn draw(
    state: &State,
    look: &Look,
    [width_px, height_px]: [u32; 2],
) -> Result<Image, String> {
    let viewport = Viewport::new(width_px.into(), height_px.into());
    let ratio = picture_scale(state, height_px) / state.pixels_per_point;
    let mut scene = (*look.scene).clone();
    for points in &mut scene.points {
        points.size_px *= ratio;
    }
    scene.scale_lines(crate::view::line_scale(height_px) / state.pixels_per_point);
    let gpu = crate::render::Gpu::headless().map_err(|e| e.to_string())?;
    let page = page(state, look, viewport);
    crate::view::draw_page(&gpu, &scene, &state.camera, &page, [width_px, height_px])
        .map_err(|e| e.to_string())
}

/// The page over a look, for a view of that size.
pub fn page<'a>(state: &State, look: &'a Look, viewport: Viewport) -> Page<'a> {
    let facts = PageFacts {
        unit: state.walked.as_ref().map(|walked| walked.fruit.unit),
        shown: &look.shown,
        analysis: look.analysis.as_deref(),
        plane: look.plane_index,
        axis: look.axis.as_ref(),
        reference: look.reference.as_ref(),
        legend: &look.legend,
    };
    let name = state.source().map(Source::name).unwrap_or_default();
    Page::new(&facts, &name, &state.shown_style(), viewport)
}

/// The number of a picture's pixels per logical pixel of the view.
pub(in crate::app) fn picture_scale(state: &State, height_px: u32) -> f32 {
    (f64::from(height_px) / state.viewport.height_px) as f32
}
