//! How a cloud's hues are spread, for the bar that a range of them is chosen on.

use crate::app::App;
use crate::fruit::PeduncleChoice;
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
    sha256: String,
}

impl Hues {
    /// The width of a bin in degrees.
    pub const BIN_DEG: usize = 5;

    /// Of a cloud; `None` where it has no colors.
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

impl App {
    pub(in crate::app) fn update_hues(&mut self) {
        if let Some(Ok(hues)) = self.peduncle.hues.take() {
            self.state.peduncle.hues = hues.map(std::sync::Arc::new);
        }
        let is_wanted = matches!(self.state.settings.request.peduncle, PeduncleChoice::Hue(_));
        let Some(walked) = self.state.current_walked().filter(|_| is_wanted).cloned() else {
            return;
        };
        let sha256 = &walked.fruit.file.sha256;
        if self.peduncle.asked_hues.as_ref() == Some(sha256) {
            return;
        }
        self.peduncle.asked_hues = Some(sha256.clone());
        if self
            .state
            .peduncle
            .hues
            .as_ref()
            .is_some_and(|h| h.sha256 != *sha256)
        {
            self.state.peduncle.hues = None;
        }
        self.peduncle
            .hues
            .submit(move |_| Hues::of(walked.fruit.cloud(), &walked.fruit.file.sha256));
        if let Some(Ok(hues)) = self.peduncle.hues.take_within(crate::app::PATIENCE) {
            self.state.peduncle.hues = hues.map(std::sync::Arc::new);
        }
    }
}
