//! The peduncle highlighted in the view, as it is or as a stroke under way makes it.

use std::sync::{Arc, Mutex, PoisonError};

use super::state::{Marked, Stroke};
use crate::app::inspector::look::{Look, next_generation};
use crate::app::state::State;
use crate::app::tool::Tool;
use crate::fruit::{Fruit, PeduncleChoice};
use crate::geometry::{Cloud, PointSet};
use crate::peduncle::{HueRange, hue_deg};
use crate::render::{Camera, Color, Scene, Viewport};
use crate::view::{Brush, Lasso, PEDUNCLE_MARK, Region, Screen, faded};

/// The result of a job: the highlight, and the stroke's selection.
pub(in crate::app) struct Marking {
    pub(super) marked: Marked,
    /// The number of the stroke that has ended, and the points that are selected after it.
    pub(super) stroke: Option<(u64, Arc<PointSet>)>,
}

/// The input of a highlight.
#[derive(Debug, Clone)]
pub(in crate::app) struct Wanted {
    look: Arc<Look>,
    what: What,
}

#[derive(Debug, Clone)]
enum What {
    /// Points of the cloud.
    Points(Arc<PointSet>),
    /// Those of a color.
    Hue(HueRange),
    /// Those that the analysis found.
    Found(Arc<Fruit>),
    /// The selection before a stroke, changed by it.
    Stroke {
        stroke: Stroke,
        radius_px: f64,
        is_through: bool,
    },
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.look, &other.look)
            && match (&self.what, &other.what) {
                (What::Points(a), What::Points(b)) => a == b,
                (What::Hue(a), What::Hue(b)) => a == b,
                (What::Found(a), What::Found(b)) => Arc::ptr_eq(a, b),
                (
                    What::Stroke {
                        stroke: a,
                        radius_px: ra,
                        is_through: ta,
                    },
                    What::Stroke {
                        stroke: b,
                        radius_px: rb,
                        is_through: tb,
                    },
                ) => {
                    let of = |s: &Stroke| (s.id, s.path_px.len(), s.is_ended);
                    of(a) == of(b) && ra == rb && ta == tb
                }
                _ => false,
            }
    }
}

/// The newest projection of a cloud: it serves all strokes until the camera moves.
#[derive(Debug, Clone, Default)]
pub(in crate::app) struct Screens(Arc<Mutex<Kept>>);

type Kept = Option<(ScreenKey, Arc<Screen>)>;

#[derive(Debug, Clone, PartialEq)]
struct ScreenKey {
    sha256: String,
    camera: Camera,
    viewport: Viewport,
    disc_px: f64,
}

impl Screens {
    fn of(&self, key: ScreenKey, cloud: &Cloud) -> Arc<Screen> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, screen)) = kept.as_ref().filter(|(k, _)| *k == key) {
            return screen.clone();
        }
        let made = Screen::new(cloud.positions(), &key.camera, key.viewport, key.disc_px);
        let screen = Arc::new(made);
        *kept = Some((key, screen.clone()));
        screen
    }
}

impl Wanted {
    /// The highlight of the state as it is; `None` where there is none to show.
    pub(super) fn of(state: &State) -> Option<Self> {
        let picking = &state.peduncle;
        if !(state.is_picking() || picking.is_previewed || !picking.strokes.is_empty()) {
            return None;
        }
        let fruit = &state.current_walked()?.fruit;
        // While another cloud is being read its predecessor's points are shown.
        let look = state.look.clone().filter(|look| look.analysis.is_some())?;
        let what = if let Some(stroke) = picking.strokes.front() {
            What::Stroke {
                stroke: stroke.clone(),
                radius_px: picking.brush_radius_px,
                is_through: picking.is_through,
            }
        } else if let Some(picked) = state.picked_peduncle() {
            What::Points(picked.clone())
        } else if let (PeduncleChoice::Hue(range), Some(_)) =
            (&state.settings.request.peduncle, fruit.cloud().colors())
        {
            What::Hue(*range)
        } else {
            What::Found(fruit.clone())
        };
        Some(Self { look, what })
    }

    /// Whether a stroke under way changes what was selected before.
    pub(super) fn is_stroke(&self) -> bool {
        matches!(self.what, What::Stroke { .. })
    }
}

/// Highlights what is wanted of a cloud; `base` is what was selected before the stroke.
pub(super) fn mark(
    wanted: &Wanted,
    fruit: &Fruit,
    base: &PointSet,
    screens: &Screens,
    is_dark: bool,
    pixels_per_point: f64,
) -> Marking {
    let cloud = fruit.cloud();
    let look = &*wanted.look;
    let mut mask = match &wanted.what {
        What::Points(points) => points.mask(cloud.len()),
        What::Hue(range) => {
            let colors = cloud.colors().unwrap_or_default();
            let is_in = |c: &Color| hue_deg(*c).is_some_and(|hue| range.contains(hue));
            let found = crate::parallel::map_pieces(colors.len(), 1 << 15, &(), |piece| {
                colors[piece].iter().map(is_in).collect::<Vec<_>>()
            });
            found.unwrap_or_default().concat()
        }
        What::Found(fruit) => {
            let found = fruit.peduncle.as_ref().map_or(&[][..], |p| &p.in_cloud[..]);
            let points: PointSet = found.iter().copied().collect();
            points.mask(cloud.len())
        }
        What::Stroke { .. } => base.mask(cloud.len()),
    };
    let mut stroked = None;
    if let What::Stroke {
        stroke,
        radius_px,
        is_through,
    } = &wanted.what
    {
        let size_px = look.scene.points.first().map_or(2.0, |p| f64::from(p.size_px));
        let key = ScreenKey {
            sha256: fruit.file.sha256.clone(),
            camera: stroke.camera,
            viewport: stroke.viewport,
            disc_px: size_px / pixels_per_point,
        };
        let screen = screens.of(key, cloud);
        let region = match stroke.tool {
            Tool::Brush => Region::Brush(Brush::new(&stroke.path_px, *radius_px)),
            _ => Region::Lasso(Lasso::new(&stroke.path_px)),
        };
        screen.mark(&region, stroke.removes, *is_through, &mut mask);
        if stroke.is_ended {
            stroked = Some((stroke.id, Arc::new(PointSet::of_mask(&mask))));
        }
    }
    let points = mask.iter().filter(|is_in| **is_in).count();
    Marking {
        marked: Marked {
            scene: Arc::new(highlighted(look, &mask, is_dark)),
            points,
            of: look.scene.clone(),
        },
        stroke: stroked,
    }
}

/// The look's scene with the points of a mask in the highlight's color and all others faded.
fn highlighted(look: &Look, mask: &[bool], is_dark: bool) -> Scene {
    let mut scene = (*look.scene).clone();
    let in_file = look.shown.in_file.as_deref();
    if let Some(points) = scene.points.first_mut() {
        let is_marked = |i: usize| {
            let of_file = in_file.map_or(i, |in_file| in_file[i]);
            mask.get(of_file).copied().unwrap_or(false)
        };
        let colors = points.colors.iter().enumerate();
        points.colors = colors
            .map(|(i, color)| {
                if is_marked(i) {
                    PEDUNCLE_MARK
                } else {
                    faded(*color, is_dark)
                }
            })
            .collect();
        points.colors_generation = next_generation();
    }
    scene
}
