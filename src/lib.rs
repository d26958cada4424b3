//! Axiscope: why a fruit's symmetry axis was found, or missed.
//!
//! The method of Li, Zhu, Huang, Guo and Qin, *Article Pose Estimation of Sweet Pepper through
//! Symmetry Axis Detection*, Sensors 18 (2018) 3083, with every step open to the eye. A point cloud
//! of a fruit seen by one depth camera enters through [`io`], walks through [`geometry`] and
//! [`method`], and leaves as a symmetry plane and an axis that [`mod@reference`] compares with others.
//! [`simulate`] makes clouds whose axis is known.

pub mod annotate;
pub mod app;
pub mod evaluate;
pub mod geometry;
pub mod io;
pub mod method;
pub mod neighbors;
pub mod parallel;
pub mod reference;
pub mod render;
pub mod simulate;
#[cfg(feature = "window")]
pub mod ui;
pub mod view;
