//! The robust loss and the scale that the fitted bodies share.

/// Huber's loss: quadratic up to a threshold, linear beyond.
#[derive(Debug, Clone, Copy)]
pub(super) struct Huber {
    /// The standard deviation of a residual.
    pub(super) sigma: f64,
    /// The factor of every row's loss: neighboring points err alike, so all of them together weigh as
    /// [`EFFECTIVE_POINTS`] independent ones.
    pub(super) temper: f64,
}

/// The number of independent points that a surface counts as.
const EFFECTIVE_POINTS: f64 = 250.0;
/// The threshold in standard deviations.
const THRESHOLD: f64 = 1.5;
/// The standard deviation of a body's misfit relative to the fruit's size: real fruits are no exact bodies.
const MISFIT: f64 = 0.035;

impl Huber {
    /// The loss of `points` residuals, given relative to the fruit's size.
    pub(super) fn of(points: usize) -> Self {
        Self {
            sigma: MISFIT,
            temper: EFFECTIVE_POINTS / points.max(1) as f64,
        }
    }

    /// The loss of a residual.
    pub(super) fn loss(&self, residual: f64) -> f64 {
        let z = residual.abs() / self.sigma;
        let loss = if z <= THRESHOLD {
            0.5 * z * z
        } else {
            THRESHOLD * (z - 0.5 * THRESHOLD)
        };
        self.temper * loss
    }

    /// The weight of a residual in iterated least squares.
    pub(super) fn weight(&self, residual: f64) -> f64 {
        let z = residual.abs() / self.sigma;
        self.temper / (self.sigma * self.sigma) * if z <= THRESHOLD { 1.0 } else { THRESHOLD / z }
    }
}

/// The root mean square of residuals in iterated least squares, weighted as the last iteration does.
pub(super) fn rms(loss: &Huber, residuals: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for residual in residuals {
        let weight = loss.weight(residual);
        sum += weight * residual * residual;
        weights += weight;
    }
    (sum / f64::max(weights, f64::MIN_POSITIVE)).sqrt()
}
