//! The commands about the peduncle.

use std::path::PathBuf;

use glam::DVec2;

use crate::fruit::PeduncleChoice;

/// A path that a dialog of the desktop asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PedunclePath {
    /// The peduncle's file.
    File,
    /// The folder of the clouds without their peduncles.
    Removed,
    /// The file that the companion is written to.
    SaveAs,
}

/// Something that is asked for about the peduncle.
#[derive(Debug, Clone, PartialEq)]
pub enum PeduncleCommand {
    /// The tool was dragged to a place of the view, in logical pixels, beginning a stroke or going on.
    Draw {
        /// The place.
        at_px: DVec2,
        /// Whether the stroke takes points away; counts where it begins.
        removes: bool,
    },
    /// The button was let go: the stroke counts.
    EndStroke,
    /// The stroke under way does not count.
    DropStroke,
    /// Add the neighbors of the selected points.
    Grow,
    /// Take the selected points away that have neighbors which are not selected.
    Shrink,
    /// Select nothing.
    Clear,
    /// Select what is not selected.
    Invert,
    /// Set the brush's radius in logical pixels.
    BrushRadius(f64),
    /// Whether hidden points are taken as well.
    Through(bool),
    /// Set the reach of growing, in multiples of the points' median spacing.
    Reach(f64),
    /// Highlight the peduncle, or no longer.
    Preview(bool),
    /// Choose the source of the peduncle.
    Choose(PeduncleChoice),
    /// A file was dropped that may be the open cloud's peduncle.
    Offer(PathBuf),
    /// Write the peduncle's points beside the cloud, under the companion's name.
    Save,
    /// Write them there, whatever is there.
    SaveAs(PathBuf),
    /// Drop the question.
    Dismiss,
    /// Compute the analyses with and without the peduncle, or no longer.
    Compare(bool),
    /// Ask for a path in a dialog of the desktop: the window's part.
    Ask(PedunclePath),
}
