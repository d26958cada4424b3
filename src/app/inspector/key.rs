//! The input of an analysis.

use crate::app::source::Source;
use crate::fruit::Request;

/// Everything that an analysis of the current cloud depends on.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app) struct AnalysisKey {
    pub(in crate::app) source: Source,
    pub(in crate::app) request: Request,
    /// The number of times that the user asked to read a cloud again.
    pub(in crate::app) reloads: u64,
}
