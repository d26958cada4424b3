//! Everything about axes set by hand that there is to show.

use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::agreement::SetReport;
use super::handles::{EditView, Handle};
use crate::annotate::{
    Annotation, Author, CloudAgreement, CloudId, Ends, Judgment, NUDGES_DEG, NameError, Pivot, Role,
};
use crate::app::inspector::stages::AnalyzedFruit;
use crate::geometry::{Extent, Unit};
use crate::render::{Camera, Scene};
use crate::undo::History;

/// A second copy of the cloud, moved by the symmetry that a true axis would have: it checks the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub enum Ghost {
    /// No ghost.
    #[default]
    Off,
    /// The cloud turned by 180° about the axis.
    Turned,
    /// The cloud mirrored in the plane through the axis and the ray from the depth camera.
    Mirrored,
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

/// An axis that is being set by two clicks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Draft {
    /// None is.
    #[default]
    None,
    /// Both ends are to be set, though there may be an axis.
    Anew,
    /// The peduncle's base is set.
    Base(DVec3),
}

/// The handle that is held with the mouse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grab {
    /// The handle.
    pub handle: Handle,
    /// The view in which it is held.
    pub view: EditView,
    /// The handle's position when it was grabbed.
    pub place: DVec3,
    /// The cursor's position then, in the view's pixels.
    pub at_px: DVec2,
}

/// The cloud whose axis is set.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// The cloud's file.
    pub path: PathBuf,
    /// The cloud's identity.
    pub cloud: CloudId,
    /// The unit of its coordinates.
    pub unit: Unit,
    /// About where its middle lies, by what is seen of it. It gives a click its depth, and has nothing to
    /// do with the method's fruit center.
    pub middle: DVec3,
    /// The extent of the bulk of its points.
    pub extent: Extent,
    /// Some of the bulk's points, for framing.
    pub sample: Arc<[DVec3]>,
    /// The position of the depth camera.
    pub viewpoint: DVec3,
}

/// Whether what is shown is on the disk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Saving {
    /// There is no annotation, and nothing to save.
    Nothing,
    /// The files are being opened.
    Opening,
    /// Being written.
    Saving,
    /// On the disk.
    Saved,
    /// It is not, and why: a sentence.
    Failed(String),
}

/// The settings that a restart keeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct KeptTrueAxes {
    /// The annotator's name.
    pub name: String,
    /// Whether everything computed is hidden.
    pub is_blind: bool,
    /// The step of the buttons that turn, as an index of [`NUDGES_DEG`].
    pub step: usize,
    /// The ghost that checks the axis.
    pub ghost: Ghost,
}

impl Default for KeptTrueAxes {
    fn default() -> Self {
        Self {
            name: String::new(),
            is_blind: false,
            // One degree.
            step: 1,
            ghost: Ghost::Off,
        }
    }
}

/// Everything about axes set by hand that there is to show.
#[derive(Debug, Clone)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each says one thing that is so or not"
)]
pub struct TrueAxesState {
    /// The annotator's name; empty as long as nobody has said one.
    pub name: String,
    /// The role in which axes are set.
    pub role: Role,
    /// Whether the name has to be asked for.
    pub asks_name: bool,
    /// Whether the left button sets the axis.
    pub is_editing: bool,
    /// Whether everything computed is hidden.
    pub is_blind: bool,
    /// Whether this cloud was shown with what is computed before, so that an axis is not set blindly.
    pub was_seen: bool,
    /// Whether everybody's axes are drawn.
    pub shows_all: bool,
    /// The step of the buttons that turn, as an index of [`NUDGES_DEG`].
    pub step: usize,
    /// The point of the axis that stays when it is turned.
    pub pivot: Pivot,
    /// The ghost that checks the axis.
    pub ghost: Ghost,
    /// The cloud; `None` for a sample, and where there is none.
    pub subject: Option<Subject>,
    /// An axis that is being set.
    pub draft: Draft,
    /// The point at which a click would land.
    pub landing: Option<DVec3>,
    /// The handle that is held with the mouse.
    pub grabbed: Option<Grab>,
    /// The axis while it is dragged, before it counts.
    pub moving: Option<Ends>,
    /// The annotator's judgments, which can be undone and redone.
    pub history: History<Judgment>,
    /// Whether that is on the disk.
    pub saving: Saving,
    /// Other clouds whose axes could not be saved yet.
    pub unsaved_elsewhere: Vec<PathBuf>,
    /// Notices about the files, a sentence each.
    pub notices: Vec<String>,
    /// The axis file.
    pub axis_file: Option<PathBuf>,
    /// Everybody's annotations of the cloud, as they are on the disk.
    pub annotations: Vec<Annotation>,
    /// The file and the SHA-256 of the cloud that [`TrueAxesState::annotations`] are of, as long as they are up to date.
    pub(super) annotated: Option<(PathBuf, String)>,
    /// The agreement of the annotations.
    pub agreement: Option<CloudAgreement>,
    /// The agreement of annotators over the open clouds, once it was asked for.
    pub set: Option<Arc<SetReport>>,
    /// Clouds looked through for that, and their number, while it is under way.
    pub set_progress: Option<f64>,
    /// For each open cloud whether this annotator has set its axis; empty while that is not known.
    pub mine: Arc<Vec<bool>>,
    /// The locked views, from the front, from the side and end-on, in edit mode.
    pub locked: Option<[Camera; 3]>,
    /// The scene of the locked views.
    pub small_scene: Option<Arc<Scene>>,
    /// The view with the ghost, where one is shown.
    pub ghost_scene: Option<Arc<Scene>>,
    /// Clouds, by their hashes, that were shown with what is computed.
    pub(super) seen: HashSet<String>,
    /// The state of the open clouds' rows, by its number, that was shown last.
    pub(super) seen_rows: Option<u64>,
}

impl TrueAxesState {
    pub(in crate::app) fn new(kept: KeptTrueAxes) -> Self {
        Self {
            name: kept.name,
            role: Role::Annotator,
            asks_name: false,
            is_editing: false,
            is_blind: kept.is_blind,
            was_seen: false,
            shows_all: false,
            step: kept.step.min(NUDGES_DEG.len() - 1),
            pivot: Pivot::Middle,
            ghost: kept.ghost,
            subject: None,
            draft: Draft::None,
            landing: None,
            grabbed: None,
            moving: None,
            history: History::default(),
            saving: Saving::Nothing,
            unsaved_elsewhere: Vec::new(),
            notices: Vec::new(),
            axis_file: None,
            annotations: Vec::new(),
            annotated: None,
            agreement: None,
            set: None,
            set_progress: None,
            mine: Arc::default(),
            locked: None,
            small_scene: None,
            ghost_scene: None,
            seen: HashSet::new(),
            seen_rows: None,
        }
    }

    /// The settings that a restart keeps.
    pub(in crate::app) fn kept(&self) -> KeptTrueAxes {
        KeptTrueAxes {
            name: self.name.clone(),
            is_blind: self.is_blind,
            step: self.step,
            ghost: self.ghost,
        }
    }

    /// The author who sets the axis.
    ///
    /// # Errors
    /// Returns an error if the name cannot be one.
    pub fn author(&self) -> Result<Author, NameError> {
        match self.role {
            Role::Annotator => Author::annotator(&self.name),
            Role::Adjudicator => Author::adjudicator(&self.name),
        }
    }

    /// The annotator's judgment of the cloud, saved or not.
    pub fn judgment(&self) -> Option<&Judgment> {
        self.history.current()
    }

    /// The axis that counts; `None` where none is set, or it cannot be told.
    pub fn set_ends(&self) -> Option<Ends> {
        self.judgment()?.ends
    }

    /// The axis as it is to be drawn, while it is dragged too.
    pub fn ends(&self) -> Option<Ends> {
        self.moving.or(self.set_ends())
    }

    /// Whether edits can be made: edit mode, of a cloud whose files are open.
    pub fn can_edit(&self) -> bool {
        self.is_editing && self.subject.is_some() && self.saving != Saving::Opening
    }

    /// The end that the next click sets; `None` if a click sets none.
    pub fn next_end(&self) -> Option<Handle> {
        match self.draft {
            _ if !self.can_edit() => None,
            Draft::Base(_) => Some(Handle::BlossomEnd),
            Draft::Anew => Some(Handle::PeduncleBase),
            Draft::None => self.judgment().is_none().then_some(Handle::PeduncleBase),
        }
    }

    /// Whether something is not on the disk that ought to be.
    pub fn is_unsaved(&self) -> bool {
        matches!(self.saving, Saving::Saving) || self.has_failed()
    }

    /// Whether something could not be written. Edits wait for it.
    pub fn has_failed(&self) -> bool {
        let waits = matches!(self.saving, Saving::Failed(_)) && self.judgment().is_some();
        waits || !self.unsaved_elsewhere.is_empty()
    }

    /// The cloud that is looked at goes.
    pub(in crate::app) fn leave_subject(&mut self) {
        self.subject = None;
        self.drop_draft();
        self.landing = None;
    }

    /// Gives up what is half done with the mouse.
    pub(super) fn drop_draft(&mut self) {
        self.draft = Draft::None;
        self.let_go();
    }

    /// Lets go of what is held, without moving it.
    pub(super) fn let_go(&mut self) {
        (self.grabbed, self.moving) = (None, None);
    }

    /// An analyzed cloud with the present annotations, which may be newer than those that were read with it.
    pub(in crate::app) fn with_annotations(&self, mut walked: AnalyzedFruit) -> AnalyzedFruit {
        let file = &walked.fruit.file;
        let annotated = self.annotated.as_ref();
        let is_it = annotated.is_some_and(|(path, sha256)| *path == file.path && *sha256 == file.sha256);
        if is_it && walked.fruit.annotations != self.annotations {
            let mut fruit = (*walked.fruit).clone();
            fruit.annotations.clone_from(&self.annotations);
            walked.fruit = Arc::new(fruit);
        }
        walked
    }

    /// The number of open clouds with this annotator's axis, and the number of all.
    pub fn progress(&self) -> Option<(usize, usize)> {
        let set = self.mine.iter().filter(|&&is_mine| is_mine).count();
        (!self.mine.is_empty()).then_some((set, self.mine.len()))
    }

    /// The step of the buttons that turn, in degrees.
    pub fn step_deg(&self) -> f64 {
        NUDGES_DEG[self.step.min(NUDGES_DEG.len() - 1)]
    }
}
