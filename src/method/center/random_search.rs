//! The paper's search for the center among random points (Eq. 3, both readings).

use glam::DVec3;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use crate::geometry::Spread;
use crate::parallel::map_pieces;
use crate::parallel::{Cancelled, Watch};

/// The random points that the center is picked from, normally distributed about the cloud's mean.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RandomSearch {
    /// Their number.
    pub count: usize,
    /// Their standard deviation along each coordinate, in multiples of the cloud's (its RMS radius over
    /// √3).
    pub spread: f64,
    /// The seed, which gives the same points on every machine.
    pub seed: u64,
}

impl Default for RandomSearch {
    fn default() -> Self {
        Self {
            count: 10_000,
            spread: 1.0,
            seed: 0,
        }
    }
}

/// Points of the cloud that every random point is first tried on. They tell a deviation to a few percent.
const TRIAL_POINTS: usize = 512;
/// Random points that are drawn between two questions to the watch: some milliseconds.
const DRAWN_AT_ONCE: usize = 1 << 16;
/// The random points for each one that is then tried on the whole cloud.
const TRIED_IN_FULL: usize = 20;

impl RandomSearch {
    /// The largest [`RandomSearch::count`].
    pub const MOST: usize = 10_000_000;

    /// Draws the random points.
    fn points(&self, spread: &Spread, watch: &dyn Watch) -> Result<Vec<DVec3>, Cancelled> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let sigma = self.spread * spread.rms_radius() / 3.0_f64.sqrt();
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut points = Vec::with_capacity(self.count);
        while points.len() < self.count {
            watch.go_on()?;
            let piece = (self.count - points.len()).min(DRAWN_AT_ONCE);
            let point = |_| spread.mean + sigma * DVec3::new(normal(), normal(), normal());
            points.extend((0..piece).map(point));
        }
        Ok(points)
    }

    /// Finds the random point with the least RMS distance to the cloud, which by the parallel axis theorem
    /// is the one nearest to the cloud's mean.
    pub(super) fn least_rms_distance(&self, points: &[DVec3], watch: &dyn Watch) -> Result<DVec3, Cancelled> {
        let Some(spread) = Spread::of_points(points) else {
            return Ok(DVec3::ZERO);
        };
        let tries = self.points(&spread, watch)?;
        let nearest = |a: &&DVec3, b: &&DVec3| {
            a.distance_squared(spread.mean)
                .total_cmp(&b.distance_squared(spread.mean))
        };
        Ok(tries.iter().min_by(nearest).copied().unwrap_or(spread.mean))
    }

    /// Finds the random point whose distances to the cloud have the least standard deviation. On a cloud
    /// of more than [`TRIAL_POINTS`] points, all random points are tried on an even sample of that size,
    /// and the best twentieth of them on the whole cloud.
    pub(super) fn least_deviation(&self, points: &[DVec3], watch: &dyn Watch) -> Result<DVec3, Cancelled> {
        let Some(spread) = Spread::of_points(points) else {
            return Ok(DVec3::ZERO);
        };
        let mut tries = self.points(&spread, watch)?;
        if points.len() > TRIAL_POINTS {
            let sample: Vec<DVec3> = (0..TRIAL_POINTS)
                .map(|i| points[i * points.len() / TRIAL_POINTS])
                .collect();
            let mut tried = deviations(&sample, &tries, watch)?;
            watch.go_on()?;
            let kept = self.count.div_ceil(TRIED_IN_FULL);
            if kept < tried.len() {
                tried.select_nth_unstable_by(kept, least_first);
                tried.truncate(kept);
            }
            watch.go_on()?;
            tried.sort_unstable_by(least_first);
            tries = tried.into_iter().map(|(_, i)| tries[i]).collect();
        }
        let tried = deviations(points, &tries, watch)?;
        let best = tried.into_iter().min_by(least_first);
        Ok(best.map_or(spread.mean, |(_, i)| tries[i]))
    }
}

/// Orders by variance, and equal ones by their index.
fn least_first(a: &(f64, usize), b: &(f64, usize)) -> std::cmp::Ordering {
    a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
}

/// Computes the variance of the distances from each of `tries` to the cloud, with the index of the try.
fn deviations(points: &[DVec3], tries: &[DVec3], watch: &dyn Watch) -> Result<Vec<(f64, usize)>, Cancelled> {
    let columns = Columns::new(points);
    // The watch is asked once in some million distances.
    let piece = (1_000_000 / columns.x.len().max(1)).clamp(1, 64);
    let pieces = map_pieces(tries.len(), piece, watch, |range| {
        range
            .map(|i| (columns.distance_moments(tries[i]).1, i))
            .collect::<Vec<_>>()
    })?;
    Ok(pieces.concat())
}

/// Computes the standard deviation of the distances from `p` to the points, in their unit: Eq. 3 read as
/// the RMS error of the distances about their mean. `None` without points.
pub fn distance_deviation(points: &[DVec3], p: DVec3) -> Option<f64> {
    (!points.is_empty()).then(|| Columns::new(points).distance_moments(p).1.sqrt())
}

/// Computes the RMS distance from `p` to the points, in their unit: Eq. 3 as printed. `None` without
/// points.
pub fn rms_distance(points: &[DVec3], p: DVec3) -> Option<f64> {
    let sum: f64 = points.iter().map(|q| q.distance_squared(p)).sum();
    (!points.is_empty()).then(|| (sum / points.len() as f64).sqrt())
}

/// The points coordinate by coordinate, so that vector instructions take several distances at once.
struct Columns {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
}

impl Columns {
    fn new(points: &[DVec3]) -> Self {
        Self {
            x: points.iter().map(|p| p.x).collect(),
            y: points.iter().map(|p| p.y).collect(),
            z: points.iter().map(|p| p.z).collect(),
        }
    }

    /// Computes the mean and the variance of the distances from `p`.
    fn distance_moments(&self, p: DVec3) -> (f64, f64) {
        const LANES: usize = 8;
        let distance =
            |x: f64, y: f64, z: f64| ((x - p.x).powi(2) + (y - p.y).powi(2) + (z - p.z).powi(2)).sqrt();
        // Deviations are taken from the first distance, since a small variance would lose its digits as
        // the difference of large squares.
        let first = distance(self.x[0], self.y[0], self.z[0]);
        let (mut sum, mut squares) = ([0.0; LANES], [0.0; LANES]);
        let (xs, x_rest) = self.x.as_chunks::<LANES>();
        let (ys, y_rest) = self.y.as_chunks::<LANES>();
        let (zs, z_rest) = self.z.as_chunks::<LANES>();
        for ((x, y), z) in xs.iter().zip(ys).zip(zs) {
            for lane in 0..LANES {
                let d = distance(x[lane], y[lane], z[lane]) - first;
                sum[lane] += d;
                squares[lane] += d * d;
            }
        }
        for ((x, y), z) in x_rest.iter().zip(y_rest).zip(z_rest) {
            let d = distance(*x, *y, *z) - first;
            sum[0] += d;
            squares[0] += d * d;
        }
        let count = self.x.len() as f64;
        let shifted_mean = sum.iter().sum::<f64>() / count;
        let variance = squares.iter().sum::<f64>() / count - shifted_mean * shifted_mean;
        (first + shifted_mean, variance.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_trial_on_a_sample_loses_next_to_nothing() {
        for seed in 0..8 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
            // A bumpy half of a sphere with noise.
            let mut point = || {
                let v = DVec3::new(normal(), normal(), -normal().abs()).normalize();
                (4.0 + 0.2 * (5.0 * v.x).sin() + 0.02 * normal()) * v
            };
            let points: Vec<DVec3> = (0..3000).map(|_| point()).collect();
            let search = RandomSearch {
                count: 2000,
                spread: 1.0,
                seed,
            };
            let found = search.least_deviation(&points, &()).expect("nobody cancels");
            let spread = Spread::of_points(&points).expect("there are points");
            let tries = search.points(&spread, &()).expect("nobody cancels");
            let all = deviations(&points, &tries, &()).expect("nobody cancels");
            let least = all.into_iter().min_by(least_first).expect("there are tries");
            let there = distance_deviation(&points, found).expect("there are points");
            assert!(
                there <= 1.001 * least.0.sqrt(),
                "seed {seed}: {there} {}",
                least.0.sqrt()
            );
        }
    }
}
