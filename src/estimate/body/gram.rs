//! The weighted Gram matrix `AᵀWA` of many short rows: nearly all of a fit's time.

#![allow(
    clippy::inline_always,
    reason = "only what is inlined is built for each kind of vector instructions"
)]

/// Rows that are added at once, so that each entry of the result is loaded and stored once for all of them.
const AT_ONCE: usize = 4;

/// Computes Σ w aᵀa over rows `a` of `width` numbers. Entry (i, j) of the result is at `i * width + j`, for j ≤ i; the rest
/// is not to be used. All machines round alike.
pub(super) fn weighted_gram(rows: &[f64], width: usize, weights: &[f64]) -> Vec<f64> {
    pulp::Arch::new().dispatch(Gram { rows, width, weights })
}

struct Gram<'a> {
    rows: &'a [f64],
    width: usize,
    weights: &'a [f64],
}

impl pulp::NullaryFnOnce for Gram<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn call(self) -> Vec<f64> {
        let Self { rows, width, weights } = self;
        let mut sums = vec![0.0; width * width];
        let zeros = vec![0.0; width];
        for (block, weights) in rows.chunks(AT_ONCE * width).zip(weights.chunks(AT_ONCE)) {
            let row = |r: usize| block.get(r * width..(r + 1) * width).unwrap_or(&zeros);
            let weight = |r: usize| weights.get(r).copied().unwrap_or(0.0);
            let (a, b, c, d) = (row(0), row(1), row(2), row(3));
            let (wa, wb, wc, wd) = (weight(0), weight(1), weight(2), weight(3));
            for i in 0..width {
                let (x, y, z, w) = (wa * a[i], wb * b[i], wc * c[i], wd * d[i]);
                // A multiple of four entries, a few beyond the diagonal, for whole vectors.
                let end = (i / 4 * 4 + 4).min(width);
                let sums = &mut sums[i * width..i * width + end];
                let (a, b, c, d) = (&a[..end], &b[..end], &c[..end], &d[..end]);
                for j in 0..end {
                    sums[j] += (x * a[j] + y * b[j]) + (z * c[j] + w * d[j]);
                }
            }
        }
        sums
    }
}
