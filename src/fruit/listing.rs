//! The clouds of a folder and the files beside them.

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::{PeduncleChoice, Request, companion_path, removed_path, truth_path};
use crate::annotate::axis_file_of;

/// Every cloud in the folder, by name. A companion that holds a peduncle alone is no cloud of its own.
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
    let companions: std::collections::HashSet<PathBuf> =
        clouds.iter().map(|path| companion_path(path)).collect();
    clouds.retain(|path| !companions.contains(path));
    Ok(clouds)
}

/// The annotators' files of each of the clouds of one folder, which is read once for all of them.
pub fn annotations_in(folder: &Path, clouds: &[PathBuf]) -> HashMap<PathBuf, Vec<PathBuf>> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let Ok(entries) = std::fs::read_dir(folder) else {
        return HashMap::new();
    };
    let is_axis = |name: &OsString| name.to_string_lossy().ends_with(".axis.json");
    let names: Vec<OsString> = entries
        .filter_map(|entry| Some(entry.ok()?.file_name()))
        .filter(is_axis)
        .collect();
    if names.is_empty() {
        return HashMap::new();
    }
    // A cloud's axis files begin with its stem and a dot.
    let mut by_stem: HashMap<String, Vec<&PathBuf>> = HashMap::new();
    for cloud in clouds {
        let stem = cloud.file_stem().unwrap_or_default().to_string_lossy();
        by_stem.entry(stem.into_owned()).or_default().push(cloud);
    }
    let mut found: HashMap<PathBuf, Vec<PathBuf>> = HashMap::new();
    for name in names {
        let text = name.to_string_lossy();
        for (dot, _) in text.match_indices('.') {
            for cloud in by_stem.get(&text[..dot]).into_iter().flatten() {
                if axis_file_of(cloud, &name).is_some() {
                    let paths = found.entry((*cloud).clone()).or_default();
                    paths.push(cloud.with_file_name(&name));
                }
            }
        }
    }
    for paths in found.values_mut() {
        paths.sort();
    }
    found
}

/// The files whose bytes a cloud's row follows from, the cloud's own first; some may not exist.
/// `annotations` are those of its annotators.
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
