//! The views in which an axis is edited, and its handles.

use glam::DVec3;

use crate::annotate::Ends;

/// A view in which the axis is edited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EditView {
    /// The large one.
    Main,
    /// The axis upright, seen from the depth camera's side.
    Front,
    /// The axis upright, seen from a right angle to that.
    Side,
    /// Along the axis, from the peduncle.
    EndOn,
}

impl EditView {
    /// The locked ones, in the order of [`TrueAxesState::locked`].
    pub const LOCKED: [Self; 3] = [Self::Front, Self::Side, Self::EndOn];

    /// The name in the interface.
    pub fn title(self) -> &'static str {
        match self {
            Self::Main => "View",
            Self::Front => "Front",
            Self::Side => "Side",
            Self::EndOn => "End-on",
        }
    }
}

/// A part of an axis that can be dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Handle {
    /// The peduncle's base.
    PeduncleBase,
    /// The blossom end.
    BlossomEnd,
    /// The middle: the axis as a whole.
    Middle,
}

impl Handle {
    /// All of them; where they lie over one another, the first is grabbed.
    pub const ALL: [Self; 3] = [Self::PeduncleBase, Self::BlossomEnd, Self::Middle];

    /// The name in the interface.
    pub fn title(self) -> &'static str {
        match self {
            Self::PeduncleBase => "Peduncle base",
            Self::BlossomEnd => "Blossom end",
            Self::Middle => "Whole axis",
        }
    }

    /// The position on an axis.
    pub fn place(self, ends: &Ends) -> DVec3 {
        match self {
            Self::PeduncleBase => ends.peduncle_base(),
            Self::BlossomEnd => ends.blossom_end(),
            Self::Middle => ends.middle(),
        }
    }
}
