//! The dialog for the size of a saved picture.

use std::ops::ControlFlow;

use egui::{DragValue, Modal};

use crate::render::MAX_SIDE_PX;

/// The fields of the dialog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SaveImage {
    /// The view's own size in physical pixels.
    view_px: [u32; 2],
    size_px: [u32; 2],
    keeps_shape: bool,
}

impl SaveImage {
    /// Begins with twice the view's size, for print.
    pub fn new(view_px: [u32; 2]) -> Self {
        Self {
            view_px,
            size_px: view_px.map(|side| (2 * side).clamp(1, MAX_SIDE_PX)),
            keeps_shape: true,
        }
    }

    /// Shows the dialog; breaks when it closes, with the picture's size in pixels unless it was canceled.
    pub fn show(&mut self, ctx: &egui::Context) -> ControlFlow<Option<[u32; 2]>> {
        let modal = Modal::new(egui::Id::unique("save image")).show(ctx, |ui| {
            ui.set_max_width(360.0);
            ui.heading("Save the view as a picture");
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                for (side, text) in ["Width", "Height"].into_iter().enumerate() {
                    let label = ui.label(text);
                    let mut value = self.size_px[side];
                    let field = DragValue::new(&mut value).range(1..=MAX_SIDE_PX).suffix(" px");
                    if ui.add(field).labelled_by(label.id).changed() {
                        self.set(side, value);
                    }
                }
            });
            ui.checkbox(&mut self.keeps_shape, "Keep the view's shape");
            ui.horizontal(|ui| {
                for times in [1, 2, 4] {
                    if ui.button(format!("{times} × the view")).clicked() {
                        self.size_px = self.view_px.map(|side| (times * side).clamp(1, MAX_SIDE_PX));
                    }
                }
            });
            ui.add_space(4.0);
            ui.label("The PNG carries its settings: “axiscope render --from PICTURE” draws it again.");
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                let is_chosen = ui.button("Save …").clicked();
                (is_chosen, ui.button("Cancel").clicked())
            })
            .inner
        });
        match modal.inner {
            (true, _) => ControlFlow::Break(Some(self.size_px)),
            (false, is_canceled) if is_canceled || modal.should_close() => ControlFlow::Break(None),
            _ => ControlFlow::Continue(()),
        }
    }

    fn set(&mut self, side: usize, value: u32) {
        self.size_px[side] = value;
        if self.keeps_shape {
            let other = 1 - side;
            let ratio = f64::from(self.view_px[other]) / f64::from(self.view_px[side].max(1));
            // Clamped to the sides that a picture may have.
            self.size_px[other] = (f64::from(value) * ratio)
                .round()
                .clamp(1.0, f64::from(MAX_SIDE_PX)) as u32;
        }
    }
}
