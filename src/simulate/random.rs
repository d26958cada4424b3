//! Where chance comes from: one seed a cloud, and one stream of numbers for each thing it decides.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What a stream of random numbers decides. Each has its own, so that more noise does not change the
/// fruit, and a fruit set by hand keeps the pose that its seed gives it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stream {
    /// Size, lobes and taper.
    Shape = 1,
    /// How the fruit departs from its own symmetry.
    Asymmetry = 2,
    /// Where it is and how it leans.
    Pose = 3,
    /// Its colors.
    Color = 4,
    /// A leaf before it.
    Leaf = 5,
    /// Noise and holes of the camera.
    Camera = 6,
}

/// The numbers that `seed` gives for one purpose. `ChaCha` is the same on every platform and in every
/// version of its crate.
pub(super) fn stream(seed: u64, purpose: Stream) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(purpose as u64);
    rng
}

/// What was set, or else a uniform draw from `low..high`. It draws either way, so that setting one
/// thing leaves every other as the seed made it.
pub(super) fn set_or_draw(set: Option<f64>, rng: &mut impl Rng, low: f64, high: f64) -> f64 {
    let drawn = low + (high - low) * rng.random::<f64>();
    set.unwrap_or(drawn)
}

/// The seeds of a data set of `count` clouds.
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

/// Scatters the bits of a number, one to one: a xor-shift-multiply chain with two odd constants.
fn mix(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
