//! A voxel grid: the second filter of the paper's data (§ 2.1), and a way to thin a cloud that is too
//! large to be analyzed whole.

use glam::{DVec3, I64Vec3, Vec3};

use super::Cloud;
use crate::parallel::sort_unstable;
use crate::parallel::{Cancelled, Watch};

/// Thins a cloud to one point for each occupied cube of edge `edge` (the points' unit, positive): the mean
/// position of the points in it, their mean normal and color, and their most frequent label (the lowest of
/// equals). Cubes are anchored at the origin, so that the clouds of a set are cut alike; they
/// come in the order of their lowest point index.
pub fn voxel_grid(cloud: &Cloud, edge: f64) -> Cloud {
    // Without a watch nothing is called off.
    voxel_grid_watched(cloud, edge, &()).unwrap_or_default()
}

/// [`voxel_grid`], called off by a watch.
pub(crate) fn voxel_grid_watched(cloud: &Cloud, edge: f64, watch: &dyn Watch) -> Result<Cloud, Cancelled> {
    let points = cloud.positions();
    let (order, starts) = by_cell(points, edge, watch)?;
    let mut voxels: Vec<&[usize]> = starts.windows(2).map(|w| &order[w[0]..w[1]]).collect();
    voxels.sort_unstable_by_key(|members| members[0]);
    watch.go_on()?;

    let mean = |members: &[usize]| {
        let mean = members.iter().map(|&i| points[i]).sum::<DVec3>() / members.len() as f64;
        // The sum of the largest numbers is infinite, and an infinite point is none.
        if mean.is_finite() {
            mean
        } else {
            points[members[0]]
        }
    };
    let filtered = Cloud::new(voxels.iter().map(|&m| mean(m)).collect());
    watch.go_on()?;
    let normals = cloud.normals().map(|normals| {
        let mean = |m: &&[usize]| m.iter().map(|&i| normals[i]).sum::<Vec3>().normalize_or_zero();
        voxels.iter().map(mean).collect()
    });
    watch.go_on()?;
    let colors = cloud
        .colors()
        .map(|colors| voxels.iter().map(|m| mean_color(colors, m)).collect());
    let labels = cloud
        .labels()
        .map(|labels| voxels.iter().map(|m| majority(labels, m)).collect());
    Ok(filtered.with_columns(normals, colors, labels))
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

fn cell(p: DVec3, edge: f64) -> I64Vec3 {
    (p / edge).floor().as_i64vec3()
}

/// The bits of a cell's number along an axis, if three of them make one key.
const BITS: u32 = 21;

/// The points' indices, cell by cell and ascending in each, and the start of each cell among them, with
/// the end of the last.
pub(crate) fn by_cell(
    points: &[DVec3],
    edge: f64,
    watch: &dyn Watch,
) -> Result<(Vec<usize>, Vec<usize>), Cancelled> {
    let (mut low, mut high) = (I64Vec3::MAX, I64Vec3::MIN);
    for piece in points.chunks(1 << 20) {
        watch.go_on()?;
        for &p in piece {
            let cell = cell(p, edge);
            (low, high) = (low.min(cell), high.max(cell));
        }
    }
    // Three numbers in one where they fit: a third of the memory and of the time.
    let fits = |e: usize| high[e].checked_sub(low[e]).is_some_and(|range| range < 1 << BITS);
    if (0..3).all(fits) {
        let key = |&p: &DVec3| {
            let c = cell(p, edge) - low;
            (c.x << (2 * BITS) | c.y << BITS | c.z) as u64
        };
        sorted(points.iter().map(key), watch)
    } else {
        sorted(points.iter().map(|&p| cell(p, edge).to_array()), watch)
    }
}

/// All indices, cell by cell, so that points that lie close together are close in the order.
pub(crate) fn near_one_another(points: &[DVec3], edge: f64) -> Vec<usize> {
    // Without a watch nothing is called off.
    by_cell(points, edge, &()).unwrap_or_default().0
}

fn sorted<K: Ord + Send>(
    keys: impl Iterator<Item = K>,
    watch: &dyn Watch,
) -> Result<(Vec<usize>, Vec<usize>), Cancelled> {
    let mut keyed: Vec<(K, usize)> = keys.zip(0..).collect();
    sort_unstable(&mut keyed, watch)?;
    let mut starts = Vec::new();
    let mut start = 0;
    for same in keyed.chunk_by(|a, b| a.0 == b.0) {
        starts.push(start);
        start += same.len();
    }
    starts.push(start);
    Ok((keyed.into_iter().map(|(_, i)| i).collect(), starts))
}

/// An edge, in the points' unit, with which a voxel grid leaves at most `most` of the points, and not
/// many fewer where their number allows it. `None` if no edge is needed, or if none is enough: around
/// the origin eight cells remain however large they are.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
pub fn voxel_edge_for(points: &[DVec3], most: usize, watch: &dyn Watch) -> Result<Option<f64>, Cancelled> {
    /// The most grids that are tried; a surface takes about four.
    const TRIES: usize = 40;
    let (low, high) = points
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| {
            (low.min(p), high.max(p))
        });
    let extent = (high - low).max_element();
    if points.len() <= most || !(extent > 0.0 && extent.is_finite()) {
        return Ok(None);
    }
    // Points on a surface occupy cells as the inverse square of the edge, more or less.
    let aim = 0.93 * most as f64;
    let mut edge = extent / aim.sqrt();
    let (mut too_fine, mut enough): (f64, Option<f64>) = (0.0, None);
    for tried in 0..TRIES {
        watch.go_on()?;
        watch.advanced(tried, TRIES);
        let count = occupied(points, edge, most.saturating_mul(2), watch)?;
        if count <= most {
            enough = Some(edge);
            // Cells much smaller than a billionth of the extent separate no more points.
            if count as f64 >= 0.85 * most as f64 || edge < 1e-9 * extent {
                break;
            }
        } else {
            too_fine = edge;
        }
        let guess = edge * (count as f64 / aim).sqrt();
        edge = match enough {
            Some(enough) if !(too_fine < guess && guess < enough) => {
                if too_fine > 0.0 {
                    (too_fine * enough).sqrt()
                } else {
                    0.25 * enough
                }
            }
            None => guess.max(1.2 * too_fine),
            _ => guess,
        };
        if enough.is_some_and(|enough| enough / edge < 1.0 + 1e-3) {
            break;
        }
    }
    Ok(enough)
}

/// The number of cells of the edge that hold points; counting stops above `most`. Fewer than one cell in
/// a billion is mistaken for another.
fn occupied(points: &[DVec3], edge: f64, most: usize, watch: &dyn Watch) -> Result<usize, Cancelled> {
    let slots = (2 * most).next_power_of_two().max(16);
    let mut table = vec![0u64; slots];
    let mut count = 0;
    for (i, &p) in points.iter().enumerate() {
        // Some hundredths of a second.
        if i % (1 << 20) == 0 {
            watch.go_on()?;
        }
        let c = cell(p, edge).to_array();
        let mixed = c.iter().fold(1u64, |h, &x| {
            let h = (h ^ x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            h ^ (h >> 29)
        });
        // Zero is a free slot.
        let mixed = mixed | 1;
        let mut slot = (mixed >> 20) as usize & (slots - 1);
        while table[slot] != 0 && table[slot] != mixed {
            slot = (slot + 1) & (slots - 1);
        }
        if table[slot] == 0 {
            table[slot] = mixed;
            count += 1;
            if count > most {
                break;
            }
        }
    }
    Ok(count)
}
