//! The spread of points: their mean, and the axes along which they vary.

use glam::DVec3;

use super::symmetric_eigen;

/// Mean and covariance of weighted points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The mean position, in the points' unit.
    pub mean: DVec3,
    /// Variances along the principal axes, smallest first, in the square of the points' unit.
    pub variances: [f64; 3],
    /// Unit vectors along the principal axes, in the order of `variances`.
    pub axes: [DVec3; 3],
}

impl Spread {
    /// The spread of points with weights (Eq. 2 divides by their sum), or `None` if the weights
    /// sum to zero. There are two passes over the points, so that a small spread far from the origin keeps
    /// its digits.
    pub fn of(points: impl Iterator<Item = (DVec3, f64)> + Clone) -> Option<Self> {
        let (sum, weight) = points
            .clone()
            .fold((DVec3::ZERO, 0.0), |(s, w), (p, wi)| (s + p * wi, w + wi));
        if weight <= 0.0 {
            return None;
        }
        let mean = sum / weight;
        let mut m = [0.0; 6];
        for (p, w) in points {
            let q = p - mean;
            let wq = q * w;
            m[0] += wq.x * q.x;
            m[1] += wq.x * q.y;
            m[2] += wq.x * q.z;
            m[3] += wq.y * q.y;
            m[4] += wq.y * q.z;
            m[5] += wq.z * q.z;
        }
        let (variances, axes) = symmetric_eigen(m.map(|v| v / weight));
        Some(Self {
            mean,
            variances: variances.map(|v| v.max(0.0)),
            axes,
        })
    }

    /// The spread of points of equal weight; `None` if there are none.
    pub fn of_points(points: &[DVec3]) -> Option<Self> {
        Self::of(points.iter().map(|&p| (p, 1.0)))
    }

    /// Whether the points lie on a line (or at one point), to within the rounding of coordinates
    /// that were once single precision.
    pub fn is_line(&self) -> bool {
        self.variances[1].sqrt() <= 1e-6 * self.variances[2].sqrt()
    }

    /// The root of the mean squared distance from the mean, in the points' unit.
    pub fn rms_radius(&self) -> f64 {
        self.variances.iter().sum::<f64>().sqrt()
    }
}
