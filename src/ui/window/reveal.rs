//! A tab that was asked for, brought into sight where its bar is too narrow for all of its tabs.

use egui::Response;
use egui_tiles::{Tabs, TileId};

/// The most frames that it takes: arrows that appear beside the tabs move them again.
const MOST_FRAMES: u32 = 12;

/// A tab that is to be seen, and how far it is out of sight.
#[derive(Debug, Clone, Copy)]
pub struct Reveal {
    tile: TileId,
    /// The way in logical pixels that the tabs have to move to the left.
    by: f32,
    frames: u32,
}

impl Reveal {
    /// Asks for the tab of a pane.
    pub fn new(tile: TileId) -> Self {
        Self {
            tile,
            by: 0.0,
            frames: 0,
        }
    }

    /// Measures the button of a tab; ends with the one that was asked for in sight.
    pub fn measure(asked: &mut Option<Self>, tile: TileId, button: &Response) {
        let Some(reveal) = asked.as_mut().filter(|reveal| reveal.tile == tile) else {
            return;
        };
        let (whole, seen) = (button.rect, button.interact_rect);
        // One wider than its bar is seen from its left edge.
        let right = (whole.right() - seen.right()).max(0.0);
        let left = (seen.left() - whole.left()).max(0.0);
        reveal.by = if left > 0.0 { -left } else { right };
        reveal.frames += 1;
        if reveal.frames >= MOST_FRAMES {
            *asked = None;
        } else {
            // It takes a frame until a new tab has its place.
            button.ctx.request_repaint();
        }
    }

    /// Moves the tabs of a bar that has the tab.
    pub fn scroll(&mut self, tabs: &Tabs, offset: &mut f32) {
        if tabs.children.contains(&self.tile) {
            *offset += std::mem::take(&mut self.by);
        }
    }
}
