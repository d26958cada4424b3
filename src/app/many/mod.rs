//! The open clouds as a set: analyzed in the background, as a table that is sorted and filtered, tagged,
//! drawn small, and swept over settings.

mod background;
mod cloud_rows;
mod saving;
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
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::app::workers::{Lane, Pool};
use crate::evaluate::{CloudTags, TruthChoice};
use crate::fruit::Request;
use crate::parallel::BackgroundPool;

pub use cloud_rows::{Column, Filter, Sort, TableRow, ordered};
pub use saving::evaluate_command_line;
pub use sweeping::{MOST_TAUS, SweepRanges, SweepState};
pub use thumbnails::{KEPT_PICTURES, Thumbnail, Thumbnails};

use background::{BatchContext, BatchResult};
use sweeping::Sweeper;
use tag_store::TagStore;
use thumbnails::ThumbnailQueue;

/// Folders of up to so many clouds are evaluated as they are opened.
pub const EVALUATED_AT_ONCE: usize = 200;

/// How far the evaluation of the open clouds is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvaluationProgress {
    /// Clouds that are done.
    pub done: usize,
    /// Clouds in all.
    pub total: usize,
    /// How long it will take yet; `None` where nothing was worked out yet.
    pub left: Option<Duration>,
}

/// What survives a restart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct KeptMany {
    sort: Sort,
    filter: Filter,
    against: TruthChoice,
    sweep: SweepRanges,
    folders: Vec<PathBuf>,
}

impl KeptMany {
    /// The folders that were open: they may hold more clouds by now.
    pub fn folders(&self) -> &[PathBuf] {
        &self.folders
    }
}

impl Default for KeptMany {
    fn default() -> Self {
        Self {
            sort: Sort::default(),
            filter: Filter::default(),
            against: TruthChoice::Auto,
            sweep: SweepRanges::default(),
            folders: Vec::new(),
        }
    }
}

/// The open clouds as a set: what there is to show of them.
#[derive(Debug, Clone)]
pub struct ManyState {
    /// A row a cloud, in the order of the list.
    pub rows: Arc<Vec<TableRow>>,
    /// The places of those that are shown, in the order of the table.
    pub order: Arc<Vec<usize>>,
    /// Counts changes of the rows and of their order.
    pub generation: u64,
    /// The order that was asked for.
    pub sort: Sort,
    /// Which ones were asked for.
    pub filter: Filter,
    /// What errors are measured against in charts, gallery, filter and results.
    pub against: TruthChoice,
    /// How far the evaluation is; `None` where there is none under way.
    pub progress: Option<EvaluationProgress>,
    /// Clouds without a row of the parameters in force.
    pub missing: usize,
    /// Whether an evaluation was called off, or never begun.
    pub was_cancelled: bool,
    /// All tags that there are, sorted, each once.
    pub known_tags: Arc<Vec<String>>,
    /// Small pictures, of some of the clouds.
    pub pictures: Arc<Thumbnails>,
    /// The map of the error over settings.
    pub sweep: SweepState,
    /// The folders that are open as a whole.
    pub folders: Vec<PathBuf>,
}

impl ManyState {
    pub(super) fn new(kept: KeptMany) -> Self {
        Self {
            rows: Arc::default(),
            order: Arc::default(),
            generation: 0,
            sort: kept.sort,
            filter: kept.filter,
            against: kept.against,
            progress: None,
            missing: 0,
            was_cancelled: false,
            known_tags: Arc::default(),
            pictures: Arc::default(),
            sweep: SweepState::new(kept.sweep),
            // They are open again once somebody opens them.
            folders: Vec::new(),
        }
    }

    pub(super) fn kept(&self) -> KeptMany {
        KeptMany {
            sort: self.sort,
            filter: self.filter.clone(),
            against: self.against,
            sweep: self.sweep.ranges.clone(),
            folders: self.folders.clone(),
        }
    }

    /// The place in the list of the cloud that is `by` rows further on in the table than the one at
    /// `current`; the table's ends where that one is not shown.
    pub fn neighbor(&self, current: usize, by: isize) -> Option<usize> {
        let last = self.order.len().checked_sub(1)?;
        let row = match self.order.iter().position(|&place| place == current) {
            Some(row) => row.checked_add_signed(by).map_or(0, |row| row.min(last)),
            None if by < 0 => last,
            None => 0,
        };
        let place = self.order[row];
        (place != current).then_some(place)
    }
}

/// Something that is asked of the set of clouds.
#[derive(Debug, Clone, PartialEq)]
pub enum ManyCommand {
    /// Analyze every open cloud that has no row of the parameters in force.
    Evaluate,
    /// Call that off; what is done stays.
    Cancel,
    /// Sort the table.
    Sort(Sort),
    /// Show some of the clouds only.
    Filter(Box<Filter>),
    /// Measure errors against another reference.
    Against(TruthChoice),
    /// Show the cloud that is so many places further on in the order of errors, least first.
    GoWorse(isize),
    /// Draw small pictures of these clouds, which are in sight, by their places in the list.
    Picture(Vec<usize>),
    /// Which settings are to be swept.
    SweepRanges(Box<SweepRanges>),
    /// Sweep over them.
    Sweep,
    /// Call the sweep off; the map stays as far as it came.
    CancelSweep,
    /// Analyze with a cell's settings.
    OpenSetting {
        /// Grid steps.
        u: usize,
        /// Weight of angles.
        tau_cm_per_rad: f64,
    },
    /// Save the results in a new folder within this one.
    SaveResults(PathBuf),
    /// Tags and note of a cloud, by its place in the list.
    Tag {
        /// Which cloud.
        place: usize,
        /// What is said of it now.
        tagged: CloudTags,
    },
}

/// What works behind [`ManyState`].
pub(super) struct Many {
    context: BatchContext,
    lane: Lane<()>,
    found: (Sender<BatchResult>, Receiver<BatchResult>),
    turn: u64,
    /// What the rows in force are of.
    request: Option<Request>,
    /// How long the parameters have rested since they were changed.
    rested: Option<Duration>,
    /// Whether all is to be evaluated as soon as the parameters rest.
    wants_all: bool,
    /// The clouds that the running evaluation has still to tell of.
    expected: HashSet<PathBuf>,
    is_evaluating: bool,
    began: std::time::Instant,
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
            began: std::time::Instant::now(),
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
