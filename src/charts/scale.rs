//! Ranges of axes and the format of their numbers.

use kuva::render::render_utils::{compute_tick_step, generate_ticks_with_step};

use super::FigureError;

/// Beyond this a span or its square leaves the floats.
const LARGEST: f64 = 1e100;
/// The axis code treats spans below the epsilon of f64 as empty; this keeps well above it.
const SMALLEST_SPAN: f64 = 1e-14;

/// The range of an axis and the distance between its ticks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) step: f64,
}

/// Whether the range of an axis is extended to zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Zero {
    /// Always: heights of bars are compared from there.
    Always,
    /// If the smallest value is positive and less than half of the largest: then heights show their ratios.
    WhenNear,
    /// Never: it holds zero only between values of both signs.
    Never,
}

impl Scale {
    /// A scale of about `ticks` steps that holds every value, from tick to tick; `None` if there is no value.
    pub(super) fn holding(
        values: impl IntoIterator<Item = f64>,
        zero: Zero,
        ticks: usize,
    ) -> Result<Option<Self>, FigureError> {
        let Some((mut low, mut high)) = extent(values)? else {
            return Ok(None);
        };
        let near = zero == Zero::WhenNear && low > 0.0 && low < 0.5 * high;
        if near || zero == Zero::Always {
            low = low.min(0.0);
            high = high.max(0.0);
        }
        (low, high) = widened(low, high);
        let step = compute_tick_step(low, high, ticks);
        // A value on a tick counts as within it despite the rounding of the division.
        let low_tick = (low / step + 1e-9).floor() * step;
        let high_tick = (high / step - 1e-9).ceil() * step;
        Ok(Some(Self {
            low: low_tick,
            high: high_tick,
            step,
        }))
    }

    /// A scale that ends just beyond the first and the last value, with or without a tick there.
    pub(super) fn around(
        values: impl IntoIterator<Item = f64>,
        ticks: usize,
    ) -> Result<Option<Self>, FigureError> {
        let Some((low, high)) = extent(values)? else {
            return Ok(None);
        };
        let (low, high) = widened(low, high);
        let margin = 0.02 * (high - low);
        let step = compute_tick_step(low, high, ticks);
        Ok(Some(Self {
            low: low - margin,
            high: high + margin,
            step,
        }))
    }

    /// The scale of a range that the caller gives.
    pub(super) fn given(low: f64, high: f64, ticks: usize) -> Result<Self, FigureError> {
        let good = low.abs() <= LARGEST && high.abs() <= LARGEST && high - low >= widest_nothing(low, high);
        if good {
            Ok(Self {
                low,
                high,
                step: compute_tick_step(low, high, ticks),
            })
        } else {
            Err(FigureError::Range(low, high))
        }
    }

    /// A scale of categories, which lie at 1, 2, 3 …
    pub(super) fn categories(count: usize) -> Self {
        Self {
            low: 0.5,
            high: count as f64 + 0.5,
            step: 1.0,
        }
    }

    /// The texts at its ticks.
    pub(super) fn tick_labels(self) -> Vec<String> {
        self.labeled_ticks().into_iter().map(|(_, label)| label).collect()
    }

    /// Its ticks, and their texts.
    pub(super) fn labeled_ticks(self) -> Vec<(f64, String)> {
        let write = self.format();
        generate_ticks_with_step(self.low, self.high, self.step)
            .into_iter()
            .map(|tick| (tick, write(tick)))
            .collect()
    }

    /// A function that writes the numbers of this axis, all with as many digits as its step needs.
    pub(super) fn format(self) -> impl Fn(f64) -> String + Send + Sync + 'static {
        let step = self.step;
        let largest = self.low.abs().max(self.high.abs());
        let exponent = largest.log10().floor();
        let significant = exponent - step.log10().floor();
        // Many digits are needed where a large offset hides a small step: an exponent would not shorten those.
        let scientific = !(-3.0..6.0).contains(&exponent) && significant < 6.0;
        let power = if scientific { exponent } else { 0.0 };
        let unit = 10f64.powf(power);
        let decimals = decimals_for(step / unit);
        move |value| {
            let digits = format!("{:.decimals$}", value / unit + 0.0);
            let negative = digits.starts_with('-') && digits.bytes().any(|b| (b'1'..=b'9').contains(&b));
            let digits = digits.trim_start_matches('-');
            let sign = if negative { "−" } else { "" };
            let is_zero = !digits.bytes().any(|b| (b'1'..=b'9').contains(&b));
            match (scientific, is_zero) {
                (true, true) => "0".to_owned(),
                (true, false) => format!("{sign}{digits}×10{}", superscript(power)),
                (false, _) => format!("{sign}{digits}"),
            }
        }
    }
}

/// The fewest decimals, up to 12, that write multiples of `step` apart.
fn decimals_for(step: f64) -> usize {
    let mut scaled = step.abs();
    for decimals in 0..12 {
        if (scaled - scaled.round()).abs() < 1e-6 * scaled.max(1.0) && scaled.round() >= 1.0 {
            return decimals;
        }
        scaled *= 10.0;
    }
    12
}

/// A whole number in raised digits.
fn superscript(number: f64) -> String {
    let raised = |c| match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        other => other,
    };
    format!("{number:.0}").chars().map(raised).collect()
}

/// The smallest and the largest finite value.
fn extent(values: impl IntoIterator<Item = f64>) -> Result<Option<(f64, f64)>, FigureError> {
    let mut found: Option<(f64, f64)> = None;
    for value in values.into_iter().filter(|v| v.is_finite()) {
        if value.abs() > LARGEST {
            return Err(FigureError::TooLarge(value));
        }
        found = Some(found.map_or((value, value), |(low, high)| (low.min(value), high.max(value))));
    }
    Ok(found)
}

/// The span below which two ends count as one.
fn widest_nothing(low: f64, high: f64) -> f64 {
    (1e-9 * low.abs().max(high.abs())).max(SMALLEST_SPAN)
}

/// The ends moved apart where they are one.
fn widened(low: f64, high: f64) -> (f64, f64) {
    if high - low >= widest_nothing(low, high) {
        return (low, high);
    }
    let middle = f64::midpoint(low, high);
    let half = if middle.abs() < SMALLEST_SPAN {
        0.5
    } else {
        0.1 * middle.abs()
    };
    (middle - half, middle + half)
}
