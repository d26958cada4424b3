//! The colorings of a cloud.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

use super::legend::{Legend, Ramp, Swatch};
use super::palette::{
    BLUE, GREEN, NEUTRAL, ORANGE, PINK, SKY, VALUE_STOPS, VALUELESS, VERMILION, direction_color, value_color,
};
use super::shown::ShownPoints;
use crate::geometry::Cloud;
use crate::method::{Analysis, PlaneDetail, PointDetail, Side};
use crate::render::Color;

/// The quantity that the points' colors show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Coloring {
    /// The file's colors.
    Rgb,
    /// The side of the plane (Fig. 9).
    Side,
    /// Whether a point has a visible partner, or is one (Fig. 5).
    Partner,
    /// d, the distance from the mirrored point to its nearest neighbor, in centimeters.
    Distance,
    /// ξ, the angle between the mirrored normal and that neighbor's, in degrees.
    Angle,
    /// d + τ·ξ, in centimeters.
    Score,
    /// The normal's direction.
    Normal,
    /// The file's labels.
    Label,
}

impl Coloring {
    /// All of them, in the order in which they are offered.
    pub const ALL: [Self; 8] = [
        Self::Rgb,
        Self::Side,
        Self::Partner,
        Self::Distance,
        Self::Angle,
        Self::Score,
        Self::Normal,
        Self::Label,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rgb => "rgb",
            Self::Side => "side",
            Self::Partner => "partner",
            Self::Distance => "distance",
            Self::Angle => "angle",
            Self::Score => "score",
            Self::Normal => "normal",
            Self::Label => "label",
        }
    }

    /// Whether it shows something of one plane.
    pub fn needs_plane(self) -> bool {
        !matches!(self, Self::Rgb | Self::Normal | Self::Label)
    }
}

/// The subject of a view: an analysis, and perhaps one of its planes.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The points that are shown.
    pub shown: &'a ShownPoints,
    /// Their analysis.
    pub analysis: &'a Analysis,
    /// The part of every used point in the plane's score.
    pub detail: Option<&'a PlaneDetail>,
}

/// The colors of a cloud with their legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Colored {
    /// One color per shown point.
    pub colors: Vec<Color>,
    /// Their legend.
    pub legend: Legend,
}

/// The reason why a cloud cannot be colored as requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ColoringError {
    /// The file has no colors.
    #[error("the file has no colors")]
    NoColors,
    /// The file has no labels.
    #[error("the file has no labels")]
    NoLabels,
    /// There is no plane to be colored by.
    #[error("there is no plane to color the points by")]
    NoPlane,
}

/// The share of values that the ramp spans; the rest has the color of its upper end.
const RAMP_SHARE: f64 = 0.98;

/// Colors every shown point.
///
/// # Errors
/// Returns an error if the file has no colors or labels, or if there is no plane.
pub fn color_points(subject: Subject<'_>, coloring: Coloring) -> Result<Colored, ColoringError> {
    let detail = || subject.detail.ok_or(ColoringError::NoPlane);
    Ok(match coloring {
        Coloring::Rgb => by_file(subject.shown)?,
        Coloring::Label => by_label(subject.shown)?,
        Coloring::Normal => by_normal(subject),
        Coloring::Side => by_side(subject, detail()?),
        Coloring::Partner => by_partner(subject, detail()?),
        Coloring::Distance => by_value(subject, detail()?, "Distance d (cm)", |p| {
            p.partner.map(|p| p.distance_cm)
        }),
        Coloring::Angle => by_value(subject, detail()?, "Angle ξ (degrees)", |p| {
            p.partner.map(|p| p.angle_rad.to_degrees())
        }),
        Coloring::Score => {
            let tau = subject.analysis.params.tau_cm_per_rad;
            by_value(subject, detail()?, "Score d + τξ (cm)", |p| {
                p.partner.map(|p| p.score_cm(tau))
            })
        }
    })
}

/// Colors the points of a cloud that was not analyzed: by the file's colors or labels, or in one gray.
pub fn color_bare(shown: &ShownPoints, coloring: Coloring) -> Colored {
    let by_what_there_is = match coloring {
        Coloring::Label => by_label(shown),
        _ => by_file(shown),
    };
    by_what_there_is.unwrap_or_else(|_| Colored {
        colors: vec![VALUELESS; shown.len()],
        legend: Legend {
            title: "Not analyzed".into(),
            ..Legend::default()
        },
    })
}

fn by_file(shown: &ShownPoints) -> Result<Colored, ColoringError> {
    let colors = shown.colors.as_ref().ok_or(ColoringError::NoColors)?;
    Ok(Colored {
        colors: colors.iter().map(|c| [c[0], c[1], c[2], 255]).collect(),
        legend: Legend {
            title: "Colors of the file".into(),
            ..Legend::default()
        },
    })
}

/// Colors by category: the categories in their order, and the index of each used point's category.
fn by_category(
    subject: Subject<'_>,
    title: &str,
    categories: &[(Color, &str)],
    category_of: impl Fn(usize) -> usize,
) -> Colored {
    let shown = subject.shown;
    let mut counts = vec![0; categories.len()];
    let mut unused = 0;
    let colors = shown.in_surface.iter().map(|place| {
        let Some(i) = place else {
            unused += 1;
            return NEUTRAL;
        };
        let category = category_of(i);
        counts[category] += 1;
        categories[category].0
    });
    let mut colors: Vec<Color> = colors.collect();
    let mut swatches: Vec<Swatch> = categories
        .iter()
        .zip(&counts)
        .map(|(&(color, label), &count)| Swatch::counted(color, label, count, shown.len()))
        .collect();
    swatches.extend(mark_unused(shown, unused, &mut colors));
    Colored {
        colors,
        legend: Legend {
            title: title.into(),
            swatches,
            ..Legend::default()
        },
    }
}

/// The color of a stray that was left out.
const STRAY: Color = GREEN;

/// Colors the strays that were left out, among the points that were `unused`, and returns the legend of all of these.
fn mark_unused(shown: &ShownPoints, unused: usize, colors: &mut [Color]) -> Vec<Swatch> {
    let mut strays = 0;
    for &i in shown
        .strays
        .iter()
        .filter(|&&i| shown.in_surface.get(i).is_none())
    {
        colors[i] = STRAY;
        strays += 1;
    }
    let counts = [(STRAY, "stray", strays), (NEUTRAL, "not used", unused - strays)];
    let counts = counts.into_iter().filter(|(_, _, count)| *count > 0);
    counts
        .map(|(color, label, count)| Swatch::counted(color, label, count, shown.len()))
        .collect()
}

fn by_side(subject: Subject<'_>, detail: &PlaneDetail) -> Colored {
    let categories = [(BLUE, "side of the normal"), (ORANGE, "other side")];
    by_category(subject, "Side of the plane", &categories, |i| {
        usize::from(detail.points[i].side == Side::Back)
    })
}

fn by_partner(subject: Subject<'_>, detail: &PlaneDetail) -> Colored {
    let mut is_partner = vec![false; detail.points.len()];
    for partner in detail.points.iter().filter_map(|p| p.partner) {
        is_partner[partner.index] = true;
    }
    let categories = [(BLUE, "has one"), (ORANGE, "only is one"), (PINK, "neither")];
    by_category(subject, "Visible symmetric partner", &categories, |i| {
        match (detail.points[i].partner, is_partner[i]) {
            (Some(_), _) => 0,
            (None, true) => 1,
            (None, false) => 2,
        }
    })
}

fn by_value(
    subject: Subject<'_>,
    detail: &PlaneDetail,
    title: &str,
    value_of: impl Fn(&PointDetail) -> Option<f64>,
) -> Colored {
    let shown = subject.shown;
    let mut values: Vec<f64> = detail.points.iter().filter_map(&value_of).collect();
    let most = values.iter().copied().max_by(f64::total_cmp);
    let high = match values.len() {
        0 => 0.0,
        n => {
            let rank = ((RAMP_SHARE * n as f64).ceil() as usize).clamp(1, n) - 1;
            *values.select_nth_unstable_by(rank, f64::total_cmp).1
        }
    };
    let (mut without, mut unused) = (0, 0);
    let colors = shown.in_surface.iter().map(|place| {
        let Some(i) = place else {
            unused += 1;
            return NEUTRAL;
        };
        let Some(value) = value_of(&detail.points[i]) else {
            without += 1;
            return VALUELESS;
        };
        value_color(if high > 0.0 { value / high } else { 0.0 })
    });
    let mut colors: Vec<Color> = colors.collect();
    let mut swatches = Vec::new();
    if without > 0 {
        swatches.push(Swatch::counted(VALUELESS, "no partner", without, shown.len()));
    }
    swatches.extend(mark_unused(shown, unused, &mut colors));
    let ramp = (high > 0.0).then(|| Ramp {
        stops: VALUE_STOPS.to_vec(),
        ticks: ticks(high),
        high,
    });
    let notes = match (most, &ramp) {
        (None, _) => vec!["no point has a partner".into()],
        (Some(_), None) => vec!["all values are 0".into()],
        (Some(most), Some(_)) => vec![format!("top: 98th percentile; most {}", digits(most, high))],
    };
    Colored {
        colors,
        legend: Legend {
            title: title.into(),
            ramp,
            swatches,
            notes,
        },
    }
}

/// Round values from zero to `high`, which itself is the last one.
fn ticks(high: f64) -> Vec<(f64, String)> {
    let step = round_step(high, 4.0);
    let mut ticks: Vec<(f64, String)> = (0..=4)
        .map(|i| f64::from(i) * step)
        // Too near to the upper end the numbers would overlap.
        .filter(|v| *v < 0.78 * high)
        .map(|v| (v / high, digits(v, high)))
        .collect();
    ticks.push((1.0, digits(high, high)));
    ticks
}

/// Returns the step of 1, 2 or 5 times a power of ten that gives at most `count` ticks up to `most`.
pub fn round_step(most: f64, count: f64) -> f64 {
    let rough = most / count;
    let power = 10_f64.powf(rough.log10().floor());
    let part = rough / power;
    power
        * [1.0, 2.0, 5.0]
            .into_iter()
            .find(|whole| part <= *whole)
            .unwrap_or(10.0)
}

/// A value with the digits that a scale up to `high` resolves.
fn digits(value: f64, high: f64) -> String {
    let decimals = (2.0 - high.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

fn by_normal(subject: Subject<'_>) -> Colored {
    let shown = subject.shown;
    let normals = subject.analysis.surface.normals();
    let mut colors: Vec<Color> = shown
        .in_surface
        .iter()
        .map(|place| place.map_or(NEUTRAL, |i| direction_color(normals[i])))
        .collect();
    let unused = shown.in_surface.iter().filter(Option::is_none).count();
    let direction = |label: &str, v: glam::DVec3| Swatch {
        color: direction_color(v),
        label: label.into(),
        count: None,
    };
    let mut swatches = vec![
        direction("right (+x)", glam::DVec3::X),
        direction("up (−y)", glam::DVec3::NEG_Y),
        direction("to the camera (−z)", glam::DVec3::NEG_Z),
    ];
    swatches.extend(mark_unused(shown, unused, &mut colors));
    Colored {
        colors,
        legend: Legend {
            title: "Direction of the normal".into(),
            swatches,
            ..Legend::default()
        },
    }
}

/// Labels beyond these share one color.
const MOST_LABELS: usize = 7;

fn by_label(shown: &ShownPoints) -> Result<Colored, ColoringError> {
    let labels = shown.labels.as_ref().ok_or(ColoringError::NoLabels)?;
    Ok(color_labels(labels))
}

/// Colors points by labels, one per point.
pub fn color_labels(labels: &[i32]) -> Colored {
    let mut counts: BTreeMap<i32, usize> = BTreeMap::new();
    for &label in labels {
        *counts.entry(label).or_default() += 1;
    }
    // The known labels always have the same colors.
    let fixed = |label: i32| match label {
        Cloud::FRUIT => Some((ORANGE, "fruit")),
        Cloud::PEDUNCLE => Some((GREEN, "peduncle")),
        Cloud::LEAF => Some((SKY, "leaf")),
        _ => None,
    };
    let mut free = [VERMILION, PINK, BLUE, [0xf0, 0xe4, 0x42, 255]].into_iter();
    let mut swatches = Vec::new();
    let mut color_of = BTreeMap::new();
    let mut others = 0;
    for (&label, &count) in &counts {
        let chosen = fixed(label)
            .map(|(color, name)| (color, name.to_owned()))
            .or_else(|| free.next().map(|color| (color, format!("label {label}"))));
        match chosen.filter(|_| swatches.len() < MOST_LABELS) {
            Some((color, name)) => {
                color_of.insert(label, color);
                swatches.push(Swatch::counted(color, name, count, labels.len()));
            }
            None => others += count,
        }
    }
    if others > 0 {
        swatches.push(Swatch::counted(NEUTRAL, "other labels", others, labels.len()));
    }
    Colored {
        colors: labels
            .iter()
            .map(|label| color_of.get(label).copied().unwrap_or(NEUTRAL))
            .collect(),
        legend: Legend {
            title: "Label".into(),
            swatches,
            ..Legend::default()
        },
    }
}
