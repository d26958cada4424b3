//! Boxes around nearby points, turned to lie along them, sixteen at a time in single precision.
//!
//! A piece of a surface is thin across and wide along. A box that lies along it is thin too, which
//! tells apart pieces that are all nearly as far from a point well off the surface: boxes along the
//! coordinate axes leave hundreds of them to look into.

use glam::DVec3;
use pulp::Simd;

use super::lanes::{BLOCK, Lanes};
use crate::geometry::eigen::about_eigenvectors;

/// Boxes that are tested together.
pub(super) const WIDTH: usize = 16;

/// What rounding may add to a distance from a box, a unit of what is added up for it (how far the
/// query is from where the box is measured from, and how far the box reaches from there): 18
/// roundings of 2^-24, and as much again for safety.
pub(super) const SLACK: f32 = 2.2e-6;

/// `a * b + c`, rounded once where the machine can. Only where a bound on rounding is kept
/// anyway: the last digit depends on the machine.
#[inline(always)]
pub(super) fn times_plus<S: Simd>(a: f32, b: f32, c: f32) -> f32 {
    // All machines with vectors that wide can.
    if S::F32_LANES >= 8 || cfg!(target_arch = "aarch64") {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}

/// Up to [`WIDTH`] boxes, each number of all of them side by side.
#[derive(Debug, Clone)]
// No vector straddles two lines of the cache.
#[repr(C, align(64))]
pub(super) struct Boxes {
    axes: [[[f32; WIDTH]; 3]; 3],
    /// The boxes' centers along their axes, negative, seen from `center`.
    offset: [[f32; WIDTH]; 3],
    half: [[f32; WIDTH]; 3],
    /// The same seen from each box's own point.
    own_offset: [[f32; WIDTH]; 3],
    /// A point among the boxes, and how far they reach from it at most. Seen from the middle of all
    /// points, which may be far away, single precision could not tell small boxes apart.
    center: [f64; 3],
    radius: f32,
}

impl Boxes {
    /// No box: infinitely far from everything.
    pub(super) const NONE: Self = Self {
        axes: [[[0.0; WIDTH]; 3]; 3],
        offset: [[0.0; WIDTH]; 3],
        half: [[f32::NEG_INFINITY; WIDTH]; 3],
        own_offset: [[0.0; WIDTH]; 3],
        center: [0.0; 3],
        radius: 0.0,
    };

    /// No box yet, of those that lie around `center`.
    pub(super) fn around(center: DVec3) -> Self {
        Self {
            center: center.to_array(),
            ..Self::NONE
        }
    }

    /// All boxes of `parts`, of which each but the last has `size`; all parts have the same center.
    pub(super) fn together(parts: &[Self], size: usize) -> Self {
        let mut all = Self::NONE;
        for (part, boxes) in parts.iter().enumerate() {
            all.center = boxes.center;
            all.radius = all.radius.max(boxes.radius);
            for lane in 0..size {
                let to = part * size + lane;
                for e in 0..3 {
                    for f in 0..3 {
                        all.axes[e][f][to] = boxes.axes[e][f][lane];
                    }
                    all.offset[e][to] = boxes.offset[e][lane];
                    all.half[e][to] = boxes.half[e][lane];
                    all.own_offset[e][to] = boxes.own_offset[e][lane];
                }
            }
        }
        all
    }

    /// Puts the box around `points` (in the boxes' frame) into `lane`. `own` is a point among them.
    pub(super) fn set(
        &mut self,
        lane: usize,
        own: DVec3,
        points: impl ExactSizeIterator<Item = DVec3> + Clone,
    ) {
        let count = points.len() as f64;
        let center = DVec3::from_array(self.center);
        let points = points.map(|p| p - center);
        let mean = points.clone().sum::<DVec3>() / count;
        let mut m = [0.0; 6];
        for p in points.clone() {
            let q = p - mean;
            m[0] += q.x * q.x;
            m[1] += q.x * q.y;
            m[2] += q.x * q.z;
            m[3] += q.y * q.y;
            m[4] += q.y * q.z;
            m[5] += q.z * q.z;
        }
        let axes = about_eigenvectors(m);
        // What is stored is what the extents are measured along.
        let axes = axes.map(DVec3::as_vec3);
        let along = |p: DVec3| DVec3::from_array(axes.map(|a| a.as_dvec3().dot(p)));
        let (low, high) = points.fold(
            (DVec3::splat(f64::INFINITY), DVec3::splat(f64::NEG_INFINITY)),
            |(low, high), p| (low.min(along(p)), high.max(along(p))),
        );
        let middle = 0.5 * (low + high);
        let half = 0.5 * (high - low);
        let own = along(own - center);
        for e in 0..3 {
            self.own_offset[e][lane] = (own[e] - middle[e]) as f32;
            self.offset[e][lane] = -middle[e] as f32;
            self.half[e][lane] = half[e] as f32;
            for f in 0..3 {
                self.axes[e][f][lane] = axes[e][f];
            }
        }
        let reach = low.abs().max(high.abs()).length() as f32;
        self.radius = self.radius.max(reach * (1.0 + SLACK));
    }

    /// The squared distances from `from` (in the boxes' frame) to the boxes, so much less that a box
    /// is surely farther away than `reach` where they exceed its square.
    #[inline(always)]
    pub(super) fn distances_squared<S: Simd>(&self, from: [f64; 3], reach: f32) -> [f32; WIDTH] {
        let mut q = [0.0; 3];
        for e in 0..3 {
            q[e] = (from[e] - self.center[e]) as f32;
        }
        let slack = SLACK * (q[0].abs() + q[1].abs() + q[2].abs() + self.radius);
        // Plain loops over lanes, which the compiler turns into vector instructions.
        let less = slack * (2.0 * reach + slack);
        let mut sum = [0.0; WIDTH];
        for e in 0..3 {
            let ([ax, ay, az], offset, half) = (&self.axes[e], &self.offset[e], &self.half[e]);
            for i in 0..WIDTH {
                let along = times_plus::<S>(ax[i], q[0], offset[i]);
                let along = times_plus::<S>(ay[i], q[1], along);
                let along = times_plus::<S>(az[i], q[2], along);
                let outside = along.abs() - half[i];
                // Not `max`, whose rule for NaN costs instructions.
                let outside = if outside > 0.0 { outside } else { 0.0 };
                sum[i] = times_plus::<S>(outside, outside, sum[i]);
            }
        }
        for i in 0..WIDTH {
            sum[i] -= less;
        }
        sum
    }

    /// Whether any query lies within its reach of the box in `lane`; NaN counts as within. The box's
    /// own point is seen at `own` from where the queries are seen from, at most `size` is added up for
    /// any of them, and none reaches farther than `farthest`.
    #[inline(always)]
    pub(super) fn any_within<S: Simd>(
        &self,
        (lane, own, size): (usize, [f32; 3], f32),
        queries: &[Lanes; 3],
        (reach_squared, farthest): (&Lanes, f32),
    ) -> bool {
        let slack = SLACK * size;
        let less = slack * (2.0 * farthest + slack);
        let [x, y, z] = queries;
        let mut sum = [0.0; BLOCK];
        for e in 0..3 {
            let axes = &self.axes[e];
            let (ax, ay, az) = (axes[0][lane], axes[1][lane], axes[2][lane]);
            let (offset, half) = (self.own_offset[e][lane], self.half[e][lane]);
            let offset = times_plus::<S>(ax, -own[0], offset);
            let offset = times_plus::<S>(ay, -own[1], offset);
            let offset = times_plus::<S>(az, -own[2], offset);
            for i in 0..BLOCK {
                let along = times_plus::<S>(ax, x.0[i], offset);
                let along = times_plus::<S>(ay, y.0[i], along);
                let along = times_plus::<S>(az, z.0[i], along);
                let outside = along.abs() - half;
                let outside = if outside > 0.0 { outside } else { 0.0 };
                sum[i] = times_plus::<S>(outside, outside, sum[i]);
            }
        }
        let mut beyond = true;
        for i in 0..BLOCK {
            beyond &= sum[i] - less > reach_squared.0[i];
        }
        !beyond
    }
}
