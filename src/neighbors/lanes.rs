//! Numbers side by side, so that vector instructions take many at once, and bounds on what rounding may
//! change in them.

use pulp::Simd;

/// The queries of a block: twice as many as the widest vectors hold numbers of single precision.
pub(crate) const BLOCK: usize = 32;

/// The bound on rounding of products of two lengths that are known to single precision, in units of
/// both: some 25 roundings of 2^-24, and as much again for safety.
pub(super) const ROUNDING: f32 = 3e-6;
/// The same for sums of what was rounded before, in units of their size: four roundings.
pub(super) const SUM_ROUNDING: f32 = 1.0 / (1 << 22) as f32;
/// The bound on rounding of squared distances up to `size` squared that are computed in double precision (32
/// roundings of 2^-53) and on what is lost where products leave single precision's range: infinite for
/// products that are too large.
#[inline(always)]
pub(super) fn rounding_of_squared(size: f32) -> f32 {
    if size * size < 1e36 {
        size * size * (1.0 / (1u64 << 48) as f32) + 1e-37
    } else {
        f32::INFINITY
    }
}

/// A number for each query of a block, or for each point of a leaf.
#[derive(Debug, Clone, Copy, Default)]
// No vector straddles two lines of the cache.
#[repr(C, align(64))]
pub(super) struct Lanes(pub(super) [f32; BLOCK]);

impl Lanes {
    /// The numbers as vectors.
    #[inline(always)]
    pub(super) fn vectors<S: Simd>(&self) -> &[S::f32s] {
        S::as_simd_f32s(&self.0).0
    }

    #[inline(always)]
    pub(super) fn vectors_mut<S: Simd>(&mut self) -> &mut [S::f32s] {
        S::as_mut_simd_f32s(&mut self.0).0
    }

    /// The numbers of all vectors joined by `join`, beginning with `start` in each lane.
    #[inline(always)]
    fn joined<S: Simd>(&self, simd: S, start: f32, join: impl Fn(S::f32s, S::f32s) -> S::f32s) -> S::f32s {
        let mut all = simd.splat_f32s(start);
        for &vector in self.vectors::<S>() {
            all = join(all, vector);
        }
        all
    }

    /// The sum of all numbers.
    #[inline(always)]
    pub(super) fn sum<S: Simd>(&self, simd: S) -> f32 {
        simd.reduce_sum_f32s(self.joined(simd, 0.0, |a, b| simd.add_f32s(a, b)))
    }

    /// The least of all numbers.
    #[inline(always)]
    pub(super) fn least<S: Simd>(&self, simd: S) -> f32 {
        simd.reduce_min_f32s(self.joined(simd, f32::INFINITY, |a, b| simd.min_f32s(a, b)))
    }

    /// The greatest of all numbers and zero.
    #[inline(always)]
    pub(super) fn greatest<S: Simd>(&self, simd: S) -> f32 {
        simd.reduce_max_f32s(self.joined(simd, 0.0, |a, b| simd.max_f32s(a, b)))
    }
}

/// `a * b + c`, rounded once where the machine can. To be used only under a bound on rounding: the last
/// digit depends on the machine.
#[inline(always)]
pub(super) fn times_plus<S: Simd>(a: f32, b: f32, c: f32) -> f32 {
    // All machines with vectors that wide can.
    if S::F32_LANES >= 8 || cfg!(target_arch = "aarch64") {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}
