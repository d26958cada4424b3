//! What of a picture can be asked for on the command line.

use axiscope::evaluate::TruthChoice;
use axiscope::render::{Camera, Projection};
use axiscope::view::{Coloring, Drawing, Overlays, Style, Theme, ViewPreset};
use clap::{Args, ValueEnum};

use super::options::positive;

#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Picture")]
pub(super) struct Picture {
    /// Pixels, from 1x1 to 16384x16384
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = size)]
    pub(super) size: [u32; 2],
    /// What the points' colors show
    #[arg(long, value_enum, default_value = "side")]
    pub(super) color: ColorOption,
    /// The plane to look at: best, or its G,H
    #[arg(long, value_name = "PLANE", default_value = "best", value_parser = plane_choice)]
    pub(super) plane: PlaneChoice,
    /// Where to look from
    #[arg(long, value_enum, default_value = "camera")]
    pub(super) view: ViewOption,
    /// The very camera, as the window writes it into pictures and command lines; --view is then not looked at
    #[arg(long, value_name = "JSON", value_parser = camera)]
    pub(super) camera: Option<Camera>,
    /// The axis that the computed one is compared with
    #[arg(long, value_enum, default_value = "peduncle")]
    pub(super) reference: ReferenceOption,
    /// What is drawn over the points: all, none, or names with commas between them [default:
    /// plane,center,axis,reference,legend,scale,triad,caption; others: normal,viewpoint,ghost,partners,normals]
    #[arg(long, value_name = "LIST", value_parser = str::parse::<Overlays>)]
    pub(super) overlays: Option<Overlays>,
    /// Light on dark, or dark on light
    #[arg(long, value_enum, default_value = "dark")]
    pub(super) background: BackgroundOption,
    /// A point's diameter in pixels [default: by the number of points and pixels]
    #[arg(long, value_name = "PX", value_parser = point_size, allow_negative_numbers = true)]
    pub(super) point_size: Option<f64>,
    /// Parallel lines stay parallel
    #[arg(long)]
    pub(super) orthographic: bool,
    /// No shading by depth
    #[arg(long)]
    pub(super) flat: bool,
}

impl Picture {
    /// What these options ask for.
    pub(super) fn drawing(&self) -> Drawing {
        Drawing {
            size_px: self.size,
            style: Style {
                coloring: self.color.coloring(),
                overlays: self.overlays.clone().unwrap_or_default(),
                theme: match self.background {
                    BackgroundOption::Dark => Theme::Dark,
                    BackgroundOption::Light => Theme::Light,
                },
                point_size: self.point_size.map(|px| px as f32),
                eye_dome: !self.flat,
            },
            plane: match self.plane {
                PlaneChoice::Best => None,
                PlaneChoice::Named { g, h } => Some([g, h]),
            },
            view: self.view.preset(),
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

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum ColorOption {
    /// The file's colors
    Rgb,
    /// The side of the plane
    Side,
    /// Whether a point has a visible partner, or is one
    Partner,
    /// d: from the reflected point to its nearest neighbor
    Distance,
    /// ξ: between the reflected normal and that neighbor's
    Angle,
    /// d + τξ
    Score,
    /// The normal's direction
    Normal,
    /// The file's labels
    Label,
}

impl ColorOption {
    pub(super) fn coloring(self) -> Coloring {
        match self {
            Self::Rgb => Coloring::Rgb,
            Self::Side => Coloring::Side,
            Self::Partner => Coloring::Partner,
            Self::Distance => Coloring::Distance,
            Self::Angle => Coloring::Angle,
            Self::Score => Coloring::Score,
            Self::Normal => Coloring::Normal,
            Self::Label => Coloring::Label,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PlaneChoice {
    Best,
    Named { g: usize, h: usize },
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum ViewOption {
    /// From the viewpoint, as the depth camera saw it
    Camera,
    /// Along the depth axis
    Front,
    /// From the camera's right
    Side,
    /// From above
    Top,
    /// Along the plane's normal
    Normal,
    /// Along the axis
    Axis,
}

impl ViewOption {
    pub(super) fn preset(self) -> ViewPreset {
        match self {
            Self::Camera => ViewPreset::Camera,
            Self::Front => ViewPreset::Front,
            Self::Side => ViewPreset::Side,
            Self::Top => ViewPreset::Top,
            Self::Normal => ViewPreset::Normal,
            Self::Axis => ViewPreset::Axis,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum ReferenceOption {
    /// The peduncle's, else the first there is
    Peduncle,
    /// The peduncle's own direction, else the first there is
    PeduncleDirection,
    /// The simulator's, else the first there is
    Truth,
    /// The one set by hand: the adjudicated one, else the annotators' mean, else the first there is
    Manual,
}

impl ReferenceOption {
    pub(super) fn choice(self) -> TruthChoice {
        match self {
            Self::Peduncle => TruthChoice::Peduncle,
            Self::PeduncleDirection => TruthChoice::PeduncleDirection,
            Self::Truth => TruthChoice::Truth,
            Self::Manual => TruthChoice::Manual,
        }
    }
}

fn camera(text: &str) -> Result<Camera, String> {
    let camera: Camera = serde_json::from_str(text).map_err(|error| error.to_string())?;
    if camera.is_sound() {
        Ok(camera)
    } else {
        Err("its numbers must be finite, and the focus distance and field of view positive".into())
    }
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum BackgroundOption {
    /// For screens
    Dark,
    /// For print
    Light,
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

fn plane_choice(text: &str) -> Result<PlaneChoice, String> {
    if text == "best" {
        return Ok(PlaneChoice::Best);
    }
    let numbers: Vec<usize> = text
        .split(',')
        .map(|n| n.trim().parse().map_err(|_| "expected best, or two numbers G,H"))
        .collect::<Result<_, _>>()?;
    match numbers[..] {
        [g, h] => Ok(PlaneChoice::Named { g, h }),
        _ => Err("expected best, or two numbers G,H".into()),
    }
}
