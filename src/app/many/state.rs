//! The open clouds as a set: everything that there is to show of them.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::cloud_rows::{Filter, Sort, TableRow};
use super::sweep_ranges::SweepRanges;
use crate::evaluate::{Sweep, TruthChoice};
use crate::render::Image;

/// The progress of an evaluation of the open clouds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvaluationProgress {
    /// Clouds that are done.
    pub done: usize,
    /// Clouds in all.
    pub total: usize,
    /// The expected time that is left; `None` until a cloud has been evaluated.
    pub left: Option<Duration>,
}

/// The settings of the table and the sweep that a restart keeps.
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
    /// The filter that was asked for.
    pub filter: Filter,
    /// The reference of every error and every reference line in the window, and of the results.
    pub against: TruthChoice,
    /// The progress of the evaluation; `None` if none is under way.
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
    pub(in crate::app) fn new(kept: KeptMany) -> Self {
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

    pub(in crate::app) fn kept(&self) -> KeptMany {
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

/// The map of a sweep, and its progress.
#[derive(Debug, Clone)]
pub struct SweepState {
    /// The ranges of the next sweep.
    pub ranges: SweepRanges,
    /// The map; of fewer clouds than requested while it grows, or after a cancellation.
    pub map: Option<Arc<Sweep>>,
    /// The numbers of clouds in the map and of requested clouds.
    pub clouds: [usize; 2],
    /// Whether the parameters or the reference have changed since.
    pub is_stale: bool,
    /// The progress of a running sweep.
    pub progress: Option<EvaluationProgress>,
}

impl SweepState {
    fn new(ranges: SweepRanges) -> Self {
        Self {
            ranges,
            map: None,
            clouds: [0, 0],
            is_stale: false,
            progress: None,
        }
    }
}

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
