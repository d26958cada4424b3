//! What one plane of an analysis looks like: the work a point that every change of plane, coloring or
//! overlay asks for, done beside the interface.

use std::ops::RangeInclusive;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::fruit::Fruit;
use crate::geometry::Cloud;
use crate::method::{Analysis, AxisEstimate, PlaneDetail, plane_detail};
use crate::parallel::{Cancelled, Watch};
use crate::peduncle::PeduncleSource;
use crate::render::{Color, Scene};
use crate::view::{
    Coloring, ColoringError, Legend, NEUTRAL, Overlay, Overlays, SceneSettings, ShownPoints, Subject, Theme,
    build_bare_scene, build_scene, color_bare, color_labels, color_points,
};

/// How a cloud is drawn, whichever it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    /// What the points' colors show.
    pub coloring: Coloring,
    /// What is drawn over them.
    pub overlays: Overlays,
    /// Light on dark, or dark on light.
    pub theme: Theme,
    /// A point's diameter in logical pixels; `None` so that the points close up to a surface.
    pub point_size: Option<f32>,
    /// Whether depth darkens.
    pub eye_dome: bool,
}

impl Default for Style {
    fn default() -> Self {
        let mut overlays = Overlays::default();
        // The window says these elsewhere.
        overlays.set(Overlay::Caption, false);
        Self {
            coloring: Coloring::Side,
            overlays,
            theme: Theme::Dark,
            point_size: None,
            eye_dome: true,
        }
    }
}

/// What a look is made from.
#[derive(Debug, Clone)]
pub struct Question {
    /// The cloud's points.
    pub shown: Arc<ShownPoints>,
    /// The analysis; `None` where there is none.
    pub analysis: Option<Arc<Analysis>>,
    /// The index of the plane that is looked at, in the grid.
    pub plane: Option<usize>,
    /// The axis that it is compared with.
    pub reference: Option<AxisEstimate>,
    /// All axes that there are to compare with.
    pub references: Vec<AxisEstimate>,
    /// How it is drawn.
    pub style: Style,
    /// Physical pixels a point of the style's sizes.
    pub pixels_per_point: f32,
    /// Contributions d + τξ in centimeters, outside of which points are grayed.
    pub brush_cm: Option<RangeInclusive<f64>>,
    /// The cloud, whose peduncle may be told otherwise than by its labels; `None` where it was not analyzed.
    pub fruit: Option<Arc<Fruit>>,
    /// What there may be already of the plane.
    pub detail: Option<Arc<PlaneDetail>>,
}

/// What came of it.
#[derive(Debug, Clone)]
pub struct Look {
    /// The points that were drawn.
    pub shown: Arc<ShownPoints>,
    /// The analysis that it shows.
    pub analysis: Option<Arc<Analysis>>,
    /// The plane's index in the grid.
    pub plane_index: Option<usize>,
    /// Every used point's part in the plane's score.
    pub detail: Option<Arc<PlaneDetail>>,
    /// The plane's axis (Eq. 16), where it has one.
    pub axis: Option<AxisEstimate>,
    /// The axis that it is compared with.
    pub reference: Option<AxisEstimate>,
    /// What is drawn.
    pub scene: Arc<Scene>,
    /// What the colors mean.
    pub legend: Arc<Legend>,
    /// Why the points are not colored as asked, where they are not.
    pub fallback: Option<ColoringError>,
    /// How the contributions are spread.
    pub contributions: Option<Arc<Contributions>>,
}

/// A histogram of the contributions S = d + τξ of one plane's points.
#[derive(Debug, Clone, PartialEq)]
pub struct Contributions {
    /// Points a bin, from zero upward.
    pub counts: Vec<usize>,
    /// The width of a bin in centimeters.
    pub bin_cm: f64,
    /// The mean in centimeters: the score under the mean.
    pub mean_cm: f64,
    /// The largest in centimeters; it may lie beyond the last bin, which then holds all that do.
    pub most_cm: f64,
}

impl Contributions {
    /// Bins of a histogram.
    pub const BINS: usize = 48;

    /// Of every point with a partner; `None` where there is none.
    pub fn of(detail: &PlaneDetail, tau_cm_per_rad: f64) -> Option<Self> {
        let partners = detail.points.iter().filter_map(|p| p.partner);
        let mut values: Vec<f64> = partners.map(|p| p.score_cm(tau_cm_per_rad)).collect();
        if values.is_empty() {
            return None;
        }
        let most_cm = values.iter().copied().fold(0.0, f64::max);
        let mean_cm = values.iter().sum::<f64>() / values.len() as f64;
        let rank = (values.len() - 1) * 99 / 100;
        let high = *values.select_nth_unstable_by(rank, f64::total_cmp).1;
        // All zero: an exact mirror.
        let bin_cm = if high > 0.0 { high } else { 1.0 } / Self::BINS as f64;
        let mut counts = vec![0; Self::BINS];
        for value in values {
            // Contributions are not negative.
            counts[((value / bin_cm) as usize).min(Self::BINS - 1)] += 1;
        }
        Some(Self {
            counts,
            bin_cm,
            mean_cm,
            most_cm,
        })
    }
}

/// Generations are counted over the whole program, so that no view mistakes one for another.
static GENERATION: AtomicU64 = AtomicU64::new(1);

pub(in crate::app) fn next_generation() -> u64 {
    GENERATION.fetch_add(1, Ordering::Relaxed)
}

/// Computes a look. `before` is the one that is on the screen: positions that have not changed keep
/// their generation, and are not sent to the GPU again.
///
/// # Errors
/// [`Cancelled`] when the watch calls the work off.
pub fn look(question: Question, before: Option<&Look>, watch: &dyn Watch) -> Result<Look, Cancelled> {
    let Question {
        shown,
        analysis,
        plane,
        reference,
        references,
        style,
        pixels_per_point,
        brush_cm,
        fruit,
        detail,
    } = question;
    let point_size_px = pixels_per_point * point_size(&style, shown.len());
    let mut settings = SceneSettings {
        overlays: &style.overlays,
        theme: style.theme,
        point_size_px,
        eye_dome_strength: if style.eye_dome { 1.0 } else { 0.0 },
        plane: None,
        axis: None,
        reference: reference.as_ref(),
        references: &references,
    };
    let Some(analysis) = analysis else {
        return Ok(bare_look(
            shown,
            reference.clone(),
            style.coloring,
            &settings,
            before,
        ));
    };
    let params = &analysis.params;
    let detail = match (plane, detail) {
        (Some(index), None) => Some(Arc::new(plane_detail(
            &analysis.surface,
            params.unit,
            analysis.plane(index),
            params.viewpoint,
            watch,
        )?)),
        (_, known) => known,
    };
    let axis = plane.and_then(|index| analysis.axis_of(index).ok());
    settings.plane = plane.map(|index| analysis.plane(index));
    settings.axis = axis.as_ref();
    let subject = Subject {
        shown: &shown,
        analysis: &analysis,
        detail: detail.as_deref(),
    };
    let told = fruit.filter(|_| style.coloring == Coloring::Label);
    let (mut colored, fallback) = match told.and_then(|fruit| told_labels(&fruit, &shown)).map_or_else(
        || color_points(subject, style.coloring),
        |labels| Ok(color_labels(&labels)),
    ) {
        Ok(colored) => (colored, None),
        Err(why) => (color_bare(&shown, style.coloring), Some(why)),
    };
    if watch.is_cancelled() {
        return Err(Cancelled);
    }
    if let (Some(range), Some(detail)) = (&brush_cm, &detail) {
        gray_outside(range, detail, params.tau_cm_per_rad, &shown, &mut colored.colors);
    }
    let mut scene = build_scene(subject, &colored, &settings);
    scene.scale_lines(pixels_per_point);
    let contributions = detail
        .as_ref()
        .and_then(|detail| Contributions::of(detail, params.tau_cm_per_rad));
    Ok(Look {
        scene: Arc::new(numbered(scene, &shown, before)),
        legend: Arc::new(colored.legend),
        shown: shown.clone(),
        plane_index: plane,
        detail,
        axis,
        reference,
        fallback,
        contributions: contributions.map(Arc::new),
        analysis: Some(analysis),
    })
}

/// Grays the points whose contribution d + τξ, in centimeters, is outside of a range.
fn gray_outside(
    range: &RangeInclusive<f64>,
    detail: &PlaneDetail,
    tau_cm_per_rad: f64,
    shown: &ShownPoints,
    colors: &mut [Color],
) {
    let is_in = |place: Option<usize>| {
        let partner = place.and_then(|i| detail.points[i].partner);
        partner.is_some_and(|p| range.contains(&p.score_cm(tau_cm_per_rad)))
    };
    for (color, place) in colors.iter_mut().zip(shown.in_surface.iter()) {
        if !is_in(place) {
            *color = NEUTRAL;
        }
    }
}

/// The shown points' labels with the peduncle as it was told; `None` where the file's own labels tell it,
/// or there is none.
fn told_labels(fruit: &Fruit, shown: &ShownPoints) -> Option<Vec<i32>> {
    let peduncle = fruit.peduncle.as_ref()?;
    if peduncle.source == PeduncleSource::Label {
        return None;
    }
    let cloud = fruit.cloud();
    // What the file calls the peduncle and nobody else does is the fruit's.
    let of_file = |i: usize| match cloud.labels().map(|labels| labels[i]) {
        None | Some(Cloud::PEDUNCLE) => Cloud::FRUIT,
        Some(other) => other,
    };
    let mut labels: Vec<i32> = (0..cloud.len()).map(of_file).collect();
    for &i in &peduncle.in_cloud {
        labels[i] = Cloud::PEDUNCLE;
    }
    Some(match &shown.in_file {
        Some(in_file) => in_file.iter().map(|&i| labels[i]).collect(),
        None => labels,
    })
}

/// The look of a cloud that was not analyzed.
fn bare_look(
    shown: Arc<ShownPoints>,
    reference: Option<AxisEstimate>,
    coloring: Coloring,
    settings: &SceneSettings<'_>,
    before: Option<&Look>,
) -> Look {
    let colored = color_bare(&shown, coloring);
    let scene = build_bare_scene(&shown, &colored, settings);
    Look {
        scene: Arc::new(numbered(scene, &shown, before)),
        legend: Arc::new(colored.legend),
        shown,
        analysis: None,
        plane_index: None,
        detail: None,
        axis: None,
        reference,
        fallback: None,
        contributions: None,
    }
}

/// A point's diameter in logical pixels.
pub(in crate::app) fn point_size(style: &Style, points: usize) -> f32 {
    style.point_size.unwrap_or_else(|| closing_size(points))
}

/// The diameter in logical pixels at which so many points close up to a surface in a view of usual size.
fn closing_size(points: usize) -> f32 {
    let fruit_px = 0.2 * 900.0 * 700.0;
    // From 1.5 to 9.
    (1.7 * (fruit_px / points.max(1) as f64).sqrt()).clamp(1.5, 9.0) as f32
}

fn numbered(mut scene: Scene, shown: &Arc<ShownPoints>, before: Option<&Look>) -> Scene {
    let same_points = before.filter(|b| Arc::ptr_eq(&b.shown, shown));
    for (i, points) in scene.points.iter_mut().enumerate() {
        let kept = same_points
            .filter(|_| i == 0)
            .and_then(|b| b.scene.points.first())
            .map(|p| p.positions_generation);
        points.positions_generation = kept.unwrap_or_else(next_generation);
        points.colors_generation = next_generation();
    }
    scene.lines_generation = next_generation();
    scene
}
