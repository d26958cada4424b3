//! The one way from settings to a scene: the window's view, saved pictures, `render`, the gallery's thumbnails and
//! the report's pictures are all composed here.

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::DVec3;

use super::coloring::{Colored, Coloring, ColoringError, Subject, color_bare, color_labels, color_points};
use super::palette::NEUTRAL;
use super::scene::{SceneSettings, build_bare_scene, build_scene, framed_points};
use super::shown::ShownPoints;
use super::style::Style;
use crate::geometry::Plane;
use crate::method::{Analysis, AxisEstimate, PlaneDetail, plane_detail};
use crate::parallel::{Cancelled, Watch};
use crate::render::{Color, Scene};

/// One candidate plane of an analysis with all that follows from it.
#[derive(Debug, Clone)]
pub struct PlaneView {
    /// The plane's index in the grid.
    pub index: usize,
    /// The plane through the fruit center.
    pub plane: Plane,
    /// The part of every used point in the plane's score.
    pub detail: Arc<PlaneDetail>,
    /// The plane's axis (Eq. 16), if it has one.
    pub axis: Option<AxisEstimate>,
}

impl PlaneView {
    /// The candidate at `index`. A `known` detail of this plane is not computed again.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if the watch calls the work off.
    pub fn new(
        analysis: &Analysis,
        index: usize,
        known: Option<Arc<PlaneDetail>>,
        watch: &dyn Watch,
    ) -> Result<Self, Cancelled> {
        let (plane, params) = (analysis.plane(index), &analysis.params);
        let detail = match known {
            Some(detail) => detail,
            None => Arc::new(plane_detail(
                &analysis.surface,
                params.unit,
                plane,
                params.viewpoint,
                watch,
            )?),
        };
        Ok(Self {
            index,
            plane,
            detail,
            axis: analysis.axis_of(index).ok(),
        })
    }
}

/// The content and style of a view: everything that its scene depends on.
#[derive(Debug, Clone)]
pub struct SceneRequest<'a> {
    /// The cloud's points.
    pub shown: &'a ShownPoints,
    /// The analysis; `None` for a cloud that was not analyzed, which is drawn bare.
    pub analysis: Option<&'a Analysis>,
    /// The index of the plane in the grid; `None` for a view without a plane.
    pub plane: Option<usize>,
    /// The detail of that plane, if it was computed before.
    pub detail: Option<Arc<PlaneDetail>>,
    /// The axis that the plane's is compared with.
    pub reference: Option<&'a AxisEstimate>,
    /// All axes to compare with.
    pub references: &'a [AxisEstimate],
    /// The style.
    pub style: &'a Style,
    /// A point's diameter in physical pixels.
    pub point_size_px: f32,
    /// Labels of the file's points that replace the file's own.
    pub labels: Option<Vec<i32>>,
    /// Contributions d + τξ in centimeters; points outside of the range are grayed.
    pub brush_cm: Option<RangeInclusive<f64>>,
}

/// A scene with what was found on the way to it.
#[derive(Debug, Clone)]
pub struct Composition {
    /// The plane that is shown.
    pub plane: Option<PlaneView>,
    /// The points' colors and their legend.
    pub colored: Colored,
    /// The reason why the points are not colored as requested.
    pub fallback: Option<ColoringError>,
    /// The scene, its lines of the usual width.
    pub scene: Scene,
}

/// Composes a scene.
///
/// # Errors
/// Returns [`Cancelled`] if the watch calls the work off.
pub fn compose(request: &SceneRequest<'_>, watch: &dyn Watch) -> Result<Composition, Cancelled> {
    let SceneRequest { shown, style, .. } = *request;
    let Some(analysis) = request.analysis else {
        let colored = color_bare(shown, style.coloring);
        return Ok(Composition {
            scene: build_bare_scene(shown, &colored, &request.settings(None)),
            plane: None,
            colored,
            fallback: None,
        });
    };
    let plane = request
        .plane
        .map(|index| PlaneView::new(analysis, index, request.detail.clone(), watch))
        .transpose()?;
    let detail = plane.as_ref().map(|plane| &*plane.detail);
    let subject = Subject {
        shown,
        analysis,
        detail,
    };
    let colored = match &request.labels {
        Some(labels) if style.coloring == Coloring::Label => Ok(color_labels(&shown.of_file(labels))),
        _ => color_points(subject, style.coloring),
    };
    let (mut colored, fallback) = match colored {
        Ok(colored) => (colored, None),
        Err(why) => (color_bare(shown, style.coloring), Some(why)),
    };
    if watch.is_cancelled() {
        return Err(Cancelled);
    }
    if let (Some(range), Some(detail)) = (&request.brush_cm, detail) {
        let tau_cm_per_rad = analysis.params.tau_cm_per_rad;
        gray_outside(range, detail, tau_cm_per_rad, shown, &mut colored.colors);
    }
    Ok(Composition {
        scene: build_scene(subject, &colored, &request.settings(plane.as_ref())),
        plane,
        colored,
        fallback,
    })
}

impl SceneRequest<'_> {
    fn settings<'a>(&'a self, plane: Option<&'a PlaneView>) -> SceneSettings<'a> {
        SceneSettings {
            style: self.style,
            point_size_px: self.point_size_px,
            plane: plane.map(|plane| plane.plane),
            axis: plane.and_then(|plane| plane.axis.as_ref()),
            reference: self.reference,
            references: self.references,
        }
    }

    /// The points that must be in the picture: those of the cloud, the plane and the axes.
    pub fn framed_points(&self, plane: Option<&PlaneView>) -> Vec<DVec3> {
        framed_points(self.shown, &self.settings(plane))
    }
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
