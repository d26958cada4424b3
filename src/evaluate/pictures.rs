//! Pictures of single clouds, for the report and as thumbnails.

use std::path::Path;

use super::{Examination, Row, TruthChoice, WorstPicture, examine, worst_first};
use crate::fruit::{Fruit, Request};
use crate::render::{Gpu, Image, Projection};
use crate::view::{
    Coloring, Drawing, Overlays, PictureSettings, Style, Theme, ViewPreset, draw_cloud, encode_picture,
};

/// The size of the report's pictures, in pixels.
const REPORT_PX: [u32; 2] = [560, 420];
const OVERLAYS: &str = "plane,axis,reference";

/// Draws the `count` worst clouds, the worst first. The second value is a sentence if one cannot be drawn: a
/// report without pictures is better than none.
pub fn pictures_of_worst(
    folder: &Path,
    rows: &[Row],
    request: &Request,
    count: usize,
) -> (Vec<WorstPicture>, Option<String>) {
    let worst = worst_first(rows);
    let mut pictures = Vec::new();
    if worst.is_empty() || count == 0 {
        return (pictures, None);
    }
    let gpu = match Gpu::headless() {
        Ok(gpu) => gpu,
        Err(error) => return (pictures, Some(format!("The report has no pictures: {error}."))),
    };
    for row in worst.into_iter().take(count) {
        match report_picture(&folder.join(&row.file), row, request, &gpu) {
            Ok(png) => pictures.push(WorstPicture {
                file: row.file.clone(),
                error_deg: row.error_deg,
                png,
            }),
            Err(error) => return (pictures, Some(format!("The report lacks pictures: {error}."))),
        }
    }
    (pictures, None)
}

/// Draws a picture as PNG bytes that hold the command line to draw it again.
fn report_picture(path: &Path, row: &Row, request: &Request, gpu: &Gpu) -> Result<Vec<u8>, String> {
    let named = || path.display().to_string();
    let fruit = Fruit::read(path, request).map_err(|e| e.to_string())?;
    let examined = examine(fruit, request, &()).map_err(|e| format!("{}: {e}", named()))?;
    let reference = reference_of_row(row.truth.as_deref());
    let image = draw_small(&examined, reference, REPORT_PX, Theme::Light, gpu)?;
    let [width, height] = REPORT_PX;
    let mut arguments: Vec<String> = ["render".into(), named(), "-o".into(), "picture.png".into()].into();
    let size = format!("{width}x{height}");
    let look = [
        "--size",
        &size,
        "--background",
        "light",
        "--overlays",
        OVERLAYS,
        "--reference",
        reference.name(),
    ];
    arguments.extend(look.map(String::from));
    arguments.extend(request.options());
    let settings = PictureSettings {
        version: env!("CARGO_PKG_VERSION").into(),
        arguments,
        cloud: named(),
        sha256: examined.fruit.file.sha256.clone(),
    };
    encode_picture(&image, &settings).map_err(|e| format!("{}: {e}", named()))
}

/// Returns the reference that a row was measured against.
fn reference_of_row(truth: Option<&str>) -> TruthChoice {
    match truth {
        Some("simulation") => TruthChoice::Truth,
        Some("peduncle") | None => TruthChoice::Peduncle,
        Some("peduncle-direction") => TruthChoice::PeduncleDirection,
        Some(_) => TruthChoice::Manual,
    }
}

/// Draws the sides of the best plane, the plane, and both axes.
///
/// # Errors
/// Returns a clause that begins with the file if the cloud cannot be drawn.
pub(super) fn draw_small(
    examined: &Examination,
    reference: TruthChoice,
    size_px: [u32; 2],
    theme: Theme,
    gpu: &Gpu,
) -> Result<Image, String> {
    let drawing = Drawing {
        size_px,
        style: Style {
            coloring: Coloring::Side,
            // A list of the program's own.
            overlays: OVERLAYS.parse::<Overlays>().unwrap_or_default(),
            theme,
            point_size: None,
            eye_dome: true,
        },
        plane: None,
        view: ViewPreset::Camera,
        camera: None,
        projection: Projection::Perspective,
        // A small picture has no room for words.
        has_angle: size_px == REPORT_PX,
    };
    let path = &examined.fruit.file.path;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    draw_cloud(&examined.drawn(&name, reference), &drawing, gpu, &())
        .map_err(|error| format!("{}: {error}", path.display()))
}
