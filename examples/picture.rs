//! Draws the picture of one cloud with its symmetry plane and axis, without a window.
//!
//! ```sh
//! cargo run --release --example picture -- CLOUD.ply PICTURE.png
//! ```
//!
//! Without arguments it draws a bundled pepper into the folder for temporary files. It needs a GPU, or a software
//! driver for Vulkan such as Mesa's.

use std::error::Error;
use std::path::PathBuf;

use axiscope::evaluate::{TruthChoice, examine};
use axiscope::fruit::{Fruit, Request};
use axiscope::render::{Gpu, Projection};
use axiscope::view::{
    Coloring, Drawing, Overlays, PictureSettings, Style, ViewPreset, draw_cloud, encode_picture,
};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let path = arguments
        .next()
        .unwrap_or_else(|| concat!(env!("CARGO_MANIFEST_DIR"), "/assets/pepper.ply").into());
    let out = arguments
        .next()
        .unwrap_or_else(|| std::env::temp_dir().join("axiscope_example.png"));

    let request = Request::default();
    let fruit = Fruit::read(&path, &request)?;
    let examined = examine(fruit, &request, &())?;

    let drawing = Drawing {
        size_px: [800, 600],
        style: Style {
            // The score of each point under the plane that is shown (Eq. 15).
            coloring: Coloring::Score,
            // Plane, axis, reference, legend, caption and more.
            overlays: Overlays::default(),
            ..Style::default()
        },
        // The best plane, seen from the depth camera.
        plane: None,
        view: ViewPreset::Camera,
        camera: None,
        projection: Projection::Perspective,
        has_angle: true,
    };
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let gpu = Gpu::headless()?;
    let image = draw_cloud(&examined.drawn(&name, TruthChoice::Truth), &drawing, &gpu, &())?;

    // The PNG carries the command line that draws it: `axiscope render --from PICTURE.png -o COPY.png` does so.
    let (cloud, png) = (path.display().to_string(), out.display().to_string());
    let settings = PictureSettings {
        version: env!("CARGO_PKG_VERSION").into(),
        arguments: [
            "render",
            &cloud,
            "-o",
            &png,
            "--color=score",
            "--reference=truth",
            "--size=800x600",
        ]
        .map(String::from)
        .into(),
        cloud,
        sha256: examined.fruit.file.sha256.clone(),
    };
    std::fs::write(&out, encode_picture(&image, &settings)?)?;
    println!("Wrote {}.", out.display());
    Ok(())
}
