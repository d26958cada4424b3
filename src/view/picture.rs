//! A picture, with the primitives painted over it, as a PNG that carries its settings.

use std::fmt::Write as _;
use std::io::Cursor;

use resvg::{tiny_skia, usvg};
use serde::{Deserialize, Serialize};

use crate::charts::{raster, text};
use crate::render::{Color, Image};
use crate::view::{Anchor, Primitive};

/// The key of the text chunk that holds the settings.
pub const SETTINGS_KEY: &str = "axiscope";

/// The origin of a picture: enough to draw it again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PictureSettings {
    /// The program's version.
    pub version: String,
    /// The arguments of `render` without cloud, output and `--from`.
    pub arguments: Vec<String>,
    /// The path of the cloud, as it was given.
    pub cloud: String,
    /// The SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

/// The reason why a picture could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The primitives could not be painted.
    #[error("the picture's texts could not be drawn: {0}")]
    Paint(String),
    /// The PNG could not be encoded.
    #[error("the PNG could not be made")]
    Encode(#[from] png::EncodingError),
    /// These bytes are no PNG.
    #[error("this is no PNG file")]
    Decode(#[from] png::DecodingError),
    /// The PNG was not drawn by this program.
    #[error(
        "this PNG carries no settings: it was not drawn by `axiscope render`, or they were removed since"
    )]
    NoSettings,
    /// The settings cannot be understood.
    #[error("the settings in this PNG cannot be read")]
    BadSettings(#[from] serde_json::Error),
}

/// The width of a text in the bundled font, in pixels, at a size in pixels.
pub fn text_width_px(text: &str, size_px: f64) -> f64 {
    // Widths grow with the size: those at 1000 pixels are exact enough for all.
    text::width(text, 1000) * size_px / 1000.0
}

/// Paints primitives onto a picture, with the bundled font.
///
/// # Errors
/// Returns an error if there is no memory for it.
pub fn paint_primitives(image: &mut Image, primitives: &[Primitive]) -> Result<(), PictureError> {
    let svg = svg_of(image.width_px, image.height_px, primitives);
    let options = usvg::Options {
        fontdb: raster::fonts(),
        ..usvg::Options::default()
    };
    let failed = |reason: String| PictureError::Paint(reason);
    let tree = usvg::Tree::from_str(&svg, &options).map_err(|error| failed(error.to_string()))?;
    // The picture is opaque, so premultiplied and straight colors are the same.
    let size = tiny_skia::IntSize::from_wh(image.width_px, image.height_px)
        .ok_or_else(|| failed("it has no pixels".into()))?;
    let mut pixmap = tiny_skia::Pixmap::from_vec(std::mem::take(&mut image.rgba), size)
        .ok_or_else(|| failed("its size and its pixels differ".into()))?;
    resvg::render(&tree, tiny_skia::Transform::identity(), &mut pixmap.as_mut());
    image.rgba = pixmap.take();
    Ok(())
}

/// Encodes a picture with its settings in a text chunk.
///
/// # Errors
/// Returns an error if the picture's size and its pixels differ.
pub fn encode_picture(image: &Image, settings: &PictureSettings) -> Result<Vec<u8>, PictureError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width_px, image.height_px);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    // International text: names of files may hold any letter.
    encoder.add_itxt_chunk(SETTINGS_KEY.to_owned(), serde_json::to_string(settings)?)?;
    let rgb: Vec<u8> = image
        .rgba
        .chunks_exact(4)
        .flat_map(|p| [p[0], p[1], p[2]])
        .collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(bytes)
}

/// The longest settings that are read from a PNG, in bytes.
const LONGEST_SETTINGS: usize = 1 << 20;

/// The settings in a PNG of [`encode_picture`].
///
/// # Errors
/// Returns an error if the bytes are no PNG, or one without settings.
pub fn picture_settings(png_bytes: &[u8]) -> Result<PictureSettings, PictureError> {
    let mut reader = png::Decoder::new(Cursor::new(png_bytes)).read_info()?;
    // Other programs may put the text behind the pixels.
    reader.finish()?;
    let chunks = &reader.info().utf8_text;
    let chunk = chunks.iter().find(|c| c.keyword == SETTINGS_KEY);
    let mut chunk = chunk.ok_or(PictureError::NoSettings)?.clone();
    // Compressed by another program, a text can grow a thousandfold.
    chunk.decompress_text_with_limit(LONGEST_SETTINGS)?;
    Ok(serde_json::from_str(&chunk.get_text()?)?)
}

/// The largest picture that is decoded, in bytes of pixels; 64 million of them.
const LARGEST_PICTURE: usize = 3 << 26;

/// The pixels of a PNG of [`encode_picture`]; `None` for any other PNG, a broken one, and one of more
/// than 64 million pixels.
pub fn decode_picture(png_bytes: &[u8]) -> Option<Image> {
    let mut reader = png::Decoder::new(Cursor::new(png_bytes)).read_info().ok()?;
    let size = reader
        .output_buffer_size()
        .filter(|&size| size <= LARGEST_PICTURE)?;
    let mut rgb = vec![0; size];
    let frame = reader.next_frame(&mut rgb).ok()?;
    if frame.color_type != png::ColorType::Rgb || frame.bit_depth != png::BitDepth::Eight {
        return None;
    }
    Some(Image {
        width_px: frame.width,
        height_px: frame.height,
        rgba: rgb
            .chunks_exact(3)
            .flat_map(|p| [p[0], p[1], p[2], 255])
            .collect(),
    })
}

/// The primitives as an SVG document of the picture's size.
fn svg_of(width_px: u32, height_px: u32, primitives: &[Primitive]) -> String {
    let mut svg =
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width_px}\" height=\"{height_px}\">");
    for (index, primitive) in primitives.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = add(&mut svg, index, primitive);
    }
    svg.push_str("</svg>");
    svg
}

fn add(svg: &mut String, index: usize, primitive: &Primitive) -> std::fmt::Result {
    match primitive {
        Primitive::Text {
            at,
            anchor,
            size_px,
            color,
            halo,
            text,
        } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let place = format!(
                "x=\"{:.2}\" y=\"{:.2}\" font-family=\"DejaVu Sans\" font-size=\"{size_px:.2}\" text-anchor=\"{anchor}\"",
                at.x, at.y
            );
            let words = escaped(text);
            if let Some(halo) = halo {
                let width = 0.3 * size_px;
                write!(
                    svg,
                    "<text {place} fill=\"none\" stroke-linejoin=\"round\" stroke-width=\"{width:.2}\" {}>{words}</text>",
                    paint("stroke", *halo)
                )?;
            }
            write!(svg, "<text {place} {}>{words}</text>", paint("fill", *color))
        }
        Primitive::Line {
            from,
            to,
            width_px,
            color,
        } => write!(
            svg,
            "<line x1=\"{:.2}\" y1=\"{:.2}\" x2=\"{:.2}\" y2=\"{:.2}\" stroke-linecap=\"round\" stroke-width=\"{width_px:.2}\" {}/>",
            from.x,
            from.y,
            to.x,
            to.y,
            paint("stroke", *color)
        ),
        Primitive::Box { min, max, color } => write!(
            svg,
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" rx=\"3\" {}/>",
            min.x,
            min.y,
            max.x - min.x,
            max.y - min.y,
            paint("fill", *color)
        ),
        Primitive::Ramp { min, max, stops } => {
            write!(svg, "<linearGradient id=\"ramp{index}\">")?;
            let last = stops.len().saturating_sub(1).max(1);
            for (i, c) in stops.iter().enumerate() {
                let place = i as f64 / last as f64;
                write!(
                    svg,
                    "<stop offset=\"{place:.4}\" stop-color=\"rgb({},{},{})\"/>",
                    c[0], c[1], c[2]
                )?;
            }
            write!(
                svg,
                "</linearGradient><rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"url(#ramp{index})\"/>",
                min.x,
                min.y,
                max.x - min.x,
                max.y - min.y
            )
        }
    }
}

fn paint(attribute: &str, [r, g, b, a]: Color) -> String {
    format!(
        "{attribute}=\"rgb({r},{g},{b})\" {attribute}-opacity=\"{:.3}\"",
        f64::from(a) / 255.0
    )
}

/// A text escaped for XML: names of files may hold anything.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
