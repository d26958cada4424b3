//! Bytes to clouds and back, and figures.
//!
//! Readers take bytes, so that a browser build can hand them what it fetched; [`read_cloud`] is the
//! one place here that opens a file.

mod cloud_file;
pub mod figures;
mod fruit;
pub mod ply;
pub mod unit_guess;

pub use cloud_file::{CloudFile, ReadError, ReadErrorKind, parse_cloud, read_cloud, sha256_hex};
pub use fruit::{Fruit, FruitError, PeduncleChoice, companion_path, truth_path};
