//! Mean, standard deviation and range of some values.

/// Mean, standard deviation and range of some values, in their unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The root of the mean squared deviation from the mean.
    pub std: f64,
    /// The least value.
    pub min: f64,
    /// The greatest value.
    pub max: f64,
}

impl Spread {
    /// Computes the spread of values; `None` if there are none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let values: Vec<f64> = values.into_iter().collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count;
        let reduce = |f: fn(f64, f64) -> f64| values.iter().copied().reduce(f);
        Some(Self {
            mean,
            std: variance.sqrt(),
            min: reduce(f64::min)?,
            max: reduce(f64::max)?,
        })
    }
}
