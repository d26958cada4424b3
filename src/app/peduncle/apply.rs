//! What commands about the peduncle do.

use std::sync::Arc;

use super::edits::Edit;
use super::{PeduncleCommand, Question, Stroke};
use crate::app::App;
use crate::app::state::Command;
use crate::fruit::{PeduncleChoice, PickedPoints};
use crate::geometry::PointSet;

/// The brush's radii in logical pixels.
const RADII_PX: std::ops::RangeInclusive<f64> = 2.0..=250.0;
/// How far a selection grows at a time, in spacings of the points.
const REACHES: std::ops::RangeInclusive<f64> = 0.5..=20.0;

/// Places of a path that are nearer to each other than this are one, in logical pixels.
const STEP_PX: f64 = 1.0;

impl App {
    /// Does what is asked for about the peduncle.
    pub(in crate::app) fn apply_peduncle(&mut self, command: PeduncleCommand) {
        let picking = &mut self.state.peduncle;
        match command {
            PeduncleCommand::Draw { at_px, removes } => self.draw(at_px, removes),
            PeduncleCommand::EndStroke => {
                if let Some(stroke) = picking.strokes.back_mut() {
                    stroke.is_ended = true;
                }
            }
            PeduncleCommand::DropStroke => picking.strokes.retain(|stroke| stroke.is_ended),
            PeduncleCommand::Grow => self.grow_picked(true),
            PeduncleCommand::Shrink => self.grow_picked(false),
            PeduncleCommand::Clear => self.pick_peduncle(Arc::default()),
            PeduncleCommand::Invert => self.invert(),
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
                self.choose_peduncle(choice);
            }
            PeduncleCommand::Offer(path) => {
                if self.state.source().is_some() {
                    self.state.peduncle.question = Some(Question::Offer(path));
                } else {
                    self.apply(Command::Open(vec![path]));
                }
            }
            PeduncleCommand::Save => self.save_companion(None),
            PeduncleCommand::SaveAs(path) => {
                picking.question = None;
                self.save_companion(Some(path));
            }
            PeduncleCommand::Dismiss => picking.question = None,
            PeduncleCommand::Compare(wants) => {
                picking.wants_beside = wants;
                if !wants {
                    picking.beside = None;
                    self.peduncle.asked_beside = None;
                    self.peduncle.besides.cancel();
                }
            }
        }
    }

    /// What is to be done once a frame, after the look.
    pub(in crate::app) fn update_peduncle(&mut self) {
        self.update_edits();
        self.update_companions();
        self.update_hues();
        self.update_beside();
        self.update_marks();
        self.state.peduncle.beside_progress = self.peduncle.besides.progress();
        self.state.peduncle.is_working = self.peduncle.edits.is_busy()
            || !self.peduncle.waiting_edits.is_empty()
            || self.peduncle.companions.is_busy();
    }

    /// Another cloud is shown: what belongs to the one before is over.
    pub(in crate::app) fn leave_peduncle(&mut self) {
        self.state.peduncle.strokes.clear();
        self.state.peduncle.question = None;
        self.state.peduncle.marked = None;
        self.peduncle.waiting_edits.clear();
    }

    fn draw(&mut self, at_px: glam::DVec2, removes: bool) {
        if !self.state.is_picking() || !at_px.is_finite() || self.state.current_walked().is_none() {
            return;
        }
        let (camera, viewport, tool) = (self.state.camera, self.state.viewport, self.state.tool);
        let strokes = &mut self.state.peduncle.strokes;
        if strokes.back().is_none_or(|stroke| stroke.is_ended) {
            self.peduncle.next_stroke += 1;
            strokes.push_back(Stroke {
                tool,
                removes,
                path_px: Vec::new(),
                is_ended: false,
                camera,
                viewport,
                id: self.peduncle.next_stroke,
            });
        }
        if let Some(stroke) = strokes.back_mut() {
            let is_far = |last: &glam::DVec2| last.distance(at_px) >= STEP_PX;
            if stroke.path_px.last().is_none_or(is_far) {
                stroke.path_px.push(at_px);
            }
        }
    }

    fn grow_picked(&mut self, grows: bool) {
        let reach_spacings = self.state.peduncle.reach_spacings;
        self.peduncle.waiting_edits.push_back(Edit {
            grows,
            reach_spacings,
        });
    }

    fn invert(&mut self) {
        let (Some(walked), Some(points)) = (self.state.current_walked(), self.state.peduncle_points()) else {
            return;
        };
        let mut mask = points.mask(walked.fruit.cloud().len());
        for is_in in &mut mask {
            *is_in = !*is_in;
        }
        self.pick_peduncle(Arc::new(PointSet::of_mask(&mask)));
    }

    /// These points of the current cloud are its peduncle from now on: one step of undo.
    pub(super) fn pick_peduncle(&mut self, points: Arc<PointSet>) {
        let (Some(walked), Some(before)) = (self.state.current_walked(), self.state.peduncle_points()) else {
            return;
        };
        if before == points {
            return;
        }
        let picked = match &self.state.settings.request.peduncle {
            PeduncleChoice::Points(picked) => picked.clone(),
            _ => PickedPoints::default(),
        };
        let picked = picked.with(&walked.fruit.file.sha256, points);
        self.choose_peduncle(PeduncleChoice::Points(picked));
    }

    fn choose_peduncle(&mut self, choice: PeduncleChoice) {
        let mut request = self.state.settings.request.clone();
        request.peduncle = choice;
        self.apply(Command::Set {
            request: Box::new(request),
            gesture: None,
        });
    }
}
