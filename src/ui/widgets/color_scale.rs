//! The color scale of scores under drawings of planes.

use egui::{Align2, Mesh, Pos2, Rect, Ui, pos2};

use super::marks::{label_font, ramp_color};
use crate::app::inspector::planes::{Planes, ScoreScale};

/// Returns the height of the scale under a drawing of these planes; 0 if none has a score.
pub fn height(ui: &Ui, planes: &Planes) -> f32 {
    planes.scale.map_or(0.0, |_| 2.0 * label_font(ui).size + 24.0)
}

/// Draws the scale, best at the left, with its numbers and unit.
pub fn paint(ui: &Ui, rect: Rect, scale: &ScoreScale, opacity: f32) {
    let font = label_font(ui);
    let color = ui.visuals().text_color();
    let painter = ui.painter();
    let bar = Rect::from_min_max(
        pos2(rect.left(), rect.top() + font.size + 6.0),
        pos2(rect.right(), rect.top() + font.size + 14.0),
    );
    let title = if rect.width() > 190.0 {
        "Score (cm), lower is better"
    } else {
        "Score (cm)"
    };
    painter.text(rect.left_top(), Align2::LEFT_TOP, title, font.clone(), color);

    let mut mesh = Mesh::default();
    let steps = 24_u32;
    for i in 0..=steps {
        let t = i as f32 / steps as f32;
        let x = egui::lerp(bar.x_range(), t);
        let shade = ramp_color(f64::from(1.0 - t)).gamma_multiply(opacity);
        mesh.colored_vertex(pos2(x, bar.top()), shade);
        mesh.colored_vertex(pos2(x, bar.bottom()), shade);
        if i > 0 {
            let last = 2 * i;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last, last + 1);
        }
    }
    painter.add(mesh);

    let below = bar.bottom() + 3.0;
    let number = |place: Pos2, align: Align2, text: String| {
        painter.text(place, align, text, font.clone(), color);
    };
    number(
        pos2(bar.left(), below),
        Align2::LEFT_TOP,
        scale.digits(scale.low_cm),
    );
    if bar.width() > 150.0 && scale.high_cm > scale.low_cm {
        let middle = 0.5 * (scale.low_cm + scale.high_cm);
        number(
            pos2(bar.center().x, below),
            Align2::CENTER_TOP,
            scale.digits(middle),
        );
    }
    if scale.high_cm > scale.low_cm {
        let beyond = if scale.is_open { " or more" } else { "" };
        let text = format!("{}{beyond}", scale.digits(scale.high_cm));
        number(pos2(bar.right(), below), Align2::RIGHT_TOP, text);
    }
}
