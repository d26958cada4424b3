//! Oriented bounding boxes, and the distances from a point to sixteen of them at a time.

use glam::{DVec3, Vec3};
use pulp::Simd;

use super::eigen::about_eigenvectors;
use super::lanes::{HUGE, ROUNDING, SUM_ROUNDING, rounding_of_squared, times_plus};

/// Boxes that are tested together.
pub(super) const WIDTH: usize = 16;

/// A box around points, along their principal axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct OrientedBox {
    /// Unit vectors at right angles, to single precision.
    pub(super) axes: [Vec3; 3],
    pub(super) center: DVec3,
    /// Half the extent along each axis.
    pub(super) half: DVec3,
}

impl OrientedBox {
    /// The box around some points.
    pub(super) fn around(points: &[DVec3]) -> Self {
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        let mut m = [0.0; 6];
        for &p in points {
            let q = p - mean;
            m[0] += q.x * q.x;
            m[1] += q.x * q.y;
            m[2] += q.x * q.z;
            m[3] += q.y * q.y;
            m[4] += q.y * q.z;
            m[5] += q.z * q.z;
        }
        // The extents are measured along the axes as they are stored.
        let axes = about_eigenvectors(m).map(DVec3::as_vec3);
        let [a, b, c] = axes.map(Vec3::as_dvec3);
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &p in points {
            let q = p - mean;
            let along = DVec3::new(a.dot(q), b.dot(q), c.dot(q));
            (low, high) = (low.min(along), high.max(along));
        }
        let middle = 0.5 * (low + high);
        Self {
            axes,
            center: mean + middle.x * a + middle.y * b + middle.z * c,
            half: 0.5 * (high - low),
        }
    }
}

/// Up to [`WIDTH`] boxes, each number of all of them side by side.
///
/// Boxes and points are seen from a point g among the boxes. A box has its center at o, the axes a₁, a₂
/// and a₃, and the half extents hₑ. A point q lies at αₑ = aₑ·(q - o) along them, and its squared distance
/// from the box is |q|² + |o|² - 2 q·o + Σ yₑ (yₑ - 2 |αₑ|), where yₑ is the lesser of |αₑ| and hₑ. The
/// first term is computed in double precision. What rounding may change in the others is small where the
/// boxes are small, however far away they are.
#[derive(Debug, Clone)]
// No vector straddles two lines of the cache.
#[repr(C, align(64))]
pub(super) struct BoxGroup {
    axes: [[[f32; WIDTH]; 3]; 3],
    /// -aₑ·o
    offset: [[f32; WIDTH]; 3],
    half: [[f32; WIDTH]; 3],
    minus_twice_center: [[f32; WIDTH]; 3],
    /// |o|² without the bound on rounding, the rest of which grows with |q| times `rounding`.
    squared: [f32; WIDTH],
    rounding: [f32; WIDTH],
    /// The point g.
    origin: [f64; 3],
}

impl BoxGroup {
    /// A group of some boxes, at most [`WIDTH`].
    pub(super) fn new(boxes: &[OrientedBox]) -> Self {
        let mut group = Self {
            axes: [[[0.0; WIDTH]; 3]; 3],
            offset: [[0.0; WIDTH]; 3],
            half: [[0.0; WIDTH]; 3],
            minus_twice_center: [[0.0; WIDTH]; 3],
            squared: [f32::INFINITY; WIDTH],
            rounding: [0.0; WIDTH],
            // About where the middle one is: no box far from all others moves that away from them.
            origin: std::array::from_fn(|e| {
                let mut along: Vec<f64> = boxes.iter().map(|b| b.center[e]).collect();
                *along.select_nth_unstable_by(boxes.len() / 2, f64::total_cmp).1
            }),
        };
        for (lane, of) in boxes.iter().enumerate() {
            let o = of.center - DVec3::from_array(group.origin);
            for e in 0..3 {
                for f in 0..3 {
                    group.axes[e][f][lane] = of.axes[e][f];
                }
                group.offset[e][lane] = -of.axes[e].as_dvec3().dot(o) as f32;
                group.half[e][lane] = of.half[e] as f32;
                group.minus_twice_center[e][lane] = -2.0 * o[e] as f32;
            }
            let reach = (o.length() + of.half.length()) as f32;
            group.rounding[lane] = ROUNDING * reach;
            group.squared[lane] = if reach * reach < HUGE {
                o.length_squared() as f32 - ROUNDING * reach * reach
            } else {
                f32::NEG_INFINITY
            };
        }
        group
    }

    /// At least what the squared distance from `from` to each box exceeds `reference` by; perhaps NaN
    /// where nothing is known.
    #[inline(always)]
    pub(super) fn excesses<S: Simd>(&self, from: &[f64; 3], reference: f64) -> [f32; WIDTH] {
        let (mut q, mut beyond, mut size) = ([0.0; 3], 0.0, 0.0);
        for e in 0..3 {
            let d = from[e] - self.origin[e];
            beyond += d * d;
            q[e] = d as f32;
            size += q[e].abs();
        }
        let beyond = (beyond - reference) as f32;
        let rounding = SUM_ROUNDING * beyond.abs() + rounding_of_squared(size);
        let mut sum = [beyond - rounding; WIDTH];
        // Plain loops over lanes, which the compiler turns into vector instructions.
        for i in 0..WIDTH {
            let more = times_plus::<S>(-size, self.rounding[i], self.squared[i]);
            let more = times_plus::<S>(self.minus_twice_center[0][i], q[0], more);
            let more = times_plus::<S>(self.minus_twice_center[1][i], q[1], more);
            sum[i] += times_plus::<S>(self.minus_twice_center[2][i], q[2], more);
        }
        for e in 0..3 {
            let ([ax, ay, az], offset, half) = (&self.axes[e], &self.offset[e], &self.half[e]);
            for i in 0..WIDTH {
                let along = times_plus::<S>(ax[i], q[0], offset[i]);
                let along = times_plus::<S>(ay[i], q[1], along);
                let along = times_plus::<S>(az[i], q[2], along).abs();
                // Not `min`, whose rule for NaN costs instructions.
                let inside = if along < half[i] { along } else { half[i] };
                let less = times_plus::<S>(-2.0, along, inside);
                sum[i] = times_plus::<S>(inside, less, sum[i]);
            }
        }
        sum
    }

    /// The box that is most promising for the nearest point to `from`: a near one, and rather a small one,
    /// since a large one may hold nothing nearby.
    pub(super) fn most_promising<S: Simd>(&self, from: &[f64; 3]) -> usize {
        let mut promises = self.excesses::<S>(from, 0.0);
        for i in 0..WIDTH {
            for e in 0..3 {
                promises[i] += self.half[e][i] * self.half[e][i];
            }
        }
        let nearest = (0..WIDTH).min_by(|&a, &b| promises[a].total_cmp(&promises[b]));
        nearest.unwrap_or(0)
    }
}
