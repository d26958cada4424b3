//! The inspector's work in each frame: it takes results, and submits the jobs that are wanted now.

use std::sync::Arc;
use std::time::Duration;

use super::apply::{choice_of, step};
use super::look::{Look, LookRequest, ShownBody, look};
use super::navigate::{default_camera, framed_camera};
use super::stages::{AnalyzeError, AnalyzedFruit, FruitStages};
use super::{Inspector, Pick};
use crate::app::context::Context;
use crate::app::source::Source;
use crate::app::state::{PlaneChoice, State};
use crate::app::workers::{Crashed, PATIENCE};
use crate::evaluate::collect_references;
use crate::fruit::Fruit;
use crate::method::AnalysisError;
use crate::parallel::Cancelled;
use crate::text::sentence;
use crate::view::pick_point;

/// Planes that are played through in a second.
const PLANES_PER_SECOND: f64 = 6.0;
/// The distance from a point, in logical pixels beyond its disc, at which it is still picked.
const PICK_MARGIN_PX: f64 = 6.0;

impl Inspector {
    /// Takes an analysis that has come, and asks for one of the current cloud and settings. `elapsed` is the time
    /// since the last frame.
    pub(in crate::app) fn update(&mut self, elapsed: Duration, cx: &mut Context) {
        self.play(elapsed, cx);
        self.take_arrivals(cx);
        if let Some(result) = self.analyses.take() {
            self.take_analysis(result, cx);
        }
        self.ask_for_analysis(cx);
        if let Some(result) = self.images.take() {
            cx.say_result(result);
        }
        cx.state.progress = self.analyses.progress();
    }

    /// Takes a view and a picked point that have come, and asks for those that are wanted now.
    pub(in crate::app) fn update_view(&mut self, cx: &mut Context) {
        self.ask_for_look(cx);
        if let Some(pick) = self.pending_click.take() {
            self.pick(pick, &cx.state);
        }
        if let Some(Ok((pick, found))) = self.picks.take_within(PATIENCE) {
            cx.state.pointed_at = found;
            if pick.is_click {
                cx.state.picked = found;
            }
        }
    }

    /// Sets the camera anew as soon as another cloud is there.
    pub(in crate::app) fn turn_to_cloud(&mut self) {
        self.needs_framing = true;
    }

    /// Frames the next cloud as the first one is: what was seen of the last has nothing to do with it.
    pub(in crate::app) fn forget_framing(&mut self) {
        self.framed = None;
    }

    /// No cloud is open any more.
    pub(in crate::app) fn close(&mut self, cx: &mut Context) {
        self.analyses.cancel();
        self.looks.cancel();
        self.asked = None;
        self.forget_analysis(cx);
        cx.state.warnings.clear();
    }

    fn play(&mut self, elapsed: Duration, cx: &mut Context) {
        if !cx.state.is_playing {
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
            step(cx, steps as isize);
        }
    }

    fn ask_for_analysis(&mut self, cx: &mut Context) {
        let wanted = cx.analysis_key();
        if wanted.is_none() || self.asked == wanted {
            return;
        }
        self.asked.clone_from(&wanted);
        let Some(wanted) = wanted else { return };
        cx.state.was_cancelled = false;
        if let Some(walked) = cx.stages.analyze_kept(&wanted.source, &wanted.request) {
            self.analyses.cancel();
            self.accept(Ok(walked), cx);
            return;
        }
        cx.state.is_stale = cx.state.walked.is_some();
        let mut stages = cx.stages.clone();
        let (arrivals, repaint) = (self.arrivals.0.clone(), cx.pool.repaint().clone());
        // What another request was to show comes too late.
        while self.arrivals.1.try_recv().is_ok() {}
        self.analyses.submit(move |watch| {
            let arrived = |fruit: &Arc<Fruit>, shown| {
                // Nobody listens any more where the window has closed.
                let _ = arrivals.send((wanted.source.clone(), fruit.clone(), shown));
                repaint();
            };
            let analyzed = stages.analyze(&wanted.source, &wanted.request, watch, &arrived);
            let result = analyzed.and_then(|analyzed| stages.with_true_center(analyzed, watch));
            (stages, result)
        });
        if let Some(result) = self.analyses.take_within(PATIENCE) {
            self.take_analysis(result, cx);
        }
    }

    /// Shows the points of a large cloud before they are analyzed.
    fn take_arrivals(&mut self, cx: &mut Context) {
        while let Ok((source, fruit, shown)) = self.arrivals.1.try_recv() {
            let is_current = cx.state.source() == Some(&source);
            if is_current && self.analyses.progress().is_some() {
                self.forget_analysis(cx);
                // Its axis can be set by hand meanwhile.
                cx.state.set_subject(&fruit, &shown);
                cx.state.unanalyzed = Some((shown, None));
                self.frame_if_new(&mut cx.state);
            }
        }
    }

    fn take_analysis(
        &mut self,
        result: Result<(FruitStages, Result<AnalyzedFruit, AnalyzeError>), Crashed>,
        cx: &mut Context,
    ) {
        match result {
            Ok((stages, result)) => {
                let before = std::mem::replace(&mut cx.stages, stages);
                cx.pool.discard(Some(before));
                // A cloud that was left meanwhile is not shown, nor its error said, in the place of the current one.
                if self.asked.as_ref().map(|key| &key.source) == cx.state.source() {
                    self.accept(result, cx);
                }
            }
            Err(Crashed(fault)) => {
                cx.say(
                    true,
                    format!("The analysis broke off by a fault of the program: {fault}"),
                );
                cx.state.was_cancelled = true;
            }
        }
    }

    fn accept(&mut self, result: Result<AnalyzedFruit, AnalyzeError>, cx: &mut Context) {
        match result {
            Ok(walked) => self.accept_walked(walked, cx),
            Err(AnalyzeError::Analysis { fruit, shown, error }) => {
                let is_inside = matches!(error, AnalysisError::ViewpointInsideCloud { .. });
                // The view says at length what is the matter with a whole scan.
                let problem = if is_inside {
                    "Whole scan".to_owned()
                } else {
                    sentence(&error.to_string())
                };
                set_problem(&mut cx.state, Some(problem));
                cx.state.warnings.clone_from(&fruit.warnings);
                self.forget_analysis(cx);
                cx.state.is_viewpoint_inside = is_inside;
                cx.state.set_subject(&fruit, &shown);
                let name = cx.state.source().map(Source::name).unwrap_or_default();
                cx.state.unanalyzed = Some((shown, Some(format!("{name}: {error}."))));
            }
            Err(AnalyzeError::Fruit(error)) => {
                set_problem(&mut cx.state, Some(sentence(&error.reason())));
                self.forget_analysis(cx);
                cx.state.true_axes.leave_subject();
                // It begins with a file's name, whose letters stay as they are.
                cx.say(true, format!("{error}."));
            }
            // The cloud before may still be shown, and keeps its view.
            Err(AnalyzeError::Cancelled) => {
                cx.state.was_cancelled = true;
                return;
            }
        }
        self.frame_if_new(&mut cx.state);
    }

    fn accept_walked(&mut self, walked: AnalyzedFruit, cx: &mut Context) {
        let state = &mut cx.state;
        set_problem(state, None);
        state.set_subject(&walked.fruit, &walked.shown);
        let walked = state.true_axes.with_annotations(walked);
        let (references, warnings) =
            collect_references(&walked.fruit, &state.settings.request, &walked.analysis);
        let before = state.walked.as_ref();
        if before.is_none_or(|b| !Arc::ptr_eq(&b.shown, &walked.shown)) {
            state.picked = None;
            state.pointed_at = None;
            state.brush_cm = None;
        }
        let same_planes = state
            .analysis()
            .is_some_and(|before| Arc::ptr_eq(&before.planes, &walked.analysis.planes));
        if !same_planes {
            self.details.clear();
            keep_direction(state, &walked);
            state.previewed = None;
        }
        (state.references, state.warnings) = (references, warnings);
        cx.pool.discard(state.walked.replace(Arc::new(walked)));
        cx.pool.discard(state.unanalyzed.take());
        state.is_viewpoint_inside = false;
        state.is_stale = false;
        state.take_current_row();
    }

    fn forget_analysis(&mut self, cx: &mut Context) {
        let state = &mut cx.state;
        self.details.clear();
        cx.pool.discard(state.walked.take());
        cx.pool.discard(state.unanalyzed.take());
        state.is_viewpoint_inside = false;
        state.references.clear();
        state.is_stale = false;
        state.previewed = None;
        state.picked = None;
        state.brush_cm = None;
    }

    fn ask_for_look(&mut self, cx: &mut Context) {
        if let Some(result) = self.looks.take() {
            self.accept_look(result, cx);
        }
        let Some(wanted) = wanted_look(&cx.state) else {
            cx.pool.discard(cx.state.look.take());
            self.asked_look = None;
            return;
        };
        if self
            .asked_look
            .as_ref()
            .is_some_and(|asked| is_same(asked, &wanted))
        {
            return;
        }
        cx.pool.discard(self.asked_look.replace(wanted.clone()));
        let request = LookRequest {
            detail: wanted.plane.and_then(|index| self.details.get(index)),
            ..wanted
        };
        let before = cx.state.look.clone();
        self.looks
            .submit(move |watch| look(request, before.as_deref(), watch));
        cx.state.is_look_pending = true;
        if let Some(result) = self.looks.take_within(PATIENCE) {
            self.accept_look(result, cx);
        }
    }

    fn accept_look(&mut self, result: Result<Result<Look, Cancelled>, Crashed>, cx: &mut Context) {
        match result {
            Ok(Ok(look)) => {
                let of_look = look.analysis.as_ref().zip(cx.state.analysis());
                let is_newest = of_look.is_some_and(|(a, b)| Arc::ptr_eq(&a.planes, &b.planes));
                if let (Some(index), Some(detail), true) = (look.plane_index, &look.detail, is_newest) {
                    self.details.keep(index, detail.clone());
                }
                cx.pool.discard(cx.state.look.replace(Arc::new(look)));
            }
            Ok(Err(Cancelled)) => return,
            Err(crash) => cx.say(true, sentence(&format!("the view broke off by {crash}"))),
        }
        cx.state.is_look_pending = false;
    }

    /// Asks for the point nearest to a place of the view.
    pub(super) fn pick(&self, pick: Pick, state: &State) {
        let Some(look) = state.look.clone() else {
            return;
        };
        let (camera, viewport) = (state.camera, state.viewport);
        let size_px = look.scene.points.first().map_or(2.0, |points| points.size_px);
        let radius_px = f64::from(0.5 * size_px / state.pixels_per_point);
        self.picks.submit(move |_| {
            let found = pick_point(
                &look.shown,
                &camera,
                viewport,
                pick.at_px,
                radius_px,
                PICK_MARGIN_PX,
            );
            (pick, found)
        });
    }

    fn frame_if_new(&mut self, state: &mut State) {
        let Some(shown) = state.shown().filter(|_| self.needs_framing) else {
            return;
        };
        let extent = shown.extent;
        self.needs_framing = false;
        // The first cloud is framed; another one is seen from where the last one was, relative to it.
        state.camera = match self.framed {
            Some(last) => {
                let ratio = extent.size().length() / last.size().length();
                let moved = extent.center() - last.center();
                state.camera.eye_in_world += moved;
                state.camera.pivot_in_world += moved;
                if (0.5..2.0).contains(&ratio) {
                    state.camera
                } else {
                    framed_camera(state)
                }
            }
            None => default_camera(state),
        };
        self.framed = Some(extent);
    }
}

fn set_problem(state: &mut State, problem: Option<String>) {
    if let Some(entry) = state.current.and_then(|i| state.entries.get_mut(i)) {
        entry.problem = problem;
    }
}

/// Keeps the direction of the plane in a new grid: chooses the plane whose normal is nearest to its own.
fn keep_direction(state: &mut State, walked: &AnalyzedFruit) {
    let (PlaneChoice::At { .. }, Some(before)) = (state.settings.plane, state.analysis()) else {
        return;
    };
    let (old, new) = (before.planes.grid, walked.analysis.planes.grid);
    if old == new {
        return;
    }
    let Some(normal) = state.chosen_plane_index().map(|i| old.candidate(i).normal) else {
        state.settings.plane = PlaneChoice::Best;
        return;
    };
    let along = |normal_there: glam::DVec3| normal_there.dot(normal).abs();
    let nearest = new
        .candidates()
        .max_by(|a, b| along(a.normal).total_cmp(&along(b.normal)));
    if let Some(nearest) = nearest {
        state.settings.plane = choice_of(&nearest);
    }
}

/// The view of the state as it is, but for the detail of its plane; `None` without a cloud.
fn wanted_look(state: &State) -> Option<LookRequest> {
    let is_blind = state.true_axes.is_blind;
    Some(LookRequest {
        shown: state.shown()?.clone(),
        analysis: state.analysis().cloned(),
        plane: state.plane_index().filter(|_| !is_blind),
        reference: state.reference().cloned().filter(|_| !is_blind),
        references: state.references.clone(),
        style: state.shown_style(),
        pixels_per_point: state.pixels_per_point,
        brush_cm: state.brush_cm.clone(),
        fruit: state.walked.as_ref().map(|walked| walked.fruit.clone()),
        detail: None,
        body: state.shown_body(),
    })
}

/// Whether two requests have the same answer. Clouds and analyses are compared by their addresses.
fn is_same(a: &LookRequest, b: &LookRequest) -> bool {
    fn are_one<T>(a: Option<&Arc<T>>, b: Option<&Arc<T>>) -> bool {
        a.map(Arc::as_ptr) == b.map(Arc::as_ptr)
    }
    Arc::ptr_eq(&a.shown, &b.shown)
        && are_one(a.analysis.as_ref(), b.analysis.as_ref())
        && are_one(a.fruit.as_ref(), b.fruit.as_ref())
        && (a.plane, &a.style, &a.brush_cm) == (b.plane, &b.style, &b.brush_cm)
        && (&a.reference, &a.references) == (&b.reference, &b.references)
        && a.pixels_per_point == b.pixels_per_point
        && is_same_body(a.body.as_ref(), b.body.as_ref())
}

fn is_same_body(a: Option<&ShownBody>, b: Option<&ShownBody>) -> bool {
    match (a, b) {
        (Some((a, parts)), Some((b, other))) => Arc::ptr_eq(a, b) && parts == other,
        (a, b) => a.is_none() && b.is_none(),
    }
}
