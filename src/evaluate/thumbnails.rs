//! Small pictures of clouds, drawn without a window and kept in a folder beside the rows.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::row_store::{THUMBNAILS, params_key, stable_hash};
use super::{Examination, RowStore, TruthChoice, examine_file};
use crate::files::write_whole;
use crate::fruit::{Request, annotation_paths, files_behind};
use crate::method::Observe;
use crate::render::Image;
use crate::text::sentence;
use crate::view::{PictureSettings, Theme, decode_picture, encode_picture};

/// The size of a thumbnail in pixels: twice that of the gallery's cells, for dense screens.
pub const THUMBNAIL_PX: [u32; 2] = [320, 240];

/// Everything that a thumbnail shows besides its cloud.
#[derive(Debug, Clone, PartialEq)]
pub struct ThumbnailSettings {
    /// The parameters of the analysis.
    pub request: Request,
    /// The reference axis that is drawn.
    pub against: TruthChoice,
    /// The colors.
    pub theme: Theme,
}

/// The file of a cloud's thumbnail, named by all that the thumbnail follows from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ThumbnailFile {
    path: PathBuf,
}

impl ThumbnailFile {
    /// Returns the file of the cloud at `path`; `None` if the store has no folder, or the cloud cannot be read.
    pub fn of(path: &Path, settings: &ThumbnailSettings, store: &RowStore) -> Option<Self> {
        let folder = store.folder()?.join(THUMBNAILS);
        let files = files_behind(path, &settings.request, &annotation_paths(path));
        let hashes: Vec<Option<String>> = files.iter().map(|file| store.hash(file)).collect();
        hashes[0].as_ref()?;
        let key = stable_hash(&(
            hashes,
            params_key(&settings.request, None),
            settings.against,
            settings.theme,
            THUMBNAIL_PX,
        ));
        let path = folder.join(format!("{key}.png"));
        Some(Self { path })
    }

    /// Reads the thumbnail, if it was drawn before.
    pub fn read(&self) -> Option<Image> {
        decode_picture(&std::fs::read(&self.path).ok()?)
    }

    /// Keeps the thumbnail of the cloud called `cloud`. If that fails, it is drawn again the next time.
    pub fn write(&self, cloud: &Path, image: &Image) {
        let settings = PictureSettings {
            version: env!("CARGO_PKG_VERSION").into(),
            arguments: Vec::new(),
            cloud: cloud.display().to_string(),
            sha256: String::new(),
        };
        let write = || {
            let folder = self.path.parent()?;
            std::fs::create_dir_all(folder).ok()?;
            let png = encode_picture(image, &settings).ok()?;
            write_whole(&self.path, &png).ok()
        };
        let _ = write();
    }
}

/// Draws thumbnails with one device, which it opens for the first of them.
#[derive(Default)]
pub struct ThumbnailRenderer {
    device: Mutex<Device>,
}

impl ThumbnailRenderer {
    /// Analyzes and draws the cloud at `path`; a sentence if it cannot be drawn, `None` if the observer
    /// cancels the work.
    pub fn draw(
        &self,
        path: &Path,
        settings: &ThumbnailSettings,
        observe: &dyn Observe,
    ) -> Option<Result<Image, String>> {
        let examined = match examine_file(path, &settings.request, observe).ok()? {
            Ok(examined) => examined,
            Err(why) => return Some(Err(sentence(&why))),
        };
        let mut device = self.device.lock().unwrap_or_else(PoisonError::into_inner);
        Some(draw(&mut device, &examined, settings))
    }
}

type Device = Option<Result<crate::render::Gpu, String>>;

fn draw(device: &mut Device, examined: &Examination, settings: &ThumbnailSettings) -> Result<Image, String> {
    let gpu = device.get_or_insert_with(|| crate::render::Gpu::headless().map_err(|e| e.to_string()));
    let gpu = gpu.as_ref().map_err(Clone::clone)?;
    super::pictures::draw_small(examined, settings.against, THUMBNAIL_PX, settings.theme, gpu)
}
