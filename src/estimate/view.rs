//! The kind of view that a cloud shows: that of one camera, or several fused.

use glam::DVec3;

use crate::method::is_viewpoint_inside;

/// The kind of view that a cloud shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// The points are what one camera sees from the viewpoint.
    OneCamera,
    /// Points lie behind others, as seen from the viewpoint: several views are fused.
    Fused,
    /// The viewpoint lies among the points.
    Inside,
}

/// Cells along the image's larger side, in which depths are compared.
const CELLS: usize = 24;

/// A gap in depth between points of one cell, in units of the fruit's size, that no single surface shows, except
/// within narrow stripes along a fold.
const GAP: f64 = 0.6;

/// The share of cells with such a gap from which on the cloud is fused. One camera's fruit has such gaps where one lobe
/// hides another, in a few percent of the cells; the far side of a fused scan lies behind most of its near side.
const FUSED_SHARE: f64 = 0.25;

impl View {
    /// Classifies points relative to the viewpoint; `size` is the fruit's, in the same unit.
    pub(super) fn of(points: &[DVec3], size: f64) -> Self {
        if is_viewpoint_inside(points, DVec3::ZERO) {
            return Self::Inside;
        }
        let Some(ahead) = points.iter().sum::<DVec3>().try_normalize() else {
            return Self::Inside;
        };
        let (right, down) = ahead.any_orthonormal_pair();
        let mut placed: Vec<([i64; 2], f64)> = Vec::with_capacity(points.len());
        let image = |p: DVec3| {
            let depth = p.dot(ahead);
            (depth > 0.0).then(|| ([p.dot(right) / depth, p.dot(down) / depth], p.length()))
        };
        let seen: Vec<_> = points.iter().filter_map(|&p| image(p)).collect();
        let side = |e: usize| {
            let of = seen.iter().map(|s| s.0[e]);
            of.clone().fold(f64::NEG_INFINITY, f64::max) - of.fold(f64::INFINITY, f64::min)
        };
        let cell = side(0).max(side(1)) / CELLS as f64;
        if !(cell > 0.0 && cell.is_finite()) {
            return Self::OneCamera;
        }
        placed.extend((seen.iter()).map(|(uv, depth)| (uv.map(|c| (c / cell).floor() as i64), *depth)));
        placed.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let (mut cells, mut layered) = (0_usize, 0_usize);
        for same in placed.chunk_by(|a, b| a.0 == b.0) {
            cells += 1;
            layered += usize::from(same.windows(2).any(|w| w[1].1 - w[0].1 > GAP * size));
        }
        if layered as f64 > FUSED_SHARE * cells as f64 {
            Self::Fused
        } else {
            Self::OneCamera
        }
    }
}
