//! The 3-D view of the current cloud, with its bars.

pub(super) mod paint;
pub mod plane_bar;
pub(super) mod view3d;
pub(super) mod view_bar;
