//! Thumbnails of the visible clouds: drawn in the background, and bounded in number.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use super::Many;
use super::background::{BatchContext, YieldingWatch};
use super::state::Thumbnail;
use crate::app::context::Context;
use crate::app::workers::{JobWatch, Lane, Pool};
use crate::evaluate::{ThumbnailFile, ThumbnailRenderer, ThumbnailSettings};
use crate::render::Image;

/// The number of thumbnails that are kept in memory.
pub const KEPT_PICTURES: usize = 200;

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

impl Many {
    /// Takes note of the clouds that are visible.
    pub(super) fn want_pictures(&mut self, places: &[usize], cx: &Context) {
        let rows = &cx.state.many.rows;
        let path = |&place: &usize| rows.get(place)?.path.clone();
        // More than are kept would evict one another again and again.
        let wanted = places.iter().filter_map(path).take(KEPT_PICTURES);
        self.thumbnails.wanted = wanted.collect();
    }

    pub(super) fn update_pictures(&mut self, cx: &mut Context) {
        self.mark_old_pictures(cx);
        let is_over = self.thumbnails.lane.take().is_some();
        while let Ok(drawn) = self.thumbnails.drawn.1.try_recv() {
            if drawn.turn == self.thumbnails.turn {
                self.keep_picture(drawn, cx);
            }
        }
        if is_over {
            self.thumbnails.requested.clear();
        }
        self.ask_for_pictures(cx);
    }

    fn mark_old_pictures(&mut self, cx: &mut Context) {
        let settings = ThumbnailSettings {
            request: cx.state.settings.request.clone(),
            against: cx.state.many.against,
            theme: cx.state.style.theme,
        };
        if self.thumbnails.settings.as_ref() == Some(&settings) {
            return;
        }
        self.thumbnails.settings = Some(settings);
        self.thumbnails.lane.cancel();
        self.thumbnails.requested.clear();
        self.thumbnails.turn += 1;
        for picture in Arc::make_mut(&mut cx.state.many.pictures).values_mut() {
            picture.is_stale = true;
        }
    }

    fn keep_picture(&mut self, drawn: Drawn, cx: &mut Context) {
        let thumbnails = &mut self.thumbnails;
        let pictures = Arc::make_mut(&mut cx.state.many.pictures);
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

    fn ask_for_pictures(&mut self, cx: &Context) {
        let pictures = &cx.state.many.pictures;
        let is_missing = |path: &&PathBuf| pictures.get(*path).is_none_or(|picture| picture.is_stale);
        let thumbnails = &mut self.thumbnails;
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
        let context = self.context.clone();
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
