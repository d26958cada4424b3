//! The sources of clouds: files, samples, the simulator, and scans of another cloud.

use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use super::samples::Sample;
use super::simulator::pepper::SimulatedPepper;
use crate::files::write_all;
use crate::fruit::{CloudFile, ReadError, parse_cloud, read_cloud_watched, simulated_files};
use crate::geometry::{Cloud, Unit};
use crate::parallel::Watch;
use crate::peduncle::median_spacing;
use crate::ply::{Encoding, PlyCloud, Precision, WriteOptions, write};
use crate::render::Camera;
use crate::simulate::seen_points;

/// The source of a cloud.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Source {
    /// A file on disk.
    File(PathBuf),
    /// A sample that the program brings along.
    Bundled(Sample),
    /// A pepper of the simulator, which has no file.
    Simulated(SimulatedPepper),
    /// The part of a cloud that a camera would see.
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
            Self::Scanned(scan) => (scan.seen_of(&scan.of.read(watch)?.file), None),
        };
        Ok(Content {
            file: Arc::new(file),
            truth,
        })
    }
}

/// A cloud as it is seen from a place. Two are the same if cloud, place and direction are.
#[derive(Debug, Clone)]
pub struct ScanFromHere {
    of: Box<Source>,
    eye: DVec3,
    /// The rotation from the view's frame to the cloud's.
    cloud_from_view: DQuat,
    path: PathBuf,
}

impl ScanFromHere {
    /// The scan of a cloud by a camera in the place of the view's.
    pub(super) fn new(of: &Source, camera: &Camera) -> Self {
        let name = of.path().file_stem().unwrap_or_default().to_string_lossy();
        Self {
            path: format!("<scanned>/{name}_from_here.ply").into(),
            of: Box::new(of.clone()),
            eye: camera.eye_in_world,
            cloud_from_view: camera.world_from_view,
        }
    }

    /// The name that stands in for a path.
    fn path(&self) -> &Path {
        &self.path
    }

    /// The part of the whole cloud that is seen, in the camera's frame.
    fn seen_of(&self, whole: &CloudFile) -> CloudFile {
        // The view looks along −z with y up, a depth camera along z with y down.
        let view_from_cloud = DMat3::from_quat(self.cloud_from_view.conjugate());
        let camera_from_cloud = DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)) * view_from_cloud;
        let cloud = &whole.ply.cloud;
        let seen = match median_spacing(cloud.positions()) {
            Some(spacing) => seen_points(cloud, self.eye, camera_from_cloud, spacing),
            None => Cloud::new(Vec::new()),
        };
        CloudFile {
            path: self.path.clone(),
            sha256: whole.sha256.clone(),
            ply: PlyCloud {
                cloud: seen,
                ..whole.ply.clone()
            },
        }
    }

    fn bits(&self) -> [u64; 7] {
        let [x, y, z] = self.eye.to_array();
        let [i, j, k, w] = self.cloud_from_view.to_array();
        [x, y, z, i, j, k, w].map(f64::to_bits)
    }
}

impl PartialEq for ScanFromHere {
    fn eq(&self, other: &Self) -> bool {
        self.of == other.of && self.bits() == other.bits()
    }
}

impl Eq for ScanFromHere {}

impl Hash for ScanFromHere {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.of.hash(state);
        self.bits().hash(state);
    }
}
