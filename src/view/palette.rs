//! Colors that can be told apart with every kind of color vision.

use crate::render::Color;

// Of Okabe and Ito's set, those that stand out on dark and on light.
pub(super) const BLUE: Color = [0x2b, 0x8c, 0xd6, 255];
pub(super) const ORANGE: Color = [0xe6, 0x9f, 0x00, 255];
pub(super) const GREEN: Color = [0x00, 0x9e, 0x73, 255];
pub(super) const VERMILION: Color = [0xd5, 0x5e, 0x00, 255];
pub(super) const PINK: Color = [0xcc, 0x79, 0xa7, 255];
pub(super) const SKY: Color = [0x56, 0xb4, 0xe9, 255];

/// The color of a point that takes no part.
pub const NEUTRAL: Color = [0x80, 0x80, 0x86, 255];

/// The color of the peduncle's points while they are picked, and of nothing else.
pub const PEDUNCLE_MARK: Color = [0xff, 0x4a, 0xbe, 255];

/// A color that steps back beside [`PEDUNCLE_MARK`].
pub fn faded(color: Color, is_dark: bool) -> Color {
    let quiet: u16 = if is_dark { 0x5c } else { 0xb8 };
    // Two fifths of the color stay, so that shape and fruit are still seen.
    let mixed = |c: u8| ((2 * u16::from(c) + 3 * quiet) / 5) as u8;
    [mixed(color[0]), mixed(color[1]), mixed(color[2]), color[3]]
}

/// The color of a point that takes part but has no value: lighter than [`NEUTRAL`].
pub(super) const VALUELESS: Color = [0xb4, 0xb4, 0xba, 255];

/// The ramp of values at equal steps from low to high: viridis from its tenth on, since its first colors are lost on a
/// dark background.
pub const VALUE_STOPS: [Color; 8] = [
    [0x48, 0x26, 0x77, 255],
    [0x3f, 0x47, 0x88, 255],
    [0x30, 0x67, 0x8d, 255],
    [0x25, 0x84, 0x8e, 255],
    [0x1f, 0xa0, 0x88, 255],
    [0x52, 0xc5, 0x69, 255],
    [0x9f, 0xda, 0x3a, 255],
    [0xfd, 0xe7, 0x25, 255],
];

/// The ramp's color at `t`, 0 (low) to 1 (high); beyond, its end.
pub fn value_color(t: f64) -> Color {
    let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 };
    let last = VALUE_STOPS.len() - 1;
    let place = t * last as f64;
    // Clamped above: at least 0, at most the last stop but one.
    let index = (place as usize).min(last - 1);
    let part = place - index as f64;
    std::array::from_fn(|c| {
        let (a, b) = (
            f64::from(VALUE_STOPS[index][c]),
            f64::from(VALUE_STOPS[index + 1][c]),
        );
        (a + part * (b - a)).round() as u8
    })
}

/// The color of a unit direction in the camera's frame: red to the right, green upward, blue toward
/// the camera.
pub(super) fn direction_color(direction: glam::DVec3) -> Color {
    let part = |v: f64| (127.5 + 127.5 * v.clamp(-1.0, 1.0)).round() as u8;
    [part(direction.x), part(-direction.y), part(-direction.z), 255]
}
