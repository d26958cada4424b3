//! Growing and shrinking of a selection of points.

use std::num::NonZeroUsize;

use glam::DVec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rustc_hash::FxHashSet;

use crate::geometry::{Extent, PointSet};
use crate::neighbors::Neighbors;
use crate::parallel::{Cancelled, Watch, map_pieces};

/// The number of places at which a spacing is measured.
const SAMPLES: usize = 2000;

/// The number of queries of one piece of work.
const PIECE: usize = 4096;

/// The median distance from a point to its nearest neighbor at another place, in the points' unit; `None` if all points
/// are at one place.
pub fn median_spacing(points: &[DVec3]) -> Option<f64> {
    // Each place once: copies of a point are no neighbors, and a k-d tree is slow on many of them.
    let mut seen = FxHashSet::default();
    let places: Vec<[f64; 3]> = points
        .iter()
        .map(|&p| (p + 0.0).to_array())
        .filter(|place| seen.insert(place.map(f64::to_bits)))
        .collect();
    if places.len() < 2 {
        return None;
    }
    let tree = ImmutableKdTree::<f64, 3>::new_from_slice(&places).ok()?;
    let two = const { NonZeroUsize::new(2).expect("it is two") };
    let step = points.len().div_ceil(SAMPLES);
    let mut distances: Vec<f64> = points
        .iter()
        .step_by(step)
        .filter_map(|p| {
            let query = p.to_array();
            let near = (tree.query(&query))
                .nearest_n::<SquaredEuclidean<f64>>(two)
                .execute();
            let other = places[near.get(1)?.item as usize];
            Some(p.distance(DVec3::from_array(other)))
        })
        .collect();
    if distances.is_empty() {
        return None;
    }
    let middle = distances.len() / 2;
    Some(*distances.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The selected points and all that lie within `reach` of one of them, in the points' unit.
///
/// # Errors
/// Returns [`Cancelled`] if the watch calls the work off.
pub fn grown(
    points: &[DVec3],
    selected: &PointSet,
    reach: f64,
    watch: &dyn Watch,
) -> Result<PointSet, Cancelled> {
    let mask = selected.mask(points.len());
    let near = within(points, &mask, true, reach, watch)?;
    Ok(selected.iter().chain(near).collect())
}

/// The selected points without those that lie within `reach` of one that is not selected.
///
/// # Errors
/// Returns [`Cancelled`] if the watch calls the work off.
pub fn shrunk(
    points: &[DVec3],
    selected: &PointSet,
    reach: f64,
    watch: &dyn Watch,
) -> Result<PointSet, Cancelled> {
    let mut mask = selected.mask(points.len());
    for i in within(points, &mask, false, reach, watch)? {
        mask[i] = false;
    }
    Ok(PointSet::of_mask(&mask))
}

/// The points whose flag is not `of`, within `reach` of one whose flag is.
fn within(
    points: &[DVec3],
    mask: &[bool],
    of: bool,
    reach: f64,
    watch: &dyn Watch,
) -> Result<Vec<usize>, Cancelled> {
    // Only what is near the selection can be near its edge, on either side.
    let selected = (0..points.len()).filter(|&i| mask[i]).map(|i| points[i]);
    let Some(around) = box_around(selected) else {
        return Ok(Vec::new());
    };
    let (low, high) = (around.min - 2.0 * reach, around.max + 2.0 * reach);
    let is_near = |i: &usize| points[*i].cmpge(low).all() && points[*i].cmple(high).all();
    let (sources, asking): (Vec<usize>, Vec<usize>) =
        (0..points.len()).filter(is_near).partition(|&i| mask[i] == of);
    let places: Vec<DVec3> = sources.iter().map(|&i| points[i]).collect();
    let Some(index) = Neighbors::new_watched(&places, watch)? else {
        return Ok(Vec::new());
    };
    let found = map_pieces(asking.len(), PIECE, watch, |range| {
        let asking = &asking[range];
        let queries: Vec<DVec3> = asking.iter().map(|&i| points[i]).collect();
        let nearest = index.nearest_of_each(&queries);
        let close = asking.iter().zip(nearest);
        close
            .filter(|(_, n)| n.distance_squared <= reach * reach)
            .map(|(&i, _)| i)
            .collect::<Vec<_>>()
    })?;
    Ok(found.concat())
}

fn box_around(points: impl Iterator<Item = DVec3>) -> Option<Extent> {
    points.fold(None, |extent: Option<Extent>, p| {
        let e = extent.unwrap_or(Extent { min: p, max: p });
        Some(Extent {
            min: e.min.min(p),
            max: e.max.max(p),
        })
    })
}
