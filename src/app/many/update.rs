//! The work on the open clouds in each frame: results are taken, and evaluations are started.

use std::collections::{BTreeSet, HashMap};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use super::Many;
use super::background::{BatchResult, BatchTask, evaluate_batch};
use super::cloud_rows::{TableRow, ordered};
use super::state::{EvaluationProgress, ManyState};
use crate::app::context::Context;
use crate::app::source::Source;
use crate::app::state::State;
use crate::evaluate::{Outcome, RowStore, StoreKind, StoreProblem};

/// Folders of up to so many clouds are evaluated as they are opened.
pub const EVALUATED_AT_ONCE: usize = 200;
/// Parameters that have rested so long are looked up for all clouds.
const CALM: Duration = Duration::from_millis(300);

impl Many {
    /// Keeps rows in a folder, so that they need not be worked out again the next time.
    pub fn keep_rows_in(&mut self, folder: PathBuf, cx: &Context) {
        let store = RowStore::in_folder(folder, StoreKind::Cache);
        self.context.store = Arc::new(store);
        self.look_up(cx);
    }

    /// The number of files that were read in the background to know their hash: for tests of the cache.
    #[doc(hidden)]
    pub fn background_reads(&self) -> usize {
        self.context.store.hash_reads()
    }

    /// Follows a change of the list of open clouds. A folder that is not too large is evaluated at once.
    pub(in crate::app) fn list_changed(&mut self, opened_folder: bool, cx: &mut Context) {
        self.wants_all |= opened_folder && cx.state.entries.len() <= EVALUATED_AT_ONCE;
        self.take_list(cx);
    }

    /// Takes what the background has made, and starts the next evaluation.
    pub(in crate::app) fn update(&mut self, elapsed: Duration, cx: &mut Context) {
        self.notice_parameters(elapsed, cx);
        self.take_found(cx);
        self.take_tags(cx);
        self.update_pictures(cx);
        self.update_sweep(cx);
        self.update_results(cx);
        if let Some(StoreProblem { path, error }) = self.context.store.take_problem() {
            let path = path.display();
            cx.say(
                true,
                format!("{path}: rows cannot be kept for the next time: {error}."),
            );
        }
    }

    /// Sets whether the background waits, because the current cloud is being worked on.
    pub(in crate::app) fn set_yielding(&self, yields: bool) {
        let flag = &self.context.is_foreground_busy;
        flag.store(yields, Ordering::Relaxed);
    }

    /// Makes the rows those of the list; what is known of a cloud stays.
    fn take_list(&mut self, cx: &mut Context) {
        let before = std::mem::take(&mut cx.state.many.rows);
        let mut known: HashMap<(String, Option<PathBuf>), &TableRow> = before
            .iter()
            .map(|row| ((row.name.clone(), row.path.clone()), row))
            .collect();
        let entries = cx.state.entries.iter().enumerate();
        let rows: Vec<TableRow> = entries
            .map(|(place, entry)| {
                let path = match &entry.source {
                    Source::File(path) => Some(path.clone()),
                    _ => None,
                };
                let name = entry.source.name();
                match known.remove(&(name.clone(), path.clone())) {
                    Some(row) => {
                        let mut row = row.clone();
                        row.write_cells(place);
                        row
                    }
                    None => TableRow::new(place, name, path),
                }
            })
            .collect();
        let places = rows.iter().enumerate();
        self.places = places
            .filter_map(|(place, row)| Some((row.path.clone()?, place)))
            .collect();
        let folders: BTreeSet<PathBuf> = rows
            .iter()
            .filter_map(|row| Some(row.path.as_deref()?.parent()?.to_owned()))
            .collect();
        cx.state.many.rows = Arc::new(rows);
        for folder in folders {
            if self.tags_read.insert(folder.clone()) {
                self.tag_store.read(folder);
            }
        }
        self.look_up(cx);
        cx.state.many.reorder();
    }

    /// Asks the cache for all clouds, or evaluates them where that is wanted, as soon as nothing else is
    /// under way. A single cloud is the current one, and needs no more.
    pub(super) fn look_up(&mut self, cx: &Context) {
        if cx.state.many.rows.len() > 1 {
            self.rested = Some(CALM);
        }
    }

    /// Rows of other parameters than those in force are marked; once the parameters rest, all clouds are
    /// looked up, and evaluated where that was asked for.
    fn notice_parameters(&mut self, elapsed: Duration, cx: &mut Context) {
        let request = &cx.state.settings.request;
        if self.request.as_ref() != Some(request) {
            let is_first = self.request.is_none();
            self.request = Some(request.clone());
            if !is_first {
                // What was under way is of the parameters before.
                self.wants_all |= self.is_evaluating;
                self.lane.cancel();
                self.expected.clear();
                self.is_evaluating = false;
                cx.state.many.progress = None;
                let rows = Arc::make_mut(&mut cx.state.many.rows);
                for row in rows.iter_mut() {
                    row.is_stale = row.outcome.is_some();
                }
                if cx.state.many.rows.len() > 1 {
                    self.rested = Some(Duration::ZERO);
                }
                cx.state.many.reorder();
            }
        }
        if let Some(rested) = &mut self.rested {
            *rested += elapsed;
            if *rested >= CALM && cx.state.progress.is_none() {
                self.rested = None;
                self.begin(cx);
            }
        }
    }

    fn begin(&mut self, cx: &mut Context) {
        let only_kept = !std::mem::take(&mut self.wants_all);
        let rows = &cx.state.many.rows;
        let clouds: Vec<PathBuf> = rows
            .iter()
            .filter(|row| !only_kept || row.outcome.is_none() || row.is_stale)
            .filter_map(|row| row.path.clone())
            .collect();
        if clouds.is_empty() {
            return;
        }
        self.turn += 1;
        self.is_evaluating = !only_kept;
        self.expected = clouds.iter().cloned().collect();
        self.began = Instant::now();
        self.worked_out = 0;
        cx.state.many.was_cancelled = false;
        cx.state.many.progress = (!only_kept).then_some(EvaluationProgress {
            done: 0,
            total: clouds.len(),
            left: None,
        });
        let task = BatchTask {
            turn: self.turn,
            clouds,
            request: cx.state.settings.request.clone(),
            only_stored: only_kept,
        };
        let context = self.context.clone();
        let found = self.found.0.clone();
        self.lane
            .submit(move |watch| evaluate_batch(&task, &context, watch, &found));
    }

    fn take_found(&mut self, cx: &mut Context) {
        let mut has_changed = false;
        let began = Instant::now();
        let is_over = self.lane.take();
        while let Ok(found) = self.found.1.try_recv() {
            if found.turn != self.turn || !self.expected.remove(&found.path) {
                continue;
            }
            has_changed = true;
            self.take_row(found, cx);
            // The rest in the next frame: texts are made for each. Where all is over, nothing may stay.
            if is_over.is_none() && began.elapsed() > Duration::from_millis(4) {
                break;
            }
        }
        if has_changed {
            self.tell_progress(cx);
            cx.state.many.reorder();
        }
        if let Some(result) = is_over {
            if let Err(crash) = result {
                cx.say(
                    true,
                    crate::text::sentence(&format!("the evaluation broke off by {crash}")),
                );
            }
            self.is_evaluating = false;
            cx.state.many.progress = None;
        }
    }

    fn take_row(&mut self, found: BatchResult, cx: &mut Context) {
        let Some(&place) = self.places.get(&found.path) else {
            return;
        };
        let rows = Arc::make_mut(&mut cx.state.many.rows);
        let Some(row) = rows.get_mut(place) else { return };
        self.worked_out += usize::from(!found.was_stored && found.outcome.is_some());
        if let Some(outcome) = found.outcome {
            if let Some(entry) = cx.state.entries.get_mut(place) {
                let failure = outcome.row().failure.as_deref();
                let is_unusable = outcome.row().sha256.is_none();
                entry.problem = failure.filter(|_| is_unusable).map(crate::text::sentence);
            }
            row.outcome = Some(outcome);
            row.is_stale = false;
            row.write_cells(place);
        }
    }

    fn tell_progress(&mut self, cx: &mut Context) {
        let left_over = self.expected.len();
        let Some(progress) = &mut cx.state.many.progress else {
            return;
        };
        progress.done = progress.total - left_over;
        let worked_out = self.worked_out;
        progress.left = (worked_out > 0).then(|| {
            let each = self.began.elapsed().as_secs_f64() / worked_out as f64;
            Duration::from_secs_f64(each * left_over as f64)
        });
    }
}

impl State {
    /// The current cloud's analysis is its row.
    pub(in crate::app) fn take_current_row(&mut self) {
        let (Some(place), Some(walked)) = (self.current, self.walked.clone()) else {
            return;
        };
        let rows = &self.many.rows;
        let is_same = rows.get(place).is_some_and(|row| {
            let path = row.path.as_ref();
            path.is_none_or(|path| *path == walked.fruit.file.path)
        });
        if self.is_stale || !is_same {
            return;
        }
        let outcome = Outcome::of_parts(
            &self.many.rows[place].name,
            &walked.fruit,
            &walked.analysis,
            walked.at_true_center.as_deref(),
            &self.references,
            &self.warnings,
        );
        let row = &mut Arc::make_mut(&mut self.many.rows)[place];
        row.is_stale = false;
        if row.outcome.as_deref() == Some(&outcome) {
            return;
        }
        row.outcome = Some(Arc::new(outcome));
        row.write_cells(place);
        self.many.reorder();
    }

    /// The cloud `by` places further on: as the table has them, but in the order of opening while axes are set or
    /// results are hidden. A table that is sorted by error would tell the annotator something, and a filter would
    /// leave clouds out.
    pub fn neighbor(&self, by: isize) -> Option<usize> {
        let current = self.current?;
        if !self.goes_in_order_of_opening() {
            return self.many.neighbor(current, by);
        }
        let last = self.entries.len().checked_sub(1)?;
        let place = current.saturating_add_signed(by).min(last);
        (place != current).then_some(place)
    }

    /// Whether the next cloud is that of the list, whatever the table's order and filter.
    pub fn goes_in_order_of_opening(&self) -> bool {
        self.true_axes.is_editing || self.true_axes.is_blind
    }
}

impl ManyState {
    /// Makes the table's order anew.
    pub(in crate::app) fn reorder(&mut self) {
        self.order = Arc::new(ordered(&self.rows, self.sort, &self.filter, self.against));
        self.missing = self
            .rows
            .iter()
            .filter(|row| row.path.is_some() && (row.outcome.is_none() || row.is_stale))
            .count();
        self.generation += 1;
    }
}
