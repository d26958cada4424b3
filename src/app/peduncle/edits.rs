//! Growing and shrinking a selection, which asks for the neighbors of points: one after the other, so
//! that none is lost.

use std::sync::Arc;

use crate::app::App;
use crate::geometry::PointSet;
use crate::peduncle::{grown, median_spacing, shrunk};

/// What is to be done with the selection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::app) struct Edit {
    pub(super) grows: bool,
    pub(super) reach_spacings: f64,
}

/// What came of it.
pub(in crate::app) struct Edited {
    sha256: String,
    from: Arc<PointSet>,
    to: Arc<PointSet>,
    spacing: f64,
}

impl App {
    pub(in crate::app) fn update_edits(&mut self) {
        self.take_edit();
        if self.peduncle.edits.is_busy() {
            return;
        }
        let Some(edit) = self.peduncle.waiting_edits.pop_front() else {
            return;
        };
        let (Some(walked), Some(from)) = (self.state.current_walked().cloned(), self.state.peduncle_points())
        else {
            return;
        };
        let sha256 = walked.fruit.file.sha256.clone();
        let known = self.peduncle.spacing.as_ref().filter(|(of, _)| *of == sha256);
        let known = known.map(|(_, spacing)| *spacing);
        self.peduncle.edits.submit(move |watch| {
            let points = walked.fruit.cloud().positions();
            let spacing = known.or_else(|| median_spacing(points)).unwrap_or(0.0);
            let reach = edit.reach_spacings * spacing;
            let to = if edit.grows {
                grown(points, &from, reach, watch)?
            } else {
                shrunk(points, &from, reach, watch)?
            };
            Ok(Edited {
                sha256,
                from,
                to: Arc::new(to),
                spacing,
            })
        });
        if let Some(result) = self.peduncle.edits.take_within(crate::app::PATIENCE) {
            self.accept_edit(result);
        }
    }

    fn take_edit(&mut self) {
        if let Some(result) = self.peduncle.edits.take() {
            self.accept_edit(result);
        }
    }

    fn accept_edit(
        &mut self,
        result: Result<Result<Edited, crate::parallel::Cancelled>, crate::app::workers::Crashed>,
    ) {
        let edited = match result {
            Ok(Ok(edited)) => edited,
            Ok(Err(_)) => return,
            Err(crash) => {
                self.say(true, format!("The selection broke off by {crash}."));
                return;
            }
        };
        self.peduncle.spacing = Some((edited.sha256.clone(), edited.spacing));
        let is_current = self
            .state
            .current_walked()
            .is_some_and(|w| w.fruit.file.sha256 == edited.sha256);
        // What was picked or undone meanwhile is newer.
        let is_newest = self.state.peduncle_points().is_some_and(|now| now == edited.from);
        if !(is_current && is_newest) {
            return;
        }
        if edited.from == edited.to {
            let text = if edited.from.is_empty() {
                "Nothing is selected yet that could grow or shrink."
            } else {
                "There is nothing within that reach: the selection stays as it is."
            };
            self.say(false, text.into());
        }
        self.pick_peduncle(edited.to);
    }
}
