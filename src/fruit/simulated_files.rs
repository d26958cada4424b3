//! The files of a simulated cloud: its points, and beside them the truth.

use std::path::{Path, PathBuf};

use crate::geometry::{Cloud, Unit};
use crate::ply::{Encoding, WriteError, WriteOptions, write};
use crate::simulate::Truth;

/// The PLY file of a simulated cloud at `path`, and beside it the truth file `NAME.truth.json`, if there is a truth: the
/// path and the bytes of each, the cloud first. Cloud and truth are in the unit given. The same cloud gives the same bytes.
///
/// # Errors
/// Returns an error if the cloud does not fit into a PLY file.
pub fn simulated_files(
    path: &Path,
    cloud: &Cloud,
    truth: Option<&Truth>,
    seed: u64,
    unit: Unit,
    encoding: Encoding,
) -> Result<Vec<(PathBuf, Vec<u8>)>, WriteError> {
    let comments = [format!(
        "simulated by axiscope {}, seed {seed}",
        env!("CARGO_PKG_VERSION")
    )];
    let options = WriteOptions {
        unit: Some(unit),
        comments: &comments,
        encoding,
        ..WriteOptions::default()
    };
    let mut bytes = Vec::new();
    write(&mut bytes, cloud, &options)?;
    // Without a failure: a truth is plain numbers and texts.
    let truth = truth.and_then(|truth| serde_json::to_string_pretty(truth).ok());
    let truth = truth.map(|json| (path.with_extension("truth.json"), (json + "\n").into_bytes()));
    Ok([(path.to_owned(), bytes)].into_iter().chain(truth).collect())
}
