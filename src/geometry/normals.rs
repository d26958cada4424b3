//! Surface normals by fitting a plane to each point's neighborhood (Eq. 2).

#![allow(
    clippy::inline_always,
    reason = "only what is inlined is built for each kind of vector instructions"
)]

use std::num::NonZeroUsize;
use std::ops::Range;

use glam::DVec3;

use super::Spread;
use crate::neighbors::Neighbors;
use crate::parallel::map_pieces;
use crate::parallel::{Cancelled, Watch};

/// Points whose neighborhoods are fitted between two checks of the watch: a few milliseconds.
const PIECE: usize = 512;

/// Estimates a unit normal at each point: the direction in which its `k` nearest points vary least,
/// the point itself among them (Eq. 2), turned towards `viewpoint`.
///
/// `None` if the neighborhood is degenerate: fewer than three distinct points, or all on a line.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
pub fn estimate_normals(
    points: &[DVec3],
    k: NonZeroUsize,
    viewpoint: DVec3,
    watch: &dyn Watch,
) -> Result<Vec<Option<DVec3>>, Cancelled> {
    let Some(neighbors) = Neighbors::new_watched(points, watch)? else {
        return Ok(Vec::new());
    };
    // Neighbors of close places lie in the same memory.
    let pieces = map_pieces(neighbors.distinct(), PIECE, watch, |range| {
        // Built for the widest vector instructions that this machine has. All round alike.
        pulp::Arch::new().dispatch(FitNormals {
            points,
            neighbors: &neighbors,
            range,
            k,
            viewpoint,
        })
    })?;
    let mut normals = vec![None; points.len()];
    for (place, normal) in pieces.into_iter().flatten().enumerate() {
        for &i in neighbors.points_at(place) {
            normals[i as usize] = normal;
        }
    }
    Ok(normals)
}

/// The normals of a range of places, in the neighbors' order.
struct FitNormals<'a> {
    points: &'a [DVec3],
    neighbors: &'a Neighbors,
    range: Range<usize>,
    k: NonZeroUsize,
    viewpoint: DVec3,
}

impl pulp::NullaryFnOnce for FitNormals<'_> {
    type Output = Vec<Option<DVec3>>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let mut normals = Vec::with_capacity(self.range.len());
        let (mut found, mut weighted) = (Vec::new(), Vec::new());
        for place in self.range.clone() {
            self.neighbors.around(place, self.k, &mut found);
            // Points that lie at one place weigh as many times, up to k in all.
            let mut left = self.k.get();
            weighted.clear();
            for &(_, at) in &found {
                let here = self.neighbors.points_at(at as usize);
                let taken = here.len().min(left);
                left -= taken;
                weighted.push((self.points[here[0] as usize], taken as f64));
            }
            let here = self.points[self.neighbors.points_at(place)[0] as usize];
            normals.push(fitted_normal(&weighted, here, self.viewpoint));
        }
        normals
    }
}

/// The normal at `point` of the points around it with their weights.
#[inline(always)]
fn fitted_normal(weighted: &[(DVec3, f64)], point: DVec3, viewpoint: DVec3) -> Option<DVec3> {
    if weighted.len() < 3 {
        return None;
    }
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
