//! Axiscope finds the symmetry plane and the axis of a fruit in a point cloud from one depth camera, and shows why
//! they were found, or missed.
//!
//! It implements Li, Zhu, Huang, Guo and Qin, *Article Pose Estimation of Sweet Pepper through Symmetry Axis
//! Detection*, Sensors 18 (2018) 3083: candidate planes through the fruit's center are scored by how well they mirror
//! the visible surface onto itself (Eq. 4–15); the best plane and the view ray give the axis (Eq. 16). Equation numbers
//! throughout this documentation are the paper's, and so are the symbols: p_c is the fruit's center, p_v the viewpoint,
//! u the steps of the grid of planes, d and ξ the distance and the angle between a mirrored point and its nearest
//! neighbor, τ the weight of ξ against d.
//!
//! The program `axiscope` opens every step in a window and does the same on the command line. This library is what it
//! is made of.
//!
//! # Example
//!
//! ```
//! use axiscope::evaluate::{TruthChoice, examine, reference_of};
//! use axiscope::fruit::{Fruit, Request};
//! use axiscope::method::axis_error_rad;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // As the paper's authors meant the method, with the unit and the peduncle that the file states.
//! let request = Request::default();
//! let fruit = Fruit::read("assets/pepper.ply".as_ref(), &request)?;
//! let examination = examine(fruit, &request, &())?;
//!
//! // This pepper was simulated: its true axis lies in a file beside it.
//! let axis = examination.analysis.axis.as_ref().expect("a plane wins, and it has an axis");
//! let truth = reference_of(&examination.references, TruthChoice::Truth).expect("pepper.truth.json");
//! let error_deg = axis_error_rad(axis, truth).to_degrees();
//! assert!(error_deg < 10.0);
//! # Ok(())
//! # }
//! ```
//!
//! A cloud that comes from elsewhere than a file is a [`geometry::Cloud`], for [`method::analyze`]. The folder
//! `examples/` holds programs for one cloud, a folder of clouds, a picture and a simulated cloud.
//!
//! # Modules
//!
//! Each builds on the ones before it.
//!
//! | Module | Contents |
//! | --- | --- |
//! | [`parallel`] | work on several cores, its progress and its cancellation |
//! | [`files`] | files read up to a limit, and written whole or not at all |
//! | [`neighbors`] | the exact nearest neighbors of many queries at once |
//! | [`geometry`] | point clouds with their unit, planes, lines and angles, normals (Eq. 2), filters |
//! | [`method`] | the paper, a file a step: center (Eq. 3), candidate planes (Eq. 4–10), partners (Eq. 11–14), score (Eq. 15), axis (Eq. 16) |
//! | [`estimate`] | estimators of the axis side by side: the paper's plane and fitted bodies, with confidence and occlusion |
//! | [`peduncle`] | the points of the peduncle and the two reference axes that they give (§ 3.2) |
//! | [`simulate`] | ellipsoids (§ 2.1) and peppers before a depth camera, with their true axes |
//! | [`annotate`] | true axes set by hand: their files, the agreement between annotators, exchange with other programs |
//! | [`undo`] | a history of undo and redo |
//! | [`ply`] | the reader and the writer of PLY files |
//! | [`fruit`] | a cloud with everything that its files say of it, and the [`Request`](fruit::Request) to analyze it |
//! | [`evaluate`] | one cloud or many, compared with their references |
//! | [`render`] | a camera, a scene of points and lines, and their picture by the GPU |
//! | [`view`] | what a view of an analysis shows: colors, legends, overlays, captions |
#![cfg_attr(feature = "reports", doc = "| [`charts`] | figures as SVG and PNG |")]
#![cfg_attr(feature = "window", doc = "| [`app`] | state and commands of the window |")]
#![cfg_attr(feature = "window", doc = "| [`ui`] | the window |")]
//!
//! # Features
//!
//! All are on by default, and the method needs none of them: `default-features = false` leaves about seventy small
//! crates to build.
//!
//! | Feature | Contents |
//! | --- | --- |
//! | `parallel` | work on every core, by rayon; results are the same to the bit without it |
//! | `reports` | results as CSV, Parquet, charts and HTML pages; pictures as PNG |
//! | `cli` | the program `axiscope`; `clap::ValueEnum` for the enums that are options of it |
//! | `window` | the window, and pictures drawn by the GPU or a software driver |
//!
//! # Units and frames
//!
//! - Positions are `f64` in the cloud's own frame and [`Unit`](geometry::Unit). A file states its unit in a comment; if
//!   it does not and none is asked for, the unit is guessed from the cloud's size, and a warning says so.
//! - The frame is the camera's: x points to the image's right, y **down**, z ahead. The viewpoint p_v is the origin
//!   unless [`Params::viewpoint`](method::Params::viewpoint) says otherwise.
//! - Scores, and the distances in them, are in centimeters whatever the cloud's unit: τ is in centimeters per radian.
//!   Names carry units wherever they could be mistaken: `_cm`, `_rad`, `_deg`, `_px`.
//! - An axis is an undirected line; the angle between two of them is from 0° to 90°. Directions have unit length.
//! - A number that does not exist is `None`, never NaN.
//!
//! Vectors are those of [`glam`], which this crate re-exports.

pub mod annotate;
#[cfg(feature = "window")]
pub mod app;
#[cfg(feature = "reports")]
pub mod charts;
pub mod estimate;
pub mod evaluate;
pub mod files;
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

pub use glam;
