//! Bytes to clouds and back, figures and pictures.
//!
//! Readers take bytes, so that a browser build can hand them what it fetched; [`read_cloud`] is the
//! one place here that opens a cloud, [`DiskFiles`] the one that writes annotators' files.

mod annotation_files;
mod annotations;
mod cloud_file;
pub mod figures;
mod fruit;
mod picked;
mod picture;
pub mod ply;
pub mod unit_guess;

pub use annotation_files::DiskFiles;
pub use annotations::{annotation_paths, read_annotations};
pub use cloud_file::{
    CloudFile, ReadError, ReadErrorKind, parse_cloud, parse_cloud_watched, read_cloud, read_cloud_watched,
    sha256_hex,
};
pub use fruit::{Fruit, FruitError, PeduncleChoice, companion_path, removed_path, truth_path};
pub use picked::PickedPoints;
pub use picture::{
    PictureError, PictureSettings, SETTINGS_KEY, decode_picture, encode_picture, paint_annotations,
    picture_settings, text_width_px,
};
