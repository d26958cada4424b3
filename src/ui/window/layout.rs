//! The panels and how they are arranged; people move them about.

use egui_tiles::{Container, Linear, LinearDir, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

/// A panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Pane {
    /// The 3-D view.
    View,
    /// The open clouds.
    Files,
    /// Every number and choice.
    Parameters,
    /// The u × u map of scores.
    ScoreMap,
    /// The normals on a hemisphere.
    Hemisphere,
    /// The planes by rank.
    Ranking,
    /// Why one point scores as it does.
    Point,
    /// How the contributions are spread.
    Contributions,
    /// The open clouds as a table.
    Table,
    /// Their errors as charts.
    Charts,
    /// Their pictures, worst first.
    Gallery,
    /// The mean error over u and τ.
    Sweep,
    /// Axes set by hand.
    TrueAxis,
}

impl Pane {
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::View,
        Self::Files,
        Self::Parameters,
        Self::ScoreMap,
        Self::Hemisphere,
        Self::Ranking,
        Self::Point,
        Self::Contributions,
        Self::Table,
        Self::Charts,
        Self::Gallery,
        Self::Sweep,
        Self::TrueAxis,
    ];

    /// Whether a key brings it to the front.
    pub(in crate::ui) fn has_key(self) -> bool {
        matches!(
            self,
            Self::View | Self::Table | Self::Charts | Self::Gallery | Self::Sweep
        )
    }

    /// What its tab says.
    pub fn title(self) -> &'static str {
        match self {
            Self::View => "View",
            Self::Files => "Clouds",
            Self::Parameters => "Parameters",
            Self::ScoreMap => "Score map",
            Self::Hemisphere => "Hemisphere",
            Self::Ranking => "Ranking",
            Self::Point => "Why this score?",
            Self::Contributions => "Contributions",
            Self::Table => "Table",
            Self::Charts => "Charts",
            Self::Gallery => "Gallery",
            Self::Sweep => "Sweep",
            Self::TrueAxis => "True axes",
        }
    }
}

/// Windows of less width have one column of panels.
const WIDE: f32 = 1000.0;

/// The arrangement at first: clouds and parameters on the left, the view, and the planes and points
/// on the right; in a narrow window all of them on the left.
pub fn first_layout(window_width: f32) -> Tree<Pane> {
    if !is_wide(window_width) {
        return narrow_layout();
    }
    let mut tiles = Tiles::default();
    let [
        view,
        files,
        parameters,
        map,
        hemisphere,
        ranking,
        point,
        contributions,
        table,
        charts,
        gallery,
        sweep,
        true_axis,
    ] = Pane::ALL.map(|pane| tiles.insert_pane(pane));
    let left = tiles.insert_tab_tile(vec![parameters, files, true_axis]);
    let above = tiles.insert_tab_tile(vec![map, hemisphere]);
    let middle = tiles.insert_tab_tile(vec![ranking]);
    let below = tiles.insert_tab_tile(vec![point, contributions]);
    // A tab tile shows its first child unless told otherwise.
    for (tabs, first) in [
        (left, parameters),
        (above, map),
        (middle, ranking),
        (below, point),
    ] {
        if let Some(egui_tiles::Tile::Container(Container::Tabs(tabs))) = tiles.get_mut(tabs) {
            tabs.set_active(first);
        }
    }
    let right = linear(
        &mut tiles,
        LinearDir::Vertical,
        &[(above, 1.25), (middle, 0.8), (below, 1.0)],
    );
    let view_tabs = view_tabs(&mut tiles, vec![view, table, charts, gallery, sweep]);
    let root = linear(
        &mut tiles,
        LinearDir::Horizontal,
        &[(left, 0.9), (view_tabs, 2.6), (right, 1.1)],
    );
    Tree::new(egui::Id::unique("panels"), root, tiles)
}

/// Whether a window of this width, in logical pixels, has room for panels on both sides.
pub(in crate::ui) fn is_wide(window_width: f32) -> bool {
    window_width >= WIDE
}

fn narrow_layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let [
        view,
        files,
        parameters,
        map,
        hemisphere,
        ranking,
        point,
        contributions,
        table,
        charts,
        gallery,
        sweep,
        true_axis,
    ] = Pane::ALL.map(|pane| tiles.insert_pane(pane));
    let above = tiles.insert_tab_tile(vec![parameters, files, true_axis, point, contributions]);
    let below = tiles.insert_tab_tile(vec![map, hemisphere, ranking]);
    for (tabs, first) in [(above, parameters), (below, map)] {
        if let Some(egui_tiles::Tile::Container(Container::Tabs(tabs))) = tiles.get_mut(tabs) {
            tabs.set_active(first);
        }
    }
    let left = linear(&mut tiles, LinearDir::Vertical, &[(above, 1.0), (below, 1.0)]);
    let view_tabs = view_tabs(&mut tiles, vec![view, table, charts, gallery, sweep]);
    let root = linear(
        &mut tiles,
        LinearDir::Horizontal,
        &[(left, 0.66), (view_tabs, 1.0)],
    );
    Tree::new(egui::Id::unique("panels"), root, tiles)
}

/// The view, with what shows all clouds behind it.
fn view_tabs(tiles: &mut Tiles<Pane>, panes: Vec<TileId>) -> TileId {
    let view = panes[0];
    let id = tiles.insert_tab_tile(panes);
    if let Some(egui_tiles::Tile::Container(Container::Tabs(tabs))) = tiles.get_mut(id) {
        tabs.set_active(view);
    }
    id
}

fn linear(tiles: &mut Tiles<Pane>, dir: LinearDir, children: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(dir, children.iter().map(|(id, _)| *id).collect());
    for &(id, share) in children {
        linear.shares.set_share(id, share);
    }
    tiles.insert_container(linear)
}

/// The arrangement that a text describes; `None` where it lacks a panel or makes no sense.
pub fn layout_from(text: &str) -> Option<Tree<Pane>> {
    let tree: Tree<Pane> = serde_json::from_str(text).ok()?;
    let has_all = Pane::ALL.iter().all(|pane| tree.tiles.find_pane(pane).is_some());
    (has_all && tree.root.is_some()).then_some(tree)
}
