//! The scenes of edit mode: the ghost, and the locked views' smaller cloud.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::state::Ghost;
use crate::annotate::Ends;
use crate::app::inspector::look::{Look, next_generation};
use crate::render::{Color, Points, Scene};

/// Points of a locked view, of the cloud and of the ghost each.
const SMALL: usize = 20_000;
/// Points of the ghost in the large view.
const GHOST: usize = 100_000;

const GRAY: Color = [0xa4, 0xa6, 0xac, 255];

/// The input of the scenes.
#[derive(Clone)]
pub(super) struct Wanted {
    pub(super) look: Arc<Look>,
    pub(super) ends: Option<Ends>,
    /// The axis that the large view's ghost is of: of a large cloud it is drawn when an axis is let go.
    pub(super) main_ends: Option<Ends>,
    pub(super) ghost: Ghost,
    /// The direction from the depth camera to the fruit.
    pub(super) view_ray: DVec3,
    pub(super) pixels_per_point: f32,
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.look, &other.look)
            && (self.ends, self.main_ends, self.ghost) == (other.ends, other.main_ends, other.ghost)
            && self.view_ray == other.view_ray
            && self.pixels_per_point == other.pixels_per_point
    }
}

impl Wanted {
    /// Whether the large view is the same.
    fn has_main_of(&self, other: &Self) -> bool {
        let main = |wanted: &Self| Self {
            ends: None,
            ..wanted.clone()
        };
        main(self) == main(other)
    }
}

/// The last scenes: the parts that stay keep their generation, and are not sent to the GPU again.
#[derive(Clone)]
pub(super) struct Made {
    wanted: Wanted,
    /// The large view's scene, where there is a ghost.
    pub(super) main: Option<Arc<Scene>>,
    /// The locked views' cloud alone, which does not change with the axis.
    cloud: Points,
}

/// Both scenes.
pub(super) struct Scenes {
    pub(super) made: Made,
    /// The locked views'.
    pub(super) small: Arc<Scene>,
}

/// Makes them.
pub(super) fn scenes(wanted: Wanted, before: Option<Made>) -> Scenes {
    let look = &wanted.look;
    let (cloud, main) = match before {
        Some(made) => {
            let is_kept = Arc::ptr_eq(&made.wanted.look, look)
                && made.wanted.pixels_per_point == wanted.pixels_per_point;
            let main = made.main.filter(|_| made.wanted.has_main_of(&wanted));
            (Some(made.cloud).filter(|_| is_kept), main)
        }
        None => (None, None),
    };
    let cloud = cloud.unwrap_or_else(|| thinned(look, wanted.pixels_per_point));
    let positions = &look.shown.local_positions;
    let mut small = (*look.scene).clone();
    (small.polygons, small.lines) = (Vec::new(), Vec::new());
    small.lines_generation = next_generation();
    small.points = vec![cloud.clone()];
    if let Some(motion) = Motion::new(&wanted, wanted.ends) {
        small
            .points
            .push(ghost(positions, SMALL, 0.8 * cloud.size_px, &motion));
        small.fit_bounds();
    }
    let main = main.or_else(|| {
        let motion = Motion::new(&wanted, wanted.main_ends)?;
        let size_px = look.scene.points.first().map_or(2.0, |points| points.size_px);
        let mut scene = (*look.scene).clone();
        scene.points.truncate(1);
        scene.points.push(ghost(positions, GHOST, 0.8 * size_px, &motion));
        scene.fit_bounds();
        Some(Arc::new(scene))
    });
    Scenes {
        small: Arc::new(small),
        made: Made { wanted, main, cloud },
    }
}

/// Every so many points, so that there are at most `most`.
fn every(count: usize, most: usize) -> usize {
    count.div_ceil(most).max(1)
}

fn small_size(points: usize, pixels_per_point: f32) -> f32 {
    // So many close up to a surface in a view of about 200 pixels each way; from 1.5 to 4.
    let closing = (1.7 * (0.3 * 200.0 * 200.0 / points.max(1) as f64).sqrt()).clamp(1.5, 4.0);
    closing as f32 * pixels_per_point
}

fn thinned(look: &Look, pixels_per_point: f32) -> Points {
    let Some(points) = look.scene.points.first() else {
        return Points::default();
    };
    let step = every(points.positions.len(), SMALL);
    let positions: Arc<[Vec3]> = points.positions.iter().step_by(step).copied().collect();
    Points {
        size_px: small_size(positions.len(), pixels_per_point),
        positions,
        colors: points.colors.iter().step_by(step).copied().collect(),
        positions_generation: next_generation(),
        colors_generation: next_generation(),
    }
}

/// The motion that makes the ghost of the cloud, about the scene's origin.
enum Motion {
    Turned { middle: DVec3, direction: DVec3 },
    Mirrored { middle: DVec3, normal: DVec3 },
}

impl Motion {
    fn new(wanted: &Wanted, ends: Option<Ends>) -> Option<Self> {
        let ends = ends.filter(|_| wanted.ghost != Ghost::Off)?;
        let middle = ends.middle() - wanted.look.shown.extent.center();
        Some(match wanted.ghost {
            Ghost::Mirrored => Self::Mirrored {
                middle,
                normal: ends.across(wanted.view_ray)[0],
            },
            Ghost::Turned | Ghost::Off => Self::Turned {
                middle,
                direction: ends.direction(),
            },
        })
    }

    fn of(&self, p: DVec3) -> DVec3 {
        match *self {
            Self::Turned { middle, direction } => {
                let offset = p - middle;
                middle + 2.0 * offset.dot(direction) * direction - offset
            }
            Self::Mirrored { middle, normal } => p - 2.0 * (p - middle).dot(normal) * normal,
        }
    }
}

fn ghost(positions: &[Vec3], most: usize, size_px: f32, motion: &Motion) -> Points {
    let step = every(positions.len(), most);
    let moved = positions.iter().step_by(step);
    let positions: Arc<[Vec3]> = moved.map(|p| motion.of(p.as_dvec3()).as_vec3()).collect();
    Points {
        colors: vec![GRAY; positions.len()].into(),
        positions,
        positions_generation: next_generation(),
        colors_generation: next_generation(),
        size_px,
    }
}
