//! The canvas of a figure: lines, areas and texts in units of the figure.
//!
//! Figures use kuva's axes, ticks, colors and SVG, but not its plots: those have no mark for a missing bar or cell, write
//! the labels of guides over the data and over each other, and let legends run over the title.

use kuva::{
    backend::svg::SvgBackend,
    render::{
        color::Color,
        render::{PathData, Primitive, Scene, TextAnchor, build_path},
    },
};

use super::{style, text};

/// The alignment of a text with its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Align {
    Start,
    Middle,
    End,
}

/// A rectangle by its sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Area {
    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// The area with `margin` added on every side.
    pub(super) fn grown(&self, margin: f64) -> Self {
        let Self {
            left,
            top,
            right,
            bottom,
        } = *self;
        Self {
            left: left - margin,
            top: top - margin,
            right: right + margin,
            bottom: bottom + margin,
        }
    }
}

/// A white sheet with the shapes drawn so far.
pub(super) struct Canvas {
    pub(super) scene: Scene,
    clips: usize,
}

impl Canvas {
    pub(super) fn new() -> Self {
        let mut scene = Scene::new(style::WIDTH, style::HEIGHT).with_background(Some("#ffffff"));
        scene.font_family = Some(text::FONT_FAMILY.to_owned());
        scene.text_color = Some(style::INK.to_owned());
        Self { scene, clips: 0 }
    }

    pub(super) fn into_svg(self) -> String {
        let svg = SvgBackend::new().with_pretty(true).render_scene(&self.scene);
        // Without a view box, a page that shows the figure smaller than it is cuts it off instead of scaling it.
        let view_box = format!("<svg viewBox=\"0 0 {} {}\" ", self.scene.width, self.scene.height);
        svg.replacen("<svg ", &view_box, 1)
    }

    /// One line of text whose baseline is at `y`.
    pub(super) fn text(&mut self, content: &str, (x, y): (f64, f64), size: u32, align: Align, color: &str) {
        self.turned_text(content, (x, y), size, align, color, None);
    }

    /// One line of text turned by `degrees` about its position.
    pub(super) fn turned_text(
        &mut self,
        content: &str,
        (x, y): (f64, f64),
        size: u32,
        align: Align,
        color: &str,
        degrees: Option<f64>,
    ) {
        let anchor = match align {
            Align::Start => TextAnchor::Start,
            Align::Middle => TextAnchor::Middle,
            Align::End => TextAnchor::End,
        };
        // Control characters are no XML, not even escaped; names come from files and may hold any.
        let content = content.chars().map(|c| {
            if c.is_control() || "\u{fffe}\u{ffff}".contains(c) {
                ' '
            } else {
                c
            }
        });
        self.scene.add(Primitive::Text {
            x,
            y,
            content: content.collect(),
            size,
            anchor,
            rotate: degrees,
            bold: false,
            color: Some(Color::from(color)),
        });
    }

    pub(super) fn line(
        &mut self,
        from: (f64, f64),
        to: (f64, f64),
        color: &str,
        width: f64,
        dash: Option<&str>,
    ) {
        self.scene.add(Primitive::Line {
            x1: from.0,
            y1: from.1,
            x2: to.0,
            y2: to.1,
            stroke: Color::from(color),
            stroke_width: width,
            stroke_dasharray: dash.map(str::to_owned),
        });
    }

    pub(super) fn polyline(&mut self, points: Vec<(f64, f64)>, color: &str, width: f64, dash: Option<&str>) {
        self.scene.add(Primitive::PolyLine {
            points,
            stroke: Color::from(color),
            stroke_width: width,
            stroke_dasharray: dash.map(str::to_owned),
        });
    }

    /// A filled polygon without an outline.
    pub(super) fn polygon(&mut self, points: &[(f64, f64)], color: &str, opacity: f64) {
        self.scene.add(Primitive::Path(Box::new(PathData {
            d: format!("{}Z", build_path(points)),
            fill: Some(Color::from(color)),
            stroke: Color::None,
            stroke_width: 0.0,
            opacity: Some(opacity),
            stroke_dasharray: None,
        })));
    }

    pub(super) fn rect(&mut self, area: Area, color: &str, outline: Option<(&str, f64)>) {
        self.scene.add(Primitive::Rect {
            x: area.left,
            y: area.top,
            width: area.width(),
            height: area.height(),
            fill: if color == "none" {
                Color::None
            } else {
                Color::from(color)
            },
            stroke: outline.map(|(color, _)| Color::from(color)),
            stroke_width: outline.map(|(_, width)| width),
            opacity: None,
        });
    }

    pub(super) fn dot(&mut self, (x, y): (f64, f64), radius: f64, color: &str, opacity: f64) {
        self.scene.add(Primitive::Circle {
            cx: x,
            cy: y,
            r: radius,
            fill: Color::from(color),
            fill_opacity: (opacity < 1.0).then_some(opacity),
            stroke: None,
            stroke_width: None,
        });
    }

    /// A small ×, the mark of a value that does not exist.
    pub(super) fn cross(&mut self, (x, y): (f64, f64), half: f64) {
        self.line(
            (x - half, y - half),
            (x + half, y + half),
            style::QUIET_INK,
            1.6,
            None,
        );
        self.line(
            (x - half, y + half),
            (x + half, y - half),
            style::QUIET_INK,
            1.6,
            None,
        );
    }

    /// Draws with everything outside of `area` cut off.
    pub(super) fn within(&mut self, area: Area, draw: impl FnOnce(&mut Self)) {
        self.clips += 1;
        let (id, x, y) = (format!("plot-{}", self.clips), area.left, area.top);
        let (width, height) = (area.width(), area.height());
        // kuva's SVG names the region; its definition is the caller's.
        self.scene.defs.push(format!(
            r#"<clipPath id="{id}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/></clipPath>"#
        ));
        self.scene.add(Primitive::ClipStart {
            x,
            y,
            width,
            height,
            id,
        });
        draw(self);
        self.scene.add(Primitive::ClipEnd);
    }
}
