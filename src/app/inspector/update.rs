//! What is done once a frame: results are taken from the workers, and what is wanted now is asked of them.

use std::sync::Arc;
use std::time::Duration;

use super::look::{Look, LookRequest, look};
use super::navigate::{default_camera, framed_camera};
use super::stages::{AnalyzeError, AnalyzedFruit, Source};
use crate::app::workers::Crashed;
use crate::app::{App, Asked, PATIENCE, PLANES_PER_SECOND, PickQuestion, Seen, sentence_of_file};
use crate::evaluate::collect_references;
use crate::parallel::Cancelled;
use crate::text::sentence;
use crate::view::pick_point;

impl App {
    pub(in crate::app) fn play(&mut self, elapsed: Duration) {
        if !self.state.is_playing {
            return;
        }
        // Not faster than the planes can be drawn.
        if !self.looks.is_busy() {
            self.play_phase += PLANES_PER_SECOND * elapsed.as_secs_f64().min(0.5);
        }
        let steps = self.play_phase.floor();
        self.play_phase -= steps;
        if steps > 0.0 {
            // At most three.
            self.step(steps as isize);
        }
    }

    pub(in crate::app) fn ask_for_analysis(&mut self) {
        let Some(source) = self.state.source().cloned() else {
            return;
        };
        let wanted = Asked {
            source,
            settings: Box::new(self.state.settings.request.clone()),
            turn: self.turn,
        };
        if self.asked.as_ref() == Some(&wanted) {
            return;
        }
        self.asked = Some(wanted.clone());
        self.state.was_cancelled = false;
        if let Some(walked) = self.stages.analyze_kept(&wanted.source, &wanted.settings) {
            self.analysis.cancel();
            self.accept(Ok(walked));
            return;
        }
        self.state.is_stale = self.state.walked.is_some();
        let mut stages = self.stages.clone();
        let (arrivals, repaint) = (self.arrivals.0.clone(), self.repaint.clone());
        // What another request was to show comes too late.
        while self.arrivals.1.try_recv().is_ok() {}
        self.analysis.submit(move |watch| {
            let arrived = |fruit: &Arc<crate::fruit::Fruit>, shown| {
                // Nobody listens any more where the window has closed.
                let _ = arrivals.send((wanted.source.clone(), fruit.clone(), shown));
                repaint();
            };
            let result = stages.analyze(&wanted.source, &wanted.settings, watch, &arrived);
            (stages, result)
        });
        self.take_analysis(Some(PATIENCE));
    }

    pub(in crate::app) fn take_arrivals(&mut self) {
        while let Ok((source, fruit, shown)) = self.arrivals.1.try_recv() {
            let is_current = self.state.source() == Some(&source);
            if is_current && self.analysis.progress().is_some() {
                self.shown_generation += 1;
                self.forget_analysis();
                // Its axis can be set by hand meanwhile.
                self.set_subject(&fruit, &shown);
                self.state.unanalyzed = Some((shown, None));
                self.frame_if_new();
            }
        }
    }

    pub(in crate::app) fn frame_if_new(&mut self) {
        if self.needs_framing && self.state.shown().is_some() {
            self.needs_framing = false;
            self.frame_new_cloud();
        }
    }

    pub(in crate::app) fn take_analysis(&mut self, patience: Option<Duration>) {
        let taken = match patience {
            Some(patience) => self.analysis.take_within(patience),
            None => self.analysis.take(),
        };
        match taken {
            None => {}
            Some(Ok((stages, result))) => {
                self.pool
                    .discard(Some(std::mem::replace(&mut self.stages, stages)));
                self.accept(result);
            }
            Some(Err(Crashed(fault))) => {
                self.say(
                    true,
                    format!("The analysis broke off by a fault of the program: {fault}"),
                );
                self.state.was_cancelled = true;
            }
        }
    }

    pub(in crate::app) fn accept(&mut self, result: Result<AnalyzedFruit, AnalyzeError>) {
        self.shown_generation += 1;
        let current = self.state.current;
        let mut set_problem = |problem: Option<String>| {
            if let Some(entry) = current.and_then(|i| self.state.entries.get_mut(i)) {
                entry.problem = problem;
            }
        };
        match result {
            Ok(walked) => {
                set_problem(None);
                self.set_subject(&walked.fruit, &walked.shown);
                let walked = self.with_annotations(walked);
                let request = &self.state.settings.request;
                let (references, warnings) = collect_references(&walked.fruit, request, &walked.analysis);
                let before = self.state.walked.as_ref();
                if before.is_none_or(|b| !Arc::ptr_eq(&b.shown, &walked.shown)) {
                    self.state.picked = None;
                    self.state.pointed_at = None;
                    self.state.brush_cm = None;
                }
                let same_planes =
                    before.is_some_and(|b| Arc::ptr_eq(&b.analysis.planes, &walked.analysis.planes));
                if !same_planes {
                    self.details.clear();
                    self.keep_direction(&walked);
                    self.state.previewed = None;
                }
                (self.state.references, self.state.warnings) = (references, warnings);
                self.pool.discard(self.state.walked.replace(Arc::new(walked)));
                self.pool.discard(self.state.unanalyzed.take());
                self.state.is_stale = false;
                self.take_current_row();
            }
            Err(AnalyzeError::Analysis { fruit, shown, error }) => {
                set_problem(Some(sentence(&error.to_string())));
                self.state.warnings.clone_from(&fruit.warnings);
                self.forget_analysis();
                self.set_subject(&fruit, &shown);
                let why = sentence(&format!("{}: {error}", self.name_of_current()));
                self.state.unanalyzed = Some((shown, Some(why)));
            }
            Err(AnalyzeError::Fruit(error)) => {
                set_problem(Some(sentence(&error.reason())));
                self.forget_analysis();
                self.leave_subject();
                self.say(true, sentence_of_file(&error.to_string()));
            }
            Err(AnalyzeError::Cancelled) => self.state.was_cancelled = true,
        }
        self.frame_if_new();
    }

    pub(in crate::app) fn forget_analysis(&mut self) {
        self.details.clear();
        self.pool.discard(self.state.walked.take());
        self.pool.discard(self.state.unanalyzed.take());
        self.state.references.clear();
        self.state.is_stale = false;
        self.state.previewed = None;
        self.state.picked = None;
        self.state.brush_cm = None;
    }

    pub(in crate::app) fn name_of_current(&self) -> String {
        self.state.source().map(Source::name).unwrap_or_default()
    }

    pub(in crate::app) fn ask_for_look(&mut self) {
        if let Some(result) = self.looks.take() {
            self.accept_look(result);
        }
        let Some(shown) = self.state.shown().cloned() else {
            self.pool.discard(self.state.look.take());
            self.seen = None;
            return;
        };
        let is_blind = self.state.true_axes.is_blind;
        let wanted = Seen {
            shown_generation: self.shown_generation,
            plane: self.state.plane_index().filter(|_| !is_blind),
            style: self.state.shown_style(),
            pixels_per_point: self.state.pixels_per_point,
            brush_cm: self.state.brush_cm.clone(),
            reference: self.state.reference().cloned().filter(|_| !is_blind),
        };
        if self.seen.as_ref() != Some(&wanted) {
            let request = LookRequest {
                shown,
                analysis: self.state.analysis().cloned(),
                plane: wanted.plane,
                reference: wanted.reference.clone(),
                references: self.state.references.clone(),
                style: wanted.style.clone(),
                pixels_per_point: wanted.pixels_per_point,
                brush_cm: wanted.brush_cm.clone(),
                fruit: self.state.walked.as_ref().map(|walked| walked.fruit.clone()),
                detail: wanted.plane.and_then(|index| self.details.get(index)),
            };
            let before = self.state.look.clone();
            self.looks
                .submit(move |watch| look(request, before.as_deref(), watch));
            self.seen = Some(wanted);
            self.state.is_look_pending = true;
            if let Some(result) = self.looks.take_within(PATIENCE) {
                self.accept_look(result);
            }
        }
    }

    pub(in crate::app) fn accept_look(&mut self, result: Result<Result<Look, Cancelled>, Crashed>) {
        match result {
            Ok(Ok(look)) => {
                let planes_of = |analysis: &Arc<crate::method::Analysis>| analysis.planes.clone();
                let (of_look, newest) = (look.analysis.as_ref(), self.state.analysis());
                let is_newest = of_look
                    .map(planes_of)
                    .zip(newest.map(planes_of))
                    .is_some_and(|(a, b)| Arc::ptr_eq(&a, &b));
                if let (Some(index), Some(detail), true) = (look.plane_index, &look.detail, is_newest) {
                    self.details.keep(index, detail.clone());
                }
                self.pool.discard(self.state.look.replace(Arc::new(look)));
            }
            Ok(Err(Cancelled)) => return,
            Err(crash) => self.say(true, sentence(&format!("the view broke off by {crash}"))),
        }
        self.state.is_look_pending = false;
    }

    pub(in crate::app) fn ask_for_pick(&mut self) {
        if let Some(question) = self.pending_click.take() {
            self.pick(question);
        }
        if let Some(Ok((question, found))) = self.picks.take_within(PATIENCE) {
            self.state.pointed_at = found;
            if question.is_click {
                self.state.picked = found;
            }
        }
    }

    pub(in crate::app) fn pick(&mut self, question: PickQuestion) {
        let Some(shown) = self.state.look.as_ref().map(|look| look.shown.clone()) else {
            return;
        };
        let (camera, viewport) = (self.state.camera, self.state.viewport);
        let radius_px = self.state.look.as_ref().map_or(1.0, |look| {
            let size = look.scene.points.first().map_or(2.0, |p| p.size_px);
            f64::from(0.5 * size / self.state.pixels_per_point)
        });
        self.picks.submit(move |_| {
            let found = pick_point(&shown, &camera, viewport, question.pixel, radius_px, 6.0);
            (question, found)
        });
    }

    /// The first cloud is framed; another one is seen from where the last one was, relative to it.
    pub(in crate::app) fn frame_new_cloud(&mut self) {
        let Some(shown) = self.state.shown() else {
            return;
        };
        let extent = shown.extent;
        self.state.camera = match self.framed {
            Some(last) => {
                let ratio = extent.size().length() / last.size().length();
                let moved = extent.center() - last.center();
                self.state.camera.eye_in_world += moved;
                self.state.camera.pivot_in_world += moved;
                if (0.5..2.0).contains(&ratio) {
                    self.state.camera
                } else {
                    framed_camera(&self.state)
                }
            }
            None => default_camera(&self.state),
        };
        self.framed = Some(extent);
    }
}
