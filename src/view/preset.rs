//! The views that are one key away.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::render::{Camera, Insets, Projection, Viewport};

/// A standard direction of the view. *Up* in a camera's frame is −y.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum ViewPreset {
    /// From the viewpoint, as the depth camera saw it.
    Camera,
    /// Along the depth axis.
    Front,
    /// From the camera's right.
    Side,
    /// From above.
    Top,
    /// Along the plane's normal, from the viewpoint's side.
    Normal,
    /// Along the axis, from above.
    Axis,
}

impl ViewPreset {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Front => "front",
            Self::Side => "side",
            Self::Top => "top",
            Self::Normal => "normal",
            Self::Axis => "axis",
        }
    }

    /// A camera with this view, so that `points` fill the picture between the insets.
    /// `direction_in_world` is the plane's normal or the axis, for the views along them.
    pub fn camera(
        self,
        points: &[DVec3],
        viewpoint_in_world: DVec3,
        direction_in_world: DVec3,
        projection: Projection,
        viewport: Viewport,
        insets: Insets,
    ) -> Camera {
        let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
        let toward_fruit = (middle - viewpoint_in_world).try_normalize().unwrap_or(DVec3::Z);
        let up = DVec3::NEG_Y;
        let (forward, up) = match self {
            Self::Camera => (toward_fruit, up),
            Self::Front => (DVec3::Z, up),
            Self::Side => (DVec3::NEG_X, up),
            Self::Top => (DVec3::Y, DVec3::Z),
            Self::Normal => {
                let away = direction_in_world.dot(toward_fruit) >= 0.0;
                (
                    if away {
                        direction_in_world
                    } else {
                        -direction_in_world
                    },
                    up,
                )
            }
            Self::Axis => {
                let downward = direction_in_world.y >= 0.0;
                let forward = if downward {
                    direction_in_world
                } else {
                    -direction_in_world
                };
                (forward, toward_fruit)
            }
        };
        if self == Self::Camera && projection == Projection::Perspective && viewpoint_in_world != middle {
            let mut camera = Camera::looking_at(viewpoint_in_world, middle, up);
            camera.frame_from_here(points, viewport, insets);
            return camera;
        }
        let mut camera = Camera::along(forward, up, middle, 1.0);
        camera.projection = projection;
        camera.frame(points, viewport, insets);
        camera
    }
}
