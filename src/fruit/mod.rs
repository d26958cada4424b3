//! A fruit as its files give it: a cloud with its unit, its peduncle, its simulated truth and its annotations; what
//! is asked of it; and the listing of the files in a folder.
//!
//! Readers take bytes, so that a browser build can hand them what it fetched; [`read_cloud`] is the
//! one place here that opens a cloud.

mod cloud_file;
mod listing;
mod picked;
mod read;
mod request;
pub mod unit_guess;

pub use cloud_file::{
    CloudFile, ReadError, ReadErrorKind, parse_cloud, parse_cloud_watched, read_cloud, read_cloud_watched,
    sha256_hex,
};
pub use listing::{AxisFile, AxisFiles, annotation_paths, clouds_in, files_behind, read_annotations};
pub use picked::PickedPoints;
pub use read::{Fruit, FruitError, PeduncleChoice, companion_path, removed_path, truth_path};
pub use request::Request;
