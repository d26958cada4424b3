//! The annotations that lie beside a cloud.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::DiskFiles;
use crate::annotate::{Annotation, Files, LONGEST_FILE, axis_file_of};

/// The axis files beside a cloud, `CLOUD.NAME.axis.json` and its copies, in the order of their names, those
/// that cannot be used among them. None where the folder cannot be read.
pub fn annotation_paths(cloud: &Path) -> Vec<PathBuf> {
    let folder = cloud.parent().filter(|folder| !folder.as_os_str().is_empty());
    let Ok(entries) = std::fs::read_dir(folder.unwrap_or(Path::new("."))) else {
        return Vec::new();
    };
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.file_name()))
        .filter(|name| axis_file_of(cloud, name).is_some())
        .map(|name| cloud.with_file_name(name))
        .collect();
    paths.sort();
    paths
}

/// What annotators have said of a cloud, one annotation each, by name, and what is wrong with the other
/// axis files beside it, a sentence each. Of an annotator's copies the last counts.
pub fn read_annotations(cloud: &Path, sha256: &str) -> (Vec<Annotation>, Vec<String>) {
    let mut warnings = Vec::new();
    let mut found = BTreeMap::new();
    for path in annotation_paths(cloud) {
        let copy = path
            .file_name()
            .and_then(|name| axis_file_of(cloud, name))
            .map_or(1, |(_, copy)| copy);
        match read(&path, sha256) {
            Ok(annotation) => {
                let whose = (annotation.role as u8, annotation.annotator.clone());
                let before = found.get(&whose).map_or(0, |&(copy, _)| copy);
                if copy > before {
                    found.insert(whose, (copy, annotation));
                }
            }
            Err(why) => warnings.push(format!("{}: this axis is not used: {why}.", path.display())),
        }
    }
    (
        found.into_values().map(|(_, annotation)| annotation).collect(),
        warnings,
    )
}

fn read(path: &Path, sha256: &str) -> Result<Annotation, String> {
    let bytes = DiskFiles::default().read(path, LONGEST_FILE);
    let bytes = bytes.map_err(|error| error.to_string())?.unwrap_or_default();
    let annotation = Annotation::from_json(&bytes).map_err(|error| error.to_string())?;
    if annotation.cloud.sha256 == sha256 {
        Ok(annotation)
    } else {
        Err("it belongs to another cloud, or the cloud has changed".into())
    }
}
