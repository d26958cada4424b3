//! The work about the peduncle in each frame: results are taken, and the jobs that are wanted now are submitted.

use std::path::PathBuf;
use std::sync::Arc;

use super::PeduncleTools;
use super::apply::pick_peduncle;
use super::beside::Beside;
use super::companion::{self, Outcome};
use super::edits::Edited;
use super::hues::Hues;
use super::marks::{Marking, Wanted, mark};
use super::state::{Question, Saved};
use crate::app::context::Context;
use crate::app::state::State;
use crate::app::workers::{Crashed, PATIENCE};
use crate::fruit::{PeduncleChoice, companion_path};
use crate::parallel::Cancelled;

impl PeduncleTools {
    /// Does the frame's work, after the view's.
    pub(in crate::app) fn update(&mut self, cx: &mut Context) {
        self.update_edits(cx);
        self.update_companions(cx);
        self.update_hues(&mut cx.state);
        self.update_beside(cx);
        self.update_marks(cx);
        cx.state.peduncle.beside_progress = self.besides.progress();
        cx.state.peduncle.is_working = self.is_working();
    }

    /// Starts the next edit of the selection, as soon as the one before is done.
    fn update_edits(&mut self, cx: &mut Context) {
        if let Some(result) = self.edits.take() {
            self.accept_edit(result, cx);
        }
        if self.edits.is_busy() {
            return;
        }
        let Some(edit) = self.waiting_edits.pop_front() else {
            return;
        };
        let (Some(walked), Some(from)) = (cx.state.current_walked().cloned(), cx.state.peduncle_points())
        else {
            return;
        };
        let sha256 = &walked.fruit.file.sha256;
        let known = self.spacing.as_ref().filter(|(of, _)| of == sha256);
        let known = known.map(|(_, spacing)| *spacing);
        self.edits
            .submit(move |watch| edit.run(&walked, from, known, watch));
        if let Some(result) = self.edits.take_within(PATIENCE) {
            self.accept_edit(result, cx);
        }
    }

    fn accept_edit(&mut self, result: Result<Result<Edited, Cancelled>, Crashed>, cx: &mut Context) {
        let edited = match result {
            Ok(Ok(edited)) => edited,
            Ok(Err(Cancelled)) => return,
            Err(crash) => return cx.say(true, format!("The selection broke off by {crash}.")),
        };
        let is_current = cx
            .state
            .current_walked()
            .is_some_and(|walked| walked.fruit.file.sha256 == edited.sha256);
        self.spacing = Some((edited.sha256, edited.spacing));
        // What was picked or undone meanwhile is newer.
        let is_newest = cx.state.peduncle_points().is_some_and(|now| now == edited.from);
        if !(is_current && is_newest) {
            return;
        }
        if edited.from == edited.to {
            let text = if edited.from.is_empty() {
                "Nothing is selected yet that could grow or shrink."
            } else {
                "There is nothing within that reach: the selection stays as it is."
            };
            cx.say(false, text);
        }
        pick_peduncle(cx, edited.to);
    }

    /// Saves the peduncle's points: beside the cloud without replacing anything, or as `to`.
    pub(super) fn save_companion(&mut self, to: Option<PathBuf>, cx: &mut Context) {
        let (Some(walked), Some(points)) = (cx.state.current_walked().cloned(), cx.state.peduncle_points())
        else {
            cx.say(false, "There is no analyzed cloud whose peduncle could be saved.");
            return;
        };
        if points.is_empty() {
            cx.say(
                false,
                "No point of this cloud belongs to a peduncle yet: there is nothing to save.",
            );
            return;
        }
        if to.is_none() && cx.state.source().is_some_and(|source| !source.is_file()) {
            cx.say(
                false,
                "This cloud has no folder of its own: save its peduncle under a name of yours.",
            );
            return;
        }
        let replaces = to.is_some();
        let path = to.unwrap_or_else(|| companion_path(&walked.fruit.file.path));
        self.companions
            .submit(move |_| companion::written(&walked.fruit, points, path, replaces));
    }

    fn update_companions(&mut self, cx: &mut Context) {
        self.compare_companion(&cx.state);
        match self.companions.take() {
            Some(Ok(Outcome::Done(saved))) => {
                let (count, path) = (saved.points.len(), saved.path.display());
                cx.say(false, format!("Saved {count} points of the peduncle as {path}."));
                remember(&mut cx.state, saved);
            }
            Some(Ok(Outcome::Known(saved))) => remember(&mut cx.state, saved),
            None | Some(Ok(Outcome::Unknown)) => {}
            Some(Ok(Outcome::Exists(path))) => cx.state.peduncle.question = Some(Question::Replace(path)),
            Some(Ok(Outcome::Failed(problem))) => cx.say(true, problem),
            Some(Err(crash)) => cx.say(true, format!("Saving the peduncle broke off by {crash}.")),
        }
    }

    /// Compares the companion with the points that an earlier session picked.
    fn compare_companion(&mut self, state: &State) {
        let (Some(walked), Some(points)) = (state.current_walked(), state.picked_peduncle()) else {
            return;
        };
        let sha256 = &walked.fruit.file.sha256;
        if self.companions.is_busy() || self.compared.contains(sha256) {
            return;
        }
        let (walked, points) = (walked.clone(), points.clone());
        self.compared.insert(sha256.clone());
        self.companions
            .submit(move |_| companion::compared(&walked.fruit, points));
    }

    /// Counts the hues of the current cloud, where its peduncle is told by them.
    fn update_hues(&mut self, state: &mut State) {
        if let Some(Ok(hues)) = self.hues.take() {
            state.peduncle.hues = hues.map(Arc::new);
        }
        let is_wanted = matches!(state.settings.request.peduncle, PeduncleChoice::Hue(_));
        let Some(walked) = state.current_walked().filter(|_| is_wanted).cloned() else {
            return;
        };
        let sha256 = &walked.fruit.file.sha256;
        if self.asked_hues.as_ref() == Some(sha256) {
            return;
        }
        self.asked_hues = Some(sha256.clone());
        let hues = state.peduncle.hues.take();
        state.peduncle.hues = hues.filter(|hues| hues.sha256 == *sha256);
        self.hues
            .submit(move |_| Hues::of(walked.fruit.cloud(), &walked.fruit.file.sha256));
        if let Some(Ok(hues)) = self.hues.take_within(PATIENCE) {
            state.peduncle.hues = hues.map(Arc::new);
        }
    }

    /// Runs both of the paper's experiments, where that is wanted and the analysis is settled.
    fn update_beside(&mut self, cx: &mut Context) {
        match self.besides.take() {
            None => {}
            Some(Ok(beside)) => cx.state.peduncle.beside = beside,
            Some(Err(crash)) => cx.say(true, format!("The comparison broke off by {crash}.")),
        }
        let mut key = cx.analysis_key();
        if let Some(key) = &mut key {
            // Both experiments are made, whichever is chosen.
            key.request.without_peduncle = false;
        }
        let state = &mut cx.state;
        if state.peduncle.beside.as_ref().map(|beside| &beside.key) != key.as_ref() {
            state.peduncle.beside = None;
        }
        let is_settled = state.current_walked().is_some() && !state.is_stale;
        let wanted = key.filter(|_| state.peduncle.wants_beside && is_settled);
        if wanted.is_none() || self.asked_beside == wanted {
            return;
        }
        self.asked_beside.clone_from(&wanted);
        if let Some(key) = wanted {
            let stages = cx.stages.clone();
            self.besides
                .submit(move |watch| Beside::compute(key, stages, watch));
        }
    }

    /// Highlights the peduncle in the view. The points of a stroke that has ended go into the settings.
    fn update_marks(&mut self, cx: &mut Context) {
        self.take_marks(cx);
        let state = &mut cx.state;
        let Some(wanted) = Wanted::of(state) else {
            state.peduncle.marked = None;
            self.asked_marks = None;
            return;
        };
        // One after the other, so that a quick hand sees what it does; the last one always comes.
        if self.asked_marks.as_ref() == Some(&wanted) || self.marks.is_busy() {
            return;
        }
        let Some(fruit) = state.current_walked().map(|walked| walked.fruit.clone()) else {
            return;
        };
        let base = state.peduncle_points().filter(|_| wanted.is_stroke());
        let (screens, is_dark) = (self.screens.clone(), state.is_dark());
        let pixels_per_point = f64::from(state.pixels_per_point);
        self.asked_marks = Some(wanted.clone());
        self.marks.submit(move |_| {
            let base = base.unwrap_or_default();
            mark(&wanted, &fruit, &base, &screens, is_dark, pixels_per_point)
        });
        self.take_marks(cx);
    }

    fn take_marks(&mut self, cx: &mut Context) {
        let picking = &mut cx.state.peduncle;
        match self.marks.take_within(PATIENCE) {
            None => {}
            Some(Ok(Marking { marked, stroke })) => {
                picking.marked = Some(Arc::new(marked));
                if let Some((id, selected)) = stroke
                    && picking
                        .strokes
                        .pop_front_if(|stroke| stroke.id == id && stroke.is_ended)
                        .is_some()
                {
                    pick_peduncle(cx, selected);
                }
            }
            Some(Err(crash)) => {
                picking.strokes.clear();
                cx.say(true, format!("The selection broke off by {crash}."));
            }
        }
    }
}

fn remember(state: &mut State, saved: Saved) {
    state.peduncle.saved.retain(|known| known.path != saved.path);
    state.peduncle.saved.push(saved);
}
