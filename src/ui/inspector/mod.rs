//! The 3-D view of the cloud that is looked at.

pub(super) mod paint;
pub mod plane_bar;
pub(super) mod view3d;
pub(super) mod view_bar;
