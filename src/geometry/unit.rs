//! The unit of a file's coordinates.

use serde::{Deserialize, Serialize};

/// The unit that a file's coordinates are in. The method's distances are centimeters (Eq. 15: τ is
/// in centimeters per radian), so every stage that adds distances takes the unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Unit {
    /// Meters, as most depth cameras' software writes.
    #[serde(rename = "m")]
    #[cfg_attr(feature = "cli", value(name = "m", help = "Meters"))]
    Meter,
    /// Centimeters, as the paper uses.
    #[serde(rename = "cm")]
    #[cfg_attr(feature = "cli", value(name = "cm", help = "Centimeters"))]
    Centimeter,
    /// Millimeters, as depth images hold.
    #[serde(rename = "mm")]
    #[cfg_attr(feature = "cli", value(name = "mm", help = "Millimeters"))]
    Millimeter,
}

impl Unit {
    /// All units, largest first.
    pub const ALL: [Self; 3] = [Self::Meter, Self::Centimeter, Self::Millimeter];

    /// The length of one unit in centimeters.
    pub fn in_cm(self) -> f64 {
        match self {
            Self::Meter => 100.0,
            Self::Centimeter => 1.0,
            Self::Millimeter => 0.1,
        }
    }

    /// The usual symbol: `m`, `cm` or `mm`.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Meter => "m",
            Self::Centimeter => "cm",
            Self::Millimeter => "mm",
        }
    }
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.symbol())
    }
}
