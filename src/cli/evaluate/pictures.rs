//! Pictures of the worst clouds, for the report.

use std::path::Path;

use anyhow::Context;
use axiscope::evaluate::{Request, Row, examine};
use axiscope::io::Fruit;
use axiscope::render::Gpu;
use clap::{Args, Command, FromArgMatches};

use super::html::WorstPicture;
use crate::cli::picture_options::Picture;
use crate::cli::render::{Drawing, picture_of};

/// What a picture of the report shows, as `axiscope render` is asked for it.
const LOOK: [&str; 6] = [
    "--size",
    "560x420",
    "--background",
    "light",
    "--overlays",
    "plane,axis,reference",
];

/// Pictures of the `count` worst clouds, the worst first. A sentence instead where one cannot be drawn: a
/// report without pictures is better than none.
pub(super) fn of_worst(
    folder: &Path,
    rows: &[Row],
    request: &Request,
    count: usize,
) -> (Vec<WorstPicture>, Option<String>) {
    let worst = super::html::worst_first(rows);
    let mut pictures = Vec::new();
    if worst.is_empty() || count == 0 {
        return (pictures, None);
    }
    let gpu = match Gpu::headless() {
        Ok(gpu) => gpu,
        Err(error) => return (pictures, Some(format!("The report has no pictures: {error}."))),
    };
    for row in worst.into_iter().take(count) {
        match picture(&folder.join(&row.file), row, request, &gpu) {
            Ok(png) => pictures.push(WorstPicture {
                file: row.file.clone(),
                error_deg: row.error_deg,
                png,
            }),
            Err(error) => return (pictures, Some(format!("The report lacks pictures: {error:#}."))),
        }
    }
    (pictures, None)
}

fn picture(path: &Path, row: &Row, request: &Request, gpu: &Gpu) -> anyhow::Result<Vec<u8>> {
    let named = || path.display().to_string();
    let fruit = Fruit::read(path, request.unit, &request.peduncle)?;
    let examined = examine(fruit, request, &()).with_context(named)?;
    let reference = match row.truth.as_deref() {
        Some("simulation") => "truth",
        Some("peduncle") | None => "peduncle",
        Some("peduncle-direction") => "peduncle-direction",
        Some(_) => "manual",
    };
    let look = LOOK.into_iter().chain(["--reference", reference]);
    let command = Picture::augment_args(Command::new("picture").no_binary_name(true));
    let picture = Picture::from_arg_matches(&command.try_get_matches_from(look.clone())?)?;
    // The picture carries the command line that draws it again.
    let mut arguments: Vec<String> = ["render".into(), named(), "-o".into(), "picture.png".into()].into();
    arguments.extend(look.map(String::from));
    arguments.extend(axiscope::app::analysis_options(request));
    picture_of(
        &examined,
        Drawing {
            named: path,
            picture: &picture,
            arguments,
        },
        gpu,
    )
    .with_context(named)
}
