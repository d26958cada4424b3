//! Points, planes and lines, and computations on them that do not depend on the method.
//!
//! Positions are `f64` in the file's own unit and frame, so that results need no transformation before
//! they are shown; code that needs `f32` (the GPU, a search) subtracts a nearby origin first.

mod cloud;
mod eigen;
mod extent;
mod filters;
mod line;
mod normals;
mod plane;
mod point_set;
mod spread;
mod strays;
mod unit;
mod voxels;

pub use cloud::{Cloud, LengthMismatch};
pub(crate) use eigen::symmetric_eigen;
pub use extent::Extent;
pub use filters::statistical_inliers;
pub(crate) use line::angles_between_directions_rad;
pub use line::{angle_between_directions_rad, angle_between_lines_rad};
pub use normals::estimate_normals;
pub use plane::Plane;
pub use point_set::PointSet;
pub use spread::Spread;
pub use strays::strays;
pub(crate) use strays::{strays_watched, without};
pub use unit::Unit;
pub(crate) use voxels::{by_cell, near_one_another, voxel_grid_watched};
pub use voxels::{voxel_edge_for, voxel_grid};
