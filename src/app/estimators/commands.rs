//! The commands about estimates.

use crate::estimate::{Estimator, Prior};

/// A part of the fitted body that the view can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyPart {
    /// Its axis.
    Axis,
    /// The other axes that were considered.
    Alternatives,
    /// Its surface.
    Surface,
}

/// Something that is asked about estimates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EstimatorsCommand {
    /// Let an estimator's axis count: the paper's or the body's.
    Count(Estimator),
    /// Show a part of the fitted body in the view, or hide it.
    Show(BodyPart, bool),
    /// Fit the body with another assumption about the axis.
    Prior(Prior),
}
