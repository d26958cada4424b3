//! Spherical harmonics about a candidate axis, and how wide each of their coefficients is expected to be.
//!
//! A body that is star-shaped about its center is R(s) = Σ `β_j` `Y_j(s)` over unit vectors s = (x, y, z) with z along the
//! axis. The harmonics are real and Schmidt-normalized, `Y_lm` = `P_l^m(z)` · {cos mθ, sin mθ}, and are computed as
//! `Q_lm(z)` · {Re, Im}(x + iy)^m with `Q_lm` = `P_l^m` / (1 − z²)^{m/2}: polynomials, which have derivatives at the poles too.

use std::sync::LazyLock;

/// The highest order m of a basis, plus one.
const ORDERS: usize = 9;
/// The highest degree l of a basis, plus one.
const DEGREES: usize = 11;

/// One order m with its degrees l, and the expected spread of each coefficient relative to the body's radius.
type Order = (usize, &'static [(usize, f64)]);

/// The terms of a body. The zonal ones (m = 0), which are the profile of a body of revolution, are wide; the others,
/// which are lobes and dents, are narrow. Left out are (1, ·) and (2, 1): they would move and turn the body, and that is
/// what its pose does.
///
/// Spreads were tuned on simulated peppers of the seeds 5000 to 5239, and are reported on others (20000 and up). The narrow
/// ones with m = 2 matter most: an oval section turns the seen side much as a lean towards the camera does, so that a
/// body that may be oval leaves the lean open.
#[derive(Debug)]
pub(super) struct Basis {
    orders: &'static [Order],
    terms: usize,
}

/// The terms of searches: 18.
pub(super) static COARSE: Basis = Basis::new(&[
    (
        0,
        &[(0, 0.3), (2, 0.14), (3, 0.14), (4, 0.105), (5, 0.091), (6, 0.07)],
    ),
    (2, &[(2, 0.0021), (3, 0.0044)]),
    (3, &[(3, 0.0108), (4, 0.0215)]),
    (4, &[(4, 0.0105), (5, 0.0175)]),
]);

/// The terms of the last fit: 50.
pub(super) static FINE: Basis = Basis::new(&[
    (
        0,
        &[
            (0, 0.3),
            (2, 0.14),
            (3, 0.14),
            (4, 0.105),
            (5, 0.091),
            (6, 0.07),
            (7, 0.049),
            (8, 0.035),
            (9, 0.021),
            (10, 0.014),
        ],
    ),
    (1, &[(3, 0.0036), (4, 0.0036), (5, 0.0007)]),
    (2, &[(2, 0.0021), (3, 0.0044), (4, 0.0012), (5, 0.0012)]),
    (3, &[(3, 0.0108), (4, 0.0215), (5, 0.0057), (6, 0.0032)]),
    (4, &[(4, 0.0105), (5, 0.0175), (6, 0.0061), (7, 0.0035)]),
    (5, &[(5, 0.0024), (6, 0.003)]),
    (6, &[(6, 0.0015), (7, 0.0018)]),
    (8, &[(8, 0.0012)]),
]);

impl Basis {
    const fn new(orders: &'static [Order]) -> Self {
        let (mut terms, mut i) = (0, 0);
        while i < orders.len() {
            terms += orders[i].1.len() * if orders[i].0 == 0 { 1 } else { 2 };
            i += 1;
        }
        Self { orders, terms }
    }

    /// The number of terms. The first is the constant, the mean radius.
    pub(super) fn terms(&self) -> usize {
        self.terms
    }

    /// Returns the order m of each term.
    pub(super) fn orders(&self) -> impl Iterator<Item = usize> + '_ {
        let each = |&(m, degrees): &Order| std::iter::repeat_n(m, degrees.len() * if m == 0 { 1 } else { 2 });
        self.orders.iter().flat_map(each)
    }

    /// Returns the expected spread of each coefficient, relative to the body's radius.
    pub(super) fn spreads(&self) -> Vec<f64> {
        let each = |&(m, degrees): &Order| {
            let copies = if m == 0 { 1 } else { 2 };
            degrees
                .iter()
                .flat_map(move |&(_, spread)| std::iter::repeat_n(spread, copies))
        };
        self.orders.iter().flat_map(each).collect()
    }

    /// Computes every term at the unit vector `s` into `values`.
    pub(super) fn values(&self, s: [f64; 3], values: &mut [f64]) {
        let mut powers = Powers::new(s);
        let mut next = 0;
        for &(m, degrees) in self.orders {
            let (re, im) = powers.to(m);
            let legendre = Legendre::new(m, degrees, s[2]);
            for &(l, _) in degrees {
                let q = legendre.value[l];
                values[next] = q * re;
                next += 1;
                if m > 0 {
                    values[next] = q * im;
                    next += 1;
                }
            }
        }
    }

    /// Returns the radius Σ `β_j` `Y_j` at the unit vector `s`, and its derivatives by x, y and z, taken as independent.
    pub(super) fn radius(&self, beta: &[f64], s: [f64; 3]) -> (f64, [f64; 3]) {
        let mut powers = Powers::new(s);
        let mut next = 0;
        let (mut radius, mut gradient) = (0.0, [0.0; 3]);
        for &(m, degrees) in self.orders {
            let (before, (re, im)) = (powers.before(m), powers.to(m));
            let legendre = Legendre::new(m, degrees, s[2]);
            // Sums over l of β Q and β Q', for the cosine and the sine.
            let (mut cos, mut sin, mut cos_slope, mut sin_slope) = (0.0, 0.0, 0.0, 0.0);
            for &(l, _) in degrees {
                let (q, slope) = (legendre.value[l], legendre.slope[l]);
                cos += beta[next] * q;
                cos_slope += beta[next] * slope;
                next += 1;
                if m > 0 {
                    sin += beta[next] * q;
                    sin_slope += beta[next] * slope;
                    next += 1;
                }
            }
            radius += cos * re + sin * im;
            gradient[2] += cos_slope * re + sin_slope * im;
            if m > 0 {
                // (x + iy)^m has the derivatives m (x + iy)^(m−1) and i times that.
                let (re, im) = (m as f64 * before.0, m as f64 * before.1);
                gradient[0] += cos * re + sin * im;
                gradient[1] += sin * re - cos * im;
            }
        }
        (radius, gradient)
    }
}

/// (x + iy)^m for rising m.
struct Powers {
    x: f64,
    y: f64,
    m: usize,
    power: (f64, f64),
}

impl Powers {
    fn new([x, y, _]: [f64; 3]) -> Self {
        Self {
            x,
            y,
            m: 0,
            power: (1.0, 0.0),
        }
    }

    fn to(&mut self, m: usize) -> (f64, f64) {
        while self.m < m {
            let (re, im) = self.power;
            self.power = (re * self.x - im * self.y, re * self.y + im * self.x);
            self.m += 1;
        }
        self.power
    }

    /// The power m − 1, or 1 for m = 0.
    fn before(&mut self, m: usize) -> (f64, f64) {
        self.to(m.saturating_sub(1))
    }
}

/// `Q_lm(z)` and its derivative for one m and all l up to the highest that is asked for.
struct Legendre {
    value: [f64; DEGREES],
    slope: [f64; DEGREES],
}

impl Legendre {
    fn new(m: usize, degrees: &[(usize, f64)], z: f64) -> Self {
        debug_assert!(m < ORDERS);
        let last = degrees.last().map_or(m, |&(l, _)| l);
        let (mut value, mut slope) = ([0.0; DEGREES], [0.0; DEGREES]);
        value[m] = FACTORS.sectoral[m];
        if last > m {
            let factor = FACTORS.rise[m];
            value[m + 1] = factor * z * value[m];
            slope[m + 1] = factor * value[m];
        }
        for l in m + 2..=last {
            let (a, b) = FACTORS.recurrence[m][l];
            value[l] = a * z * value[l - 1] - b * value[l - 2];
            slope[l] = a * (value[l - 1] + z * slope[l - 1]) - b * slope[l - 2];
        }
        Self { value, slope }
    }
}

/// The factors of the Legendre functions' recurrences.
struct Factors {
    /// `Q_mm`: constants.
    sectoral: [f64; ORDERS],
    /// Q_(m+1)m = rise · z · `Q_mm`.
    rise: [f64; ORDERS],
    /// `Q_lm` = a · z · Q_(l−1)m − b · Q_(l−2)m, by m and l.
    recurrence: [[(f64, f64); DEGREES]; ORDERS],
}

static FACTORS: LazyLock<Factors> = LazyLock::new(|| {
    let mut factors = Factors {
        sectoral: [1.0; ORDERS],
        rise: [1.0; ORDERS],
        recurrence: [[(0.0, 0.0); DEGREES]; ORDERS],
    };
    for m in 0..ORDERS {
        let order = m as f64;
        if m > 1 {
            factors.sectoral[m] = factors.sectoral[m - 1] * ((2.0 * order - 1.0) / (2.0 * order)).sqrt();
        }
        factors.rise[m] = (2.0 * order + 1.0).sqrt();
        for l in m + 2..DEGREES {
            let degree = l as f64;
            let norm = (degree * degree - order * order).sqrt();
            let below = ((degree - 1.0).powi(2) - order * order).sqrt();
            factors.recurrence[m][l] = ((2.0 * degree - 1.0) / norm, below / norm);
        }
    }
    factors
});
