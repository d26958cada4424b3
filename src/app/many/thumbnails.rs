//! Small pictures of the clouds in sight: drawn in the background, kept within bounds in memory, and on disk
//! beside the rows.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use super::cache::{Hash, params_hash, read_hash, row_key};
use super::run::{Background, Polite};
use crate::app::App;
use crate::app::workers::{JobWatch, Lane, Pool};
use crate::evaluate::{Outcome, TruthChoice};
use crate::fruit::annotation_paths;
use crate::fruit::{Request, files_behind};
use crate::parallel::Crew;
use crate::render::Image;
use crate::view::Theme;
use crate::view::{PictureSettings, decode_picture, encode_picture};

/// Pictures that are kept in memory.
pub const KEPT_PICTURES: usize = 200;
/// Pictures that are kept on disk.
const KEPT_FILES: usize = 4000;
/// Their size in pixels: twice that of the gallery's, for screens of many pixels.
pub const THUMBNAIL_PX: [u32; 2] = [320, 240];

/// What a picture is of, besides the cloud.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Subject {
    request: Request,
    against: TruthChoice,
    theme: Theme,
}

/// A small picture, or why there is none.
#[derive(Debug, Clone)]
pub struct Thumbnail {
    /// The picture, or why it could not be drawn.
    pub image: Result<Arc<Image>, String>,
    /// Whether it is of other parameters, another reference or other colors than those in force.
    pub is_stale: bool,
}

struct Drawn {
    turn: u64,
    path: PathBuf,
    image: Result<Arc<Image>, String>,
}

/// What draws the pictures.
pub(super) struct Studio {
    lane: Lane<()>,
    drawn: (Sender<Drawn>, Receiver<Drawn>),
    gpu: Arc<Mutex<Adapter>>,
    wanted: Vec<PathBuf>,
    asked: HashSet<PathBuf>,
    turn: u64,
    subject: Option<Subject>,
    /// In the order in which they came.
    order: Vec<PathBuf>,
}

impl Studio {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            lane: Lane::new(pool),
            drawn: channel(),
            gpu: Arc::default(),
            wanted: Vec::new(),
            asked: HashSet::new(),
            turn: 0,
            subject: None,
            order: Vec::new(),
        }
    }

    pub(super) fn is_busy(&self) -> bool {
        self.lane.is_busy()
    }
}

impl App {
    /// The clouds that are in sight and want pictures.
    pub(super) fn want_pictures(&mut self, places: &[usize]) {
        let rows = &self.state.many.rows;
        let path = |&place: &usize| rows.get(place)?.path.clone();
        // More than are kept would push one another out for ever.
        let wanted = places.iter().filter_map(path).take(KEPT_PICTURES);
        self.many.studio.wanted = wanted.collect();
    }

    pub(super) fn update_pictures(&mut self) {
        self.mark_old_pictures();
        let is_over = self.many.studio.lane.take().is_some();
        while let Ok(drawn) = self.many.studio.drawn.1.try_recv() {
            if drawn.turn == self.many.studio.turn {
                self.hang(drawn);
            }
        }
        if is_over {
            self.many.studio.asked.clear();
        }
        self.ask_for_pictures();
    }

    fn mark_old_pictures(&mut self) {
        let subject = Subject {
            request: self.state.settings.request.clone(),
            against: self.state.many.against,
            theme: self.state.style.theme,
        };
        if self.many.studio.subject.as_ref() == Some(&subject) {
            return;
        }
        self.many.studio.subject = Some(subject);
        self.many.studio.lane.cancel();
        self.many.studio.asked.clear();
        self.many.studio.turn += 1;
        for picture in Arc::make_mut(&mut self.state.many.pictures).values_mut() {
            picture.is_stale = true;
        }
    }

    fn hang(&mut self, drawn: Drawn) {
        let studio = &mut self.many.studio;
        let pictures = Arc::make_mut(&mut self.state.many.pictures);
        studio.order.retain(|path| *path != drawn.path);
        studio.order.push(drawn.path.clone());
        let picture = Thumbnail {
            image: drawn.image,
            is_stale: false,
        };
        pictures.insert(drawn.path, picture);
        while pictures.len() > KEPT_PICTURES {
            let oldest = studio.order.iter().position(|path| !studio.wanted.contains(path));
            let path = studio.order.remove(oldest.unwrap_or(0));
            pictures.remove(&path);
        }
    }

    fn ask_for_pictures(&mut self) {
        let pictures = &self.state.many.pictures;
        let is_missing = |path: &&PathBuf| pictures.get(*path).is_none_or(|picture| picture.is_stale);
        let studio = &mut self.many.studio;
        let missing: Vec<PathBuf> = studio.wanted.iter().filter(is_missing).cloned().collect();
        let is_asked = missing.iter().all(|path| studio.asked.contains(path));
        let Some(subject) = studio.subject.clone().filter(|_| !is_asked) else {
            return;
        };
        studio.turn += 1;
        studio.asked = missing.iter().cloned().collect();
        let (turn, drawn, gpu) = (studio.turn, studio.drawn.0.clone(), studio.gpu.clone());
        let (background, crew) = (self.many.background.clone(), self.many.crew.clone());
        studio.lane.submit(move |watch| {
            let easel = Easel {
                subject: &subject,
                background: &background,
                crew: &crew,
                gpu: &gpu,
            };
            for path in missing {
                let Some(image) = easel.picture(&path, watch) else {
                    return;
                };
                // Nobody listens any more where the window has closed.
                let _ = drawn.send(Drawn { turn, path, image });
            }
        });
    }
}

/// What one picture is drawn with.
struct Easel<'a> {
    subject: &'a Subject,
    background: &'a Background,
    crew: &'a Crew,
    gpu: &'a Mutex<Adapter>,
}

impl Easel<'_> {
    /// A cloud's picture; `None` where the work was called off.
    fn picture(&self, path: &Path, watch: &JobWatch) -> Option<Result<Arc<Image>, String>> {
        let file = self.file_of(path);
        if let Some(image) = file
            .as_deref()
            .and_then(|file| decode_picture(&std::fs::read(file).ok()?))
        {
            return Some(Ok(Arc::new(image)));
        }
        let polite = Polite {
            watch,
            background: self.background,
        };
        let request = &self.subject.request;
        let drawn = self.crew.run(|| {
            let (outcome, examined) = Outcome::of_file("", path, request, &polite).ok()?;
            let Some(examined) = examined else {
                let why = outcome.row().failure.clone().unwrap_or_default();
                return Some(Err(crate::text::sentence(&why)));
            };
            let mut adapter = self.gpu.lock().unwrap_or_else(PoisonError::into_inner);
            Some(draw(&mut adapter, &examined, self.subject))
        })?;
        if let (Ok(image), Some(file)) = (&drawn, file) {
            keep(&file, path, image);
        }
        Some(drawn.map(Arc::new))
    }

    /// Where a cloud's picture lies on disk.
    fn file_of(&self, path: &Path) -> Option<PathBuf> {
        let folder = self.background.cache().folder()?.join("thumbnails");
        let files = files_behind(path, &self.subject.request, &annotation_paths(path));
        let hash = |file: &PathBuf| {
            let known = self.background.cache().known_hash(file);
            match known {
                Hash::Known(hash) => hash,
                Hash::Unread => {
                    let read = read_hash(file)?;
                    self.background.cache().learn(file, &read);
                    Some(read.sha256)
                }
            }
        };
        let Subject {
            request,
            against,
            theme,
        } = self.subject;
        let mut parts: Vec<Option<String>> = files.iter().map(hash).collect();
        parts[0].as_ref()?;
        parts.push(Some(params_hash(request)));
        parts.push(Some(format!("{against:?} {theme:?} {THUMBNAIL_PX:?}")));
        Some(folder.join(format!("{}.png", row_key(&parts))))
    }
}

/// Keeps a picture on disk; where that fails it is drawn again the next time.
fn keep(file: &Path, cloud: &Path, image: &Image) {
    let settings = PictureSettings {
        version: env!("CARGO_PKG_VERSION").into(),
        arguments: Vec::new(),
        cloud: cloud.display().to_string(),
        sha256: String::new(),
    };
    let write = || {
        let folder = file.parent()?;
        std::fs::create_dir_all(folder).ok()?;
        let png = encode_picture(image, &settings).ok()?;
        // Aside first, under a name of this program's own: no half of a picture is ever there.
        let aside = file.with_extension(format!("{}.part", std::process::id()));
        std::fs::write(&aside, png).ok()?;
        std::fs::rename(&aside, file).ok()
    };
    let _ = write();
}

/// Lets go of the pictures that were drawn longest ago.
pub(super) fn prune(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder.join("thumbnails")) else {
        return;
    };
    let mut files: Vec<_> = entries
        .filter_map(|entry| {
            let entry = entry.ok()?;
            Some((entry.metadata().ok()?.modified().ok()?, entry.path()))
        })
        .collect();
    files.sort();
    let surplus = files.len().saturating_sub(KEPT_FILES);
    for (_, path) in files.into_iter().take(surplus) {
        let _ = std::fs::remove_file(path);
    }
}

/// The pictures by their clouds.
pub type Thumbnails = HashMap<PathBuf, Thumbnail>;

/// The device that draws them, asked for at the first picture.
#[cfg(feature = "window")]
type Adapter = Option<Result<crate::render::Gpu, String>>;

#[cfg(feature = "window")]
fn draw(
    adapter: &mut Adapter,
    examined: &crate::evaluate::Examined,
    subject: &Subject,
) -> Result<Image, String> {
    let gpu = adapter.get_or_insert_with(|| crate::render::Gpu::headless().map_err(|e| e.to_string()));
    let gpu = gpu.as_ref().map_err(Clone::clone)?;
    super::pictures::picture(examined, subject.against, THUMBNAIL_PX, subject.theme, gpu)
}

/// Without a renderer there are no pictures.
#[cfg(not(feature = "window"))]
type Adapter = ();

#[cfg(not(feature = "window"))]
fn draw(_: &mut Adapter, _: &crate::evaluate::Examined, _: &Subject) -> Result<Image, String> {
    Err("This build draws no pictures: it lacks the feature `window`.".into())
}
