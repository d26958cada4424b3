//! A lasso: a closed line and its inside.

use glam::DVec2;

/// A polygon in which many pixels are looked up. A place that it surrounds an even number of times is outside, as in most
/// programs.
#[derive(Debug, Clone)]
pub struct Lasso {
    low: DVec2,
    high: DVec2,
    /// For each row of pixels from `low.y` on, the edges that cross it: a row's points ask few of them.
    rows: Vec<Vec<(DVec2, DVec2)>>,
}

/// The most rows that are kept; a view has fewer.
const MOST_ROWS: f64 = 20_000.0;

impl Lasso {
    /// A lasso around the corners, the last of which joins the first. With fewer than three it is empty.
    pub fn new(corners: &[DVec2]) -> Self {
        let corners: Vec<DVec2> = corners.iter().copied().filter(|c| c.is_finite()).collect();
        let low = corners.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = corners.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        let mut lasso = Self {
            low,
            high,
            rows: Vec::new(),
        };
        if corners.len() < 3 || (high.y - low.y) > MOST_ROWS {
            return lasso;
        }
        lasso.rows = vec![Vec::new(); lasso.row(high.y) + 1];
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            let (from, to) = (lasso.row(a.y.min(b.y)), lasso.row(a.y.max(b.y)));
            for row in &mut lasso.rows[from..=to] {
                row.push((a, b));
            }
        }
        lasso
    }

    /// Not below zero, since nothing lies under `low`.
    fn row(&self, y: f64) -> usize {
        (y - self.low.y).floor().max(0.0) as usize
    }

    /// Whether a pixel lies inside.
    pub fn contains(&self, pixel: DVec2) -> bool {
        if !(pixel.cmpge(self.low).all() && pixel.cmple(self.high).all()) {
            return false;
        }
        let Some(edges) = self.rows.get(self.row(pixel.y)) else {
            return false;
        };
        let is_crossed = |&&(a, b): &&(DVec2, DVec2)| {
            (a.y > pixel.y) != (b.y > pixel.y) && pixel.x < a.x + (pixel.y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        edges.iter().filter(is_crossed).count() % 2 == 1
    }
}
