//! What the set of clouds does once a frame, and when something is asked of it.

use std::collections::{BTreeSet, HashMap};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use super::background::{BatchResult, BatchTask, evaluate_batch};
use super::{EVALUATED_AT_ONCE, EvaluationProgress, ManyCommand, TableRow, ordered};
use crate::app::state::State;
use crate::app::{App, Source};
use crate::evaluate::{Outcome, RowStore, StoreKind, StoreProblem};

/// Parameters that have rested so long are looked up for all clouds.
const CALM: Duration = Duration::from_millis(300);

impl App {
    /// Keeps rows in a folder, so that they need not be worked out again the next time.
    pub fn keep_rows_in(&mut self, folder: PathBuf) {
        let store = RowStore::in_folder(folder, StoreKind::Cache);
        self.many.context.store = Arc::new(store);
        self.look_up();
    }

    /// How many files were read in the background to know their hash: for tests of the cache.
    #[doc(hidden)]
    pub fn background_reads(&self) -> usize {
        self.many.context.store.hash_reads()
    }

    /// The list of open clouds has changed. A folder that is not too large is evaluated at once.
    pub(in crate::app) fn list_changed(&mut self, opened_folder: bool) {
        self.many.wants_all |= opened_folder && self.state.entries.len() <= EVALUATED_AT_ONCE;
        self.take_list();
    }

    /// Once a frame, before the current cloud is asked for.
    pub(in crate::app) fn update_folder(&mut self, elapsed: Duration) {
        self.notice_parameters(elapsed);
        self.take_found();
        self.take_tags();
        self.update_pictures();
        self.update_sweep();
        self.update_results();
        if let Some(StoreProblem { path, error }) = self.many.context.store.take_problem() {
            let path = path.display();
            self.say(
                true,
                format!("{path}: rows cannot be kept for the next time: {error}."),
            );
        }
    }

    /// Whether the current cloud is being worked on: the background waits while it is.
    pub(in crate::app) fn stand_aside(&self, is_in_the_way: bool) {
        let flag = &self.many.context.is_foreground_busy;
        flag.store(is_in_the_way, Ordering::Relaxed);
    }

    /// Does what is asked.
    pub(in crate::app) fn apply_folder(&mut self, command: ManyCommand) {
        match command {
            ManyCommand::Evaluate => {
                self.many.wants_all = true;
                self.look_up();
            }
            ManyCommand::Cancel => {
                self.many.lane.cancel();
                self.many.expected.clear();
                self.many.wants_all = false;
                self.many.is_evaluating = false;
                self.state.many.progress = None;
                self.state.many.was_cancelled = true;
            }
            ManyCommand::Sort(sort) => {
                self.state.many.sort = sort;
                self.reorder();
            }
            ManyCommand::Filter(filter) => {
                self.state.many.filter = *filter;
                self.reorder();
            }
            ManyCommand::Against(choice) => {
                self.state.many.against = choice;
                self.reorder();
            }
            ManyCommand::GoWorse(by) => self.go_worse(by),
            ManyCommand::Picture(places) => self.want_pictures(&places),
            ManyCommand::SweepRanges(ranges) => self.state.many.sweep.ranges = *ranges,
            ManyCommand::Sweep => self.sweep(),
            ManyCommand::SaveResults(into) => self.save_results(into),
            ManyCommand::CancelSweep => self.cancel_sweep(),
            ManyCommand::OpenSetting { u, tau_cm_per_rad } => {
                let mut request = self.state.settings.request.clone();
                request.params.u = u;
                request.params.tau_cm_per_rad = tau_cm_per_rad;
                self.set(request, None);
            }
            ManyCommand::Tag { place, tagged } => self.tag(place, tagged),
        }
    }

    /// Of the clouds that the table shows, the one whose error is the next larger or smaller.
    fn go_worse(&mut self, by: isize) {
        let folder = &self.state.many;
        let error = |place: usize| folder.rows[place].error_deg(folder.against);
        let mut ranked: Vec<(f64, usize)> = folder
            .order
            .iter()
            .filter_map(|&place| Some((error(place)?, place)))
            .collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(last) = ranked.len().checked_sub(1) else {
            self.say(false, "No cloud has an error against this reference yet.".into());
            return;
        };
        let current = self.state.current;
        let to = match ranked.iter().position(|&(_, place)| Some(place) == current) {
            Some(at) => at.checked_add_signed(by).map_or(0, |to| to.min(last)),
            None if by > 0 => last,
            None => 0,
        };
        let place = ranked[to].1;
        self.apply(crate::app::Command::Show(place));
    }

    /// Makes the rows those of the list; what is known of a cloud stays.
    fn take_list(&mut self) {
        let before = std::mem::take(&mut self.state.many.rows);
        let mut known: HashMap<(String, Option<PathBuf>), &TableRow> = before
            .iter()
            .map(|row| ((row.name.clone(), row.path.clone()), row))
            .collect();
        let entries = self.state.entries.iter().enumerate();
        let rows: Vec<TableRow> = entries
            .map(|(place, entry)| {
                let path = match &entry.source {
                    Source::File(path) => Some(path.clone()),
                    Source::Bundled(_) => None,
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
        self.many.places = places
            .filter_map(|(place, row)| Some((row.path.clone()?, place)))
            .collect();
        let folders: BTreeSet<PathBuf> = rows
            .iter()
            .filter_map(|row| Some(row.path.as_deref()?.parent()?.to_owned()))
            .collect();
        self.state.many.rows = Arc::new(rows);
        for folder in folders {
            if self.many.tags_read.insert(folder.clone()) {
                self.many.tag_store.read(folder);
            }
        }
        self.look_up();
        self.reorder();
    }

    /// Asks the cache for all clouds, or evaluates them where that is wanted, as soon as nothing else is
    /// under way. A single cloud is the current one, and needs no more.
    fn look_up(&mut self) {
        if self.state.many.rows.len() > 1 {
            self.many.rested = Some(CALM);
        }
    }

    /// Rows of other parameters than those in force are marked; once the parameters rest, all clouds are
    /// looked up, and evaluated where that was asked for.
    fn notice_parameters(&mut self, elapsed: Duration) {
        let request = &self.state.settings.request;
        if self.many.request.as_ref() != Some(request) {
            let is_first = self.many.request.is_none();
            self.many.request = Some(request.clone());
            if !is_first {
                // What was under way is of the parameters before.
                self.many.wants_all |= self.many.is_evaluating;
                self.many.lane.cancel();
                self.many.expected.clear();
                self.many.is_evaluating = false;
                self.state.many.progress = None;
                let rows = Arc::make_mut(&mut self.state.many.rows);
                for row in rows.iter_mut() {
                    row.is_stale = row.outcome.is_some();
                }
                if self.state.many.rows.len() > 1 {
                    self.many.rested = Some(Duration::ZERO);
                }
                self.reorder();
            }
        }
        if let Some(rested) = &mut self.many.rested {
            *rested += elapsed;
            if *rested >= CALM && !self.analysis.is_busy() {
                self.many.rested = None;
                self.begin();
            }
        }
    }

    fn begin(&mut self) {
        let only_kept = !std::mem::take(&mut self.many.wants_all);
        let rows = &self.state.many.rows;
        let clouds: Vec<PathBuf> = rows
            .iter()
            .filter(|row| !only_kept || row.outcome.is_none() || row.is_stale)
            .filter_map(|row| row.path.clone())
            .collect();
        if clouds.is_empty() {
            return;
        }
        self.many.turn += 1;
        self.many.is_evaluating = !only_kept;
        self.many.expected = clouds.iter().cloned().collect();
        self.many.began = Instant::now();
        self.many.worked_out = 0;
        self.state.many.was_cancelled = false;
        self.state.many.progress = (!only_kept).then_some(EvaluationProgress {
            done: 0,
            total: clouds.len(),
            left: None,
        });
        let task = BatchTask {
            turn: self.many.turn,
            clouds,
            request: self.state.settings.request.clone(),
            only_stored: only_kept,
        };
        let context = self.many.context.clone();
        let found = self.many.found.0.clone();
        self.many
            .lane
            .submit(move |watch| evaluate_batch(&task, &context, watch, &found));
    }

    fn take_found(&mut self) {
        let mut has_changed = false;
        let began = Instant::now();
        let is_over = self.many.lane.take();
        while let Ok(found) = self.many.found.1.try_recv() {
            if found.turn != self.many.turn || !self.many.expected.remove(&found.path) {
                continue;
            }
            has_changed = true;
            self.take_row(found);
            // The rest in the next frame: texts are made for each. Where all is over, nothing may stay.
            if is_over.is_none() && began.elapsed() > Duration::from_millis(4) {
                break;
            }
        }
        if has_changed {
            self.tell_progress();
            self.reorder();
        }
        if let Some(result) = is_over {
            if let Err(crash) = result {
                self.say(
                    true,
                    crate::text::sentence(&format!("the evaluation broke off by {crash}")),
                );
            }
            self.many.is_evaluating = false;
            self.state.many.progress = None;
        }
    }

    fn take_row(&mut self, found: BatchResult) {
        let Some(&place) = self.many.places.get(&found.path) else {
            return;
        };
        let rows = Arc::make_mut(&mut self.state.many.rows);
        let Some(row) = rows.get_mut(place) else { return };
        self.many.worked_out += usize::from(!found.was_stored && found.outcome.is_some());
        if let Some(outcome) = found.outcome {
            if let Some(entry) = self.state.entries.get_mut(place) {
                let failure = outcome.row().failure.as_deref();
                let is_unusable = outcome.row().sha256.is_none();
                entry.problem = failure.filter(|_| is_unusable).map(crate::text::sentence);
            }
            row.outcome = Some(outcome);
            row.is_stale = false;
            row.write_cells(place);
        }
    }

    fn tell_progress(&mut self) {
        let left_over = self.many.expected.len();
        let Some(progress) = &mut self.state.many.progress else {
            return;
        };
        progress.done = progress.total - left_over;
        let worked_out = self.many.worked_out;
        progress.left = (worked_out > 0).then(|| {
            let each = self.many.began.elapsed().as_secs_f64() / worked_out as f64;
            Duration::from_secs_f64(each * left_over as f64)
        });
    }

    /// The current cloud's analysis is its row.
    pub(in crate::app) fn take_current_row(&mut self) {
        let (Some(place), Some(walked)) = (self.state.current, self.state.walked.clone()) else {
            return;
        };
        let rows = &self.state.many.rows;
        let is_same = rows.get(place).is_some_and(|row| {
            let path = row.path.as_ref();
            path.is_none_or(|path| *path == walked.fruit.file.path)
        });
        if self.state.is_stale || !is_same {
            return;
        }
        let outcome = Outcome::of_parts(
            &self.state.many.rows[place].name,
            &walked.fruit,
            &walked.analysis,
            &self.state.references,
            &self.state.warnings,
        );
        let row = &mut Arc::make_mut(&mut self.state.many.rows)[place];
        row.is_stale = false;
        if row.outcome.as_deref() == Some(&outcome) {
            return;
        }
        row.outcome = Some(Arc::new(outcome));
        row.write_cells(place);
        self.reorder();
    }

    /// Makes the table's order anew.
    pub(super) fn reorder(&mut self) {
        let folder = &mut self.state.many;
        folder.order = Arc::new(ordered(&folder.rows, folder.sort, &folder.filter, folder.against));
        folder.missing = folder
            .rows
            .iter()
            .filter(|row| row.path.is_some() && (row.outcome.is_none() || row.is_stale))
            .count();
        folder.generation += 1;
    }
}

impl State {
    /// The cloud `by` places further on, as the table has them.
    pub fn neighbor(&self, by: isize) -> Option<usize> {
        self.many.neighbor(self.current?, by)
    }
}
