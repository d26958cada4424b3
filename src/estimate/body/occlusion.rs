//! The occlusion of a fruit, from the outline of its fitted body.

use super::outline::{Comparison, Outline};
use crate::estimate::Occlusion;

/// Estimates the share of the fruit's cross-section that is seen, 0 to 1.
///
/// The body reaches beyond the seen points where something hides it, but a little everywhere, as grazing surface is not
/// measured; and where something hides it, less than the fruit does. A line was fitted to the shares that a leaf hides of
/// simulated peppers (seeds 20000 to 20149, 20400 to 20549, 21400 to 21499), from which it is off by 0.036 (standard
/// deviation).
pub(super) fn seen_share(outline: &Outline, comparison: &Comparison) -> f64 {
    let hidden = 1.227 - 1.116 * comparison.seen_share - 0.156 * outline.contour_share();
    (1.0 - hidden).clamp(0.0, 1.0)
}

/// Classifies how much of a fruit is hidden.
pub(super) fn occlusion(seen_share: f64) -> Occlusion {
    if seen_share <= 0.5 {
        Occlusion::Serious
    } else if seen_share < 0.9 {
        Occlusion::Light
    } else {
        Occlusion::None
    }
}
