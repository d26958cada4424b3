//! The panes of the window, by the titles on their tabs.

use serde::{Deserialize, Serialize};

/// A pane. Stored layouts name panes by their variants, three of them by older names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Pane {
    /// The 3-D view.
    View,
    /// The list of open clouds.
    #[serde(rename = "Files")]
    Clouds,
    /// The parameters of the analysis.
    Parameters,
    /// The u × u map of scores.
    ScoreMap,
    /// The hemisphere of the candidate normals.
    Hemisphere,
    /// The planes by rank.
    Ranking,
    /// The steps that lead to one point's score.
    #[serde(rename = "Point")]
    WhyThisScore,
    /// The histogram of the points' contributions.
    Contributions,
    /// The table of the open clouds.
    Table,
    /// The charts of their errors.
    Charts,
    /// Their pictures, largest error first.
    Gallery,
    /// The mean error over u and τ.
    Sweep,
    /// The axes set by hand.
    #[serde(rename = "TrueAxis")]
    TrueAxes,
    /// The simulated pepper.
    Simulate,
    /// The axis by several estimators.
    Estimators,
}

impl Pane {
    /// All panes.
    pub const ALL: [Self; 15] = [
        Self::View,
        Self::Clouds,
        Self::Parameters,
        Self::ScoreMap,
        Self::Hemisphere,
        Self::Ranking,
        Self::WhyThisScore,
        Self::Contributions,
        Self::Table,
        Self::Charts,
        Self::Gallery,
        Self::Sweep,
        Self::TrueAxes,
        Self::Simulate,
        Self::Estimators,
    ];

    /// Whether the pane has no tab until somebody asks for it.
    pub(in crate::ui) fn is_on_demand(self) -> bool {
        matches!(self, Self::Simulate | Self::Estimators)
    }

    /// Whether a key brings the pane to the front.
    pub(in crate::ui) fn has_key(self) -> bool {
        matches!(
            self,
            Self::View | Self::Table | Self::Charts | Self::Gallery | Self::Sweep
        )
    }

    /// The title on the pane's tab.
    pub fn title(self) -> &'static str {
        match self {
            Self::View => "View",
            Self::Clouds => "Clouds",
            Self::Parameters => "Parameters",
            Self::ScoreMap => "Score map",
            Self::Hemisphere => "Hemisphere",
            Self::Ranking => "Ranking",
            Self::WhyThisScore => "Why this score?",
            Self::Contributions => "Contributions",
            Self::Table => "Table",
            Self::Charts => "Charts",
            Self::Gallery => "Gallery",
            Self::Sweep => "Sweep",
            Self::TrueAxes => "True axes",
            Self::Simulate => "Simulate",
            Self::Estimators => "Estimators",
        }
    }
}
