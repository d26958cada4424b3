//! Bytes to clouds and back, reports and figures.
//!
//! Readers take bytes, so that a browser build can hand them what it fetched; [`read_cloud`] is the
//! one place here that opens a file.

mod cloud_file;
pub mod figures;
mod fruit;
mod picture;
pub mod ply;
mod report;
pub mod unit_guess;

pub use cloud_file::{CloudFile, ReadError, ReadErrorKind, parse_cloud, read_cloud};
pub use fruit::{Fruit, FruitError, PeduncleChoice, companion_path};
pub use picture::{
    PictureError, PictureSettings, SETTINGS_KEY, encode_picture, paint_annotations, picture_settings,
    text_width_px,
};
pub use report::{AnalysisReport, Request, SCHEMA, Timings};
