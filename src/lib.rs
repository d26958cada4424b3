//! Axiscope: why a fruit's symmetry axis was found, or missed.
//!
//! The method of Li, Zhu, Huang, Guo and Qin, *Article Pose Estimation of Sweet Pepper through
//! Symmetry Axis Detection*, Sensors 18 (2018) 3083, with every step open to the eye. A point cloud
//! of a fruit seen by one depth camera enters through [`fruit`], walks through [`geometry`] and
//! [`method`], and leaves as a symmetry plane and an axis that [`peduncle`] compares with others.
//! [`simulate`] makes clouds whose axis is known.

pub mod annotate;
#[cfg(feature = "reports")]
pub mod app;
#[cfg(feature = "reports")]
pub mod charts;
pub mod evaluate;
pub mod fruit;
pub mod geometry;
pub mod method;
pub mod neighbors;
pub mod parallel;
pub mod peduncle;
pub mod ply;
pub mod render;
pub mod simulate;
pub mod text;
#[cfg(feature = "window")]
pub mod ui;
pub mod undo;
pub mod view;
