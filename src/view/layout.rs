//! The layout of legend, scale bar, triad, angle and caption, so that none covers another.

use glam::{DVec2, DVec3};

use super::legend::Legend;
use super::page::Page;
use super::primitive::{Anchor, Primitive};
use crate::render::{Camera, Color, Insets};

/// The painter's measure of a text: its width in pixels at a size in pixels.
type Measure<'a> = &'a dyn Fn(&str, f64) -> f64;

impl Page<'_> {
    fn text_px(&self) -> f64 {
        (self.viewport.width_px / 80.0)
            .min(self.viewport.height_px / 60.0)
            .clamp(11.0, 48.0)
    }

    fn margin_px(&self) -> f64 {
        self.text_px()
    }

    fn line_px(&self) -> f64 {
        1.45 * self.text_px()
    }

    fn caption_height_px(&self) -> f64 {
        self.line_px() * self.caption.len() as f64
    }

    /// The legend's width without its padding, and with it its lines as they will be written.
    fn legend_width_px(&self, measure: Measure<'_>) -> f64 {
        let Some(legend) = self.legend else {
            return 0.0;
        };
        let size = self.text_px();
        let swatch = 1.6 * size;
        let texts = legend.swatches.iter().map(|s| swatch + measure(&s.text(), size));
        let notes = legend.notes.iter().map(|n| measure(n, 0.85 * size));
        let ramp = legend.ramp.as_ref().map_or(0.0, |_| 13.0 * size);
        let widest = texts
            .chain(notes)
            .fold(measure(&legend.title, size).max(ramp), f64::max);
        // At most half of the picture, even for long texts.
        widest.min(0.5 * self.viewport.width_px - 3.0 * self.margin_px())
    }
}

/// The room that texts and legends take at the edges of the picture; the fruit is framed between them.
pub fn insets(page: &Page<'_>, measure: Measure<'_>) -> Insets {
    let margin = page.margin_px();
    let legend = page.legend_width_px(measure);
    Insets {
        left_px: margin,
        right_px: if legend > 0.0 {
            legend + 3.0 * margin
        } else {
            margin
        },
        top_px: margin + if page.label.is_some() { page.line_px() } else { 0.0 },
        bottom_px: margin + page.caption_height_px() + if page.caption.is_empty() { 0.0 } else { margin },
    }
}

/// A box that is taken.
#[derive(Debug, Clone, Copy)]
struct Area {
    min: DVec2,
    max: DVec2,
}

impl Area {
    fn meets(&self, other: &Self) -> bool {
        self.min.cmplt(other.max).all() && other.min.cmplt(self.max).all()
    }
}

/// Lays everything out; `camera` is the picture's, framed with [`insets`] or not.
pub fn lay_out(page: &Page<'_>, camera: &Camera, measure: Measure<'_>) -> Vec<Primitive> {
    let mut out = Vec::new();
    let mut taken = Vec::new();
    caption(page, measure, &mut out);
    let bottom = page.viewport.height_px - page.margin_px() - page.caption_height_px();
    if page.legend.is_some() {
        taken.push(legend(page, measure, &mut out));
    }
    if page.has_triad {
        taken.push(triad(page, camera, bottom, &mut out));
    }
    if page.scale_unit.is_some() {
        taken.extend(scale_bar(page, camera, bottom, measure, &mut out));
    }
    if let Some((place, text)) = &page.label {
        label(page, camera, *place, text, &taken, bottom, measure, &mut out);
    }
    out
}

fn shortened(text: &str, size: f64, room: f64, measure: Measure<'_>) -> String {
    crate::text::shortened(text, |text| measure(text, size) <= room).unwrap_or_default()
}

fn caption(page: &Page<'_>, measure: Measure<'_>, out: &mut Vec<Primitive>) {
    let (size, margin) = (page.text_px(), page.margin_px());
    let room = page.viewport.width_px - 2.0 * margin;
    let top = page.viewport.height_px - margin - page.caption_height_px();
    for (i, line) in page.caption.iter().enumerate() {
        out.push(Primitive::Text {
            at: DVec2::new(margin, top + page.line_px() * (i as f64 + 0.8)),
            anchor: Anchor::Start,
            size_px: size,
            color: if i == 0 {
                page.theme.ink()
            } else {
                page.theme.quiet_ink()
            },
            halo: Some(page.theme.paper()),
            text: shortened(line, size, room, measure),
        });
    }
}

fn legend(page: &Page<'_>, measure: Measure<'_>, out: &mut Vec<Primitive>) -> Area {
    let (size, margin, line) = (page.text_px(), page.margin_px(), page.line_px());
    let width = page.legend_width_px(measure);
    let empty = Legend::default();
    let legend = page.legend.unwrap_or(&empty);
    let left = page.viewport.width_px - 1.8 * margin - width;
    let ramp_lines = if legend.ramp.is_some() { 2.3 } else { 0.0 };
    let lines = 1.0 + ramp_lines + (legend.swatches.len() + legend.notes.len()) as f64;
    let area = Area {
        min: DVec2::new(left - 0.8 * margin, margin),
        max: DVec2::new(
            page.viewport.width_px - margin,
            1.8 * margin + lines * line + 0.4 * margin,
        ),
    };
    out.push(Primitive::Box {
        min: area.min,
        max: area.max,
        color: page.theme.paper(),
    });
    let mut y = 1.6 * margin;
    let text = |y: f64, x: f64, anchor, size_px: f64, color: Color, text: String| Primitive::Text {
        at: DVec2::new(x, y + 0.75 * line),
        anchor,
        size_px,
        color,
        halo: None,
        text,
    };
    let (ink, quiet) = (page.theme.ink(), page.theme.quiet_ink());
    let title = shortened(&legend.title, size, width, measure);
    out.push(text(y, left, Anchor::Start, size, ink, title));
    y += line;
    if let Some(ramp) = &legend.ramp {
        let min = DVec2::new(left, y + 0.2 * line);
        out.push(Primitive::Ramp {
            min,
            max: DVec2::new(left + width, y + line),
            stops: ramp.stops.clone(),
        });
        let high_width = ramp
            .ticks
            .last()
            .map_or(0.0, |(_, tick)| measure(tick, 0.9 * size));
        for (place, tick) in &ramp.ticks {
            // One that would run into the upper end's is left out: that one matters more.
            let reaches = place * width + 0.5 * measure(tick, 0.9 * size) + 0.4 * size;
            if *place < 1.0 && reaches > width - high_width {
                continue;
            }
            let x = left + place * width;
            let anchor = match *place {
                p if p <= 0.0 => Anchor::Start,
                p if p >= 1.0 => Anchor::End,
                _ => Anchor::Middle,
            };
            out.push(Primitive::Line {
                from: DVec2::new(x, y + line),
                to: DVec2::new(x, y + 1.2 * line),
                width_px: 1.0,
                color: quiet,
            });
            out.push(text(y + 1.2 * line, x, anchor, 0.9 * size, quiet, tick.clone()));
        }
        y += ramp_lines * line;
    }
    for swatch in &legend.swatches {
        out.push(Primitive::Box {
            min: DVec2::new(left, y + 0.2 * line),
            max: DVec2::new(left + 0.6 * line, y + 0.8 * line),
            color: swatch.color,
        });
        let words = shortened(&swatch.text(), size, width - 1.6 * size, measure);
        out.push(text(y, left + 1.6 * size, Anchor::Start, size, ink, words));
        y += line;
    }
    for note in &legend.notes {
        let words = shortened(note, 0.85 * size, width, measure);
        out.push(text(y, left, Anchor::Start, 0.85 * size, quiet, words));
        y += line;
    }
    area
}

/// The directions of the world's axes in the view, in the lower left corner. The letters name the file's own axes, so y
/// points down in a camera's frame.
fn triad(page: &Page<'_>, camera: &Camera, bottom: f64, out: &mut Vec<Primitive>) -> Area {
    let (size, margin) = (page.text_px(), page.margin_px());
    let arm = 2.2 * size;
    let reach = arm + 1.1 * size;
    let middle = DVec2::new(margin + reach, bottom - 0.5 * margin - reach);
    let mut arms: Vec<(f64, DVec2, &str, Color)> = [
        (DVec3::X, "x", [0xe5, 0x5b, 0x4d, 255]),
        (DVec3::Y, "y", [0x4c, 0xb0, 0x50, 255]),
        (DVec3::Z, "z", [0x4a, 0x90, 0xe2, 255]),
    ]
    .map(|(axis, name, color)| {
        let in_view = camera.world_from_view.inverse() * axis;
        (in_view.z, DVec2::new(in_view.x, -in_view.y), name, color)
    })
    .to_vec();
    // Those that point away first, so that the nearer ones cover them.
    arms.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, toward, name, color) in arms {
        let tip = middle + arm * toward;
        out.push(Primitive::Line {
            from: middle,
            to: tip,
            width_px: (size / 7.0).max(1.5),
            color,
        });
        // An axis along the line of sight has no direction to write its letter in.
        let beside = toward.try_normalize().filter(|_| toward.length() > 0.2);
        let at = tip + 0.65 * size * beside.unwrap_or(DVec2::new(-0.7, -0.7));
        out.push(Primitive::Text {
            at: at + DVec2::new(0.0, 0.35 * size),
            anchor: Anchor::Middle,
            size_px: size,
            color,
            halo: Some(page.theme.paper()),
            text: name.into(),
        });
    }
    Area {
        min: middle - reach,
        max: middle + reach,
    }
}

/// A bar of a round length at the pivot's depth, in the lower right corner.
fn scale_bar(
    page: &Page<'_>,
    camera: &Camera,
    bottom: f64,
    measure: Measure<'_>,
    out: &mut Vec<Primitive>,
) -> Option<Area> {
    let (size, margin) = (page.text_px(), page.margin_px());
    let depth = camera.depth_of(camera.pivot_in_world);
    let pixel = camera.pixel_size_at(depth, page.viewport);
    let longest = 0.18 * page.viewport.width_px * pixel;
    if !(longest.is_finite() && longest > 0.0) {
        return None;
    }
    let magnitude = 10_f64.powf(longest.log10().floor());
    let length = [5.0, 2.0, 1.0]
        .map(|s| s * magnitude)
        .into_iter()
        .find(|l| *l <= longest)
        .unwrap_or(magnitude);
    let decimals = (-magnitude.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{length:.decimals$} {}", page.scale_unit.unwrap_or_default());
    let width = length / pixel;
    let (right, y) = (page.viewport.width_px - margin, bottom - 0.7 * margin);
    let color = page.theme.ink();
    let mut line = |from: DVec2, to: DVec2| {
        out.push(Primitive::Line {
            from,
            to,
            width_px: (size / 8.0).max(1.5),
            color,
        });
    };
    line(DVec2::new(right - width, y), DVec2::new(right, y));
    for x in [right - width, right] {
        line(DVec2::new(x, y - 0.35 * size), DVec2::new(x, y + 0.35 * size));
    }
    let half = 0.5 * width.max(measure(&text, size));
    let middle = right - half;
    out.push(Primitive::Text {
        at: DVec2::new(middle, y - 0.7 * size),
        anchor: Anchor::Middle,
        size_px: size,
        color,
        halo: Some(page.theme.paper()),
        text,
    });
    Some(Area {
        min: DVec2::new(middle - half, y - 1.8 * size),
        max: DVec2::new(right, y + 0.5 * size),
    })
}

/// A text beside a point, moved so that it covers nothing else and is not cut off.
#[expect(
    clippy::too_many_arguments,
    reason = "the page, a text with its place, and what is there already"
)]
fn label(
    page: &Page<'_>,
    camera: &Camera,
    place_in_world: DVec3,
    text: &str,
    taken: &[Area],
    bottom: f64,
    measure: Measure<'_>,
    out: &mut Vec<Primitive>,
) {
    let Some(place) = camera.project(place_in_world, page.viewport) else {
        return;
    };
    let (size, margin) = (page.text_px(), page.margin_px());
    let (width, height) = (measure(text, size) + size, 1.4 * size);
    let half = DVec2::new(0.5 * width, 0.5 * height);
    let low = half + 0.5 * margin;
    let high = DVec2::new(page.viewport.width_px, bottom) - half - 0.5 * margin;
    // First beyond the axis' end, where the axis itself is not covered.
    let pivot = camera
        .project(camera.pivot_in_world, page.viewport)
        .unwrap_or(place);
    let away = (place - pivot).normalize_or_zero();
    let near = [
        away * (half + 0.6 * size),
        DVec2::new(half.x + size, 0.0),
        DVec2::new(-half.x - size, 0.0),
        DVec2::new(0.0, -1.5 * height),
        DVec2::new(0.0, 1.5 * height),
        DVec2::new(-half.x - size, 2.0 * height),
        DVec2::new(-half.x - size, 5.0 * height),
    ];
    let area_at = |middle: DVec2| {
        let middle = middle.max(low).min(high.max(low));
        Area {
            min: middle - half,
            max: middle + half,
        }
    };
    let free = |area: &Area| taken.iter().all(|t| !t.meets(area));
    let Some(area) = near.map(|offset| area_at(place + offset)).into_iter().find(free) else {
        return;
    };
    out.push(Primitive::Box {
        min: area.min,
        max: area.max,
        color: page.theme.paper(),
    });
    out.push(Primitive::Text {
        at: DVec2::new(0.5 * (area.min.x + area.max.x), area.max.y - 0.35 * height),
        anchor: Anchor::Middle,
        size_px: size,
        color: page.theme.ink(),
        halo: None,
        text: text.into(),
    });
}
