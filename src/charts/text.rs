//! Widths and line breaks of texts.

use std::sync::LazyLock;

use ttf_parser::Face;

/// `DejaVu Sans`: it has the degree sign, Greek, subscripts and the arrows that captions use.
pub(super) const FONT: &[u8] = include_bytes!("../../assets/fonts/DejaVuSans.ttf");

/// The fonts that an SVG asks for. Verdana has the same widths and the others are narrower, so that all texts fit.
pub(super) const FONT_FAMILY: &str = "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif";

static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::parse(FONT, 0).ok());

/// The width of `text` in units of the figure.
pub(crate) fn width(text: &str, size: u32) -> f64 {
    let size = f64::from(size);
    let Some(face) = FACE.as_ref() else {
        return text.chars().count() as f64 * 0.65 * size;
    };
    let advance = |c: char| {
        face.glyph_index(c)
            .and_then(|glyph| face.glyph_hor_advance(glyph))
            .unwrap_or(1400)
    };
    let units: f64 = text.chars().map(|c| f64::from(advance(c))).sum();
    units * size / f64::from(face.units_per_em())
}

/// The text on one line of at most `room`, its end replaced by an ellipsis if it is longer.
pub(super) fn shortened(text: &str, size: u32, room: f64) -> String {
    let short = crate::text::shortened(text, |text| width(text, size) <= room);
    short.unwrap_or_else(|| "…".to_owned())
}

/// The text broken between words into lines of at most `room`; at most `max_lines` of them, the last one shortened.
pub(super) fn wrapped(text: &str, size: u32, room: f64, max_lines: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if fits_behind(line, word, size, room) => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    if lines.len() > max_lines {
        let rest = lines.split_off(max_lines.max(1) - 1).join(" ");
        lines.push(rest);
    }
    lines.iter().map(|line| shortened(line, size, room)).collect()
}

/// Whether `word` still fits behind `line`.
fn fits_behind(line: &str, word: &str, size: u32, room: f64) -> bool {
    width(line, size) + width(" ", size) + width(word, size) <= room
}
