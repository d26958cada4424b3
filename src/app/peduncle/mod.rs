//! Picking the peduncle: lasso and brush, growing, a preview of hues, the companion file, and both of the paper's
//! experiments side by side.
//!
//! ```text
//! drag ─▶ stroke ─▶ job of marks ─▶ highlight … button let go ─▶ settings (one step of undo) ─▶ analysis
//! ```

mod apply;
mod beside;
pub(super) mod commands;
mod companion;
mod edits;
mod hues;
mod marks;
mod selection;
pub(super) mod state;
mod update;

use std::collections::{HashSet, VecDeque};

use super::inspector::key::AnalysisKey;
use super::workers::{Lane, Pool};
use crate::parallel::Cancelled;

pub use beside::{Beside, Errors};
pub use commands::{PeduncleCommand, PedunclePath};
pub use hues::Hues;
pub use state::{Marked, PeduncleState, Question, Stroke};

/// The jobs about the peduncle, and what they were last asked.
pub(super) struct PeduncleTools {
    marks: Lane<marks::Marking>,
    asked_marks: Option<marks::Wanted>,
    screens: marks::Screens,
    edits: Lane<Result<edits::Edited, Cancelled>>,
    /// Edits that wait for the one before, so that none is lost.
    waiting_edits: VecDeque<edits::Edit>,
    /// The median spacing of a cloud's points, by its SHA-256, which takes a tree of them to tell.
    spacing: Option<(String, f64)>,
    companions: Lane<companion::Outcome>,
    /// Clouds whose companions were compared with what the last session had picked.
    compared: HashSet<String>,
    hues: Lane<Option<Hues>>,
    asked_hues: Option<String>,
    besides: Lane<Option<Beside>>,
    asked_beside: Option<AnalysisKey>,
    strokes: u64,
}

impl PeduncleTools {
    pub(super) fn new(pool: &Pool) -> Self {
        Self {
            marks: Lane::new(pool),
            asked_marks: None,
            screens: marks::Screens::default(),
            edits: Lane::new(pool),
            waiting_edits: VecDeque::new(),
            spacing: None,
            companions: Lane::new(pool),
            compared: HashSet::new(),
            hues: Lane::new(pool),
            asked_hues: None,
            besides: Lane::new(pool),
            asked_beside: None,
            strokes: 0,
        }
    }

    /// Whether a result is still to come or to be taken.
    pub(super) fn is_busy(&self) -> bool {
        self.is_working() || self.marks.is_busy() || self.hues.is_busy() || self.besides.is_busy()
    }

    /// Whether a selection is being grown, or a companion written.
    fn is_working(&self) -> bool {
        self.edits.is_busy() || !self.waiting_edits.is_empty() || self.companions.is_busy()
    }
}
