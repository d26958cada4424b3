//! Statistical outliers: the first of the two filters that the paper's data went through (§ 2.1).

use std::num::NonZeroUsize;

use glam::DVec3;

use crate::neighbors::Neighbors;
use crate::parallel::map_pieces;
use crate::parallel::{Cancelled, Watch};

/// Returns the indices of the points that are not outliers, ascending: those whose mean distance to their `neighbors`
/// nearest other points is at most the cloud's mean of that distance plus `std_ratio` times its
/// sample standard deviation, with n − 1, as in PCL's `StatisticalOutlierRemoval`.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
pub fn statistical_inliers(
    points: &[DVec3],
    neighbors: NonZeroUsize,
    std_ratio: f64,
    watch: &dyn Watch,
) -> Result<Vec<usize>, Cancelled> {
    let Some(index) = Neighbors::new_watched(points, watch)? else {
        return Ok(Vec::new());
    };
    let with_itself = neighbors.saturating_add(1);
    let mean_distance = |i: usize| {
        let (mut left, mut sum, mut met) = (with_itself.get(), 0.0, 0);
        for n in index.nearest_places(points[i], with_itself) {
            let taken = n.multiplicity.min(left);
            left -= taken;
            met += taken;
            sum += taken as f64 * n.distance_squared.sqrt();
        }
        // The point itself is among them, at distance zero.
        if met > 1 { sum / (met - 1) as f64 } else { 0.0 }
    };
    let means = map_pieces(points.len(), 512, watch, |range| {
        range.map(mean_distance).collect::<Vec<_>>()
    })?
    .concat();
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let squares = means.iter().map(|d| (d - mean).powi(2)).sum::<f64>();
    // A single point has no spread.
    let variance = squares / (count - 1.0).max(1.0);
    let limit = mean + std_ratio * variance.sqrt();
    Ok((0..points.len()).filter(|&i| means[i] <= limit).collect())
}
