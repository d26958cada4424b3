//! The Levenberg–Marquardt method, for the small problems of this room: a few parameters, some hundred rows.

use nalgebra::{DMatrix, DVector};

use crate::parallel::{Cancelled, Watch};

/// A problem whose cost is to be made least, cost = ½ Σ w r² or much like it. `State` is what the parameters
/// describe; a direction, say, is moved within its tangent plane rather than by angles.
pub trait LeastSquares {
    /// A place in the space that is searched.
    type State: Clone;

    /// Linearizes the problem about a state; `None` if the state is impossible.
    fn linearize(&self, state: &Self::State) -> Option<Linearized>;

    /// Returns the cost at a state alone; `None` if the state is impossible.
    fn cost(&self, state: &Self::State) -> Option<f64>;

    /// Returns the state moved by a step. This is the place to shorten a step that is too long.
    fn moved(&self, state: &Self::State, step: &DVector<f64>) -> Self::State;
}

/// A problem about one state: cost(step) ≈ cost − descentᵀ step + ½ stepᵀ information step.
#[derive(Debug, Clone)]
pub struct Linearized {
    /// The cost at the state.
    pub cost: f64,
    /// `JᵀWJ`, symmetric.
    pub information: DMatrix<f64>,
    /// −`JᵀWr`: the negative gradient of the cost.
    pub descent: DVector<f64>,
}

impl Linearized {
    /// Starts with zeros for `parameters` parameters.
    pub fn zeros(parameters: usize) -> Self {
        Self {
            cost: 0.0,
            information: DMatrix::zeros(parameters, parameters),
            descent: DVector::zeros(parameters),
        }
    }

    /// Adds a row: its residual, the residual's derivatives, and its weight. With a robust loss, the weight is that of
    /// iterated least squares, and the caller corrects `cost`.
    pub fn add(&mut self, residual: f64, derivatives: &[f64], weight: f64) {
        self.cost += 0.5 * weight * residual * residual;
        for (i, a) in derivatives.iter().enumerate() {
            self.descent[i] -= weight * a * residual;
            for (j, b) in derivatives.iter().enumerate().take(i + 1) {
                self.information[(i, j)] += weight * a * b;
                if i != j {
                    self.information[(j, i)] += weight * a * b;
                }
            }
        }
    }
}

/// The limits of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// The most steps.
    pub steps: usize,
    /// The least decrease of the cost by a step; less ends the search.
    pub least_decrease: f64,
}

/// The end of a search.
#[derive(Debug, Clone)]
pub struct Minimum<S> {
    /// The best state that was found.
    pub state: S,
    /// The problem about it.
    pub linearized: Linearized,
    /// The steps that were taken.
    pub steps: usize,
}

/// Searches the least cost from `start`; `None` if the start is impossible. No step raises the cost, and the result
/// depends on the problem alone.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
pub fn minimize<P: LeastSquares>(
    problem: &P,
    start: P::State,
    options: Options,
    watch: &dyn Watch,
) -> Result<Option<Minimum<P::State>>, Cancelled> {
    let Some(linearized) = problem.linearize(&start) else {
        return Ok(None);
    };
    let mut best = Minimum {
        state: start,
        linearized,
        steps: 0,
    };
    let mut damping = 1e-2;
    while best.steps < options.steps {
        if watch.is_cancelled() {
            return Err(Cancelled);
        }
        let Some((state, cost)) = step(problem, &best, &mut damping) else {
            break;
        };
        let decrease = best.linearized.cost - cost;
        let Some(linearized) = problem.linearize(&state) else {
            break;
        };
        best = Minimum {
            state,
            linearized,
            steps: best.steps + 1,
        };
        damping = (damping / 4.0).max(1e-6);
        if decrease < options.least_decrease {
            break;
        }
    }
    Ok(Some(best))
}

/// A step that lowers the cost, with more and more damping; `None` if no damping helps.
fn step<P: LeastSquares>(problem: &P, at: &Minimum<P::State>, damping: &mut f64) -> Option<(P::State, f64)> {
    for _ in 0..5 {
        let mut damped = at.linearized.information.clone();
        for i in 0..damped.nrows() {
            // The second term keeps a parameter that the data do not touch from making the matrix singular.
            damped[(i, i)] += *damping * damped[(i, i)] + f64::MIN_POSITIVE.sqrt();
        }
        let solved = damped.cholesky().map(|c| c.solve(&at.linearized.descent));
        if let Some(step) = solved.filter(|s| s.iter().all(|v| v.is_finite())) {
            let state = problem.moved(&at.state, &step);
            if let Some(cost) = problem.cost(&state)
                && cost < at.linearized.cost
            {
                return Some((state, cost));
            }
        }
        *damping *= 8.0;
    }
    None
}
