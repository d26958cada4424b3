//! What happens to axes beside the interface: the annotator's stores, on a thread of their own. Nothing
//! that was not saved is ever let go of.

use std::path::PathBuf;

use crate::annotate::{Annotation, Author, CloudId, Judgment, Store, StoreError, now};
use crate::annotate::{DiskFiles, read_annotations};
use crate::geometry::Unit;
use crate::undo::History;

/// A cloud's axis files.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    pub(super) path: PathBuf,
    pub(super) cloud: CloudId,
    pub(super) unit: Unit,
}

/// What an annotator does.
#[derive(Debug, Clone)]
pub(super) enum Deed {
    Edit(Box<Judgment>),
    Undo,
    Redo,
}

/// Does a deed in the annotator's history, as its store will.
pub(super) fn act(history: &mut History<Judgment>, deed: &Deed) {
    match deed {
        Deed::Edit(judgment) => history.push((**judgment).clone()),
        Deed::Undo => drop(history.undo()),
        Deed::Redo => drop(history.redo()),
    }
}

/// How things stand after a job.
#[derive(Debug, Clone)]
pub(super) struct Report {
    pub(super) history: History<Judgment>,
    /// The axis file, once it has a name.
    pub(super) axis_file: Option<PathBuf>,
    /// Why the newest edits are not on the disk, where they are not.
    pub(super) problem: Option<String>,
    pub(super) notices: Vec<String>,
    /// What everybody says of the cloud, as it is on the disk.
    pub(super) annotations: Vec<Annotation>,
    /// Other clouds whose axes could not be saved yet.
    pub(super) unsaved_elsewhere: Vec<PathBuf>,
}

/// One annotator's axis of one cloud.
struct Desk {
    place: Place,
    author: Author,
    /// `None` as long as it cannot be opened; edits then wait.
    store: Option<Store>,
    waiting: Vec<(Deed, String)>,
    problem: Option<String>,
}

impl Desk {
    fn new(place: Place, author: Author) -> Self {
        let mut desk = Self {
            place,
            author,
            store: None,
            waiting: Vec::new(),
            problem: None,
        };
        desk.open();
        desk
    }

    fn open(&mut self) {
        let Place { path, cloud, unit } = &self.place;
        let files = Box::new(DiskFiles::default());
        match Store::open(files, path, cloud.clone(), *unit, self.author.clone()) {
            Ok((store, writable)) => {
                self.problem = writable.err().as_ref().map(told);
                self.store = Some(store);
            }
            Err(error) => self.problem = Some(told(&error)),
        }
    }

    fn act(&mut self, deed: Deed, now: String) {
        self.waiting.push((deed, now));
        self.catch_up();
    }

    /// Does what waits, and writes what is not written.
    fn catch_up(&mut self) {
        if self.store.is_none() {
            self.open();
        }
        let Some(store) = &mut self.store else { return };
        let mut outcome = Ok(());
        for (deed, now) in self.waiting.drain(..) {
            outcome = match deed {
                Deed::Edit(judgment) => store.edit(*judgment, &now),
                Deed::Undo => store.undo(&now).map(drop),
                Deed::Redo => store.redo(&now).map(drop),
            };
        }
        if outcome.is_ok() {
            outcome = store.save();
        }
        self.problem = outcome.err().as_ref().map(told);
    }

    fn is_settled(&self) -> bool {
        self.waiting.is_empty() && self.store.as_ref().is_none_or(Store::is_saved)
    }

    fn history(&self) -> History<Judgment> {
        let of_store = |store: &Store| store.history().map(|annotation| annotation.judgment.clone());
        let mut history = self.store.as_ref().map(of_store).unwrap_or_default();
        for (deed, _) in &self.waiting {
            act(&mut history, deed);
        }
        history
    }
}

/// Everything that the thread holds.
#[derive(Default)]
pub(super) struct Keeper {
    /// The current one, and those that could not be saved.
    desks: Vec<Desk>,
    /// The cloud that is looked at, and who sets its axis.
    place: Option<Place>,
    author: Option<Author>,
}

impl Keeper {
    /// Turns to another cloud or author. Without an author its annotations are only read.
    pub(super) fn turn_to(&mut self, place: Option<Place>, author: Option<Author>) -> Report {
        for desk in &mut self.desks {
            if !desk.is_settled() {
                desk.catch_up();
            }
        }
        (self.place, self.author) = (place, author);
        let wanted = self.place.clone().zip(self.author.clone());
        let is_wanted = |desk: &Desk| {
            let same = |(place, author): &(Place, Author)| {
                place.path == desk.place.path
                    && place.cloud.sha256 == desk.place.cloud.sha256
                    && *author == desk.author
            };
            wanted.as_ref().is_some_and(same)
        };
        // One with another unit is opened anew.
        self.desks.retain(|desk| {
            let is_same = is_wanted(desk) && Some(&desk.place) == wanted.as_ref().map(|(place, _)| place);
            !desk.is_settled() || is_same
        });
        if !self.desks.iter().any(is_wanted)
            && let Some((place, author)) = wanted
        {
            self.desks.push(Desk::new(place, author));
        }
        self.report()
    }

    /// One edit, undo or redo of the current axis.
    pub(super) fn act(&mut self, deed: Deed) -> Report {
        let now = now();
        if let Some(desk) = self.current() {
            desk.act(deed, now);
        }
        self.report()
    }

    /// Tries again to write whatever is not on the disk.
    pub(super) fn try_again(&mut self) -> Report {
        self.desks.iter_mut().for_each(Desk::catch_up);
        let (place, author) = (self.place.clone(), self.author.clone());
        self.turn_to(place, author)
    }

    fn current(&mut self) -> Option<&mut Desk> {
        let (place, author) = (self.place.as_ref()?, self.author.as_ref()?);
        self.desks.iter_mut().find(|desk| {
            desk.place.path == place.path
                && desk.place.cloud.sha256 == place.cloud.sha256
                && desk.author == *author
        })
    }

    fn report(&mut self) -> Report {
        let (mut annotations, mut notices) = self
            .place
            .as_ref()
            .map(|place| read_annotations(&place.path, &place.cloud.sha256))
            .unwrap_or_default();
        annotations.sort_by(|a, b| (a.role as u8, &a.annotator).cmp(&(b.role as u8, &b.annotator)));
        let current = self.current().map(|desk| {
            let notices: Vec<String> = desk
                .store
                .iter()
                .flat_map(Store::notices)
                .map(ToString::to_string)
                .collect();
            (
                desk.history(),
                desk.store.as_ref().map(|store| store.axis_path().to_owned()),
                desk.problem.clone(),
                notices,
                (desk.place.path.clone(), desk.author.clone()),
            )
        });
        let (history, axis_file, problem, of_store, here) = match current {
            Some((history, file, problem, notices, desk)) => (history, file, problem, notices, Some(desk)),
            None => (History::default(), None, None, Vec::new(), None),
        };
        notices.splice(0..0, of_store);
        Report {
            history,
            axis_file,
            problem,
            notices,
            annotations,
            unsaved_elsewhere: self
                .desks
                .iter()
                .filter(|desk| !desk.is_settled())
                .filter(|desk| {
                    let is_here = |(path, author): &(PathBuf, Author)| {
                        *path == desk.place.path && *author == desk.author
                    };
                    !here.as_ref().is_some_and(is_here)
                })
                .map(|desk| desk.place.path.clone())
                .collect(),
        }
    }
}

/// It begins with a file's name, whose letters stay as they are.
fn told(error: &StoreError) -> String {
    format!("{error}.")
}
