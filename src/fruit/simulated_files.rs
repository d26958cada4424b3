//! The files of a simulated cloud: its points, and beside them the truth.

use std::path::{Path, PathBuf};

use crate::geometry::Unit;
use crate::ply::{Encoding, WriteError, WriteOptions, write};
use crate::simulate::Simulated;

/// The PLY file of a simulated cloud at `path`, in a unit and an encoding, and its truth file `NAME.truth.json` beside it:
/// the path and the bytes of each. The same cloud gives the same bytes.
///
/// # Errors
/// Returns an error if the cloud does not fit into a PLY file.
pub fn simulated_files(
    path: &Path,
    simulated: &Simulated,
    unit: Unit,
    encoding: Encoding,
) -> Result<[(PathBuf, Vec<u8>); 2], WriteError> {
    let simulated = simulated.clone().in_unit(unit);
    let truth = &simulated.truth;
    let comments = [format!(
        "simulated by axiscope {}, seed {}",
        truth.program_version, truth.seed
    )];
    let options = WriteOptions {
        unit: Some(unit),
        comments: &comments,
        encoding,
        ..WriteOptions::default()
    };
    let mut cloud = Vec::new();
    write(&mut cloud, &simulated.cloud, &options)?;
    // Without a failure: a truth is plain numbers and texts.
    let json = serde_json::to_string_pretty(truth).unwrap_or_default() + "\n";
    Ok([
        (path.to_owned(), cloud),
        (path.with_extension("truth.json"), json.into_bytes()),
    ])
}
