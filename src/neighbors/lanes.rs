//! One number a query of a block, side by side, so that vector instructions take many at once.

use pulp::{Simd, WithSimd};

/// Queries in a block: twice what the widest vectors hold of single precision.
pub(crate) const BLOCK: usize = 32;

/// What one number is for each query.
#[derive(Debug, Clone, Copy)]
// No vector straddles two lines of the cache.
#[repr(C, align(64))]
pub(super) struct Lanes(pub(super) [f32; BLOCK]);

impl Lanes {
    pub(super) const ZERO: Self = Self::all(0.0);
    pub(super) const INFINITY: Self = Self::all(f32::INFINITY);

    const fn all(value: f32) -> Self {
        Self([value; BLOCK])
    }

    /// Vector by vector.
    #[inline(always)]
    pub(super) fn parts<S: Simd>(&self) -> &[S::f32s] {
        S::as_simd_f32s(&self.0).0
    }

    /// Vector by vector.
    #[inline(always)]
    pub(super) fn parts_mut<S: Simd>(&mut self) -> &mut [S::f32s] {
        S::as_mut_simd_f32s(&mut self.0).0
    }

    /// The sum of all.
    #[inline(always)]
    pub(super) fn sum<S: Simd>(&self, simd: S) -> f32 {
        let mut sum = simd.splat_f32s(0.0);
        for &part in self.parts::<S>() {
            sum = simd.add_f32s(sum, part);
        }
        simd.reduce_sum_f32s(sum)
    }

    /// The greatest of all and zero.
    #[inline(always)]
    pub(super) fn greatest<S: Simd>(&self, simd: S) -> f32 {
        let mut greatest = simd.splat_f32s(0.0);
        for &part in self.parts::<S>() {
            greatest = simd.max_f32s(greatest, part);
        }
        simd.reduce_max_f32s(greatest)
    }
}

/// Which of the leaves that were looked into, for each query.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct Looks(pub(super) [u32; BLOCK]);

impl Looks {
    pub(super) const FIRST: Self = Self([0; BLOCK]);
}

/// Runs what is seldom wanted: built for the same vector instructions, but where it does not crowd what
/// is wanted often.
#[cold]
#[inline(never)]
pub(super) fn seldom<S: Simd, W: WithSimd>(simd: S, work: W) -> W::Output {
    simd.vectorize(work)
}
