//! The sources of clouds: files, samples, the simulator, and scans of another cloud.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::samples::Sample;
use super::scan_from_here::ScanFromHere;
use super::simulator::pepper::SimulatedPepper;
use crate::files::write_all;
use crate::fruit::{CloudFile, ReadError, parse_cloud, read_cloud_watched, simulated_files};
use crate::geometry::Unit;
use crate::parallel::Watch;
use crate::ply::{Encoding, Precision, WriteOptions, write};

/// The source of a cloud.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Source {
    /// A file on disk.
    File(PathBuf),
    /// A sample that the program brings along.
    Bundled(Sample),
    /// A pepper of the simulator, which has no file.
    Simulated(SimulatedPepper),
    /// The part of a cloud or a mesh that a camera would see.
    Scanned(ScanFromHere),
}

/// A cloud as its source gives it, with the text of its truth if that lies in no file.
#[derive(Debug, Clone)]
pub(super) struct Content {
    pub(super) file: Arc<CloudFile>,
    pub(super) truth: Option<Arc<str>>,
}

impl Source {
    /// Its path, or the name of the sample.
    pub fn path(&self) -> &Path {
        match self {
            Self::File(path) => path,
            Self::Bundled(sample) => Path::new(sample.path()),
            Self::Simulated(_) => Path::new("<simulated>/simulated_pepper.ply"),
            Self::Scanned(scan) => scan.path(),
        }
    }

    /// Its last part, for lists and titles.
    pub fn name(&self) -> String {
        let path = self.path();
        path.file_name()
            .unwrap_or(path.as_os_str())
            .to_string_lossy()
            .into_owned()
    }

    /// Whether the cloud lies in a file, beside which others can be kept.
    pub fn is_file(&self) -> bool {
        matches!(self, Self::File(_))
    }

    /// The files that the cloud makes at `path`: its points, and its truth beside them where it has one.
    ///
    /// # Errors
    /// Returns a clause that names the cause.
    fn files(&self, path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        if let Self::Simulated(pepper) = self {
            let simulated = pepper.settings().simulate().map_err(|error| error.to_string())?;
            let (cloud, truth) = (&simulated.cloud, &simulated.truth);
            let encoding = Encoding::default();
            let files = simulated_files(path, cloud, Some(truth), truth.seed, Unit::Centimeter, encoding);
            return files.map_err(|error| error.to_string());
        }
        let content = self.read(&()).map_err(|error| error.to_string())?;
        let cloud = &content.file.ply.cloud;
        let options = WriteOptions {
            unit: content.file.ply.stated_unit,
            precision: Precision::needed_by(cloud),
            ..WriteOptions::default()
        };
        let mut bytes = Vec::new();
        write(&mut bytes, cloud, &options).map_err(|error| error.to_string())?;
        let truth = content.truth.map(|truth| {
            let path = path.with_extension("truth.json");
            (path, truth.as_bytes().to_vec())
        });
        Ok([(path.to_owned(), bytes)].into_iter().chain(truth).collect())
    }

    /// Writes the cloud, and its truth where it has one; returns what was done, or why not, in a sentence.
    pub(super) fn save(&self, path: &Path) -> Result<String, String> {
        let files = self
            .files(path)
            .map_err(|error| format!("{}: {error}.", path.display()))?;
        write_all(&files).map_err(|error| format!("{error}."))?;
        Ok(match files.len() {
            1 => format!("Saved {}.", path.display()),
            _ => format!("Saved {} and its truth beside it.", path.display()),
        })
    }

    /// Reads or makes the cloud.
    pub(super) fn read(&self, watch: &dyn Watch) -> Result<Content, ReadError> {
        let (file, truth) = match self {
            Self::File(path) => (read_cloud_watched(path, watch)?, None),
            Self::Bundled(sample) => {
                let file = parse_cloud(sample.path(), sample.bytes())?;
                (file, Some(sample.truth().into()))
            }
            Self::Simulated(pepper) => pepper.read(self.path())?,
            Self::Scanned(scan) => (scan.read(watch)?, None),
        };
        Ok(Content {
            file: Arc::new(file),
            truth,
        })
    }
}
