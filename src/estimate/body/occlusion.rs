//! The occlusion of a fruit, from the outline of its fitted body.

use super::outline::{Comparison, Outline};
use crate::estimate::Occlusion;

/// Classifies how much of a fruit is hidden.
pub(super) fn occlusion(outline: &Outline, comparison: &Comparison) -> Occlusion {
    let _ = outline;
    if comparison.seen_share < 0.5 {
        Occlusion::Serious
    } else if comparison.seen_share < 0.85 {
        Occlusion::Light
    } else {
        Occlusion::None
    }
}
