//! The bar of hues: the histogram of the cloud's hues, and the chosen range.

use egui::{Color32, Mesh, Response, Sense, Ui, ecolor::Hsva, pos2, vec2};

use crate::app::peduncle::Hues;
use crate::peduncle::HueRange;

/// The heights of the histogram, of the colors, and of the line under them.
const HEIGHTS: [f32; 3] = [34.0, 8.0, 5.0];

/// Shows the hues from 0° to 360° with the cloud's histogram over them, and a line under those in the range,
/// whose ends can be dragged.
pub(in crate::ui) fn show(ui: &mut Ui, range: &mut HueRange, hues: Option<&Hues>) -> Response {
    let height = HEIGHTS.iter().sum();
    let size = vec2(ui.available_width(), height);
    let (rect, mut response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(
            egui::Role::Canvas,
            true,
            format!(
                "Hues of the cloud; from {:.0}° to {:.0}°",
                range.from_deg, range.to_deg
            ),
        )
    });
    drag(ui, rect, range, &mut response);
    let at = |deg: f64| rect.left() + rect.width() * (deg / 360.0) as f32;
    let (top, strip) = (rect.top() + HEIGHTS[0], HEIGHTS[1]);
    let hue_color = |deg: f64, is_in: bool| {
        let saturation = if is_in { 0.85 } else { 0.35 };
        let value = if is_in { 0.92 } else { 0.5 };
        Color32::from(Hsva::new((deg / 360.0) as f32, saturation, value, 1.0))
    };
    if let Some(hues) = hues {
        let most = hues.counts.iter().copied().max().unwrap_or(0).max(1);
        for (bin, &count) in hues.counts.iter().enumerate() {
            let low = (bin * Hues::BIN_DEG) as f64;
            let middle = low + 0.5 * Hues::BIN_DEG as f64;
            // The square root, so that a peduncle of few points is seen beside its fruit.
            let share = (count as f64 / most as f64).sqrt() as f32;
            let bar = egui::Rect::from_min_max(
                pos2(at(low), top - share * (HEIGHTS[0] - 2.0)),
                pos2(at(low + Hues::BIN_DEG as f64) - 0.5, top),
            );
            ui.painter()
                .rect_filled(bar, 0.0, hue_color(middle, range.contains(middle)));
        }
    }
    let mut mesh = Mesh::default();
    for step in 0..=36_u8 {
        let deg = 10.0 * f64::from(step);
        let color = hue_color(deg, true);
        mesh.colored_vertex(pos2(at(deg), top), color);
        mesh.colored_vertex(pos2(at(deg), top + strip), color);
        if step > 0 {
            let first = 2 * u32::from(step) - 2;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    ui.painter().add(mesh);
    let pieces = if range.from_deg <= range.to_deg {
        vec![range.from_deg..=range.to_deg]
    } else {
        vec![0.0..=range.to_deg, range.from_deg..=360.0]
    };
    let color = ui.visuals().strong_text_color();
    for piece in pieces {
        let stroke = egui::Stroke::new(3.0, color);
        ui.painter()
            .hline(at(*piece.start())..=at(*piece.end()), top + strip + 3.5, stroke);
    }
    for end in [range.from_deg, range.to_deg] {
        let stroke = egui::Stroke::new(1.5, color);
        ui.painter()
            .vline(at(end), rect.top()..=top + strip + 5.0, stroke);
    }
    response
}

/// Moves the end of the range that was nearer when the drag began.
fn drag(ui: &Ui, rect: egui::Rect, range: &mut HueRange, response: &mut Response) {
    let memory = response.id.with("end");
    let Some(at) = response.interact_pointer_pos() else {
        return;
    };
    let deg = f64::from((at.x - rect.left()) / rect.width().max(1.0)).clamp(0.0, 1.0) * 360.0;
    if response.drag_started() || response.clicked() {
        let moves_to = (deg - range.to_deg).abs() < (deg - range.from_deg).abs();
        ui.data_mut(|data| data.insert_temp(memory, moves_to));
    }
    if response.dragged() || response.clicked() {
        let moves_to = ui.data(|data| data.get_temp::<bool>(memory).unwrap_or(false));
        let end = if moves_to {
            &mut range.to_deg
        } else {
            &mut range.from_deg
        };
        let rounded = deg.round();
        if *end != rounded {
            *end = rounded;
            response.mark_changed();
        }
    }
}
