//! The unit of a cloud whose file does not state one, guessed from its size.

use crate::geometry::{Cloud, Extent, Unit};

/// The source of a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnitSource {
    /// The file or the user stated it.
    Stated,
    /// It was guessed, as a fruit is some centimeters large.
    Guessed {
        /// The robust extent that it was guessed from, in the file's unit; zero for an empty cloud.
        extent: f64,
    },
}

/// An extent below this is taken for meters: the geometric mean of 0.08 and 8, as a fruit of 8 cm
/// has them in meters and centimeters.
const LARGEST_IN_METERS: f64 = 0.8;
/// An extent from here on is taken for millimeters: the geometric mean of 8 and 80.
const SMALLEST_IN_MILLIMETERS: f64 = 25.3;
/// Sizes in centimeters that a fruit, with its peduncle or without, may have.
const PLAUSIBLE_CM: std::ops::RangeInclusive<f64> = 1.0..=60.0;

/// The unit of a cloud: the stated one, or else a guess. The third value is a warning, one or two sentences, that the unit
/// is a guess or that the fruit would be of an unlikely size.
pub fn resolve(cloud: &Cloud, stated: Option<Unit>) -> (Unit, UnitSource, Option<String>) {
    let extent = robust_extent(cloud);
    let unit = stated.unwrap_or_else(|| guess(extent));
    let mut warnings = Vec::new();
    if stated.is_none() {
        let name = match unit {
            Unit::Meter => "meters",
            Unit::Centimeter => "centimeters",
            Unit::Millimeter => "millimeters",
        };
        let extent = short(extent);
        warnings.push(format!(
            "The unit was guessed: {name}, since the points span {extent}. Use --unit to state it."
        ));
    }
    let size_cm = extent * unit.in_cm();
    if !PLAUSIBLE_CM.contains(&size_cm) && !cloud.is_empty() {
        let size = short(size_cm);
        warnings.push(format!(
            "In {unit} the points span {size} cm, which is unlikely for a fruit."
        ));
    }
    let source = if stated.is_some() {
        UnitSource::Stated
    } else {
        UnitSource::Guessed { extent }
    };
    (unit, source, (!warnings.is_empty()).then(|| warnings.join(" ")))
}

/// The unit in which a fruit would most likely have this extent.
fn guess(extent: f64) -> Unit {
    if extent < LARGEST_IN_METERS {
        Unit::Meter
    } else if extent < SMALLEST_IN_MILLIMETERS {
        Unit::Centimeter
    } else {
        Unit::Millimeter
    }
}

/// The longest edge of the cloud's robust extent, in the file's unit; zero for an empty cloud.
fn robust_extent(cloud: &Cloud) -> f64 {
    Extent::robust(cloud.positions()).map_or(0.0, |extent| extent.size().max_element())
}

/// Three significant digits, without an exponent where it can be avoided.
fn short(value: f64) -> String {
    let digits = if value > 0.0 {
        2.0 - value.log10().floor()
    } else {
        0.0
    };
    if (0.0..=6.0).contains(&digits) {
        let fixed = format!("{value:.0$}", digits as usize);
        let trimmed = if fixed.contains('.') {
            fixed.trim_end_matches('0').trim_end_matches('.')
        } else {
            &fixed
        };
        return trimmed.to_owned();
    }
    if digits < 0.0 && value < 1e9 {
        format!("{value:.0}")
    } else {
        format!("{value:.2e}")
    }
}
