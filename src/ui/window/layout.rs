//! The arrangement of the panes, at first and as stored.

use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};

use crate::ui::pane::Pane;

/// The width in logical pixels from which the panes stand on both sides of the view.
const WIDE: f32 = 1000.0;

/// Returns the first arrangement. In a wide window: clouds and parameters on the left, the view in the middle,
/// planes and points on the right; in a narrow one all panes on the left of the view.
pub fn first_layout(window_width: f32) -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let view = tabs(
        &mut tiles,
        &[Pane::View, Pane::Table, Pane::Charts, Pane::Gallery, Pane::Sweep],
    );
    let columns = if is_wide(window_width) {
        let left = tabs(
            &mut tiles,
            // The one on demand first: in a narrow bar the last may be out of sight.
            &[Pane::Simulate, Pane::Parameters, Pane::Clouds, Pane::TrueAxes],
        );
        let above = tabs(&mut tiles, &[Pane::ScoreMap, Pane::Hemisphere]);
        let middle = tabs(&mut tiles, &[Pane::Ranking, Pane::Estimators]);
        let below = tabs(&mut tiles, &[Pane::WhyThisScore, Pane::Contributions]);
        let right = linear(
            &mut tiles,
            LinearDir::Vertical,
            &[(above, 1.25), (middle, 0.8), (below, 1.0)],
        );
        vec![(left, 0.9), (view, 2.6), (right, 1.1)]
    } else {
        let above = tabs(
            &mut tiles,
            &[
                Pane::Simulate,
                Pane::Parameters,
                Pane::Clouds,
                Pane::TrueAxes,
                Pane::WhyThisScore,
                Pane::Contributions,
            ],
        );
        let below = tabs(
            &mut tiles,
            &[Pane::ScoreMap, Pane::Hemisphere, Pane::Ranking, Pane::Estimators],
        );
        let left = linear(&mut tiles, LinearDir::Vertical, &[(above, 1.0), (below, 1.0)]);
        vec![(left, 0.66), (view, 1.0)]
    };
    let root = linear(&mut tiles, LinearDir::Horizontal, &columns);
    hide_on_demand(&mut tiles);
    Tree::new(egui::Id::unique("panels"), root, tiles)
}

/// Hides the panes that wait until somebody asks for them.
fn hide_on_demand(tiles: &mut Tiles<Pane>) {
    for pane in Pane::ALL.iter().filter(|pane| pane.is_on_demand()) {
        if let Some(tile) = tiles.find_pane(pane) {
            tiles.set_visible(tile, false);
        }
    }
}

/// Whether a window of this width, in logical pixels, has room for panes on both sides.
pub(in crate::ui) fn is_wide(window_width: f32) -> bool {
    window_width >= WIDE
}

/// Inserts panes as tabs of one tile, the first of them in front.
fn tabs(tiles: &mut Tiles<Pane>, panes: &[Pane]) -> TileId {
    let children = panes.iter().map(|pane| tiles.insert_pane(*pane)).collect();
    tiles.insert_tab_tile(children)
}

fn linear(tiles: &mut Tiles<Pane>, dir: LinearDir, children: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(dir, children.iter().map(|(id, _)| *id).collect());
    for &(id, share) in children {
        linear.shares.set_share(id, share);
    }
    tiles.insert_container(linear)
}

/// Returns the pane beside which a pane on demand gets its tab.
fn neighbor(pane: Pane) -> Pane {
    match pane {
        Pane::Estimators => Pane::Ranking,
        _ => Pane::Parameters,
    }
}

/// Reads a stored arrangement; returns `None` if the text is malformed or lacks a pane. One of a version before the panes
/// on demand gets them, hidden.
pub fn layout_from(text: &str) -> Option<Tree<Pane>> {
    let mut tree: Tree<Pane> = serde_json::from_str(text).ok()?;
    for pane in Pane::ALL.into_iter().filter(|pane| pane.is_on_demand()) {
        if tree.tiles.find_pane(&pane).is_none() {
            let beside = tree.tiles.find_pane(&neighbor(pane))?;
            let group = tree.tiles.parent_of(beside)?;
            let tile = tree.tiles.insert_pane(pane);
            tree.tiles.set_visible(tile, false);
            match tree.tiles.get_mut(group) {
                Some(Tile::Container(Container::Tabs(tabs))) if pane == Pane::Simulate => {
                    tabs.children.insert(0, tile);
                }
                Some(Tile::Container(container)) => container.add_child(tile),
                _ => {}
            }
        }
    }
    let has_all = Pane::ALL.iter().all(|pane| tree.tiles.find_pane(pane).is_some());
    (has_all && tree.root.is_some()).then_some(tree)
}
