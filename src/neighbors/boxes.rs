//! Oriented bounding boxes, and the distances from a point to sixteen of them at a time.

use glam::{DMat3, DVec3, Vec3};
use pulp::Simd;

use super::lanes::{ROUNDING, SUM_ROUNDING, rounding_of_squared, times_plus};

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
        let mut covariance = DMat3::ZERO;
        for &p in points {
            let q = p - mean;
            covariance += DMat3::from_cols(q * q.x, q * q.y, q * q.z);
        }
        // The extents are measured along the axes as they are stored.
        let axes = principal_axes(covariance).map(DVec3::as_vec3);
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

/// Unit vectors at right angles, about along the principal axes of points with a covariance.
fn principal_axes(covariance: DMat3) -> [DVec3; 3] {
    // The columns of powers turn towards the axis of the largest variance.
    let mut power = covariance;
    for _ in 0..4 {
        let trace = power.x_axis.x + power.y_axis.y + power.z_axis.z;
        power *= 1.0 / trace;
        power = power * power;
    }
    let columns = [power.x_axis, power.y_axis, power.z_axis];
    let longest = columns
        .into_iter()
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let Some(first) = longest.and_then(DVec3::try_normalize) else {
        return DVec3::AXES;
    };
    // The other two lie in the plane across: an angle remains.
    let (u, v) = first.any_orthonormal_pair();
    let (along_u, along_v) = (covariance * u, covariance * v);
    let (sin, cos) = (0.5 * (2.0 * along_u.dot(v)).atan2(along_u.dot(u) - along_v.dot(v))).sin_cos();
    [first, cos * u + sin * v, cos * v - sin * u]
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
            let rounding = ROUNDING * reach * reach + rounding_of_squared(reach);
            group.squared[lane] = o.length_squared() as f32 - rounding;
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

    /// The box that is most promising for the nearest point to `from`: the nearest one, unless it is so much
    /// larger than another that it may hold nothing nearby.
    pub(super) fn most_promising<S: Simd>(&self, from: &[f64; 3]) -> usize {
        let excesses = self.excesses::<S>(from, 0.0);
        let promise = |&i: &usize| {
            let [x, y, z] = self.half.map(|half| half[i] * half[i]);
            excesses[i] + (x + y + z) * (1.0 / 64.0)
        };
        (0..WIDTH)
            .min_by(|a, b| promise(a).total_cmp(&promise(b)))
            .unwrap_or(0)
    }
}
