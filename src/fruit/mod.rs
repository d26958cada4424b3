//! A fruit from its files: a cloud with its unit, its peduncle, its simulated truth and its annotations; the settings of
//! its analysis; and the listing of the files in a folder.

mod axis_files;
mod cloud_file;
mod listing;
mod mesh_file;
mod picked;
mod read;
mod request;
mod request_options;
mod simulated_files;
pub mod unit_guess;

pub use axis_files::{AxisFile, AxisFiles, annotation_paths, read_annotations};
pub use cloud_file::{
    CloudFile, ReadError, ReadErrorKind, parse_cloud, parse_cloud_watched, read_cloud, read_cloud_watched,
    sha256_hex,
};
pub use listing::{clouds_in, files_behind};
pub use mesh_file::{MeshFile, MeshFormatError, read_mesh};
pub use picked::PickedPoints;
pub use read::{Fruit, FruitError, PeduncleChoice, companion_path, removed_path, truth_path};
pub use request::Request;
pub use simulated_files::simulated_files;
