//! The two filters that the paper's data went through (§ 2.1): statistical outliers and a voxel grid.

use std::num::NonZeroUsize;

use glam::{DVec3, I64Vec3, Vec3};

use super::parallel::map_pieces;
use super::{Cancelled, Cloud, Neighbors, Watch};

/// The indices of the points that are no outliers: those whose mean distance to their `neighbors`
/// nearest other points is at most the cloud's mean of that distance plus `std_ratio` times its
/// standard deviation. Ascending.
///
/// # Errors
/// [`Cancelled`] when the watch calls the work off.
pub fn statistical_inliers(
    points: &[DVec3],
    neighbors: NonZeroUsize,
    std_ratio: f64,
    watch: &dyn Watch,
) -> Result<Vec<usize>, Cancelled> {
    let Some(index) = Neighbors::new(points) else {
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
        // The point met itself, at distance zero.
        if met > 1 { sum / (met - 1) as f64 } else { 0.0 }
    };
    let means = map_pieces(points.len(), 512, watch, |range| {
        range.map(mean_distance).collect::<Vec<_>>()
    })?
    .concat();
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let variance = means.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count;
    let limit = mean + std_ratio * variance.sqrt();
    Ok((0..points.len()).filter(|&i| means[i] <= limit).collect())
}

/// One point for each occupied cube of edge `edge` (the points' unit, positive): the mean position
/// of the points in it, their mean normal and color, and their most frequent label (the lowest of
/// equals). Cubes are anchored at the origin, so that a cloud's neighbor in a set is cut alike; they
/// come in the order of their lowest point index.
pub fn voxel_grid(cloud: &Cloud, edge: f64) -> Cloud {
    let cell = |p: DVec3| -> I64Vec3 { (p / edge).floor().as_i64vec3() };
    let points = cloud.positions();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_cached_key(|&i| {
        let c = cell(points[i]);
        (c.x, c.y, c.z, i)
    });
    let mut voxels: Vec<&[usize]> = order
        .chunk_by(|&a, &b| cell(points[a]) == cell(points[b]))
        .collect();
    voxels.sort_unstable_by_key(|members| members[0]);

    let mean = |members: &[usize]| members.iter().map(|&i| points[i]).sum::<DVec3>() / members.len() as f64;
    let filtered = Cloud::new(voxels.iter().map(|m| mean(m)).collect());
    let normals = cloud.normals().map(|normals| {
        let mean = |m: &&[usize]| m.iter().map(|&i| normals[i]).sum::<Vec3>().normalize_or_zero();
        voxels.iter().map(mean).collect()
    });
    let colors = cloud
        .colors()
        .map(|colors| voxels.iter().map(|m| mean_color(colors, m)).collect());
    let labels = cloud
        .labels()
        .map(|labels| voxels.iter().map(|m| majority(labels, m)).collect());
    filtered.with_columns(normals, colors, labels)
}

fn mean_color(colors: &[[u8; 4]], members: &[usize]) -> [u8; 4] {
    std::array::from_fn(|channel| {
        let sum: u64 = members.iter().map(|&i| u64::from(colors[i][channel])).sum();
        let count = members.len() as u64;
        // A mean of bytes is a byte.
        ((sum + count / 2) / count) as u8
    })
}

fn majority(labels: &[i32], members: &[usize]) -> i32 {
    let mut found: Vec<i32> = members.iter().map(|&i| labels[i]).collect();
    found.sort_unstable();
    let mut best: &[i32] = &[];
    for same in found.chunk_by(i32::eq) {
        if same.len() > best.len() {
            best = same;
        }
    }
    best.first().copied().unwrap_or(Cloud::FRUIT)
}
