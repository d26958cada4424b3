//! The command-line options of a picture.

use axiscope::evaluate::TruthChoice;
use axiscope::render::{Camera, Projection};
use axiscope::view::{Coloring, Drawing, Overlays, Style, Theme, ViewPreset};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use super::options::{OrBest, plane_choice, positive};

#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Picture")]
pub(super) struct Picture {
    /// Width and height in pixels, from 1x1 to 16384x16384
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = size)]
    pub(super) size: [u32; 2],
    /// Meaning of the points' colors
    #[arg(long, value_enum, default_value = "side")]
    pub(super) color: Coloring,
    /// Plane to show: best, or its G,H
    #[arg(long, value_name = "PLANE", default_value = "best", value_parser = plane_choice)]
    pub(super) plane: OrBest<[usize; 2]>,
    /// Direction of the view
    #[arg(long, value_enum, default_value = "camera")]
    pub(super) view: ViewPreset,
    /// Exact camera, as the window writes it into pictures and command lines; overrides --view
    #[arg(long, value_name = "JSON", value_parser = camera)]
    pub(super) camera: Option<Camera>,
    /// The axis that the computed one is compared with; without one of this kind, the first there is
    #[arg(long, default_value = "peduncle", value_parser = reference())]
    pub(super) reference: TruthChoice,
    /// Overlays on the points: all, none, or names with commas between them [default:
    /// plane,center,axis,reference,legend,scale,triad,caption; others: normal,viewpoint,ghost,partners,normals]
    #[arg(long, value_name = "LIST", value_parser = str::parse::<Overlays>)]
    pub(super) overlays: Option<Overlays>,
    /// Background of the picture
    #[arg(long, value_enum, default_value = "dark")]
    pub(super) background: Theme,
    /// Diameter of a point in pixels [default: by the number of points and pixels]
    #[arg(long, value_name = "PX", value_parser = point_size, allow_negative_numbers = true)]
    pub(super) point_size: Option<f64>,
    /// Use an orthographic projection: parallel lines stay parallel
    #[arg(long)]
    pub(super) orthographic: bool,
    /// Leave out the shading of steps in depth
    #[arg(long)]
    pub(super) flat: bool,
}

impl Picture {
    /// The settings of the picture.
    pub(super) fn drawing(&self) -> Drawing {
        Drawing {
            size_px: self.size,
            style: Style {
                coloring: self.color,
                overlays: self.overlays.clone().unwrap_or_default(),
                theme: self.background,
                point_size: self.point_size.map(|px| px as f32),
                eye_dome: !self.flat,
            },
            plane: self.plane,
            view: self.view,
            camera: self.camera,
            projection: if self.orthographic {
                Projection::Orthographic
            } else {
                Projection::Perspective
            },
            has_angle: true,
        }
    }
}

/// Parses the name of a kind of reference; `auto` is not offered.
fn reference() -> impl TypedValueParser<Value = TruthChoice> {
    let kinds = TruthChoice::value_variants().iter().copied();
    let names = kinds.filter(|kind| *kind != TruthChoice::Auto);
    PossibleValuesParser::new(names.filter_map(|kind| kind.to_possible_value()))
        .try_map(|name| TruthChoice::from_str(&name, false))
}

fn camera(text: &str) -> Result<Camera, String> {
    let camera: Camera = serde_json::from_str(text).map_err(|error| error.to_string())?;
    if camera.is_sound() {
        Ok(camera)
    } else {
        Err("its numbers must be finite, and the focus distance and field of view positive".into())
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let wrong = || "expected WIDTHxHEIGHT in pixels, each from 1 to 16384".to_owned();
    let (width, height) = text.split_once(['x', '×']).ok_or_else(wrong)?;
    let side = |text: &str| {
        let side = text.parse::<u32>().map_err(|_| wrong())?;
        if (1..=axiscope::render::MAX_SIDE_PX).contains(&side) {
            Ok(side)
        } else {
            Err(wrong())
        }
    };
    Ok([side(width)?, side(height)?])
}

fn point_size(text: &str) -> Result<f64, String> {
    match positive(text)? {
        px if px <= 100.0 => Ok(px),
        _ => Err("expected at most 100 pixels".into()),
    }
}
