//! What commands about axes set by hand do to the state.

use glam::DVec3;

use super::desk::Deed;
use super::{Decision, Draft, Ghost, Grab, Handle, Saving, TrueAxesCommand, Turn};
use crate::annotate::{Annotation, Ends, EndsError, Finding, Judgment, Method, Role, mean_axis};
use crate::app::App;
use crate::evaluate::start_axis;
use crate::render::Projection;
use crate::text::sentence;

impl App {
    pub(in crate::app) fn annotate(&mut self, command: TrueAxesCommand) {
        let annotating = &mut self.state.true_axes;
        match command {
            TrueAxesCommand::Edit(on) => self.edit_mode(on),
            TrueAxesCommand::Name(name) => {
                name.trim().clone_into(&mut annotating.name);
                if annotating.asks_name && annotating.author().is_ok() {
                    annotating.asks_name = false;
                    annotating.is_editing = true;
                } else if annotating.author().is_err() {
                    annotating.is_editing = false;
                }
            }
            TrueAxesCommand::WithoutName => annotating.asks_name = false,
            TrueAxesCommand::Role(role) => annotating.role = role,
            TrueAxesCommand::Blind(on) => self.blind(on),
            TrueAxesCommand::ShowAll(on) => annotating.shows_all = on && !annotating.is_blind,

            TrueAxesCommand::Hover(landing) => annotating.landing = landing,
            TrueAxesCommand::Place(place) => self.place(place),
            TrueAxesCommand::Anew => {
                if annotating.can_edit() {
                    annotating.draft = Draft::Anew;
                    (annotating.grabbed, annotating.moving) = (None, None);
                }
            }
            TrueAxesCommand::Escape => self.escape(),
            TrueAxesCommand::Grab { handle, view, at_px } => {
                if let Some(ends) = annotating.ends().filter(|_| annotating.can_edit()) {
                    annotating.grabbed = Some(Grab {
                        handle,
                        view,
                        place: handle.place(&ends),
                        at_px,
                    });
                }
            }
            TrueAxesCommand::Drag(place) => self.drag(place),
            TrueAxesCommand::Drop => {
                annotating.grabbed = None;
                if let Some(ends) = annotating.moving.take() {
                    self.set_ends(ends);
                }
            }
            TrueAxesCommand::Preview(ends) => {
                annotating.moving = Some(ends).filter(|_| annotating.can_edit());
            }
            TrueAxesCommand::SetEnds(ends) => {
                annotating.moving = None;
                self.set_ends(ends);
            }
            TrueAxesCommand::Nudge(turn, degrees) => self.nudge(turn, degrees),
            TrueAxesCommand::Step(step) => annotating.step = step,
            TrueAxesCommand::Hold(pivot) => annotating.pivot = pivot,
            TrueAxesCommand::Flip => {
                if let Some(ends) = annotating.set_ends() {
                    self.set_ends(ends.flipped());
                }
            }
            TrueAxesCommand::Start(method) => self.start(method),
            TrueAxesCommand::Ghost(ghost) => annotating.ghost = ghost,
            TrueAxesCommand::Confidence(confidence) => {
                self.change(|judgment| judgment.confidence = confidence);
            }
            TrueAxesCommand::Note(note) => self.change(|judgment| judgment.note = note),
            TrueAxesCommand::CannotTell => {
                let (confidence, note) = self.carried();
                self.edit(Judgment {
                    confidence,
                    note,
                    ..Judgment::cannot_tell()
                });
            }
            TrueAxesCommand::Undo => self.undo_or_redo(Deed::Undo),
            TrueAxesCommand::Redo => self.undo_or_redo(Deed::Redo),
            TrueAxesCommand::TryAgain => self.try_again(),

            TrueAxesCommand::NextWithout => self.next_without(),
            TrueAxesCommand::CompareSet => self.compare_set(),
            TrueAxesCommand::CancelSet => self.cancel_set(),
            TrueAxesCommand::Decide(decision) => self.decide(&decision),
            TrueAxesCommand::CompareWith(source) => annotating.compared = Some(source),
        }
    }

    fn edit_mode(&mut self, on: bool) {
        let is_sample = matches!(self.state.source(), Some(crate::app::Source::Bundled(_)));
        let annotating = &mut self.state.true_axes;
        (annotating.draft, annotating.landing) = (Draft::None, None);
        (annotating.grabbed, annotating.moving) = (None, None);
        if !on {
            annotating.is_editing = false;
            annotating.role = Role::Annotator;
        } else if is_sample {
            self.say(
                false,
                "A sample lies in no folder in which its axis could be kept: open a cloud from a file."
                    .into(),
            );
        } else if annotating.author().is_err() {
            annotating.asks_name = true;
        } else {
            annotating.is_editing = true;
            self.state.tool = crate::app::Tool::Navigate;
            self.state.pointed_at = None;
            self.state.is_playing = false;
        }
    }

    fn blind(&mut self, on: bool) {
        self.state.true_axes.is_blind = on;
        if on {
            self.state.true_axes.shows_all = false;
            self.state.true_axes.compared = None;
            self.state.is_playing = false;
            self.state.previewed = None;
            self.state.tool = crate::app::Tool::Navigate;
        }
    }

    fn place(&mut self, place: DVec3) {
        let annotating = &mut self.state.true_axes;
        match (annotating.next_end(), annotating.draft) {
            (Some(Handle::BlossomEnd), Draft::Base(base)) => match Ends::new(base, place) {
                Ok(ends) => {
                    annotating.draft = Draft::None;
                    annotating.landing = None;
                    let (confidence, note) = self.carried();
                    self.edit(Judgment {
                        confidence,
                        note,
                        ..Judgment::by_hand(ends)
                    });
                }
                Err(error) => self.refuse(error),
            },
            (Some(_), _) => annotating.draft = Draft::Base(place),
            (None, _) => {}
        }
    }

    fn escape(&mut self) {
        let annotating = &mut self.state.true_axes;
        if annotating.grabbed.is_some() || annotating.moving.is_some() {
            (annotating.grabbed, annotating.moving) = (None, None);
        } else if annotating.draft != Draft::None {
            annotating.draft = Draft::None;
        } else {
            self.edit_mode(false);
        }
    }

    fn drag(&mut self, place: DVec3) {
        let annotating = &mut self.state.true_axes;
        let (Some(grab), Some(ends)) = (annotating.grabbed, annotating.set_ends()) else {
            return;
        };
        let moved = match grab.handle {
            Handle::PeduncleBase => ends.with_peduncle_base(place),
            Handle::BlossomEnd => ends.with_blossom_end(place),
            Handle::Middle => ends.shifted(place - grab.place),
        };
        // Where the ends meet, the axis stays as it was.
        annotating.moving = moved.ok().or(annotating.moving);
    }

    fn nudge(&mut self, turn: Turn, degrees: f64) {
        let Some(ends) = self.state.true_axes.set_ends() else {
            return;
        };
        let camera = &self.state.camera;
        let view_ray = match camera.projection {
            Projection::Perspective => ends.middle() - camera.eye_in_world,
            Projection::Orthographic => camera.forward_in_world(),
        };
        let [lean, picture] = ends.across(view_ray);
        let about = match turn {
            Turn::Lean => lean,
            Turn::Picture => picture,
        };
        match ends.turned(about, degrees, self.state.true_axes.pivot) {
            Ok(turned) => self.set_ends(turned),
            Err(error) => self.refuse(error),
        }
    }

    fn start(&mut self, method: Method) {
        if self.state.true_axes.is_blind || !self.state.true_axes.can_edit() || self.state.is_stale {
            return;
        }
        let Some(walked) = self.state.walked.clone() else {
            self.say(
                false,
                "There is nothing to start from yet: the cloud is not analyzed.".into(),
            );
            return;
        };
        match start_axis(&walked.fruit, &walked.analysis, &self.state.references, method) {
            Ok(ends) => {
                self.state.true_axes.draft = Draft::None;
                let (confidence, note) = self.carried();
                self.edit(Judgment {
                    method,
                    confidence,
                    note,
                    ..Judgment::by_hand(ends)
                });
            }
            Err(error) => self.say(false, sentence(&error.to_string())),
        }
    }

    fn refuse(&mut self, error: EndsError) {
        self.say(false, sentence(&error.to_string()));
    }

    /// The confidence and the note that stay when the axis changes.
    fn carried(&self) -> (Option<crate::annotate::Confidence>, String) {
        let before = self.state.true_axes.judgment();
        before.map_or((None, String::new()), |before| {
            (before.confidence, before.note.clone())
        })
    }

    /// Another axis, begun where the last one was.
    fn set_ends(&mut self, ends: Ends) {
        let before = self.state.true_axes.judgment().cloned();
        let before = before.unwrap_or_else(|| Judgment::by_hand(ends));
        self.edit(Judgment {
            finding: Finding::Axis(ends),
            ..before
        });
    }

    fn change(&mut self, change: impl FnOnce(&mut Judgment)) {
        if let Some(mut judgment) = self.state.true_axes.judgment().cloned() {
            change(&mut judgment);
            self.edit(judgment);
        }
    }

    fn edit(&mut self, mut judgment: Judgment) {
        let annotating = &self.state.true_axes;
        if !annotating.can_edit() {
            return;
        }
        judgment.blind = annotating.is_blind && !annotating.was_seen && judgment.method == Method::ByHand;
        let same = |before: &Judgment| {
            Judgment {
                blind: judgment.blind,
                ..before.clone()
            } == judgment
        };
        if annotating.judgment().is_some_and(same) {
            return;
        }
        self.act_on_axis(Deed::Edit(Box::new(judgment)));
    }

    fn undo_or_redo(&mut self, deed: Deed) {
        let annotating = &mut self.state.true_axes;
        (annotating.draft, annotating.moving, annotating.grabbed) = (Draft::None, None, None);
        let steps = match deed {
            Deed::Undo => annotating.history.undo_steps(),
            _ => annotating.history.redo_steps(),
        };
        if annotating.can_edit() && steps > 0 {
            self.act_on_axis(deed);
        }
    }

    fn next_without(&mut self) {
        let (mine, Some(current)) = (self.state.true_axes.mine.clone(), self.state.current) else {
            return;
        };
        let count = mine.len();
        let next = (1..count)
            .map(|by| (current + by) % count)
            .find(|&place| !mine[place]);
        match next {
            Some(place) => self.apply(crate::app::Command::Show(place)),
            None => self.say(false, "Every other open cloud has an axis of yours.".into()),
        }
    }

    /// Turns to the adjudicated axis and sets it.
    fn decide(&mut self, decision: &Decision) {
        let of_annotators = |a: &&Annotation| a.role == Role::Annotator;
        let annotations = &self.state.true_axes.annotations;
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
                    self.say(
                        false,
                        "The annotators' axes have no mean: they contradict one another.".into(),
                    );
                    return;
                };
                Some(mean)
            }
        };
        let annotating = &mut self.state.true_axes;
        if annotating.is_blind {
            return;
        }
        annotating.role = Role::Adjudicator;
        self.edit_mode(true);
        if !self.state.true_axes.is_editing {
            return;
        }
        self.update_annotating();
        let Some(judgment) = judgment else { return };
        // The files may still be opening: edits wait behind that.
        self.state.true_axes.saving = Saving::Saving;
        self.edit(judgment);
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

impl Ghost {
    /// The next one, for a key that goes through them.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Off => Self::Turned,
            Self::Turned => Self::Mirrored,
            Self::Mirrored => Self::Off,
        }
    }
}
