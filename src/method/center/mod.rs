//! The fruit center p_c (§ 2.4, Eq. 3): by either reading, of the best sphere, or given by hand.
//!
//! As printed, Eq. 3 is the RMS *distance* of a random point to the cloud, which is least at the
//! cloud's mean, the very point that the section rules out. Read as the RMS *error* of those
//! distances about their mean, it is least at the point equidistant from the surface: the center of
//! a sphere that the surface is part of.

mod random_search;
mod sphere;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Preset;
use crate::parallel::{Cancelled, Watch};

pub use random_search::{RandomSearch, distance_deviation, rms_distance};
pub use sphere::fit_sphere;
use sphere::fit_sphere_watched;

/// A method to find the fruit center.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum CenterMethod {
    /// The random point with the least RMS distance to the cloud: Eq. 3 as printed.
    MeanRms(RandomSearch),
    /// The random point whose distances to the cloud deviate least from their mean: Eq. 3 as
    /// intended.
    Equidistant(RandomSearch),
    /// The center of the sphere that fits best by least squares of the distances to its surface.
    Sphere,
    /// Set by hand, in the file's unit and frame.
    Given(DVec3),
}

impl CenterMethod {
    /// The method that a preset reads out of Eq. 3.
    pub fn of_preset(preset: Preset, search: RandomSearch) -> Self {
        match preset {
            Preset::AsPrinted => Self::MeanRms(search),
            Preset::AsIntended => Self::Equidistant(search),
        }
    }

    /// The preset that this method belongs to, if any.
    pub fn preset(&self) -> Option<Preset> {
        match self {
            Self::MeanRms(_) => Some(Preset::AsPrinted),
            Self::Equidistant(_) => Some(Preset::AsIntended),
            Self::Sphere | Self::Given(_) => None,
        }
    }

    /// The random search, if the method has one.
    pub fn search(&self) -> Option<RandomSearch> {
        match self {
            Self::MeanRms(search) | Self::Equidistant(search) => Some(*search),
            Self::Sphere | Self::Given(_) => None,
        }
    }
}

/// Why no center was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum CenterError {
    /// The points lie in a plane, where a sphere of any radius fits.
    #[error("no sphere fits its points: they lie in a plane")]
    NoSphere,
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Finds the fruit center of `points`, in their unit and frame.
///
/// # Errors
/// Returns an error if no sphere fits, or the watch cancels the work.
pub fn find_center(points: &[DVec3], method: &CenterMethod, watch: &dyn Watch) -> Result<DVec3, CenterError> {
    match *method {
        CenterMethod::MeanRms(search) => Ok(search.least_rms_distance(points, watch)?),
        CenterMethod::Equidistant(search) => Ok(search.least_deviation(points, watch)?),
        CenterMethod::Sphere => fit_sphere_watched(points, watch)?
            .map(|(center, _)| center)
            .ok_or(CenterError::NoSphere),
        CenterMethod::Given(center) => Ok(center),
    }
}
