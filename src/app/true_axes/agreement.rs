//! The open clouds together: whose axes there are, and how far annotators agree.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use crate::annotate::{Author, CloudAgreement, FAR_OFF_DEG, Files, LONGEST_FILE, SetAgreement, axis_file_of};
use crate::annotate::{DiskFiles, read_annotations};
use crate::fruit::read_cloud;
use crate::parallel::{Cancelled, Watch};

/// The agreement of annotators over the open clouds.
#[derive(Debug, Clone, PartialEq)]
pub struct SetReport {
    /// The agreement.
    pub agreement: SetAgreement,
    /// The files that could not be used, a sentence each.
    pub warnings: Vec<String>,
}

/// The names of all files in a cloud's folder, each folder listed once.
#[derive(Default)]
struct Listings(BTreeMap<PathBuf, Vec<OsString>>);

impl Listings {
    /// The axis files beside a cloud, in the order of their names, with the slugs in their names.
    fn axes_of(&mut self, cloud: &Path) -> Vec<(String, PathBuf)> {
        let folder = cloud.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        let names = self.0.entry(folder.to_owned()).or_insert_with(|| {
            let mut names: Vec<OsString> = std::fs::read_dir(folder)
                .map(|entries| entries.filter_map(|e| Some(e.ok()?.file_name())).collect())
                .unwrap_or_default();
            names.retain(|name| name.to_string_lossy().ends_with(".axis.json"));
            names.sort();
            names
        });
        let of_cloud = names.iter().filter_map(|name| {
            let (slug, _) = axis_file_of(cloud, name)?;
            Some((slug, cloud.with_file_name(name)))
        });
        of_cloud.collect()
    }
}

/// For each cloud whether this author has said something of it.
pub(super) fn set_by(author: &Author, clouds: &[PathBuf]) -> Vec<bool> {
    let (mut listings, slug) = (Listings::default(), author.slug());
    let is_theirs = |path: &Path| {
        // Two names can look alike in a file's name.
        let bytes = DiskFiles::default().read(path, LONGEST_FILE).ok().flatten();
        bytes
            .and_then(|bytes| crate::annotate::Annotation::from_json(&bytes).ok())
            .is_some_and(|annotation| annotation.is_by(author))
    };
    let mut has_set = |cloud: &PathBuf| {
        let axes = listings.axes_of(cloud);
        axes.iter().any(|(of, path)| *of == slug && is_theirs(path))
    };
    clouds.iter().map(&mut has_set).collect()
}

/// Compares the annotators over all clouds. Only those with axes are read.
pub(super) fn compare(clouds: &[PathBuf], watch: &dyn Watch) -> Result<SetReport, Cancelled> {
    let (mut listings, mut warnings, mut each) = (Listings::default(), Vec::new(), Vec::new());
    for (i, path) in clouds.iter().enumerate() {
        if watch.is_cancelled() {
            return Err(Cancelled);
        }
        watch.advanced(i, clouds.len());
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let mut annotations = Vec::new();
        if !listings.axes_of(path).is_empty() {
            match read_cloud(path) {
                Ok(file) => {
                    let (found, unusable) = read_annotations(path, &file.sha256);
                    annotations = found;
                    warnings.extend(unusable);
                }
                Err(error) => warnings.push(format!("{error}.")),
            }
        }
        each.push(CloudAgreement::of(&name, &annotations, FAR_OFF_DEG));
    }
    Ok(SetReport {
        agreement: SetAgreement::of(each, FAR_OFF_DEG),
        warnings,
    })
}
