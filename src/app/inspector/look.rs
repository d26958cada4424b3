//! The look of one plane of an analysis: the work per point that follows every change of plane, coloring or overlay,
//! done outside of the interface's thread.

use std::ops::RangeInclusive;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::fruit::Fruit;
use crate::method::{Analysis, AxisEstimate, PlaneDetail};
use crate::parallel::{Cancelled, Watch};
use crate::render::Scene;
use crate::view::{
    BodyDrawing, BodyParts, Coloring, ColoringError, Legend, SceneRequest, ShownPoints, Style, compose,
};

/// A fitted body, and the parts of it that are shown.
pub type ShownBody = (Arc<BodyDrawing>, BodyParts);

/// Everything that a look depends on.
#[derive(Debug, Clone)]
pub struct LookRequest {
    /// The cloud's points.
    pub shown: Arc<ShownPoints>,
    /// The analysis; `None` for a cloud that was not analyzed.
    pub analysis: Option<Arc<Analysis>>,
    /// The plane's index in the grid.
    pub plane: Option<usize>,
    /// The axis that the plane's is compared with.
    pub reference: Option<AxisEstimate>,
    /// All axes to compare with.
    pub references: Vec<AxisEstimate>,
    /// The style of the cloud.
    pub style: Style,
    /// Physical pixels per logical pixel.
    pub pixels_per_point: f32,
    /// Contributions d + τξ in centimeters; points outside of the range are grayed.
    pub brush_cm: Option<RangeInclusive<f64>>,
    /// The cloud, whose peduncle may have another source than its labels; `None` if it was not analyzed.
    pub fruit: Option<Arc<Fruit>>,
    /// The plane's detail, if it was computed before.
    pub detail: Option<Arc<PlaneDetail>>,
    /// The fitted body and what is shown of it.
    pub body: Option<ShownBody>,
}

/// One plane of an analysis as it is drawn.
#[derive(Debug, Clone)]
pub struct Look {
    /// The points that were drawn.
    pub shown: Arc<ShownPoints>,
    /// The analysis that it shows.
    pub analysis: Option<Arc<Analysis>>,
    /// The plane's index in the grid.
    pub plane_index: Option<usize>,
    /// The part of every used point in the plane's score.
    pub detail: Option<Arc<PlaneDetail>>,
    /// The plane's axis (Eq. 16), if it has one.
    pub axis: Option<AxisEstimate>,
    /// The axis that it is compared with.
    pub reference: Option<AxisEstimate>,
    /// The scene.
    pub scene: Arc<Scene>,
    /// The key to the colors.
    pub legend: Arc<Legend>,
    /// The reason why the points are not colored as requested.
    pub fallback: Option<ColoringError>,
    /// The distribution of the contributions.
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

    /// The histogram over every point with a partner; `None` if there is none.
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

/// Computes a look. `before` is the one on the screen: unchanged positions keep their generation, and are not sent
/// to the GPU again.
///
/// # Errors
/// Returns [`Cancelled`] if the watch calls the work off.
pub fn look(request: LookRequest, before: Option<&Look>, watch: &dyn Watch) -> Result<Look, Cancelled> {
    let LookRequest {
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
        body,
    } = request;
    let mut composed = compose(
        &SceneRequest {
            shown: &shown,
            analysis: analysis.as_deref(),
            plane,
            detail,
            reference: reference.as_ref(),
            references: &references,
            style: &style,
            point_size_px: pixels_per_point * style.point_size_in_window(shown.len()),
            labels: fruit
                .filter(|_| style.coloring == Coloring::Label)
                .and_then(|fruit| fruit.labels_by_peduncle()),
            brush_cm,
        },
        watch,
    )?;
    if let Some((body, parts)) = body {
        let size = shown.extent.size().length();
        body.add_to(&mut composed.scene, &mut composed.colored.legend, parts, size);
        composed.scene.fit_bounds();
    }
    let (mut scene, plane) = (composed.scene, composed.plane);
    scene.scale_lines(pixels_per_point);
    let contributions = (plane.as_ref().zip(analysis.as_ref()))
        .and_then(|(plane, analysis)| Contributions::of(&plane.detail, analysis.params.tau_cm_per_rad));
    Ok(Look {
        scene: Arc::new(numbered(scene, &shown, before)),
        legend: Arc::new(composed.colored.legend),
        plane_index: plane.as_ref().map(|plane| plane.index),
        detail: plane.as_ref().map(|plane| plane.detail.clone()),
        axis: plane.and_then(|plane| plane.axis),
        reference,
        fallback: composed.fallback,
        contributions: contributions.map(Arc::new),
        shown,
        analysis,
    })
}

/// The scene with generations: the positions keep theirs if the look before shows the same points.
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
