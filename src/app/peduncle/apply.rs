//! The commands about the peduncle.

use std::sync::Arc;

use glam::DVec2;

use super::PeduncleTools;
use super::commands::PeduncleCommand;
use super::edits::Edit;
use super::state::{PeduncleState, Question, Stroke};
use crate::app::command::Command;
use crate::app::context::Context;
use crate::app::state::State;
use crate::fruit::{PeduncleChoice, PickedPoints};
use crate::geometry::PointSet;

/// The brush's radii in logical pixels.
const RADII_PX: std::ops::RangeInclusive<f64> = 2.0..=250.0;
/// The reaches of growing, in spacings of the points.
const REACHES: std::ops::RangeInclusive<f64> = 0.5..=20.0;

/// Places of a path that are nearer to each other than this are one, in logical pixels.
const STEP_PX: f64 = 1.0;

impl PeduncleTools {
    /// Does what is asked about the peduncle.
    pub(in crate::app) fn apply(&mut self, command: PeduncleCommand, cx: &mut Context) {
        let picking = &mut cx.state.peduncle;
        match command {
            PeduncleCommand::Draw { at_px, removes } => self.draw(at_px, removes, &mut cx.state),
            PeduncleCommand::EndStroke => {
                if let Some(stroke) = picking.strokes.back_mut() {
                    stroke.is_ended = true;
                }
            }
            PeduncleCommand::DropStroke => picking.strokes.retain(|stroke| stroke.is_ended),
            PeduncleCommand::Grow => self.grow_picked(true, &cx.state),
            PeduncleCommand::Shrink => self.grow_picked(false, &cx.state),
            PeduncleCommand::Clear => pick_peduncle(cx, Arc::default()),
            PeduncleCommand::Invert => invert(cx),
            PeduncleCommand::BrushRadius(radius) if radius.is_finite() => {
                picking.brush_radius_px = radius.clamp(*RADII_PX.start(), *RADII_PX.end());
            }
            PeduncleCommand::Reach(reach) if reach.is_finite() => {
                picking.reach_spacings = reach.clamp(*REACHES.start(), *REACHES.end());
            }
            PeduncleCommand::BrushRadius(_) | PeduncleCommand::Reach(_) | PeduncleCommand::Ask(_) => {}
            PeduncleCommand::Through(is_through) => picking.is_through = is_through,
            PeduncleCommand::Preview(is_previewed) => picking.is_previewed = is_previewed,
            PeduncleCommand::Choose(choice) => {
                picking.question = None;
                choose_peduncle(cx, choice);
            }
            PeduncleCommand::Offer(path) => {
                if cx.state.source().is_some() {
                    cx.state.peduncle.question = Some(Question::Offer(path));
                } else {
                    cx.ask(Command::Open(vec![path]));
                }
            }
            PeduncleCommand::Save => self.save_companion(None, cx),
            PeduncleCommand::SaveAs(path) => {
                picking.question = None;
                self.save_companion(Some(path), cx);
            }
            PeduncleCommand::Dismiss => picking.question = None,
            PeduncleCommand::Compare(wants) => {
                picking.wants_beside = wants;
                if !wants {
                    picking.beside = None;
                    self.asked_beside = None;
                    self.besides.cancel();
                }
            }
        }
    }

    /// Drops what belongs to a cloud that is no longer shown.
    pub(in crate::app) fn leave_cloud(&mut self, state: &mut PeduncleState) {
        state.strokes.clear();
        state.question = None;
        state.marked = None;
        self.waiting_edits.clear();
    }

    /// Begins a stroke, or goes on with it.
    fn draw(&mut self, at_px: DVec2, removes: bool, state: &mut State) {
        if !state.is_picking() || !at_px.is_finite() || state.current_walked().is_none() {
            return;
        }
        let (camera, viewport, tool) = (state.camera, state.viewport, state.tool);
        let strokes = &mut state.peduncle.strokes;
        if strokes.back().is_none_or(|stroke| stroke.is_ended) {
            self.strokes += 1;
            strokes.push_back(Stroke {
                tool,
                removes,
                path_px: Vec::new(),
                is_ended: false,
                camera,
                viewport,
                id: self.strokes,
            });
        }
        if let Some(stroke) = strokes.back_mut() {
            let is_far = |last: &DVec2| last.distance(at_px) >= STEP_PX;
            if stroke.path_px.last().is_none_or(is_far) {
                stroke.path_px.push(at_px);
            }
        }
    }

    fn grow_picked(&mut self, grows: bool, state: &State) {
        let reach_spacings = state.peduncle.reach_spacings;
        self.waiting_edits.push_back(Edit {
            grows,
            reach_spacings,
        });
    }
}

fn invert(cx: &mut Context) {
    let (Some(walked), Some(points)) = (cx.state.current_walked(), cx.state.peduncle_points()) else {
        return;
    };
    let mut mask = points.mask(walked.fruit.cloud().len());
    for is_in in &mut mask {
        *is_in = !*is_in;
    }
    pick_peduncle(cx, Arc::new(PointSet::of_mask(&mask)));
}

/// These points of the current cloud are its peduncle from now on: one step of undo.
pub(super) fn pick_peduncle(cx: &mut Context, points: Arc<PointSet>) {
    let (Some(walked), Some(before)) = (cx.state.current_walked(), cx.state.peduncle_points()) else {
        return;
    };
    if before == points {
        return;
    }
    let picked = match &cx.state.settings.request.peduncle {
        PeduncleChoice::Points(picked) => picked.clone(),
        _ => PickedPoints::default(),
    };
    let picked = picked.with(&walked.fruit.file.sha256, points);
    choose_peduncle(cx, PeduncleChoice::Points(picked));
}

fn choose_peduncle(cx: &mut Context, choice: PeduncleChoice) {
    let mut request = cx.state.settings.request.clone();
    request.peduncle = choice;
    cx.set_request(request, None);
}
