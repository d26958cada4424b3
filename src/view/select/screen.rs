//! The projections of points in a view, and whether other points hide them.

use glam::{DVec2, DVec3};

use super::Region;
use crate::parallel::map_pieces;
use crate::render::{Camera, Viewport};

/// The projections of a cloud's points in one view. It is made once for a camera and serves every move of a brush.
#[derive(Debug, Clone)]
pub struct Screen {
    /// One per point, in logical pixels; not finite behind the camera.
    pixels: Vec<DVec2>,
    is_hidden: Vec<bool>,
}

/// The number of points of one piece of work.
const PIECE: usize = 1 << 15;

/// A surface may fall away by so many pixels' lengths within a pixel of a cell and still be one surface.
const SLOPE: f64 = 4.0;

impl Screen {
    /// Projects all points. Of the points within a cell of `disc_px` pixels, the diameter of a drawn point, those well
    /// behind the nearest are hidden.
    pub fn new(points: &[DVec3], camera: &Camera, viewport: Viewport, disc_px: f64) -> Self {
        let project = |range: std::ops::Range<usize>| -> Vec<(DVec2, f64)> {
            let one = |&p: &DVec3| {
                let pixel = camera.project(p, viewport).unwrap_or(DVec2::NAN);
                (pixel, camera.depth_of(p))
            };
            points[range].iter().map(one).collect()
        };
        // Without a watch, nothing is called off.
        let projected: Vec<(DVec2, f64)> = map_pieces(points.len(), PIECE, &(), project)
            .unwrap_or_default()
            .concat();
        let cell_px = disc_px.clamp(2.0, 32.0);
        let cells = Cells::of(viewport, cell_px);
        let mut nearest = vec![f64::INFINITY; cells.count()];
        for (pixel, depth) in &projected {
            if let Some(cell) = cells.at(*pixel) {
                nearest[cell] = nearest[cell].min(*depth);
            }
        }
        let is_hidden = projected.iter().map(|(pixel, depth)| {
            // What is outside of the view is not seen either.
            cells.at(*pixel).is_none_or(|cell| {
                let front = nearest[cell];
                *depth > front + SLOPE * cell_px * camera.pixel_size_at(front, viewport).abs()
            })
        });
        Self {
            is_hidden: is_hidden.collect(),
            pixels: projected.into_iter().map(|(pixel, _)| pixel).collect(),
        }
    }

    /// The projection of a point, in logical pixels; `None` behind the camera.
    pub fn pixel(&self, point: usize) -> Option<DVec2> {
        self.pixels[point].is_finite().then(|| self.pixels[point])
    }

    /// Whether other points lie before it, or it is outside of the view.
    pub fn is_hidden(&self, point: usize) -> bool {
        self.is_hidden[point]
    }

    /// Adds the points in a region to a mask, one flag a point, or takes them out of it: only those that
    /// are not hidden, or all of them, `through` the cloud.
    pub fn mark(&self, region: &Region, removes: bool, through: bool, mask: &mut [bool]) {
        let takes = |i: usize| (through || !self.is_hidden[i]) && region.contains(self.pixels[i]);
        let found = map_pieces(mask.len().min(self.pixels.len()), PIECE, &(), |range| {
            range.filter(|&i| takes(i)).collect::<Vec<_>>()
        });
        for i in found.into_iter().flatten().flatten() {
            mask[i] = !removes;
        }
    }
}

/// The view in square cells.
struct Cells {
    edge_px: f64,
    columns: usize,
    rows: usize,
}

impl Cells {
    fn of(viewport: Viewport, edge_px: f64) -> Self {
        // A view has some thousand pixels each way, and is clamped should it claim more.
        let along = |px: f64| (px / edge_px).ceil().clamp(1.0, 10_000.0) as usize;
        Self {
            edge_px,
            columns: along(viewport.width_px),
            rows: along(viewport.height_px),
        }
    }

    fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// The cell of a pixel; `None` outside of the view.
    fn at(&self, pixel: DVec2) -> Option<usize> {
        let cell = (pixel / self.edge_px).floor();
        let size = DVec2::new(self.columns as f64, self.rows as f64);
        // False for what is not a number.
        let is_inside = cell.cmpge(DVec2::ZERO).all() && cell.cmplt(size).all();
        is_inside.then(|| cell.y as usize * self.columns + cell.x as usize)
    }
}
