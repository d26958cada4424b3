//! The annotator's stores, which are read and written beside the interface. A store is kept until everything in it is
//! saved.

use std::path::PathBuf;

use crate::annotate::{Annotation, Author, CloudId, Judgment, Store, StoreError, now};
use crate::annotate::{DiskFiles, read_annotations};
use crate::geometry::Unit;
use crate::undo::History;

/// The cloud that a store is of.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AxisCloud {
    pub(super) path: PathBuf,
    pub(super) id: CloudId,
    pub(super) unit: Unit,
}

/// A change of the annotator's.
#[derive(Debug, Clone)]
pub(super) enum Change {
    Edit(Box<Judgment>),
    Undo,
    Redo,
}

/// Does a change in the annotator's history, as its store will.
pub(super) fn apply(history: &mut History<Judgment>, change: &Change) {
    match change {
        Change::Edit(judgment) => history.push((**judgment).clone()),
        Change::Undo => drop(history.undo()),
        Change::Redo => drop(history.redo()),
    }
}

/// The state of the current cloud's axes after a job.
#[derive(Debug, Clone)]
pub(super) struct Status {
    pub(super) history: History<Judgment>,
    /// The axis file, once it has a name.
    pub(super) axis_file: Option<PathBuf>,
    /// The reason why the newest edits are not on the disk, if they are not.
    pub(super) problem: Option<String>,
    pub(super) notices: Vec<String>,
    /// Everybody's annotations of the cloud, as they are on the disk.
    pub(super) annotations: Vec<Annotation>,
    /// Other clouds whose axes could not be saved yet.
    pub(super) unsaved_elsewhere: Vec<PathBuf>,
}

/// The store of one annotator's axis of one cloud, and the changes that wait for it.
struct OpenStore {
    cloud: AxisCloud,
    author: Author,
    /// `None` as long as it cannot be opened; edits then wait.
    store: Option<Store>,
    waiting: Vec<(Change, String)>,
    problem: Option<String>,
}

impl OpenStore {
    fn new(cloud: AxisCloud, author: Author) -> Self {
        let mut opened = Self {
            cloud,
            author,
            store: None,
            waiting: Vec::new(),
            problem: None,
        };
        opened.open();
        opened
    }

    fn open(&mut self) {
        let AxisCloud { path, id, unit } = &self.cloud;
        let files = Box::new(DiskFiles::default());
        match Store::open(files, path, id.clone(), *unit, self.author.clone()) {
            Ok((store, writable)) => {
                self.problem = writable.err().as_ref().map(sentence_of);
                self.store = Some(store);
            }
            Err(error) => self.problem = Some(sentence_of(&error)),
        }
    }

    fn act(&mut self, change: Change, now: String) {
        self.waiting.push((change, now));
        self.catch_up();
    }

    /// Does what waits, and writes what is not written.
    fn catch_up(&mut self) {
        if self.store.is_none() {
            self.open();
        }
        let Some(store) = &mut self.store else { return };
        let mut outcome = Ok(());
        for (change, now) in self.waiting.drain(..) {
            outcome = match change {
                Change::Edit(judgment) => store.edit(*judgment, &now),
                Change::Undo => store.undo(&now).map(drop),
                Change::Redo => store.redo(&now).map(drop),
            };
        }
        if outcome.is_ok() {
            outcome = store.save();
        }
        self.problem = outcome.err().as_ref().map(sentence_of);
    }

    /// Whether the store is this author's of this cloud, whatever its unit.
    fn is_of(&self, cloud: &AxisCloud, author: &Author) -> bool {
        let (own, other) = (&self.cloud, cloud);
        own.path == other.path && own.id.sha256 == other.id.sha256 && self.author == *author
    }

    fn is_settled(&self) -> bool {
        self.waiting.is_empty() && self.store.as_ref().is_none_or(Store::is_saved)
    }

    fn history(&self) -> History<Judgment> {
        let of_store = |store: &Store| store.history().map(|annotation| annotation.judgment.clone());
        let mut history = self.store.as_ref().map(of_store).unwrap_or_default();
        for (change, _) in &self.waiting {
            apply(&mut history, change);
        }
        history
    }
}

/// The stores that are open: the current one, and those that could not be saved.
#[derive(Default)]
pub(super) struct AxisStores {
    stores: Vec<OpenStore>,
    /// The cloud that is looked at.
    cloud: Option<AxisCloud>,
    /// The annotator who sets its axis.
    author: Option<Author>,
}

impl AxisStores {
    /// Turns to another cloud or author. Without an author its annotations are only read.
    pub(super) fn turn_to(&mut self, cloud: Option<AxisCloud>, author: Option<Author>) -> Status {
        for store in self.stores.iter_mut().filter(|store| !store.is_settled()) {
            store.catch_up();
        }
        // A store of another unit is opened anew.
        self.stores.retain(|store| {
            let is_wanted = Some(&store.cloud) == cloud.as_ref() && Some(&store.author) == author.as_ref();
            !store.is_settled() || is_wanted
        });
        (self.cloud, self.author) = (cloud, author);
        if self.current().is_none()
            && let Some((cloud, author)) = self.cloud.clone().zip(self.author.clone())
        {
            self.stores.push(OpenStore::new(cloud, author));
        }
        self.status()
    }

    /// Changes the current axis.
    pub(super) fn act(&mut self, change: Change) -> Status {
        let now = now();
        if let Some(place) = self.current() {
            self.stores[place].act(change, now);
        }
        self.status()
    }

    /// Tries again to write whatever is not on the disk.
    pub(super) fn try_again(&mut self) -> Status {
        self.stores.iter_mut().for_each(OpenStore::catch_up);
        let (cloud, author) = (self.cloud.clone(), self.author.clone());
        self.turn_to(cloud, author)
    }

    /// The place of the current axis' store.
    fn current(&self) -> Option<usize> {
        let (cloud, author) = (self.cloud.as_ref()?, self.author.as_ref()?);
        self.stores.iter().position(|store| store.is_of(cloud, author))
    }

    fn status(&self) -> Status {
        let (mut annotations, unusable) = self
            .cloud
            .as_ref()
            .map(|cloud| read_annotations(&cloud.path, &cloud.id.sha256))
            .unwrap_or_default();
        annotations.sort_by(|a, b| (a.role as u8, &a.annotator).cmp(&(b.role as u8, &b.annotator)));
        let current = self.current().map(|place| &self.stores[place]);
        let store = current.and_then(|opened| opened.store.as_ref());
        let of_store = store.into_iter().flat_map(Store::notices);
        let is_elsewhere = |opened: &&OpenStore| {
            current.is_none_or(|here| here.cloud.path != opened.cloud.path || here.author != opened.author)
        };
        Status {
            history: current.map(OpenStore::history).unwrap_or_default(),
            axis_file: store.map(|store| store.axis_path().to_owned()),
            problem: current.and_then(|opened| opened.problem.clone()),
            notices: of_store.map(ToString::to_string).chain(unusable).collect(),
            annotations,
            unsaved_elsewhere: self
                .stores
                .iter()
                .filter(|opened| !opened.is_settled())
                .filter(is_elsewhere)
                .map(|opened| opened.cloud.path.clone())
                .collect(),
        }
    }
}

/// It begins with a file's name, whose letters stay as they are.
fn sentence_of(error: &StoreError) -> String {
    format!("{error}.")
}
