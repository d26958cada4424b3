//! True axes set by hand.
//!
//! An edit shows at once. `stores.rs` writes it beside the interface, in order, and only its answer makes the edit saved.

mod agreement;
mod apply;
mod blind;
pub(super) mod commands;
mod handles;
mod scenes;
mod seen;
pub(super) mod state;
mod stores;
mod subject;
mod update;
mod views;

use std::path::PathBuf;

use super::workers::{JobId, Lane, Pool, Queue};
use crate::annotate::Author;
use crate::parallel::Cancelled;

pub use agreement::SetReport;
pub use blind::overlay_reveals;
pub use commands::{Decision, TrueAxesCommand, Turn};
pub use handles::{EditView, Handle};
pub use state::{Draft, Ghost, Grab, KeptTrueAxes, Saving, Subject, TrueAxesState};

use scenes::{Made, Scenes, Wanted};
use stores::{AxisCloud, AxisStores, Status};

/// The jobs about axes set by hand, and what they were last asked.
pub(super) struct TrueAxes {
    stores: Queue<AxisStores, Status>,
    /// The job whose answer is the present status.
    newest: JobId,
    /// The cloud and the author that the stores were last turned to.
    turned_to: Option<(AxisCloud, Option<Author>)>,
    scenes: Lane<Scenes>,
    scenes_asked: Option<Wanted>,
    made: Option<Made>,
    set: Lane<Result<SetReport, Cancelled>>,
    mine: Lane<Vec<bool>>,
    mine_asked: Option<(Author, usize, Option<PathBuf>)>,
    /// Writes which clouds were shown with results.
    seen_writes: Queue<(), Result<(), String>>,
    /// The file for that.
    seen_file: Option<PathBuf>,
}

impl TrueAxes {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            stores: Queue::new(pool, AxisStores::default()),
            newest: 0,
            turned_to: None,
            scenes: Lane::new(pool),
            scenes_asked: None,
            made: None,
            set: Lane::new(pool),
            mine: Lane::new(pool),
            mine_asked: None,
            seen_writes: Queue::new(pool, ()),
            seen_file: None,
        }
    }

    /// Whether a result is still to come or to be taken.
    pub(super) fn is_busy(&self) -> bool {
        self.stores.is_busy()
            || self.scenes.is_busy()
            || self.set.is_busy()
            || self.mine.is_busy()
            || self.seen_writes.is_busy()
    }
}
