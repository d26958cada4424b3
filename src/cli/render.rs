//! `axiscope render`: the 3-D view as a picture, without a window.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use anyhow::Context;
use axiscope::evaluate::{Examination, examine};
use axiscope::files::read_at_most;
use axiscope::fruit::Fruit;
use axiscope::render::Gpu;
use axiscope::view::{DrawingError, PictureSettings, draw_cloud, encode_picture, picture_settings};
use clap::Args;

use super::options::AnalysisOptions;
use super::output::say;
use super::picture_options::Picture;
use super::progress::StageClock;
use super::usage_error;

/// The arguments of `render`.
#[derive(Debug, Args)]
pub(super) struct Render {
    /// The point cloud (PLY); with --from, its present path
    #[arg(required_unless_present = "from")]
    cloud: Option<PathBuf>,
    /// The PNG to write, which carries its settings
    #[arg(short, long, value_name = "PATH")]
    out: PathBuf,
    /// Draw this picture again, from the settings that it carries
    #[arg(long, value_name = "PNG", conflicts_with_all = ["Picture", "AnalysisOptions"])]
    from: Option<PathBuf>,
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    analysis: AnalysisOptions,
}

/// The longest picture that is read for its settings, in bytes.
const LONGEST_PICTURE: u64 = 256 << 20;

/// Draws. `arguments` is the whole command line, `parse` reads one.
pub(super) fn run(
    args: &Render,
    arguments: impl Iterator<Item = OsString>,
    parse: impl Fn(&[String]) -> Option<Render>,
) -> anyhow::Result<()> {
    let png = match &args.from {
        None => {
            let arguments = arguments
                .skip(1)
                .map(|a| a.to_string_lossy().into_owned())
                .collect();
            let cloud = args.cloud.as_deref().unwrap_or(Path::new(""));
            draw(cloud, cloud, &args.picture, &args.analysis, arguments, None)?
        }
        Some(figure) => {
            let bytes =
                read_at_most(figure, LONGEST_PICTURE).with_context(|| figure.display().to_string())?;
            let settings = picture_settings(&bytes).with_context(|| figure.display().to_string())?;
            let words = std::iter::once("axiscope".to_owned()).chain(settings.arguments.clone());
            let words: Vec<String> = words.collect();
            let stored = parse(&words).with_context(|| {
                format!(
                    "{}: its settings are of version {} and cannot be understood",
                    figure.display(),
                    settings.version
                )
            })?;
            let named = PathBuf::from(&settings.cloud);
            let cloud = args.cloud.as_deref().unwrap_or(&named);
            draw(
                cloud,
                &named,
                &stored.picture,
                &stored.analysis,
                settings.arguments,
                Some(&settings.sha256),
            )?
        }
    };
    super::output::write(&args.out, &png)
}

/// The picture as PNG bytes. `named` is what the settings call the cloud, which lies at `cloud`.
fn draw(
    cloud: &Path,
    named: &Path,
    picture: &Picture,
    options: &AnalysisOptions,
    arguments: Vec<String>,
    expected_sha256: Option<&str>,
) -> anyhow::Result<Vec<u8>> {
    let examined = examined(cloud, options, expected_sha256)?;
    let gpu = Gpu::headless()?;
    let name = named.file_name().unwrap_or_default().to_string_lossy();
    let drawn = examined.drawn(&name, picture.reference);
    let image = draw_cloud(&drawn, &picture.drawing(), &gpu, &()).map_err(|error| match error {
        DrawingError::NoSuchPlane { .. } => usage_error(&error.to_string()),
        _ => error.into(),
    });
    let image = image.with_context(|| cloud.display().to_string())?;
    let settings = PictureSettings {
        version: env!("CARGO_PKG_VERSION").into(),
        arguments,
        cloud: named.display().to_string(),
        sha256: examined.fruit.file.sha256.clone(),
    };
    encode_picture(&image, &settings).with_context(|| cloud.display().to_string())
}

/// The fruit, its analysis and its references; warnings go to standard error.
fn examined(
    cloud: &Path,
    options: &AnalysisOptions,
    expected_sha256: Option<&str>,
) -> anyhow::Result<Examination> {
    let request = options.request();
    let fruit = Fruit::read(cloud, &request)?;
    if expected_sha256.is_some_and(|hash| hash != fruit.file.sha256) {
        say!(
            "Warning: {} has changed since the picture was drawn: this one may differ.",
            cloud.display()
        );
    }
    let clock = StageClock::new();
    let examined = examine(fruit, &request, &clock);
    clock.finish();
    let examined = examined.with_context(|| cloud.display().to_string())?;
    for warning in &examined.warnings {
        say!("Warning: {warning}");
    }
    Ok(examined)
}
