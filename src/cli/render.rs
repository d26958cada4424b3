//! `axiscope render`: the 3-D view as a picture, without a window.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use anyhow::Context;
use axiscope::app::caption;
use axiscope::evaluate::{Examined, examine, reference_of};
use axiscope::geometry::Plane;
use axiscope::io::{
    Fruit, PictureSettings, encode_picture, paint_annotations, picture_settings, text_width_px,
};
use axiscope::method::{Analysis, AxisEstimate, AxisSource, PlaneDetail, plane_detail, symmetry_axis};
use axiscope::reference::axis_error_rad;
use axiscope::render::{Gpu, Projection, Viewport, draw_image};
use axiscope::view::{
    Overlay, Page, SceneSettings, ShownPoints, Subject, Theme, ViewPreset, annotate, build_scene,
    color_points, framed_points, insets,
};
use clap::Args;
use glam::DVec3;

use super::options::AnalysisOptions;
use super::picture_options::{BackgroundOption, Picture, PlaneChoice};
use super::progress::StageClock;
use super::usage_error;

/// What of the picture is asked for; the analysis has its own options.
#[derive(Debug, Args)]
pub(super) struct Render {
    /// The point cloud (PLY); with --from, where it lies now
    #[arg(required_unless_present = "from")]
    cloud: Option<PathBuf>,
    /// The PNG to write; it carries its settings
    #[arg(short, long, value_name = "PATH")]
    out: PathBuf,
    /// Draw a picture again, from the settings that it carries
    #[arg(long, value_name = "PNG", conflicts_with_all = ["Picture", "AnalysisOptions"])]
    from: Option<PathBuf>,
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    analysis: AnalysisOptions,
}

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
            let bytes = std::fs::read(figure).with_context(|| figure.display().to_string())?;
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
    std::fs::write(&args.out, png).with_context(|| args.out.display().to_string())
}

/// The plane that is looked at, and what follows from it.
struct Looked {
    plane: Plane,
    index: usize,
    detail: PlaneDetail,
    axis: Option<AxisEstimate>,
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
    let drawing = Drawing {
        named,
        picture,
        arguments,
    };
    picture_of(&examined, drawing, &gpu).with_context(|| cloud.display().to_string())
}

/// What to draw of a cloud.
pub(super) struct Drawing<'a> {
    /// What the settings and the caption call the cloud.
    pub(super) named: &'a Path,
    pub(super) picture: &'a Picture,
    /// The command line that the picture carries.
    pub(super) arguments: Vec<String>,
}

/// A picture of a cloud that was examined, as PNG bytes.
pub(super) fn picture_of(examined: &Examined, drawing: Drawing<'_>, gpu: &Gpu) -> anyhow::Result<Vec<u8>> {
    let Examined {
        fruit,
        analysis,
        references,
        ..
    } = examined;
    let Drawing {
        named,
        picture,
        arguments,
    } = drawing;
    let looked = looked_at(analysis, picture.plane)?;
    let reference = reference_of(references, picture.reference.choice()).or(references.first());
    let shown = ShownPoints::new(fruit.cloud(), analysis);
    let subject = Subject {
        shown: &shown,
        analysis,
        detail: looked.as_ref().map(|l| &l.detail),
    };
    let colored = color_points(subject, picture.color.coloring())?;

    let overlays = picture.overlays.clone().unwrap_or_default();
    let has = |overlay| overlays.has(overlay);
    let axis = looked.as_ref().and_then(|l| l.axis.as_ref());
    let theme = match picture.background {
        BackgroundOption::Dark => Theme::Dark,
        BackgroundOption::Light => Theme::Light,
    };
    let settings = SceneSettings {
        overlays: &overlays,
        theme,
        point_size_px: picture
            .point_size
            .unwrap_or_else(|| default_point_size(shown.len(), picture.size)) as f32,
        eye_dome_strength: if picture.flat { 0.0 } else { 1.0 },
        plane: looked.as_ref().map(|l| l.plane),
        axis,
        reference,
        references,
    };
    let mut scene = build_scene(subject, &colored, &settings);
    scene.scale_lines(axiscope::view::line_scale(picture.size[1]));

    let name = named.file_name().unwrap_or_default().to_string_lossy();
    let index = looked.as_ref().map(|l| l.index);
    let caption = caption(&name, analysis, index, axis, reference);
    let both = axis
        .zip(reference)
        .filter(|_| has(Overlay::Axis) && has(Overlay::Reference));
    // Where the drawn line ends: 0.62 of the fruit's size, which is twice the shading's length.
    let reach = 1.24 * f64::from(scene.eye_dome.scale);
    let angle = both.map(|(axis, reference)| angle_label(axis, reference, reach));
    let [width, height] = picture.size;
    let viewport = Viewport::new(width.into(), height.into());
    let page = Page {
        viewport,
        theme,
        legend: has(Overlay::Legend).then_some(&colored.legend),
        scale_unit: has(Overlay::Scale).then(|| fruit.unit.symbol()),
        has_triad: has(Overlay::Triad),
        caption: if has(Overlay::Caption) { &caption } else { &[] },
        label: angle.as_ref().map(|(place, text)| (*place, text.as_str())),
    };
    let preset = picture.view.preset();
    let direction = match preset {
        ViewPreset::Normal => Some(
            looked
                .as_ref()
                .context("there is no plane to look along the normal of")?
                .plane
                .normal,
        ),
        ViewPreset::Axis => Some(axis.context("there is no axis to look along")?.direction),
        _ => None,
    };
    let projection = if picture.orthographic {
        Projection::Orthographic
    } else {
        Projection::Perspective
    };
    let preset_camera = || {
        preset.camera(
            &framed_points(subject, &settings),
            analysis.params.viewpoint,
            direction.unwrap_or_default(),
            projection,
            viewport,
            insets(&page, &text_width_px),
        )
    };
    let camera = picture.camera.unwrap_or_else(preset_camera);
    let mut image = draw_image(gpu, &scene, &camera, width, height)?;
    paint_annotations(&mut image, &annotate(&page, &camera, &text_width_px))?;
    Ok(encode_picture(
        &image,
        &PictureSettings {
            version: env!("CARGO_PKG_VERSION").into(),
            arguments,
            cloud: named.display().to_string(),
            sha256: fruit.file.sha256.clone(),
        },
    )?)
}

/// The angle between two axes in words, and its place: `reach` from the axis' origin, at its upper end.
fn angle_label(axis: &AxisEstimate, reference: &AxisEstimate, reach: f64) -> (DVec3, String) {
    let text = format!("{:.1}° apart", axis_error_rad(axis, reference).to_degrees());
    let upward = if axis.direction.y > 0.0 {
        -axis.direction
    } else {
        axis.direction
    };
    (axis.origin + reach * upward, text)
}

/// The fruit, its analysis and its references; warnings go to standard error.
fn examined(
    cloud: &Path,
    options: &AnalysisOptions,
    expected_sha256: Option<&str>,
) -> anyhow::Result<Examined> {
    let request = options.request();
    let fruit = Fruit::read(cloud, request.unit, &request.peduncle)?;
    if expected_sha256.is_some_and(|hash| hash != fruit.file.sha256) {
        eprintln!(
            "Warning: {} has changed since the picture was drawn: this one may differ.",
            cloud.display()
        );
    }
    let clock = StageClock::new();
    let examined = examine(fruit, &request, &clock);
    clock.finish();
    let examined = examined.with_context(|| cloud.display().to_string())?;
    for warning in &examined.warnings {
        eprintln!("Warning: {warning}");
    }
    Ok(examined)
}

fn looked_at(analysis: &Analysis, choice: PlaneChoice) -> anyhow::Result<Option<Looked>> {
    let grid = analysis.planes.grid;
    let index = match choice {
        PlaneChoice::Best => match analysis.ranking.best() {
            Ok(index) => index,
            // Why there is none, a warning has told.
            Err(_) => return Ok(None),
        },
        PlaneChoice::Named { g, h } => grid.index_of(g, h).ok_or_else(|| {
            usage_error(&format!(
                "there is no plane {g},{h}: both numbers run from 1 to {}",
                grid.u()
            ))
        })?,
    };
    let candidate = grid.candidate(index);
    let (center, params) = (analysis.center, &analysis.params);
    let plane = Plane {
        point: center,
        normal: candidate.normal,
    };
    let axis = symmetry_axis(candidate.normal, center, params.viewpoint).ok();
    Ok(Some(Looked {
        plane,
        index,
        detail: plane_detail(&analysis.surface, params.unit, plane, params.viewpoint, &())?,
        axis: axis.map(|direction| AxisEstimate {
            source: AxisSource::SymmetryPlane,
            origin: center,
            direction,
            confidence: None,
        }),
    }))
}

/// So large that the points of a fruit close up to a surface, within reason.
fn default_point_size(points: usize, [width, height]: [u32; 2]) -> f64 {
    let fruit_px = 0.2 * f64::from(width) * f64::from(height);
    (1.7 * (fruit_px / points.max(1) as f64).sqrt()).clamp(2.0, 12.0)
}
