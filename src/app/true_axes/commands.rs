//! The commands about axes set by hand.

use glam::{DVec2, DVec3};

use super::handles::{EditView, Handle};
use super::state::Ghost;
use crate::annotate::{Confidence, Ends, Method, Pivot, Role};

/// A direction in which an axis is turned, as seen in the large view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// Within the picture, clockwise.
    Picture,
    /// The peduncle's base away from the viewer.
    Lean,
}

/// The source of the adjudicated axis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Decision {
    /// The mean of the annotators' axes.
    Mean,
    /// The axis of the annotator with this name.
    Of(String),
    /// One that is set by hand.
    ByHand,
}

/// Something that is asked about axes set by hand.
#[derive(Debug, Clone, PartialEq)]
pub enum TrueAxesCommand {
    /// Enter edit mode, or leave it.
    Edit(bool),
    /// The annotator's name; edit mode follows where it waits for one.
    Name(String),
    /// No name, and no edit mode.
    WithoutName,
    /// The role in which axes are set.
    Role(Role),
    /// Hide everything computed, or show it.
    Blind(bool),
    /// The results of the open clouds are on the screen: as a table, charts, pictures or a map.
    ResultsShown,
    /// Draw everybody's axes, or only one's own.
    ShowAll(bool),

    /// The point at which a click would land.
    Hover(Option<DVec3>),
    /// Set the next end.
    Place(DVec3),
    /// Set both ends anew.
    Anew,
    /// Out of whatever is half done, or else of edit mode.
    Escape,
    /// Take hold of a handle.
    Grab {
        /// The handle.
        handle: Handle,
        /// The view in which it is held.
        view: EditView,
        /// The cursor's position, in the view's pixels.
        at_px: DVec2,
    },
    /// Move what is held.
    Drag(DVec3),
    /// Let go: the axis counts where it is.
    Drop,
    /// The axis as a number is dragged.
    Preview(Ends),
    /// The axis by its ends.
    SetEnds(Ends),
    /// Turn the axis.
    Nudge(Turn, f64),
    /// The step of the buttons that turn, as an index.
    Step(usize),
    /// The point of the axis that stays when it is turned.
    Hold(Pivot),
    /// Exchange the ends.
    Flip,
    /// Start from an axis that is known.
    Start(Method),
    /// The ghost that checks the axis.
    Ghost(Ghost),
    /// The annotator's confidence.
    Confidence(Option<Confidence>),
    /// The annotator's note.
    Note(String),
    /// The cloud does not show its axis.
    CannotTell,
    /// Take back the last edit of the axis.
    Undo,
    /// Take back the last undo.
    Redo,
    /// Write what could not be written.
    TryAgain,

    /// The next cloud without an axis of this annotator's.
    NextWithout,
    /// Compare the annotators over all open clouds.
    CompareSet,
    /// Stop doing so.
    CancelSet,
    /// Set the adjudicated axis.
    Decide(Decision),
}
