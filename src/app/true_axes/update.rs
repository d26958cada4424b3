//! What is done once a frame: the files' answers are taken, and what is wanted now is asked for.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use super::agreement::{SetReport, compare, set_by};
use super::desk::{Deed, Keeper, Place, Report, act};
use super::middle::middle;
use super::scenes::{Made, Scenes, Wanted, scenes};
use super::views::locked_cameras;
use super::{Draft, Saving, Subject};
use glam::DVec3;

use crate::annotate::{Author, CloudAgreement, CloudId, FAR_OFF_DEG};
use crate::app::inspector::stages::Source;
use crate::app::workers::{JobId, Lane, Pool, Queue};
use crate::app::{AnalyzedFruit, App, PATIENCE};
use crate::evaluate::collect_references;
use crate::fruit::Fruit;
use crate::parallel::Cancelled;
use crate::text::sentence;
use crate::undo::History;
use crate::view::ShownPoints;

/// Points that tell how large a locked view has to be.
const FOR_FRAMING: usize = 400;

/// Points up to which the large view's ghost follows a drag.
const LIVE_GHOST: usize = 60_000;

/// Points that tell where the middle of a fruit lies.
const FOR_MIDDLE: usize = 4_000;

/// What works for annotators beside the interface.
pub(in crate::app) struct Annotator {
    files: Queue<Keeper, Report>,
    /// The job whose answer tells how things stand now.
    newest: JobId,
    answered: JobId,
    /// What the files were last turned to.
    turned_to: Option<(Place, Option<Author>)>,
    scenes: Lane<Scenes>,
    scenes_asked: Option<Wanted>,
    made: Option<Made>,
    set: Lane<Result<SetReport, Cancelled>>,
    mine: Lane<Vec<bool>>,
    mine_asked: Option<(Author, usize, Option<PathBuf>)>,
}

impl Annotator {
    pub(in crate::app) fn new(pool: &Pool) -> Self {
        Self {
            files: Queue::new(pool, Keeper::default()),
            newest: 0,
            answered: 0,
            turned_to: None,
            scenes: Lane::new(pool),
            scenes_asked: None,
            made: None,
            set: Lane::new(pool),
            mine: Lane::new(pool),
            mine_asked: None,
        }
    }

    pub(in crate::app) fn is_busy(&self) -> bool {
        self.files.is_busy() || self.scenes.is_busy() || self.set.is_busy() || self.mine.is_busy()
    }
}

impl App {
    /// Waits until every edit of an axis that was made is written. Nothing can be edited afterwards.
    pub fn finish(&mut self) {
        self.annotator.files.finish();
        self.take_reports();
    }

    /// The cloud that is looked at has come, with its analysis or without.
    pub(in crate::app) fn set_subject(&mut self, fruit: &Fruit, shown: &ShownPoints) {
        let is_file = matches!(self.state.source(), Some(Source::File(path)) if *path == fruit.file.path);
        let annotating = &mut self.state.true_axes;
        if !is_file {
            annotating.subject = None;
            return;
        }
        let viewpoint = self.state.settings.request.params.viewpoint;
        let is_known = annotating.subject.as_ref().is_some_and(|known| {
            known.path == fruit.file.path
                && known.cloud.sha256 == fruit.file.sha256
                && (known.unit, known.viewpoint) == (fruit.unit, viewpoint)
        });
        if is_known {
            return;
        }
        let step = shown.len().div_ceil(FOR_MIDDLE).max(1);
        let sample: Vec<_> = shown.positions.iter().step_by(step).copied().collect();
        let extent = shown.extent;
        let middle = middle(&sample, &extent, viewpoint);
        let path = fruit.file.path.clone();
        let step = sample.len().div_ceil(FOR_FRAMING).max(1);
        let margin = 0.1 * extent.size();
        let (least, most) = (extent.min - margin, extent.max + margin);
        let is_bulk = |p: &DVec3| p.cmpge(least).all() && p.cmple(most).all();
        annotating.subject = Some(Subject {
            sample: sample.iter().copied().filter(is_bulk).step_by(step).collect(),
            cloud: CloudId {
                file: path.file_name().unwrap_or_default().to_string_lossy().into(),
                sha256: fruit.file.sha256.clone(),
            },
            path,
            unit: fruit.unit,
            middle,
            extent,
            viewpoint,
        });
    }

    /// The cloud that is looked at goes.
    pub(in crate::app) fn leave_subject(&mut self) {
        let annotating = &mut self.state.true_axes;
        annotating.subject = None;
        annotating.draft = Draft::None;
        (annotating.landing, annotating.grabbed, annotating.moving) = (None, None, None);
    }

    /// Once a frame.
    pub(in crate::app) fn update_annotating(&mut self) {
        self.take_reports();
        self.turn_to_subject();
        self.note_seen();
        self.ask_for_mine();
        self.take_set();
    }

    /// Once a frame, when the look is settled.
    pub(in crate::app) fn update_edit_scenes(&mut self) {
        let annotating = &mut self.state.true_axes;
        annotating.locked = annotating
            .subject
            .as_ref()
            .filter(|_| annotating.is_editing)
            .map(|subject| locked_cameras(subject, annotating.set_ends().as_ref()));
        let (true, Some(subject), Some(look)) =
            (annotating.is_editing, &annotating.subject, &self.state.look)
        else {
            (annotating.small_scene, annotating.ghost_scene) = (None, None);
            self.annotator.scenes_asked = None;
            self.annotator.made = None;
            return;
        };
        let has_ghost = annotating.ghost != super::Ghost::Off;
        let main_ends = if look.shown.len() > LIVE_GHOST {
            annotating.set_ends()
        } else {
            annotating.ends()
        };
        let wanted = Wanted {
            look: look.clone(),
            ends: annotating.ends().filter(|_| has_ghost),
            main_ends: main_ends.filter(|_| has_ghost),
            ghost: annotating.ghost,
            view_ray: subject.extent.center() - subject.viewpoint,
            pixels_per_point: self.state.pixels_per_point,
        };
        if self.annotator.scenes_asked.as_ref() != Some(&wanted) {
            self.annotator.scenes_asked = Some(wanted.clone());
            let before = self.annotator.made.clone();
            self.annotator.scenes.submit(move |_| scenes(wanted, before));
        }
        if let Some(Ok(Scenes { made, small })) = self.annotator.scenes.take_within(PATIENCE) {
            let annotating = &mut self.state.true_axes;
            annotating.ghost_scene.clone_from(&made.main);
            annotating.small_scene = Some(small);
            self.annotator.made = Some(made);
        }
    }

    /// Hands a deed to the files, and shows it at once.
    pub(super) fn act_on_axis(&mut self, deed: Deed) {
        let annotating = &mut self.state.true_axes;
        act(&mut annotating.history, &deed);
        annotating.saving = Saving::Saving;
        if let (Some(place), Some(mine)) = (self.state.current, Some(Arc::make_mut(&mut annotating.mine)))
            && let Some(is_mine) = mine.get_mut(place)
        {
            *is_mine = annotating.history.current().is_some();
        }
        self.annotator.newest = self.annotator.files.submit(move |keeper| keeper.act(deed));
    }

    pub(super) fn try_again(&mut self) {
        self.state.true_axes.saving = Saving::Saving;
        self.annotator.newest = self.annotator.files.submit(Keeper::try_again);
    }

    pub(super) fn compare_set(&mut self) {
        let clouds = self.clouds();
        self.annotator.set.submit(move |watch| compare(&clouds, watch));
        self.state.true_axes.set_progress = Some(0.0);
    }

    pub(super) fn cancel_set(&mut self) {
        self.annotator.set.cancel();
        self.state.true_axes.set_progress = None;
    }

    fn clouds(&self) -> Vec<PathBuf> {
        let entries = self.state.entries.iter();
        entries.map(|entry| entry.source.path().to_owned()).collect()
    }

    fn take_reports(&mut self) {
        while let Some((id, answer)) = self.annotator.files.take_within(Duration::ZERO) {
            self.annotator.answered = id;
            let is_newest = id == self.annotator.newest;
            match answer {
                Ok(report) if is_newest => self.accept_report(report),
                // Of what was there before the last edit.
                Ok(_) => {}
                Err(crash) => {
                    let text = sentence(&format!("the axis could not be kept: {crash}"));
                    self.state.true_axes.saving = Saving::Failed(text.clone());
                    self.say(true, text);
                }
            }
        }
    }

    fn accept_report(&mut self, report: Report) {
        let annotating = &mut self.state.true_axes;
        annotating.history = report.history;
        annotating.axis_file = report.axis_file;
        annotating.saving = match report.problem {
            Some(problem) => Saving::Failed(problem),
            None if annotating.history == History::default() => Saving::Nothing,
            None => Saving::Saved,
        };
        annotating.unsaved_elsewhere = report.unsaved_elsewhere;
        annotating.notices = report.notices;
        if let Some(subject) = &annotating.subject {
            annotating.agreement = Some(CloudAgreement::of(
                &subject.cloud.file,
                &report.annotations,
                FAR_OFF_DEG,
            ));
        }
        if annotating.annotations != report.annotations {
            annotating.annotations = report.annotations;
            self.refresh_references();
        }
    }

    /// The references, with the axes by hand as they are now.
    fn refresh_references(&mut self) {
        if let Some(walked) = self.state.walked.clone() {
            let walked = self.with_annotations((*walked).clone());
            let request = &self.state.settings.request;
            let (references, warnings) = collect_references(&walked.fruit, request, &walked.analysis);
            (self.state.references, self.state.warnings) = (references, warnings);
            self.state.walked = Some(Arc::new(walked));
            self.take_current_row();
            // The view may draw all of them.
            self.shown_generation += 1;
        }
    }

    /// The cloud with what annotators say of it now, which may be newer than when it was read.
    pub(in crate::app) fn with_annotations(&self, mut walked: AnalyzedFruit) -> AnalyzedFruit {
        let turned_to = self.annotator.turned_to.as_ref();
        let is_it = turned_to.is_some_and(|(place, _)| {
            place.path == walked.fruit.file.path && place.cloud.sha256 == walked.fruit.file.sha256
        });
        let annotating = &self.state.true_axes;
        let is_known = self.annotator.answered >= self.annotator.newest;
        if is_it && is_known && walked.fruit.annotations != annotating.annotations {
            let mut fruit = (*walked.fruit).clone();
            fruit.annotations.clone_from(&annotating.annotations);
            walked.fruit = Arc::new(fruit);
        }
        walked
    }

    fn turn_to_subject(&mut self) {
        let annotating = &self.state.true_axes;
        let author = annotating.author().ok().filter(|_| annotating.is_editing);
        let wanted = annotating.subject.as_ref().map(|subject| {
            let place = Place {
                path: subject.path.clone(),
                cloud: subject.cloud.clone(),
                unit: subject.unit,
            };
            (place, author)
        });
        // Between two clouds the last one's files stay.
        if wanted == self.annotator.turned_to || (wanted.is_none() && self.analysis.progress().is_some()) {
            return;
        }
        self.annotator.turned_to.clone_from(&wanted);
        let annotating = &mut self.state.true_axes;
        annotating.history = History::default();
        annotating.draft = Draft::None;
        (annotating.grabbed, annotating.moving) = (None, None);
        (annotating.axis_file, annotating.agreement) = (None, None);
        annotating.annotations.clear();
        annotating.notices.clear();
        annotating.saving = Saving::Opening;
        let (place, author) = match wanted {
            Some((place, author)) => (Some(place), author),
            None => (None, None),
        };
        self.annotator.newest = self
            .annotator
            .files
            .submit(move |keeper| keeper.turn_to(place, author));
        if let Some((id, answer)) = self.annotator.files.take_within(PATIENCE) {
            self.annotator.answered = id;
            if let (Ok(report), true) = (answer, id == self.annotator.newest) {
                self.accept_report(report);
            }
        }
    }

    /// What is computed has been seen of a cloud, once it is shown.
    fn note_seen(&mut self) {
        let has_analysis = self
            .state
            .look
            .as_ref()
            .is_some_and(|look| look.analysis.is_some());
        let annotating = &mut self.state.true_axes;
        let Some(subject) = &annotating.subject else {
            annotating.was_seen = false;
            return;
        };
        if !annotating.is_blind && has_analysis && !annotating.seen.contains(&subject.cloud.sha256) {
            annotating.seen.insert(subject.cloud.sha256.clone());
        }
        annotating.was_seen = annotating.seen.contains(&subject.cloud.sha256);
    }

    fn ask_for_mine(&mut self) {
        if let Some(Ok(mine)) = self.annotator.mine.take() {
            self.state.true_axes.mine = Arc::new(mine);
        }
        let author = self.state.true_axes.author().ok();
        let entries = &self.state.entries;
        let wanted = author.filter(|_| !entries.is_empty()).map(|author| {
            let last = entries.last().map(|entry| entry.source.path().to_owned());
            (author, entries.len(), last)
        });
        if wanted == self.annotator.mine_asked {
            return;
        }
        self.annotator.mine_asked.clone_from(&wanted);
        self.state.true_axes.mine = Arc::default();
        if let Some((author, ..)) = wanted {
            let clouds = self.clouds();
            self.annotator.mine.submit(move |_| set_by(&author, &clouds));
        }
    }

    fn take_set(&mut self) {
        if let Some(answer) = self.annotator.set.take() {
            self.state.true_axes.set_progress = None;
            match answer {
                Ok(Ok(report)) => self.state.true_axes.set = Some(Arc::new(report)),
                Ok(Err(Cancelled)) => {}
                Err(crash) => self.say(true, sentence(&crash.to_string())),
            }
        } else if let Some(progress) = self.annotator.set.progress() {
            self.state.true_axes.set_progress = Some(progress.share);
        }
    }
}
