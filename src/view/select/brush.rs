//! A brush: a disc that is dragged along a path.

use std::collections::HashMap;

use glam::DVec2;

/// The pixels within a radius of a path.
#[derive(Debug, Clone)]
pub struct Brush {
    radius_px: f64,
    /// Pieces of the path by the cells that they reach: a pixel asks those of its own cell.
    cells: HashMap<[i32; 2], Vec<(DVec2, DVec2)>>,
}

/// The edge of a cell in pixels.
const CELL_PX: f64 = 16.0;

/// Paths may leave the view, but not by this far.
const FARTHEST_PX: f64 = 1e5;

impl Brush {
    /// A brush along a path; a path of one place is a dab.
    pub fn new(path: &[DVec2], radius_px: f64) -> Self {
        let limit = DVec2::splat(FARTHEST_PX);
        let mut path: Vec<DVec2> = path
            .iter()
            .filter(|p| p.is_finite())
            .map(|p| p.clamp(-limit, limit))
            .collect();
        path.dedup();
        let mut brush = Self {
            radius_px,
            cells: HashMap::new(),
        };
        if let [only] = path[..] {
            brush.add(only, only);
        }
        for piece in path.windows(2) {
            // Short pieces reach few cells in vain.
            let steps = (piece[0].distance(piece[1]) / (4.0 * CELL_PX)).ceil().max(1.0) as u32;
            for step in 0..steps {
                let at = |step: u32| piece[0].lerp(piece[1], f64::from(step) / f64::from(steps));
                brush.add(at(step), at(step + 1));
            }
        }
        brush
    }

    fn add(&mut self, from: DVec2, to: DVec2) {
        let low = cell(from.min(to) - self.radius_px);
        let high = cell(from.max(to) + self.radius_px);
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                self.cells.entry([x, y]).or_default().push((from, to));
            }
        }
    }

    /// Whether the disc covered a pixel.
    pub fn contains(&self, pixel: DVec2) -> bool {
        let Some(pieces) = self.cells.get(&cell(pixel)) else {
            return false;
        };
        let reach = self.radius_px * self.radius_px;
        pieces.iter().any(|&(from, to)| {
            let along = to - from;
            let share = (pixel - from).dot(along) / along.length_squared();
            // A dab has no length, and every share of it is its one place.
            let nearest = from
                + along
                    * if share.is_finite() {
                        share.clamp(0.0, 1.0)
                    } else {
                        0.0
                    };
            pixel.distance_squared(nearest) <= reach
        })
    }
}

/// The cell of a pixel, clamped so that every pixel has one.
fn cell(pixel: DVec2) -> [i32; 2] {
    (pixel / CELL_PX)
        .floor()
        .clamp(DVec2::splat(-1e9), DVec2::splat(1e9))
        .to_array()
        .map(|c| c as i32)
}
