//! The work about axes set by hand in each frame: results are taken, and the jobs that are wanted now are submitted.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use super::TrueAxes;
use super::agreement::{compare, set_by};
use super::scenes::{Scenes, Wanted, scenes};
use super::seen;
use super::state::{Ghost, Saving};
use super::stores::{AxisCloud, AxisStores, Change, Status, apply};
use super::views::locked_cameras;
use crate::annotate::{CloudAgreement, FAR_OFF_DEG};
use crate::app::context::Context;
use crate::app::state::State;
use crate::app::workers::PATIENCE;
use crate::evaluate::collect_references;
use crate::parallel::Cancelled;
use crate::text::sentence;
use crate::undo::History;

/// Points up to which the large view's ghost follows a drag.
const LIVE_GHOST: usize = 60_000;

impl TrueAxes {
    /// Follows the cloud that is looked at, and takes what has become of its axes.
    pub(in crate::app) fn update(&mut self, cx: &mut Context) {
        self.take_statuses(cx);
        self.turn_to_subject(cx);
        self.note_current(cx);
        self.take_seen_writes(cx);
        self.ask_for_mine(&mut cx.state);
        self.take_set(cx);
    }

    /// Waits until every edit of an axis is written.
    pub(in crate::app) fn finish(&mut self, cx: &mut Context) {
        self.stores.finish();
        self.seen_writes.finish();
        self.take_statuses(cx);
        self.take_seen_writes(cx);
    }

    /// Sets the locked cameras, and asks for the views of edit mode.
    pub(in crate::app) fn update_view(&mut self, state: &mut State) {
        let axes = &mut state.true_axes;
        axes.locked = axes
            .subject
            .as_ref()
            .filter(|_| axes.is_editing)
            .map(|subject| locked_cameras(subject, axes.set_ends().as_ref()));
        let (true, Some(subject), Some(look)) = (axes.is_editing, &axes.subject, &state.look) else {
            (axes.small_scene, axes.ghost_scene) = (None, None);
            self.scenes_asked = None;
            self.made = None;
            return;
        };
        let has_ghost = axes.ghost != Ghost::Off;
        let main_ends = if look.shown.len() > LIVE_GHOST {
            axes.set_ends()
        } else {
            axes.ends()
        };
        let wanted = Wanted {
            look: look.clone(),
            ends: axes.ends().filter(|_| has_ghost),
            main_ends: main_ends.filter(|_| has_ghost),
            ghost: axes.ghost,
            view_ray: subject.extent.center() - subject.viewpoint,
            pixels_per_point: state.pixels_per_point,
        };
        if self.scenes_asked.as_ref() != Some(&wanted) {
            self.scenes_asked = Some(wanted.clone());
            let before = self.made.clone();
            self.scenes.submit(move |_| scenes(wanted, before));
        }
        if let Some(Ok(Scenes { made, small })) = self.scenes.take_within(PATIENCE) {
            let axes = &mut state.true_axes;
            axes.ghost_scene.clone_from(&made.main);
            axes.small_scene = Some(small);
            self.made = Some(made);
        }
    }

    /// Shows a change of the axis at once, and hands it to the stores.
    pub(super) fn act_on_axis(&mut self, cx: &mut Context, change: Change) {
        let axes = &mut cx.state.true_axes;
        apply(&mut axes.history, &change);
        axes.annotated = None;
        axes.saving = Saving::Saving;
        let mine = Arc::make_mut(&mut axes.mine);
        if let Some(is_mine) = cx.state.current.and_then(|place| mine.get_mut(place)) {
            *is_mine = axes.history.current().is_some();
        }
        self.newest = self.stores.submit(move |stores| stores.act(change));
    }

    pub(super) fn try_again(&mut self, cx: &mut Context) {
        cx.state.true_axes.annotated = None;
        cx.state.true_axes.saving = Saving::Saving;
        self.newest = self.stores.submit(AxisStores::try_again);
    }

    pub(super) fn compare_set(&mut self, cx: &mut Context) {
        let clouds = clouds(&cx.state);
        self.set.submit(move |watch| compare(&clouds, watch));
        cx.state.true_axes.set_progress = Some(0.0);
    }

    pub(super) fn cancel_set(&mut self, cx: &mut Context) {
        self.set.cancel();
        cx.state.true_axes.set_progress = None;
    }

    /// Keeps in a file which clouds were shown with results, and takes over what it holds.
    pub(in crate::app) fn keep_seen_in(&mut self, path: PathBuf, cx: &mut Context) {
        match seen::read(&path) {
            Ok(seen) => cx.state.true_axes.seen.extend(seen),
            Err(problem) => cx.say(true, problem),
        }
        self.seen_file = Some(path);
    }

    /// Notes that results of all rows are on the screen.
    pub(super) fn note_results(&self, cx: &mut Context) {
        if cx.state.true_axes.is_blind {
            return;
        }
        cx.state.true_axes.seen_rows = Some(cx.state.many.generation);
        let rows = cx.state.many.rows.iter();
        let hashes = rows.filter_map(|row| {
            let outcome = row.outcome.as_ref()?;
            outcome.row().sha256.clone()
        });
        let hashes: Vec<String> = hashes.collect();
        self.note_seen(&mut cx.state, hashes);
    }

    /// Notes that the current cloud is shown with what is computed: its axis is not set blindly afterwards.
    fn note_current(&self, cx: &mut Context) {
        let state = &mut cx.state;
        let has_analysis = state.look.as_ref().is_some_and(|look| look.analysis.is_some());
        let subject = state.true_axes.subject.as_ref();
        let Some(sha256) = subject.map(|subject| subject.cloud.sha256.clone()) else {
            state.true_axes.was_seen = false;
            return;
        };
        if !state.true_axes.is_blind && has_analysis && !state.true_axes.seen.contains(&sha256) {
            self.note_seen(state, vec![sha256.clone()]);
        }
        state.true_axes.was_seen = state.true_axes.seen.contains(&sha256);
    }

    fn note_seen(&self, state: &mut State, mut hashes: Vec<String>) {
        hashes.retain(|sha256| state.true_axes.seen.insert(sha256.clone()));
        if let Some(path) = self.seen_file.clone().filter(|_| !hashes.is_empty()) {
            self.seen_writes.submit(move |()| seen::append(&path, &hashes));
        }
    }

    fn take_seen_writes(&self, cx: &mut Context) {
        while let Some((_, answer)) = self.seen_writes.take_within(Duration::ZERO) {
            match answer {
                Ok(Ok(())) => {}
                Ok(Err(problem)) => cx.say(true, problem),
                Err(crash) => cx.say(true, sentence(&crash.to_string())),
            }
        }
    }

    fn take_statuses(&mut self, cx: &mut Context) {
        while let Some((id, answer)) = self.stores.take_within(Duration::ZERO) {
            let is_newest = id == self.newest;
            match answer {
                Ok(status) if is_newest => self.accept_status(status, cx),
                // It is older than the last edit.
                Ok(_) => {}
                Err(crash) => {
                    let text = sentence(&format!("the axis could not be kept: {crash}"));
                    cx.state.true_axes.saving = Saving::Failed(text.clone());
                    cx.say(true, text);
                }
            }
        }
    }

    fn accept_status(&mut self, status: Status, cx: &mut Context) {
        let axes = &mut cx.state.true_axes;
        axes.history = status.history;
        axes.axis_file = status.axis_file;
        axes.saving = match status.problem {
            Some(problem) => Saving::Failed(problem),
            None if axes.history == History::default() => Saving::Nothing,
            None => Saving::Saved,
        };
        axes.unsaved_elsewhere = status.unsaved_elsewhere;
        axes.notices = status.notices;
        if let Some(subject) = &axes.subject {
            axes.agreement = Some(CloudAgreement::of(
                &subject.cloud.file,
                &status.annotations,
                FAR_OFF_DEG,
            ));
        }
        let turned_to = self.turned_to.as_ref();
        axes.annotated = turned_to.map(|(cloud, _)| (cloud.path.clone(), cloud.id.sha256.clone()));
        if axes.annotations != status.annotations {
            axes.annotations = status.annotations;
            refresh_references(&mut cx.state);
        }
    }

    /// Turns the stores to the cloud whose axis is set.
    fn turn_to_subject(&mut self, cx: &mut Context) {
        let axes = &cx.state.true_axes;
        let author = axes.author().ok().filter(|_| axes.is_editing);
        let wanted = axes.subject.as_ref().map(|subject| {
            let cloud = AxisCloud {
                path: subject.path.clone(),
                id: subject.cloud.clone(),
                unit: subject.unit,
            };
            (cloud, author)
        });
        // Between two clouds the last one's files stay.
        if wanted == self.turned_to || (wanted.is_none() && cx.state.progress.is_some()) {
            return;
        }
        self.turned_to.clone_from(&wanted);
        let axes = &mut cx.state.true_axes;
        axes.history = History::default();
        axes.drop_draft();
        (axes.axis_file, axes.agreement, axes.annotated) = (None, None, None);
        axes.annotations.clear();
        axes.notices.clear();
        axes.saving = Saving::Opening;
        let (cloud, author) = wanted.unzip();
        self.newest = self
            .stores
            .submit(move |stores| stores.turn_to(cloud, author.flatten()));
        if let Some((id, Ok(status))) = self.stores.take_within(PATIENCE)
            && id == self.newest
        {
            self.accept_status(status, cx);
        }
    }

    /// Asks which of the open clouds have an axis of this annotator's.
    fn ask_for_mine(&mut self, state: &mut State) {
        if let Some(Ok(mine)) = self.mine.take() {
            state.true_axes.mine = Arc::new(mine);
        }
        let author = state.true_axes.author().ok();
        let entries = &state.entries;
        let wanted = author.filter(|_| !entries.is_empty()).map(|author| {
            let last = entries.last().map(|entry| entry.source.path().to_owned());
            (author, entries.len(), last)
        });
        if wanted == self.mine_asked {
            return;
        }
        self.mine_asked.clone_from(&wanted);
        state.true_axes.mine = Arc::default();
        if let Some((author, ..)) = wanted {
            let clouds = clouds(state);
            self.mine.submit(move |_| set_by(&author, &clouds));
        }
    }

    fn take_set(&mut self, cx: &mut Context) {
        if let Some(answer) = self.set.take() {
            cx.state.true_axes.set_progress = None;
            match answer {
                Ok(Ok(report)) => cx.state.true_axes.set = Some(Arc::new(report)),
                Ok(Err(Cancelled)) => {}
                Err(crash) => cx.say(true, sentence(&crash.to_string())),
            }
        } else if let Some(progress) = self.set.progress() {
            cx.state.true_axes.set_progress = Some(progress.share);
        }
    }
}

fn clouds(state: &State) -> Vec<PathBuf> {
    let entries = state.entries.iter();
    entries.map(|entry| entry.source.path().to_owned()).collect()
}

/// Measures errors anew, against the axes set by hand as they are now.
fn refresh_references(state: &mut State) {
    if let Some(walked) = state.walked.clone() {
        let walked = state.true_axes.with_annotations((*walked).clone());
        let (references, warnings) =
            collect_references(&walked.fruit, &state.settings.request, &walked.analysis);
        (state.references, state.warnings) = (references, warnings);
        state.walked = Some(Arc::new(walked));
        state.take_current_row();
    }
}
