//! Boxes around nearby points, turned to lie along them, sixteen at a time in single precision.
//!
//! A piece of a surface is thin across and wide along. A box that lies along it is thin too, which
//! tells apart pieces that are all nearly as far from a point well off the surface: boxes along the
//! coordinate axes leave hundreds of them to look into.

use glam::DVec3;
use pulp::Simd;

use super::eigen::about_eigenvectors;
use super::lanes::{BLOCK, Lanes};

/// Boxes that are tested together.
pub(super) const WIDTH: usize = 16;

/// What rounding may add to a distance from a box, a unit of what is added up for it (how far the
/// query is from where the box is measured from, and how far the box reaches from there): 18
/// roundings of 2^-24, and as much again for safety.
pub(super) const SLACK: f32 = 2.2e-6;

/// Boxes that are this many times as far away as they reach are far off; squared.
pub(super) const FAR_OFF_SQUARED: f64 = 256.0 * 256.0;
/// What rounding may add to q·p, a unit of the sizes of both: some 50 roundings, and as much again.
const FAR_OFF_ROUNDING: f32 = 1.0 / (1 << 17) as f32;
/// The same for squared distances computed in double precision, in units of their size and 2.
pub(super) const DOUBLE_ROUNDING: f32 = 1.0 / (1u64 << 48) as f32;
/// More than is lost where products fall below single precision's range.
pub(super) const UNDERFLOW: f32 = 1e-37;

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
    /// A point among the boxes, and how far each reaches from it at most. Seen from the middle of all
    /// points, which may be far away, single precision could not tell small boxes apart.
    center: [f64; 3],
    reach: [f32; WIDTH],
    /// A point in each box, its center along the box's axes, negative, seen from there, and how far the
    /// box reaches from it at most.
    own: [[f64; WIDTH]; 3],
    own_offset: [[f32; WIDTH]; 3],
    own_radius: [f32; WIDTH],
    /// The largest of these, and one that is about as large as most.
    largest: f32,
    typical: f32,
}

impl Boxes {
    /// No box: infinitely far from everything.
    pub(super) const NONE: Self = Self {
        axes: [[[0.0; WIDTH]; 3]; 3],
        offset: [[0.0; WIDTH]; 3],
        half: [[-f32::MAX; WIDTH]; 3],
        center: [0.0; 3],
        reach: [0.0; WIDTH],
        own: [[0.0; WIDTH]; 3],
        own_offset: [[0.0; WIDTH]; 3],
        own_radius: [0.0; WIDTH],
        largest: 0.0,
        typical: 0.0,
    };

    /// No box yet, of those with own points at `own`. They are seen from about the middle one: not even
    /// one that is as wide as all points moves that far from most of them.
    pub(super) fn among(own: &[DVec3]) -> Self {
        let mut boxes = Self::NONE;
        for e in 0..3 {
            let mut along = [0.0; WIDTH];
            let along = &mut along[..own.len()];
            for (to, point) in along.iter_mut().zip(own) {
                *to = point[e];
            }
            let (_, &mut middle, _) = along.select_nth_unstable_by(own.len() / 2, f64::total_cmp);
            boxes.center[e] = middle;
        }
        boxes
    }

    /// To be called once `count` boxes are set.
    pub(super) fn finish(&mut self, count: usize) {
        let mut radii = self.own_radius;
        let radii = &mut radii[..count];
        radii.sort_unstable_by(f32::total_cmp);
        (self.typical, self.largest) = (radii[count / 2], radii[count - 1]);
    }

    /// All boxes of `parts`, of which each but the last has `size`; all parts have the same center.
    pub(super) fn together(parts: &[Self], size: usize) -> Self {
        let mut all = Self::NONE;
        for (part, boxes) in parts.iter().enumerate() {
            all.center = boxes.center;
            for lane in 0..size {
                let to = part * size + lane;
                for e in 0..3 {
                    for f in 0..3 {
                        all.axes[e][f][to] = boxes.axes[e][f][lane];
                    }
                    all.offset[e][to] = boxes.offset[e][lane];
                    all.half[e][to] = boxes.half[e][lane];
                    all.own[e][to] = boxes.own[e][lane];
                    all.own_offset[e][to] = boxes.own_offset[e][lane];
                }
                all.own_radius[to] = boxes.own_radius[lane];
                all.reach[to] = boxes.reach[lane];
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
        let own_along = along(own - center);
        for e in 0..3 {
            self.own[e][lane] = own[e];
            self.own_offset[e][lane] = (own_along[e] - middle[e]) as f32;
            self.offset[e][lane] = -middle[e] as f32;
            self.half[e][lane] = half[e] as f32;
            for f in 0..3 {
                self.axes[e][f][lane] = axes[e][f];
            }
        }
        let reach =
            |from: DVec3| ((low - from).abs().max((high - from).abs())).length() as f32 * (1.0 + SLACK);
        self.reach[lane] = reach(DVec3::ZERO);
        self.own_radius[lane] = reach(own_along);
    }

    /// At least how far each box's points are from `from`.
    #[inline(always)]
    pub(super) fn spans<S: Simd>(&self, from: [f64; 3]) -> [f32; WIDTH] {
        let mut squared = [0.0; WIDTH];
        for e in 0..3 {
            for i in 0..WIDTH {
                let d = (self.own[e][i] - from[e]) as f32;
                squared[i] = times_plus::<S>(d, d, squared[i]);
            }
        }
        let mut spans = [0.0; WIDTH];
        for i in 0..WIDTH {
            spans[i] = (squared[i].sqrt() + self.own_radius[i]) * (1.0 + SLACK);
        }
        spans
    }

    /// How promising each box is for what lies nearest to `from`, the least most of all: by how far it is,
    /// squared, and how large, since a large one may hold nothing nearby.
    #[inline(always)]
    pub(super) fn promises<S: Simd>(&self, from: [f64; 3]) -> [f32; WIDTH] {
        let (_, squared) = self.seen_from(from);
        let root = squared.sqrt() as f32;
        let mut promises = if self.is_far_off(from) {
            self.excesses_far_off::<S>(from, squared, root)
        } else {
            self.excesses_close_by::<S>(from, squared, root)
        };
        for i in 0..WIDTH {
            promises[i] += self.own_radius[i] * self.own_radius[i];
        }
        promises
    }

    /// Where `from` is as seen from the boxes' center, and how far from it, squared.
    #[inline(always)]
    fn seen_from(&self, from: [f64; 3]) -> ([f32; 3], f64) {
        let (mut q, mut squared) = ([0.0; 3], 0.0);
        for e in 0..3 {
            let d = from[e] - self.center[e];
            squared += d * d;
            q[e] = d as f32;
        }
        (q, squared)
    }

    /// Whether boxes are small beside their distance from `from`.
    #[inline(always)]
    pub(super) fn is_far_off(&self, from: [f64; 3]) -> bool {
        let (_, squared) = self.seen_from(from);
        !(squared < FAR_OFF_SQUARED * f64::from(self.typical) * f64::from(self.typical))
    }

    /// What the squared distances from `from` (in the boxes' frame) to the boxes exceed `reference` by,
    /// so much less that a box is surely farther away where they exceed what another squared distance
    /// does, of which `reach` is no less than the root.
    #[inline(always)]
    pub(super) fn excesses_close_by<S: Simd>(
        &self,
        from: [f64; 3],
        reference: f64,
        reach: f32,
    ) -> [f32; WIDTH] {
        let mut q = [0.0; 3];
        for e in 0..3 {
            q[e] = (from[e] - self.center[e]) as f32;
        }
        let size = q[0].abs() + q[1].abs() + q[2].abs();
        let reference = reference as f32;
        let reference = SLACK * reference + reference;
        let mut sum = [0.0; WIDTH];
        for e in 0..3 {
            let ([ax, ay, az], offset, half) = (&self.axes[e], &self.offset[e], &self.half[e]);
            // Plain loops over lanes, which the compiler turns into vector instructions.
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
            let slack = SLACK * (size + self.reach[i]);
            sum[i] -= times_plus::<S>(slack, 2.0 * reach + slack, reference);
        }
        sum
    }

    /// The same where most boxes are small beside their distance, which single precision knows to more
    /// than they measure. With q and p, a point of the box, seen from the box's own point, |q - p|² is
    /// at least |q|² - 2 q·p.
    #[inline(always)]
    pub(super) fn excesses_far_off<S: Simd>(
        &self,
        from: [f64; 3],
        reference: f64,
        reach: f32,
    ) -> [f32; WIDTH] {
        let mut q = [[0.0; WIDTH]; 3];
        let mut beyond = [-reference; WIDTH];
        let mut size = [0.0; WIDTH];
        for e in 0..3 {
            for i in 0..WIDTH {
                let d = from[e] - self.own[e][i];
                beyond[i] += d * d;
                q[e][i] = d as f32;
                size[i] += q[e][i].abs();
            }
        }
        let mut toward = [0.0; WIDTH];
        for e in 0..3 {
            let ([ax, ay, az], offset, half) = (&self.axes[e], &self.own_offset[e], &self.half[e]);
            for i in 0..WIDTH {
                let along = times_plus::<S>(ay[i], q[1][i], ax[i] * q[0][i]);
                let along = times_plus::<S>(az[i], q[2][i], along);
                let most = times_plus::<S>(-along, offset[i], toward[i]);
                toward[i] = times_plus::<S>(along.abs(), half[i], most);
            }
        }
        let mut all = [0.0; WIDTH];
        for i in 0..WIDTH {
            let (beyond, radius) = (beyond[i] as f32, self.own_radius[i]);
            let size = size[i] + radius;
            let rounding = FAR_OFF_ROUNDING * size * radius + rest(beyond, size);
            all[i] = beyond - 2.0 * toward[i] - rounding;
        }
        let (_, squared) = self.seen_from(from);
        if squared < FAR_OFF_SQUARED * f64::from(self.largest) * f64::from(self.largest) {
            // Some boxes are not.
            let close_by = self.excesses_close_by::<S>(from, reference, reach);
            for i in 0..WIDTH {
                all[i] = if close_by[i] > all[i] { close_by[i] } else { all[i] };
            }
        }
        all
    }

    /// Whether the box in `lane` is surely out of every query's reach; not where NaN comes in. The box's
    /// own point is seen at `at` from the queries' middle; `size` is at least the sum of the sizes of its
    /// coordinates, how far the box reaches from there, and the queries from their middle. The squared
    /// reaches exceed |q|² and the reference by `upper`, none by more than the square of `farthest`.
    #[inline(always)]
    pub(super) fn beyond_close_by<S: Simd>(
        &self,
        (lane, at, size): (usize, [f32; 3], f32),
        queries: &[Lanes; 3],
        (upper, squares, reference, farthest): (&Lanes, &Lanes, f32, f32),
    ) -> bool {
        let slack = SLACK * size;
        let less = slack * (2.0 * farthest + slack) + SLACK * reference + reference;
        let [x, y, z] = queries;
        let mut sum = [0.0; BLOCK];
        for e in 0..3 {
            let axes = &self.axes[e];
            let (ax, ay, az) = (axes[0][lane], axes[1][lane], axes[2][lane]);
            let (offset, half) = (self.own_offset[e][lane], self.half[e][lane]);
            let offset = times_plus::<S>(ax, -at[0], offset);
            let offset = times_plus::<S>(ay, -at[1], offset);
            let offset = times_plus::<S>(az, -at[2], offset);
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
            beyond &= sum[i] - less > upper.0[i] + squares.0[i];
        }
        beyond
    }

    /// The same where the box is small beside its distance: its own point's, squared, exceeds the
    /// reference by `beyond`, and `radius` is how far the box reaches from there and the queries from
    /// their middle, together.
    #[inline(always)]
    pub(super) fn beyond_far_off<S: Simd>(
        &self,
        (lane, at, size): (usize, [f32; 3], f32),
        queries: &[Lanes; 3],
        (upper, beyond, radius): (&Lanes, f64, f32),
    ) -> bool {
        let beyond = beyond as f32;
        let less = FAR_OFF_ROUNDING * size * radius + rest(beyond, size);
        let [x, y, z] = queries;
        let mut toward = [0.0; BLOCK];
        for e in 0..3 {
            let axes = &self.axes[e];
            let (ax, ay, az) = (axes[0][lane], axes[1][lane], axes[2][lane]);
            let (offset, half) = (-self.own_offset[e][lane], self.half[e][lane]);
            let start = ax * -at[0];
            let start = times_plus::<S>(ay, -at[1], start);
            let start = times_plus::<S>(az, -at[2], start);
            for i in 0..BLOCK {
                let along = times_plus::<S>(ax, x.0[i], start);
                let along = times_plus::<S>(ay, y.0[i], along);
                let along = times_plus::<S>(az, z.0[i], along);
                let most = times_plus::<S>(along, offset, toward[i]);
                toward[i] = times_plus::<S>(along.abs(), half, most);
            }
        }
        let [ox, oy, oz] = at;
        let mut all = true;
        for i in 0..BLOCK {
            let most = times_plus::<S>(ox, x.0[i], toward[i]);
            let most = times_plus::<S>(oy, y.0[i], most);
            let most = times_plus::<S>(oz, z.0[i], most);
            all &= beyond - 2.0 * most - less > upper.0[i];
        }
        all
    }
}

/// What rounding of `beyond`, and of what was computed in double precision, may add.
#[inline(always)]
fn rest(beyond: f32, size: f32) -> f32 {
    SLACK * beyond.abs() + DOUBLE_ROUNDING * size * (size + 2.0) + UNDERFLOW
}
