//! The open clouds together: whose axes there are, and how far annotators agree.

use std::path::PathBuf;

use crate::annotate::{Author, CloudAgreement, FAR_OFF_DEG, SetAgreement, read_annotation};
use crate::fruit::{AxisFiles, read_annotations, read_cloud};
use crate::parallel::{Cancelled, Watch};

/// The agreement of annotators over the open clouds.
#[derive(Debug, Clone, PartialEq)]
pub struct SetReport {
    /// The agreement.
    pub agreement: SetAgreement,
    /// The files that could not be used, a sentence each.
    pub warnings: Vec<String>,
}

/// Returns for each cloud whether this author has annotated it.
pub(super) fn set_by(author: &Author, clouds: &[PathBuf]) -> Vec<bool> {
    let (mut files, slug) = (AxisFiles::default(), author.slug());
    let mut has_set = |cloud: &PathBuf| {
        // Two names can look alike in a file's name.
        let mut named_so = files.of(cloud).into_iter().filter(|file| file.slug == slug);
        named_so.any(|file| read_annotation(&file.path).is_ok_and(|annotation| annotation.is_by(author)))
    };
    clouds.iter().map(&mut has_set).collect()
}

/// Compares the annotators over all clouds. Only those with axes are read.
pub(super) fn compare(clouds: &[PathBuf], watch: &dyn Watch) -> Result<SetReport, Cancelled> {
    let (mut files, mut warnings, mut each) = (AxisFiles::default(), Vec::new(), Vec::new());
    for (i, path) in clouds.iter().enumerate() {
        if watch.is_cancelled() {
            return Err(Cancelled);
        }
        watch.advanced(i, clouds.len());
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let mut annotations = Vec::new();
        let files = files.of(path);
        if !files.is_empty() {
            match read_cloud(path) {
                Ok(file) => {
                    let (found, unusable) = read_annotations(&files, &file.sha256);
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
