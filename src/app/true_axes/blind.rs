//! Blind mode: nothing computed is shown, so that it cannot draw the annotator's hand.

use super::commands::TrueAxesCommand::{ShowAll, Start};
use crate::app::command::Command;
use crate::app::estimators::EstimatorsCommand;
use crate::app::many::ManyCommand;
use crate::app::state::State;
use crate::app::tool::Tool;
use crate::view::{Coloring, Overlay, Style, ViewPreset};

/// Overlays that show, or give away, what was computed.
const COMPUTED: [Overlay; 9] = [
    Overlay::Plane,
    Overlay::Normal,
    Overlay::Center,
    Overlay::Axis,
    Overlay::Reference,
    Overlay::References,
    Overlay::Ghost,
    Overlay::Partners,
    Overlay::Caption,
];

impl State {
    /// The style in which the cloud is drawn: as chosen, but for what blind mode hides.
    pub fn shown_style(&self) -> Style {
        let mut style = self.style.clone();
        if self.true_axes.is_blind {
            for overlay in COMPUTED {
                style.overlays.set(overlay, false);
            }
            if style.coloring.needs_plane() {
                let has_colors = self.shown().is_some_and(|shown| shown.colors.is_some());
                style.coloring = if has_colors {
                    Coloring::Rgb
                } else {
                    Coloring::Normal
                };
            }
        }
        style
    }

    /// The warnings that are shown: in blind mode those of the file alone.
    pub fn shown_warnings(&self) -> &[String] {
        match (&self.walked, self.true_axes.is_blind) {
            (Some(walked), true) => &walked.fruit.warnings,
            (None, true) => &[],
            (_, false) => &self.warnings,
        }
    }
}

impl State {
    /// Whether results of the open clouds that a panel shows are still to be counted as seen.
    pub fn has_unseen_results(&self) -> bool {
        !self.true_axes.is_blind && self.true_axes.seen_rows != Some(self.many.generation)
    }
}

impl Command {
    /// Whether it shows what was computed, or is about that alone.
    pub fn reveals(&self) -> bool {
        matches!(
            self,
            Self::LookAt(_)
                | Self::Step(_)
                | Self::StepRank(_)
                | Self::Preview(Some(_))
                | Self::Play(true)
                | Self::MoveCenter(_)
                | Self::Use(Tool::MoveCenter)
                | Self::View(ViewPreset::Normal | ViewPreset::Axis)
                | Self::Estimators(EstimatorsCommand::Count(_) | EstimatorsCommand::Show(_, true))
                | Self::TrueAxes(Start(_) | ShowAll(true))
                | Self::Many(ManyCommand::GoWorse(_))
        )
    }
}

/// Whether an overlay shows what was computed.
pub fn overlay_reveals(overlay: Overlay) -> bool {
    COMPUTED.contains(&overlay)
}
