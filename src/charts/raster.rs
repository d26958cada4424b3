//! An SVG of ours as PNG bytes.

use std::sync::{Arc, LazyLock};

use resvg::{tiny_skia, usvg};

use super::{FigureError, style, text};

/// The longest side of a PNG; larger ones are typing errors, and a gigabyte of memory.
const MAX_SIDE_PX: f64 = 16_384.0;

/// Only the bundled font is known, so that no machine draws with another one.
static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(text::FONT.to_vec());
    Arc::new(fonts)
});

/// The bundled font and no other.
pub(crate) fn fonts() -> Arc<usvg::fontdb::Database> {
    Arc::clone(&FONTS)
}

/// Rasterizes `svg` at `scale` pixels a unit.
pub(super) fn png_from_svg(svg: &str, scale: f64) -> Result<Vec<u8>, FigureError> {
    let side_px = |units: f64| (units * scale).round();
    let (width_px, height_px) = (side_px(style::WIDTH), side_px(style::HEIGHT));
    // Written so that NaN is refused as well.
    if !(width_px >= 1.0 && height_px >= 1.0 && width_px <= MAX_SIDE_PX && height_px <= MAX_SIDE_PX) {
        return Err(FigureError::Scale(scale));
    }
    let options = usvg::Options {
        fontdb: fonts(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| FigureError::Raster(error.to_string()))?;
    let mut pixmap =
        tiny_skia::Pixmap::new(width_px as u32, height_px as u32).ok_or(FigureError::Scale(scale))?;
    pixmap.fill(tiny_skia::Color::WHITE);
    // Each axis by its own rounded factor: the drawing fills the last row and column of pixels, too.
    let transform = tiny_skia::Transform::from_scale(
        (width_px / style::WIDTH) as f32,
        (height_px / style::HEIGHT) as f32,
    );
    resvg::render(&tree, transform, &mut pixmap.as_mut());
    pixmap
        .encode_png()
        .map_err(|error| FigureError::Raster(error.to_string()))
}
