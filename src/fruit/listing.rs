//! The clouds of a folder, and the files that the results for a cloud depend on.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::{PeduncleChoice, Request, companion_path, removed_path, truth_path};

/// Returns every cloud in a folder, by name. A companion file that holds a peduncle alone is not a cloud of its own.
///
/// # Errors
/// Returns an error if the folder cannot be read.
pub fn clouds_in(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut clouds = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        let is_ply = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("ply"));
        // The file itself is asked only if the folder's list does not tell its kind.
        if is_ply && (entry.file_type().is_ok_and(|kind| kind.is_file()) || !path.is_dir()) {
            clouds.push(path);
        }
    }
    clouds.sort();
    let companions: HashSet<PathBuf> = clouds.iter().map(|path| companion_path(path)).collect();
    clouds.retain(|path| !companions.contains(path));
    Ok(clouds)
}

/// Returns the files that the results for a cloud depend on, the cloud's own first; some may not exist. `annotations` are
/// its axis files.
pub fn files_behind(path: &Path, request: &Request, annotations: &[PathBuf]) -> Vec<PathBuf> {
    let mut files = vec![path.to_path_buf(), companion_path(path), truth_path(path)];
    match &request.peduncle {
        PeduncleChoice::Removed(folder) => files.push(removed_path(path, folder)),
        PeduncleChoice::File(companion) => files.push(companion.clone()),
        _ => {}
    }
    files.extend_from_slice(annotations);
    files
}
