//! Small texts, warnings, and fields for text.

use egui::{Color32, FontId, Label, Response, RichText, TextEdit, TextStyle, Ui};

/// Returns the color of a warning that is read as text, with enough contrast on dark and on light.
pub fn warning_color(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode {
        Color32::from_rgb(0xf0, 0xb0, 0x40)
    } else {
        Color32::from_rgb(0x9a, 0x4a, 0x00)
    }
}

/// Returns the font of explanations: smaller than the rest, and still easy to read.
pub fn small(ui: &Ui) -> FontId {
    let body = TextStyle::Body.resolve(ui.style());
    FontId::new((0.88 * body.size).max(11.0), body.family)
}

/// Shows a field for text, whose hint has as much contrast as other text.
pub fn text_field(ui: &mut Ui, typed: &mut String, hint: &'static str, name: &str) -> Response {
    ui.scope(|ui| {
        ui.visuals_mut().weak_text_color = Some(ui.visuals().text_color());
        let field = TextEdit::singleline(typed)
            .hint_text(hint)
            .desired_width(f32::INFINITY);
        ui.add(field).accessible_name(name)
    })
    .inner
}

/// Shows a small explanation over the whole width.
pub fn hint(ui: &mut Ui, text: impl Into<String>) -> Response {
    let text = RichText::new(text).font(small(ui));
    ui.add(Label::new(text).wrap())
}

/// Shows a small warning over the whole width.
pub fn caution(ui: &mut Ui, text: impl Into<String>) -> Response {
    let text = RichText::new(text).font(small(ui)).color(warning_color(ui));
    ui.add(Label::new(text).wrap())
}
