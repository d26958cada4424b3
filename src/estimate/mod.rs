//! Estimators of a fruit's axis, side by side: the paper's plane, and bodies that are fitted to the visible surface.
//!
//! A [`Surface`] is prepared once for a cloud; [`estimate`] runs one [`Estimator`] on it. Each gives an [`Estimate`]:
//! an axis with its confidence, the alternatives that it was chosen from, how much of the fruit can be seen, and
//! warnings. Degenerate input gives an [`EstimateError`] or an ambiguous estimate, never a confident axis.
//!
//! Lengths within this room are in centimeters, and positions are relative to the viewpoint: see [`Surface`]. An
//! [`Estimate`] is in the file's unit and frame again.

pub mod body;
mod directions;
mod estimator;
mod least_squares;
mod outcome;
mod paper;
mod plane;
mod revolution;
mod robust;
mod sample;
mod search;
mod superquadric;
mod surface;
mod view;

pub use directions::half_sphere;
pub use estimator::{EstimateSettings, Estimator, InvalidPrior, Prior, estimate};
pub use least_squares::{LeastSquares, Linearized, Minimum, Options, minimize};
use outcome::lead_over;
pub use outcome::{Alternative, Estimate, EstimateError, Occlusion, SEEN_SHARE_SD};
pub use sample::Sample;
pub use surface::Surface;
pub use view::View;
