//! The histogram of a cloud's hues, for the bar on which a range of them is chosen.

use crate::geometry::Cloud;
use crate::peduncle::hue_deg;

/// A histogram of hues.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hues {
    /// Points in each bin of [`Hues::BIN_DEG`], from 0° upward.
    pub counts: Vec<usize>,
    /// Points that are too gray to have a hue.
    pub gray: usize,
    /// The cloud, by its file's SHA-256.
    pub(super) sha256: String,
}

impl Hues {
    /// The width of a bin in degrees.
    pub const BIN_DEG: usize = 5;

    /// The histogram of a cloud; `None` if it has no colors.
    pub fn of(cloud: &Cloud, sha256: &str) -> Option<Self> {
        let mut counts = vec![0; 360 / Self::BIN_DEG];
        let mut gray = 0;
        for &color in cloud.colors()? {
            match hue_deg(color) {
                // From 0 to less than 360, but for rounding.
                Some(hue) => counts[(hue as usize / Self::BIN_DEG).min(360 / Self::BIN_DEG - 1)] += 1,
                None => gray += 1,
            }
        }
        Some(Self {
            counts,
            gray,
            sha256: sha256.into(),
        })
    }
}
