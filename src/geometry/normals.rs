//! Surface normals by fitting a plane to each point's neighborhood (Eq. 2).

use std::num::NonZeroUsize;

use glam::DVec3;

use super::parallel::map_pieces;
use super::{Cancelled, Neighbors, Spread, Watch};

/// Points whose neighborhoods are fitted between two looks at the watch: a few milliseconds.
const PIECE: usize = 512;

/// Estimates a unit normal at each point: the direction in which its `k` nearest points vary least,
/// the point itself among them (Eq. 2), turned towards `viewpoint`.
///
/// `None` where the neighborhood is degenerate: fewer than three distinct points, or all on a line.
///
/// # Errors
/// [`Cancelled`] when the watch calls the work off.
pub fn estimate_normals(
    points: &[DVec3],
    k: NonZeroUsize,
    viewpoint: DVec3,
    watch: &dyn Watch,
) -> Result<Vec<Option<DVec3>>, Cancelled> {
    let Some(neighbors) = Neighbors::new(points) else {
        return Ok(Vec::new());
    };
    // Neighbors of close points lie in the same memory.
    let order = neighbors.order();
    let pieces = map_pieces(points.len(), PIECE, watch, |range| {
        order[range]
            .iter()
            .map(|&i| fitted_normal(points, &neighbors, points[i as usize], k, viewpoint))
            .collect::<Vec<_>>()
    })?;
    let mut normals = vec![None; points.len()];
    for (&i, normal) in order.iter().zip(pieces.into_iter().flatten()) {
        normals[i as usize] = normal;
    }
    Ok(normals)
}

fn fitted_normal(
    points: &[DVec3],
    neighbors: &Neighbors,
    point: DVec3,
    k: NonZeroUsize,
    viewpoint: DVec3,
) -> Option<DVec3> {
    let places = neighbors.nearest_places(point, k);
    if places.len() < 3 {
        return None;
    }
    // Points that lie at one place weigh as many times, up to k in all.
    let mut left = k.get();
    let weighted: Vec<(DVec3, f64)> = places
        .iter()
        .map(|n| {
            let taken = n.multiplicity.min(left);
            left -= taken;
            (points[n.index], taken as f64)
        })
        .collect();
    let spread = Spread::of(weighted.iter().copied())?;
    if spread.is_line() {
        return None;
    }
    let normal = spread.axes[0].normalize();
    Some(if normal.dot(viewpoint - point) < 0.0 {
        -normal
    } else {
        normal
    })
}
