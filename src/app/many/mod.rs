//! The open clouds as a set: analyzed in the background, as a table that is sorted and filtered, tagged,
//! drawn small, and swept over settings.

mod apply;
mod background;
mod cloud_rows;
pub(super) mod commands;
mod saving;
pub(super) mod state;
mod sweep_ranges;
mod sweeping;
mod tag_store;
mod tagging;
mod thumbnails;
mod update;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use super::workers::{Lane, Pool};
use crate::evaluate::CloudTags;
use crate::fruit::Request;
use crate::parallel::BackgroundPool;

pub use cloud_rows::{Column, Filter, Sort, TableRow, ordered};
pub use commands::ManyCommand;
pub use saving::evaluate_command_line;
pub use state::{EvaluationProgress, KeptMany, ManyState, SweepState, Thumbnail, Thumbnails};
pub use sweep_ranges::{MOST_TAUS, SweepRanges};
pub use thumbnails::KEPT_PICTURES;
pub use update::EVALUATED_AT_ONCE;

use background::{BatchContext, BatchResult};
use sweeping::Sweeper;
use tag_store::TagStore;
use thumbnails::ThumbnailQueue;

/// The jobs on the open clouds, and what they were last asked.
pub(super) struct Many {
    context: BatchContext,
    lane: Lane<()>,
    found: (Sender<BatchResult>, Receiver<BatchResult>),
    turn: u64,
    /// The parameters that the rows in force are of.
    request: Option<Request>,
    /// The time since the parameters were changed, until all clouds are looked up.
    rested: Option<Duration>,
    /// Whether all is to be evaluated as soon as the parameters rest.
    wants_all: bool,
    /// The clouds whose results are still to come.
    expected: HashSet<PathBuf>,
    is_evaluating: bool,
    began: Instant,
    worked_out: usize,
    places: HashMap<PathBuf, usize>,
    tag_store: TagStore,
    thumbnails: ThumbnailQueue,
    sweeper: Sweeper,
    results: Lane<Result<String, String>>,
    tags_read: HashSet<PathBuf>,
    /// The tags and notes that were given in this session, which are newer than any file that is still to be read.
    edited: HashMap<PathBuf, CloudTags>,
}

impl Many {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            context: BatchContext {
                store: Arc::default(),
                pool: Arc::new(BackgroundPool::new()),
                is_foreground_busy: Arc::new(AtomicBool::new(false)),
            },
            lane: Lane::new(pool),
            found: channel(),
            turn: 0,
            request: None,
            rested: None,
            wants_all: false,
            expected: HashSet::new(),
            is_evaluating: false,
            began: Instant::now(),
            worked_out: 0,
            places: HashMap::new(),
            tag_store: TagStore::new(pool),
            thumbnails: ThumbnailQueue::new(pool),
            sweeper: Sweeper::new(pool),
            results: Lane::new(pool),
            tags_read: HashSet::new(),
            edited: HashMap::new(),
        }
    }

    pub(super) fn is_busy(&self) -> bool {
        let is_drawing = self.thumbnails.is_busy() || self.sweeper.is_busy() || self.results.is_busy();
        self.lane.is_busy() || self.rested.is_some() || self.tag_store.is_busy() || is_drawing
    }
}
