//! The sheet about the program and the paper of its method.

use egui::Modal;

/// Shows the sheet; returns whether it stays open.
pub fn show(ctx: &egui::Context) -> bool {
    let modal = Modal::new(egui::Id::unique("about")).show(ctx, |ui| {
        ui.set_max_width(440.0);
        ui.heading(format!("Axiscope {}", env!("CARGO_PKG_VERSION")));
        ui.label("Shows why a fruit's symmetry axis was found, or missed.");
        ui.add_space(8.0);
        ui.label(
            "The method: H. Li, Q. Zhu, M. Huang, Y. Guo, J. Qin, “Pose Estimation of Sweet Pepper through \
             Symmetry Axis Detection”, Sensors 18 (2018) 3083.",
        );
        ui.add_space(4.0);
        ui.label(
            "The paper can be read in two ways where its equations and its words differ. “As printed” takes the \
             equations, “as intended” the words around them; every result names its reading.",
        );
        ui.add_space(4.0);
        ui.label("Free to use under the MIT license or the Apache license 2.0.");
        ui.add_space(8.0);
        ui.button("Close").clicked()
    });
    !(modal.inner || modal.should_close())
}
