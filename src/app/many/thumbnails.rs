//! Thumbnails of the visible clouds: drawn in the background, and bounded in number.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use super::background::{BatchContext, YieldingWatch};
use crate::app::App;
use crate::app::workers::{JobWatch, Lane, Pool};
use crate::evaluate::{ThumbnailFile, ThumbnailRenderer, ThumbnailSettings};
use crate::render::Image;

/// The number of thumbnails that are kept in memory.
pub const KEPT_PICTURES: usize = 200;

/// The thumbnails by their clouds.
pub type Thumbnails = HashMap<PathBuf, Thumbnail>;

/// A thumbnail, or the reason why there is none.
#[derive(Debug, Clone)]
pub struct Thumbnail {
    /// The picture, or a sentence that says why it could not be drawn.
    pub image: Result<Arc<Image>, String>,
    /// Whether it shows other parameters, another reference or other colors than those in force.
    pub is_stale: bool,
}

struct Drawn {
    turn: u64,
    path: PathBuf,
    image: Result<Arc<Image>, String>,
}

/// The thumbnails that are wanted and those that are being drawn.
pub(super) struct ThumbnailQueue {
    lane: Lane<()>,
    drawn: (Sender<Drawn>, Receiver<Drawn>),
    renderer: Arc<ThumbnailRenderer>,
    wanted: Vec<PathBuf>,
    requested: HashSet<PathBuf>,
    turn: u64,
    settings: Option<ThumbnailSettings>,
    /// The clouds that have thumbnails, the oldest first.
    order: Vec<PathBuf>,
}

impl ThumbnailQueue {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            lane: Lane::new(pool),
            drawn: channel(),
            renderer: Arc::default(),
            wanted: Vec::new(),
            requested: HashSet::new(),
            turn: 0,
            settings: None,
            order: Vec::new(),
        }
    }

    pub(super) fn is_busy(&self) -> bool {
        self.lane.is_busy()
    }
}

impl App {
    /// Takes note of the clouds that are visible.
    pub(super) fn want_pictures(&mut self, places: &[usize]) {
        let rows = &self.state.many.rows;
        let path = |&place: &usize| rows.get(place)?.path.clone();
        // More than are kept would evict one another again and again.
        let wanted = places.iter().filter_map(path).take(KEPT_PICTURES);
        self.many.thumbnails.wanted = wanted.collect();
    }

    pub(super) fn update_pictures(&mut self) {
        self.mark_old_pictures();
        let is_over = self.many.thumbnails.lane.take().is_some();
        while let Ok(drawn) = self.many.thumbnails.drawn.1.try_recv() {
            if drawn.turn == self.many.thumbnails.turn {
                self.keep_picture(drawn);
            }
        }
        if is_over {
            self.many.thumbnails.requested.clear();
        }
        self.ask_for_pictures();
    }

    fn mark_old_pictures(&mut self) {
        let settings = ThumbnailSettings {
            request: self.state.settings.request.clone(),
            against: self.state.many.against,
            theme: self.state.style.theme,
        };
        if self.many.thumbnails.settings.as_ref() == Some(&settings) {
            return;
        }
        self.many.thumbnails.settings = Some(settings);
        self.many.thumbnails.lane.cancel();
        self.many.thumbnails.requested.clear();
        self.many.thumbnails.turn += 1;
        for picture in Arc::make_mut(&mut self.state.many.pictures).values_mut() {
            picture.is_stale = true;
        }
    }

    fn keep_picture(&mut self, drawn: Drawn) {
        let thumbnails = &mut self.many.thumbnails;
        let pictures = Arc::make_mut(&mut self.state.many.pictures);
        thumbnails.order.retain(|path| *path != drawn.path);
        thumbnails.order.push(drawn.path.clone());
        let picture = Thumbnail {
            image: drawn.image,
            is_stale: false,
        };
        pictures.insert(drawn.path, picture);
        while pictures.len() > KEPT_PICTURES {
            let oldest = thumbnails
                .order
                .iter()
                .position(|path| !thumbnails.wanted.contains(path));
            let path = thumbnails.order.remove(oldest.unwrap_or(0));
            pictures.remove(&path);
        }
    }

    fn ask_for_pictures(&mut self) {
        let pictures = &self.state.many.pictures;
        let is_missing = |path: &&PathBuf| pictures.get(*path).is_none_or(|picture| picture.is_stale);
        let thumbnails = &mut self.many.thumbnails;
        let missing: Vec<PathBuf> = thumbnails.wanted.iter().filter(is_missing).cloned().collect();
        let is_asked = missing.iter().all(|path| thumbnails.requested.contains(path));
        let Some(settings) = thumbnails.settings.clone().filter(|_| !is_asked) else {
            return;
        };
        thumbnails.turn += 1;
        thumbnails.requested = missing.iter().cloned().collect();
        let (turn, drawn, renderer) = (
            thumbnails.turn,
            thumbnails.drawn.0.clone(),
            thumbnails.renderer.clone(),
        );
        let context = self.many.context.clone();
        thumbnails.lane.submit(move |watch| {
            for path in missing {
                let Some(image) = picture(&path, &settings, &renderer, &context, watch) else {
                    return;
                };
                // The window may have closed.
                let _ = drawn.send(Drawn { turn, path, image });
            }
        });
    }
}

/// Reads or draws a thumbnail; `None` if the job is cancelled.
fn picture(
    path: &Path,
    settings: &ThumbnailSettings,
    renderer: &ThumbnailRenderer,
    context: &BatchContext,
    watch: &JobWatch,
) -> Option<Result<Arc<Image>, String>> {
    let file = ThumbnailFile::of(path, settings, &context.store);
    if let Some(image) = file.as_ref().and_then(ThumbnailFile::read) {
        return Some(Ok(Arc::new(image)));
    }
    let yielding = YieldingWatch { watch, context };
    let drawn = context
        .pool
        .install(|| renderer.draw(path, settings, &yielding))?;
    if let (Ok(image), Some(file)) = (&drawn, file) {
        file.write(path, image);
    }
    Some(drawn.map(Arc::new))
}
