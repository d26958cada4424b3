//! The view as a picture of any size.

use super::look::Look;
use super::state::State;
use crate::render::Image;

/// Draws what the window shows; lines and points keep their size relative to the picture.
#[cfg(feature = "window")]
pub(super) fn draw(state: &State, look: &Look, [width_px, height_px]: [u32; 2]) -> Result<Image, String> {
    use crate::io::{paint_annotations, text_width_px};
    use crate::render::{Gpu, Viewport, draw_image};
    use crate::view::annotate;

    let viewport = Viewport::new(width_px.into(), height_px.into());
    let ratio = f64::from(height_px) / (state.viewport.height_px * f64::from(state.pixels_per_point));
    let mut scene = (*look.scene).clone();
    for points in &mut scene.points {
        points.size_px *= ratio as f32;
    }
    for line in &mut scene.lines {
        line.width_px *= ratio as f32;
        line.outline_px *= ratio as f32;
    }
    let gpu = Gpu::headless().map_err(|e| e.to_string())?;
    let mut image =
        draw_image(&gpu, &scene, &state.camera, width_px, height_px).map_err(|e| e.to_string())?;
    let written = super::written::Written::of(state, look);
    let page = written.page(state, viewport);
    paint_annotations(&mut image, &annotate(&page, &state.camera, &text_width_px))
        .map_err(|e| e.to_string())?;
    Ok(image)
}

/// Without a renderer there are no pictures.
#[cfg(not(feature = "window"))]
pub(super) fn draw(_: &State, _: &Look, _: [u32; 2]) -> Result<Image, String> {
    Err("this build draws no pictures: it lacks the feature `window`.".into())
}
