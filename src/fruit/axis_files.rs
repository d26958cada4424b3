//! The axis files beside clouds: their listing, and the annotations in them.

use std::collections::{BTreeMap, HashMap};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use crate::annotate::{AXIS_ENDING, Annotation, axis_file_of, read_annotation};

/// An axis file beside a cloud, as its name describes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AxisFile {
    /// The path of the file.
    pub path: PathBuf,
    /// The author's part of the name, [`crate::annotate::Author::slug`].
    pub slug: String,
    /// The number of the copy, from 1.
    pub copy: u32,
}

/// The axis files in folders of clouds. Each folder is read once, when one of its clouds is first asked about.
#[derive(Debug, Default)]
pub struct AxisFiles {
    /// The sorted names of every folder's axis files.
    names: HashMap<PathBuf, Vec<OsString>>,
}

impl AxisFiles {
    /// The axis files of a cloud, `CLOUD.NAME.axis.json` and further copies, in the order of their names, unusable ones
    /// among them. There are none where the folder cannot be read.
    pub fn of(&mut self, cloud: &Path) -> Vec<AxisFile> {
        let Some(stem) = cloud.file_stem() else {
            return Vec::new();
        };
        let folder = cloud.parent().unwrap_or(Path::new(""));
        if !self.names.contains_key(folder) {
            self.names.insert(folder.to_owned(), axis_file_names(folder));
        }
        let names = &self.names[folder];
        // Names with the same beginning stand together in a sorted list.
        let mut prefix = stem.to_owned();
        prefix.push(".");
        let first = names.partition_point(|name| *name < prefix);
        let is_of_stem = |name: &&OsString| name.as_encoded_bytes().starts_with(prefix.as_encoded_bytes());
        let of_stem = names[first..].iter().take_while(is_of_stem);
        let of_cloud = of_stem.filter_map(|name| {
            let (slug, copy) = axis_file_of(cloud, name)?;
            let path = cloud.with_file_name(name);
            Some(AxisFile { path, slug, copy })
        });
        of_cloud.collect()
    }
}

fn axis_file_names(folder: &Path) -> Vec<OsString> {
    let is_here = folder.as_os_str().is_empty();
    let entries = std::fs::read_dir(if is_here { Path::new(".") } else { folder });
    let names = entries
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.file_name()));
    let is_axis = |name: &OsString| name.as_encoded_bytes().ends_with(AXIS_ENDING.as_bytes());
    let mut names: Vec<OsString> = names.filter(is_axis).collect();
    names.sort();
    names
}

/// The paths of a cloud's axis files, as [`AxisFiles::of`] lists them.
pub fn annotation_paths(cloud: &Path) -> Vec<PathBuf> {
    let files = AxisFiles::default().of(cloud).into_iter();
    files.map(|file| file.path).collect()
}

/// Reads a cloud's annotations: one an annotator, by name, then the adjudicator's; and a sentence about each axis file
/// that cannot be used. Of an annotator's copies the last counts. `sha256` is the hash of the cloud.
pub fn read_annotations(files: &[AxisFile], sha256: &str) -> (Vec<Annotation>, Vec<String>) {
    let (mut newest, mut warnings) = (BTreeMap::new(), Vec::new());
    for AxisFile { path, copy, .. } in files {
        match read_annotation(path) {
            Ok(annotation) if annotation.cloud.sha256 == sha256 => {
                let whose = (annotation.role as u8, annotation.annotator.clone());
                if newest.get(&whose).is_none_or(|(before, _)| copy > before) {
                    newest.insert(whose, (*copy, annotation));
                }
            }
            read => {
                let why = read
                    .err()
                    .unwrap_or_else(|| "it belongs to another cloud, or the cloud has changed".into());
                warnings.push(format!("{}: this axis is not used: {why}.", path.display()));
            }
        }
    }
    (
        newest.into_values().map(|(_, annotation)| annotation).collect(),
        warnings,
    )
}
