//! Lines of 3D Slicer's Markups module (`.mrk.json`).
//!
//! Slicer takes every coordinate for a patient's, in millimeters, in one of two frames: left, posterior and superior (LPS,
//! as in its files) or right, anterior and superior (RAS). A PLY file is loaded as LPS by default, so it has the same frame
//! as the lines drawn on it. Its numbers are taken for millimeters whatever their unit, so a line drawn on a cloud in
//! meters holds meters.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::annotate::{Ends, EndsError};
use crate::geometry::{Extent, Unit};
use crate::text::one_line;

/// The frame of Slicer in which the cloud was loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum SlicerFrame {
    /// Left, posterior, superior: Slicer's own choice for a file that does not say.
    #[default]
    Lps,
    /// Right, anterior, superior.
    Ras,
}

/// The relation between the coordinates of a line in Slicer and those of the cloud's file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Placement {
    /// The frame in which the cloud was loaded.
    pub frame: SlicerFrame,
    /// Whether the cloud was loaded as it is, its numbers taken for millimeters. If not, it was converted to millimeters
    /// first.
    pub numbers_as_they_are: bool,
}

/// A line with its two points, in Slicer's LPS frame and its millimeters.
#[derive(Debug, Clone, PartialEq)]
pub struct SlicerLine {
    /// Its name.
    pub name: String,
    /// The first point placed and the second.
    pub points: [DVec3; 2],
}

/// The reason why a markup file gives no axis.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SlicerError {
    /// The file is not a markup file.
    #[error("it is no markup file: {0}")]
    Malformed(String),
    /// The file has no line.
    #[error("it holds no line")]
    NoLine,
    /// The frame is neither LPS nor RAS.
    #[error("its coordinate system {0:?} is neither LPS nor RAS")]
    Frame(String),
    /// The unit is not millimeters.
    #[error("its coordinates are in {0:?}, not in mm")]
    Unit(String),
    /// A line has more or fewer points than two.
    #[error("the line {name:?} has {points} points where a line has two")]
    Points {
        /// The line's name.
        name: String,
        /// The number of its points that have a position.
        points: usize,
    },
    /// The two points of the line are not an axis.
    #[error(transparent)]
    Ends(#[from] EndsError),
    /// The line is far from the cloud.
    #[error("the line lies away from the cloud{}", hint(.fits))]
    Away {
        /// The placements with which the line would lie on the cloud.
        fits: Vec<Placement>,
    },
}

fn hint(fits: &[Placement]) -> String {
    let Some(fit) = fits.first() else {
        return ", however its coordinates are read".into();
    };
    let frame = match fit.frame {
        SlicerFrame::Lps => "LPS",
        SlicerFrame::Ras => "RAS",
    };
    let numbers = if fit.numbers_as_they_are {
        "its numbers as they are"
    } else {
        "its millimeters converted"
    };
    format!("; it would lie on it where the cloud was loaded as {frame}, with {numbers}")
}

#[derive(Deserialize)]
struct File {
    markups: Vec<Markup>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Markup {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    name: String,
    /// A name, or in old files a number.
    #[serde(default)]
    coordinate_system: Option<serde_json::Value>,
    #[serde(default)]
    coordinate_units: Option<serde_json::Value>,
    #[serde(default)]
    control_points: Vec<Point>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Point {
    #[serde(default)]
    position: Option<DVec3>,
    #[serde(default)]
    position_status: Option<String>,
}

/// Reads every line of a markup file. Other markups are skipped.
///
/// # Errors
/// Returns an error if the file is not a markup file or has no line, and if a line does not have two points, or is in
/// another unit or frame than Slicer's.
pub fn read_lines(bytes: &[u8]) -> Result<Vec<SlicerLine>, SlicerError> {
    let file: File =
        serde_json::from_slice(bytes).map_err(|e| SlicerError::Malformed(one_line(&e.to_string())))?;
    let lines = file.markups.into_iter().filter(|markup| markup.kind == "Line");
    let lines = lines.map(line).collect::<Result<Vec<_>, _>>()?;
    if lines.is_empty() {
        return Err(SlicerError::NoLine);
    }
    Ok(lines)
}

fn line(markup: Markup) -> Result<SlicerLine, SlicerError> {
    // LPS is the default of the format; the first versions of Slicer wrote 0 and 1 for RAS and LPS.
    let frame = match &markup.coordinate_system {
        None => SlicerFrame::Lps,
        Some(value) => match (value.as_str(), value.as_u64()) {
            (Some("LPS"), _) | (_, Some(1)) => SlicerFrame::Lps,
            (Some("RAS"), _) | (_, Some(0)) => SlicerFrame::Ras,
            _ => return Err(SlicerError::Frame(value.to_string())),
        },
    };
    match &markup.coordinate_units {
        None => {}
        Some(unit) if unit.as_str() == Some("mm") => {}
        Some(unit) => return Err(SlicerError::Unit(unit.to_string())),
    }
    let is_placed = |p: &Point| {
        p.position_status
            .as_deref()
            .is_none_or(|status| status == "defined")
    };
    let placed = markup.control_points.iter().filter(|p| is_placed(p));
    let points: Vec<DVec3> = placed.filter_map(|p| p.position).collect();
    let [first, second] = points[..] else {
        return Err(SlicerError::Points {
            name: markup.name,
            points: points.len(),
        });
    };
    Ok(SlicerLine {
        name: markup.name,
        points: [first, second].map(|p| turned(p, frame)),
    })
}

/// Converts between LPS and a frame, in either direction: RAS is LPS after half a turn about the vertical.
fn turned(point: DVec3, frame: SlicerFrame) -> DVec3 {
    match frame {
        SlicerFrame::Lps => point,
        SlicerFrame::Ras => DVec3::new(-point.x, -point.y, point.z),
    }
}

/// Returns the length in Slicer's millimeters of one unit of the cloud's file.
fn millimeters(unit: Unit, placement: Placement) -> f64 {
    if placement.numbers_as_they_are {
        1.0
    } else {
        10.0 * unit.in_cm()
    }
}

/// Converts a line to the frame and unit of the cloud's file; its first point becomes the peduncle's base. `extent` is the
/// cloud's.
///
/// # Errors
/// Returns an error if the line lies farther from the cloud than half the cloud's size, or is much shorter or longer than
/// the cloud: then its placement is wrong, and the error names those that would fit.
pub fn place(
    line: &SlicerLine,
    unit: Unit,
    extent: &Extent,
    placement: Placement,
) -> Result<Ends, SlicerError> {
    let ends = |placement: Placement| {
        let [base, blossom] = line
            .points
            .map(|p| turned(p, placement.frame) / millimeters(unit, placement));
        Ends::new(base, blossom)
    };
    let fits = |ends: &Ends| {
        let size = extent.size().length();
        // The camera sees half of a fruit, and the other half reaches about as far beyond the points.
        let reach = DVec3::splat(0.5 * size);
        let near = |p: DVec3| p.cmpge(extent.min - reach).all() && p.cmple(extent.max + reach).all();
        // Near the origin a line in the wrong unit can lie on the cloud too, but it is far too short.
        let share = ends.length() / size;
        near(ends.peduncle_base()) && near(ends.blossom_end()) && (0.2..3.0).contains(&share)
    };
    let placed = ends(placement)?;
    if fits(&placed) {
        return Ok(placed);
    }
    let others = [SlicerFrame::Lps, SlicerFrame::Ras]
        .into_iter()
        .flat_map(|frame| {
            [false, true].map(|numbers_as_they_are| Placement {
                frame,
                numbers_as_they_are,
            })
        });
    let fits = others.filter(|&other| ends(other).is_ok_and(|ends| fits(&ends)));
    Err(SlicerError::Away { fits: fits.collect() })
}

#[derive(Serialize)]
struct FileOut<'a> {
    #[serde(rename = "@schema")]
    schema: &'static str,
    markups: [MarkupOut<'a>; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct MarkupOut<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    name: &'a str,
    coordinate_system: &'static str,
    coordinate_units: &'static str,
    control_points: [PointOut; 2],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct PointOut {
    id: &'static str,
    label: &'static str,
    position: DVec3,
    position_status: &'static str,
}

const SCHEMA: &str = "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#";

/// A markup file with the axis as its one line, from the peduncle's base to the blossom end. [`place`]
/// with the same placement gives the ends back.
pub fn write_line(name: &str, ends: &Ends, unit: Unit, placement: Placement) -> String {
    let point = |id, label, place: DVec3| PointOut {
        id,
        label,
        position: turned(place * millimeters(unit, placement), placement.frame),
        position_status: "defined",
    };
    let file = FileOut {
        schema: SCHEMA,
        markups: [MarkupOut {
            kind: "Line",
            name,
            coordinate_system: "LPS",
            coordinate_units: "mm",
            control_points: [
                point("1", "peduncle base", ends.peduncle_base()),
                point("2", "blossom end", ends.blossom_end()),
            ],
        }],
    };
    // Strings and finite numbers cannot fail to become JSON.
    serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
}
