//! The commands about the open clouds as a set.

use std::path::PathBuf;

use super::cloud_rows::{Filter, Sort};
use super::sweep_ranges::SweepRanges;
use crate::evaluate::CloudTags;

/// Something that is asked of the set of clouds.
#[derive(Debug, Clone, PartialEq)]
pub enum ManyCommand {
    /// Analyze every open cloud that has no row of the parameters in force.
    Evaluate,
    /// Call that off; what is done stays.
    Cancel,
    /// Sort the table.
    Sort(Sort),
    /// Show some of the clouds only.
    Filter(Box<Filter>),
    /// Show the cloud that is so many places further on in the order of errors, least first.
    GoWorse(isize),
    /// Draw small pictures of these clouds, which are in sight, by their places in the list.
    Picture(Vec<usize>),
    /// Set the ranges of the next sweep.
    SweepRanges(Box<SweepRanges>),
    /// Sweep over them.
    Sweep,
    /// Call the sweep off; the map stays as far as it came.
    CancelSweep,
    /// Analyze with a cell's settings.
    OpenSetting {
        /// Grid steps.
        u: usize,
        /// Weight of angles.
        tau_cm_per_rad: f64,
    },
    /// Save the results in a new folder within this one.
    SaveResults(PathBuf),
    /// Tags and note of a cloud, by its place in the list.
    Tag {
        /// The cloud's place in the list.
        place: usize,
        /// Its tags and note.
        tagged: CloudTags,
    },
}
