//! The view as a picture of any size.

use super::look::Look;
use crate::app::state::State;
use crate::render::Image;

/// Draws what the window shows, as `render` does; points keep their size relative to the picture.
#[cfg(feature = "window")]
pub(in crate::app) fn draw(
    state: &State,
    look: &Look,
    [width_px, height_px]: [u32; 2],
) -> Result<Image, String> {
    use crate::render::{Gpu, Viewport, draw_image};
    use crate::view::lay_out;
    use crate::view::{paint_primitives, text_width_px};

    let viewport = Viewport::new(width_px.into(), height_px.into());
    let ratio = picture_scale(state, height_px) / state.pixels_per_point;
    let mut scene = (*look.scene).clone();
    for points in &mut scene.points {
        points.size_px *= ratio;
    }
    scene.scale_lines(crate::view::line_scale(height_px) / state.pixels_per_point);
    let gpu = Gpu::headless().map_err(|e| e.to_string())?;
    let mut image =
        draw_image(&gpu, &scene, &state.camera, width_px, height_px).map_err(|e| e.to_string())?;
    let written = super::written::Written::of(state, look);
    let page = written.page(state, viewport);
    paint_primitives(&mut image, &lay_out(&page, &state.camera, &text_width_px))
        .map_err(|e| e.to_string())?;
    Ok(image)
}

/// How many pixels of a picture a logical pixel of the view becomes.
pub(in crate::app) fn picture_scale(state: &State, height_px: u32) -> f32 {
    (f64::from(height_px) / state.viewport.height_px) as f32
}

/// Without a renderer there are no pictures.
#[cfg(not(feature = "window"))]
pub(in crate::app) fn draw(_: &State, _: &Look, _: [u32; 2]) -> Result<Image, String> {
    Err("this build draws no pictures: it lacks the feature `window`.".into())
}
