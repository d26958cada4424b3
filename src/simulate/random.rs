//! Random numbers: one seed for each cloud, and a stream of numbers for each of its properties.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The purpose of a stream of random numbers. Each purpose has its own, so that more noise does not change
/// the fruit, and a fruit whose shape is set keeps the pose that its seed gives it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stream {
    /// Size, lobes and taper.
    Shape = 1,
    /// The fruit's departure from its symmetry.
    Asymmetry = 2,
    /// Its position and lean.
    Pose = 3,
    /// Its colors.
    Color = 4,
    /// A leaf before it.
    Leaf = 5,
    /// Noise and holes of the camera.
    Camera = 6,
    /// Errors of the camera's poses.
    CameraPoses = 7,
}

/// Returns the random numbers of `seed` for one purpose. `ChaCha` is the same on every platform and in every
/// version of its crate.
pub(super) fn stream(seed: u64, purpose: Stream) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(purpose as u64);
    rng
}

/// Returns the random numbers of `seed` for the camera's noise and holes in one of several views.
pub(super) fn view_stream(seed: u64, view: usize) -> ChaCha8Rng {
    /// The streams below are those of [`Stream`].
    const FIRST: u64 = 1 << 32;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(FIRST + view as u64);
    rng
}

/// Returns the value that was set, or else a uniform draw from `low..high`. It draws in either case, so that
/// setting one property leaves all others as the seed makes them.
pub(super) fn set_or_draw(set: Option<f64>, rng: &mut impl Rng, low: f64, high: f64) -> f64 {
    let drawn = low + (high - low) * rng.random::<f64>();
    set.unwrap_or(drawn)
}

/// Returns the seeds of a data set of `count` clouds.
///
/// Cloud 0 has `seed` itself, so a single cloud is the first of every data set of that seed; the
/// others are scattered by a bijective mixing of `seed` and their index. Cloud i does not depend on
/// `count`. The derived seeds stay below 2^53, so that every reader of JSON reads them exactly.
pub fn seeds(seed: u64, count: usize) -> Vec<u64> {
    (0..count as u64)
        .map(|index| match index {
            0 => seed,
            _ => mix(mix(seed) ^ index) >> 11,
        })
        .collect()
}

/// Scatters the bits of a number by a chain of shifts, exclusive ors and odd multiplications, which is a
/// bijection.
fn mix(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
