//! The commands about axes set by hand.

use glam::DVec3;

use super::TrueAxes;
use super::commands::{Decision, TrueAxesCommand, Turn};
use super::handles::Handle;
use super::state::{Draft, Grab, Saving};
use super::stores::Change;
use crate::annotate::{Annotation, Ends, Judgment, Method, Role, mean_axis};
use crate::app::command::Command;
use crate::app::context::Context;
use crate::app::tool::Tool;
use crate::evaluate::start_axis;
use crate::render::Projection;
use crate::text::sentence;

impl TrueAxes {
    /// Does what is asked about axes set by hand.
    pub(in crate::app) fn apply(&mut self, command: TrueAxesCommand, cx: &mut Context) {
        let axes = &mut cx.state.true_axes;
        match command {
            TrueAxesCommand::Edit(on) => edit_mode(cx, on),
            TrueAxesCommand::Name(name) => {
                name.trim().clone_into(&mut axes.name);
                if axes.asks_name && axes.author().is_ok() {
                    axes.asks_name = false;
                    axes.is_editing = true;
                } else if axes.author().is_err() {
                    axes.is_editing = false;
                }
            }
            TrueAxesCommand::WithoutName => axes.asks_name = false,
            TrueAxesCommand::Role(role) => axes.role = role,
            TrueAxesCommand::Blind(on) => blind(cx, on),
            TrueAxesCommand::ResultsShown => self.note_results(cx),
            TrueAxesCommand::ShowAll(on) => axes.shows_all = on && !axes.is_blind,

            TrueAxesCommand::Hover(landing) => axes.landing = landing,
            TrueAxesCommand::Place(place) => self.place(cx, place),
            TrueAxesCommand::Anew => {
                if axes.can_edit() {
                    axes.drop_draft();
                    axes.draft = Draft::Anew;
                }
            }
            TrueAxesCommand::Escape => escape(cx),
            TrueAxesCommand::Grab { handle, view, at_px } => {
                if let Some(ends) = axes.ends().filter(|_| axes.can_edit()) {
                    axes.grabbed = Some(Grab {
                        handle,
                        view,
                        place: handle.place(&ends),
                        at_px,
                    });
                }
            }
            TrueAxesCommand::Drag(place) => drag(cx, place),
            TrueAxesCommand::Drop => {
                axes.grabbed = None;
                if let Some(ends) = axes.moving.take() {
                    self.set_ends(cx, ends);
                }
            }
            TrueAxesCommand::Preview(ends) => {
                axes.moving = Some(ends).filter(|_| axes.can_edit());
            }
            TrueAxesCommand::SetEnds(ends) => {
                axes.moving = None;
                self.set_ends(cx, ends);
            }
            TrueAxesCommand::Nudge(turn, degrees) => self.nudge(cx, turn, degrees),
            TrueAxesCommand::Step(step) => axes.step = step,
            TrueAxesCommand::Hold(pivot) => axes.pivot = pivot,
            TrueAxesCommand::Flip => {
                if let Some(ends) = axes.set_ends() {
                    self.set_ends(cx, ends.flipped());
                }
            }
            TrueAxesCommand::Start(method) => self.start(cx, method),
            TrueAxesCommand::Ghost(ghost) => axes.ghost = ghost,
            TrueAxesCommand::Confidence(confidence) => {
                self.change(cx, |judgment| judgment.confidence = confidence);
            }
            TrueAxesCommand::Note(note) => self.change(cx, |judgment| judgment.note = note),
            TrueAxesCommand::CannotTell => {
                let judgment = with_remarks(cx, Judgment::cannot_tell());
                self.edit(cx, judgment);
            }
            TrueAxesCommand::Undo => self.undo_or_redo(cx, Change::Undo),
            TrueAxesCommand::Redo => self.undo_or_redo(cx, Change::Redo),
            TrueAxesCommand::TryAgain => self.try_again(cx),

            TrueAxesCommand::NextWithout => next_without(cx),
            TrueAxesCommand::CompareSet => self.compare_set(cx),
            TrueAxesCommand::CancelSet => self.cancel_set(cx),
            TrueAxesCommand::Decide(decision) => self.decide(cx, &decision),
        }
    }

    fn place(&mut self, cx: &mut Context, place: DVec3) {
        let axes = &mut cx.state.true_axes;
        match (axes.next_end(), axes.draft) {
            (Some(Handle::BlossomEnd), Draft::Base(base)) => match Ends::new(base, place) {
                Ok(ends) => {
                    axes.draft = Draft::None;
                    axes.landing = None;
                    let judgment = with_remarks(cx, Judgment::by_hand(ends));
                    self.edit(cx, judgment);
                }
                Err(error) => cx.say(false, sentence(&error.to_string())),
            },
            (Some(_), _) => axes.draft = Draft::Base(place),
            (None, _) => {}
        }
    }

    fn nudge(&mut self, cx: &mut Context, turn: Turn, degrees: f64) {
        let Some(ends) = cx.state.true_axes.set_ends() else {
            return;
        };
        let camera = &cx.state.camera;
        let view_ray = match camera.projection {
            Projection::Perspective => ends.middle() - camera.eye_in_world,
            Projection::Orthographic => camera.forward_in_world(),
        };
        let [lean, picture] = ends.across(view_ray);
        let about = match turn {
            Turn::Lean => lean,
            Turn::Picture => picture,
        };
        match ends.turned(about, degrees, cx.state.true_axes.pivot) {
            Ok(turned) => self.set_ends(cx, turned),
            Err(error) => cx.say(false, sentence(&error.to_string())),
        }
    }

    fn start(&mut self, cx: &mut Context, method: Method) {
        if cx.state.true_axes.is_blind || !cx.state.true_axes.can_edit() || cx.state.is_stale {
            return;
        }
        let Some(walked) = cx.state.walked.clone() else {
            cx.say(
                false,
                "There is nothing to start from yet: the cloud is not analyzed.",
            );
            return;
        };
        match start_axis(&walked.fruit, &walked.analysis, &cx.state.references, method) {
            Ok(ends) => {
                cx.state.true_axes.draft = Draft::None;
                let judgment = with_remarks(cx, Judgment::by_hand(ends));
                self.edit(cx, Judgment { method, ..judgment });
            }
            Err(error) => cx.say(false, sentence(&error.to_string())),
        }
    }

    /// Sets another axis, with the method and the remarks of the last one.
    fn set_ends(&mut self, cx: &mut Context, ends: Ends) {
        let before = cx.state.true_axes.judgment().cloned();
        let before = before.unwrap_or_else(|| Judgment::by_hand(ends));
        self.edit(
            cx,
            Judgment {
                ends: Some(ends),
                ..before
            },
        );
    }

    fn change(&mut self, cx: &mut Context, change: impl FnOnce(&mut Judgment)) {
        if let Some(mut judgment) = cx.state.true_axes.judgment().cloned() {
            change(&mut judgment);
            self.edit(cx, judgment);
        }
    }

    fn edit(&mut self, cx: &mut Context, mut judgment: Judgment) {
        let axes = &cx.state.true_axes;
        if !axes.can_edit() {
            return;
        }
        judgment.blind = axes.is_blind && !axes.was_seen && judgment.method == Method::ByHand;
        let same = |before: &Judgment| {
            Judgment {
                blind: judgment.blind,
                ..before.clone()
            } == judgment
        };
        if axes.judgment().is_some_and(same) {
            return;
        }
        self.act_on_axis(cx, Change::Edit(Box::new(judgment)));
    }

    fn undo_or_redo(&mut self, cx: &mut Context, change: Change) {
        let axes = &mut cx.state.true_axes;
        axes.drop_draft();
        let steps = match change {
            Change::Undo => axes.history.undo_steps(),
            _ => axes.history.redo_steps(),
        };
        if axes.can_edit() && steps > 0 {
            self.act_on_axis(cx, change);
        }
    }

    /// Turns to the adjudicated axis and sets it.
    fn decide(&mut self, cx: &mut Context, decision: &Decision) {
        let of_annotators = |a: &&Annotation| a.role == Role::Annotator;
        let annotations = &cx.state.true_axes.annotations;
        let theirs: Vec<&Annotation> = annotations.iter().filter(of_annotators).collect();
        let judgment = match decision {
            Decision::ByHand => None,
            Decision::Of(name) => {
                let Some(found) = theirs.iter().find(|a| a.annotator == *name) else {
                    return;
                };
                let mut judgment = found.judgment.clone();
                judgment.note = format!("{name}'s axis");
                Some(judgment)
            }
            Decision::Mean => {
                let Some(mean) = mean_of(&theirs) else {
                    cx.say(
                        false,
                        "The annotators' axes have no mean: they contradict one another.",
                    );
                    return;
                };
                Some(mean)
            }
        };
        let axes = &mut cx.state.true_axes;
        if axes.is_blind {
            return;
        }
        axes.role = Role::Adjudicator;
        edit_mode(cx, true);
        if !cx.state.true_axes.is_editing {
            return;
        }
        self.update(cx);
        let Some(judgment) = judgment else { return };
        // The files may still be opening: edits wait behind that.
        if cx.state.true_axes.saving == Saving::Opening {
            cx.state.true_axes.saving = Saving::Saving;
        }
        self.edit(cx, judgment);
    }
}

fn edit_mode(cx: &mut Context, on: bool) {
    let is_in_no_folder = cx.state.source().is_some_and(|source| !source.is_file());
    let axes = &mut cx.state.true_axes;
    axes.drop_draft();
    axes.landing = None;
    if !on {
        axes.is_editing = false;
        axes.role = Role::Annotator;
    } else if is_in_no_folder {
        cx.say(
            false,
            "This cloud lies in no folder in which its axis could be kept: open one from a file.",
        );
    } else if axes.author().is_err() {
        axes.asks_name = true;
    } else {
        axes.is_editing = true;
        cx.state.tool = Tool::Navigate;
        cx.state.pointed_at = None;
        cx.state.is_playing = false;
    }
}

fn blind(cx: &mut Context, on: bool) {
    cx.state.true_axes.is_blind = on;
    if on {
        cx.state.true_axes.shows_all = false;
        cx.state.is_playing = false;
        cx.state.previewed = None;
        cx.state.tool = Tool::Navigate;
    }
}

fn escape(cx: &mut Context) {
    let axes = &mut cx.state.true_axes;
    if axes.grabbed.is_some() || axes.moving.is_some() {
        axes.let_go();
    } else if axes.draft != Draft::None {
        axes.draft = Draft::None;
    } else {
        edit_mode(cx, false);
    }
}

fn drag(cx: &mut Context, place: DVec3) {
    let axes = &mut cx.state.true_axes;
    let (Some(grab), Some(ends)) = (axes.grabbed, axes.set_ends()) else {
        return;
    };
    let moved = match grab.handle {
        Handle::PeduncleBase => ends.with_peduncle_base(place),
        Handle::BlossomEnd => ends.with_blossom_end(place),
        Handle::Middle => ends.shifted(place - grab.place),
    };
    // Where the ends meet, the axis stays as it was.
    axes.moving = moved.ok().or(axes.moving);
}

/// A judgment with the confidence and the note of the one before, which stay when the axis changes.
fn with_remarks(cx: &Context, judgment: Judgment) -> Judgment {
    match cx.state.true_axes.judgment() {
        Some(before) => Judgment {
            confidence: before.confidence,
            note: before.note.clone(),
            ..judgment
        },
        None => judgment,
    }
}

fn next_without(cx: &mut Context) {
    let (mine, Some(current)) = (cx.state.true_axes.mine.clone(), cx.state.current) else {
        return;
    };
    let count = mine.len();
    let next = (1..count)
        .map(|by| (current + by) % count)
        .find(|&place| !mine[place]);
    match next {
        Some(place) => cx.ask(Command::Show(place)),
        None => cx.say(false, "Every other open cloud has an axis of yours."),
    }
}

/// The mean axis, as long as the axes are on average, begun where the least independent of them was.
fn mean_of(annotations: &[&Annotation]) -> Option<Judgment> {
    let axes: Vec<(&Ends, Method)> = annotations
        .iter()
        .filter_map(|a| Some((a.ends()?, a.judgment.method)))
        .collect();
    let mean = mean_axis(axes.iter().map(|(ends, _)| *ends))?;
    let half = 0.5 * axes.iter().map(|(ends, _)| ends.length()).sum::<f64>() / axes.len() as f64;
    let ends = Ends::new(
        mean.origin + half * mean.direction,
        mean.origin - half * mean.direction,
    )
    .ok()?;
    let any = |method| axes.iter().any(|&(_, of)| of == method).then_some(method);
    let method = any(Method::FromComputed)
        .or(any(Method::FromPeduncle))
        .or(any(Method::Imported))
        .unwrap_or(Method::ByHand);
    Some(Judgment {
        method,
        note: format!("mean of {} annotators", axes.len()),
        ..Judgment::by_hand(ends)
    })
}
