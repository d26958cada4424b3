//! Angles between directions and between lines.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use glam::DVec3;

/// The angle between two directions in radians, 0 to π; neither needs to be of unit length.
///
/// By the tangent rather than the arc cosine, which loses half of its digits near 0 and π.
pub fn angle_between_directions_rad(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// The angle between two undirected lines in radians, 0 to π/2 (§ 3: the error of an axis).
pub fn angle_between_lines_rad(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b).abs())
}

/// tan(π/8): above it the arc tangent is taken from π/4 on.
const TAN_EIGHTH_PI: f64 = std::f64::consts::SQRT_2 - 1.0;

/// atan(r) / r as a polynomial in r², r up to tan(π/8): it meets that function at the zeros of the
/// 12th Chebyshev polynomial of the interval, and is off by 4e-18 of it at most.
#[allow(clippy::excessive_precision, reason = "as they came out")]
const ATAN: [f64; 12] = [
    1.0,
    -0.333_333_333_333_331_2,
    0.199_999_999_999_408_93,
    -0.142_857_142_792_502_45,
    0.111_111_107_449_196_58,
    -0.090_908_968_090_640_27,
    0.076_920_453_309_022_25,
    -0.066_629_518_136_291_59,
    0.058_468_782_973_308_72,
    -0.050_351_024_566_015_52,
    0.037_965_257_453_865_93,
    -0.017_805_397_205_419_446,
];

/// [`angle_between_directions_rad`] of several pairs, coordinate by coordinate, of about unit
/// length: the same but for the last digit, and several times as fast where vector instructions are
/// at hand (inlined into a caller that was built for them).
#[inline(always)]
#[allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "what is inlined into vectorized loops becomes part of them"
)]
pub(crate) fn angles_between_directions_rad<const N: usize>(
    a: &[[f64; N]; 3],
    b: &[[f64; N]; 3],
) -> [f64; N] {
    let mut angles = [0.0; N];
    for i in 0..N {
        let cross = [
            a[1][i] * b[2][i] - b[1][i] * a[2][i],
            a[2][i] * b[0][i] - b[2][i] * a[0][i],
            a[0][i] * b[1][i] - b[0][i] * a[1][i],
        ];
        let y = (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt();
        let x = a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i];
        let steep = y > x.abs();
        let (low, high) = if steep { (x.abs(), y) } else { (y, x.abs()) };
        let wide = low > TAN_EIGHTH_PI * high;
        let (over, under) = if wide {
            (low - high, low + high)
        } else {
            (low, high)
        };
        let r = over / if under > 0.0 { under } else { 1.0 };
        let squared = r * r;
        let mut sum = ATAN[11];
        for k in (0..11).rev() {
            sum = sum * squared + ATAN[k];
        }
        let angle = r * sum + if wide { FRAC_PI_4 } else { 0.0 };
        let angle = if steep { FRAC_PI_2 - angle } else { angle };
        angles[i] = if x < 0.0 { PI - angle } else { angle };
    }
    angles
}
