//! The kinds of simulated fruits: the form of each, and the ranges that its measures are drawn from.

use serde::{Deserialize, Serialize};

use crate::simulate::FruitColor;
use crate::simulate::shape::Form;

/// A kind of fruit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum FruitKind {
    /// Wide at the blossom end, with a neck.
    Pear,
    /// Long, wider at the blossom end.
    Eggplant,
    /// Long and slender.
    Cucumber,
    /// Flattened, with a dent at the stem end and ribs.
    Tomato,
    /// As wide as long or wider, with a deep dent at either end.
    Apple,
    /// A sphere without a peduncle: it has no axis, and no estimator should state one.
    Ball,
}

/// The lowest and the highest value that a measure is drawn from.
pub(super) type Range = (f64, f64);

/// The measures of a kind.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measures {
    pub(super) form: Form,
    pub(super) length_cm: Range,
    /// Relative to the length.
    pub(super) width: Range,
    /// The narrowing of the blossom end, relative to the width; below 0 it widens.
    pub(super) taper: Range,
    /// The narrowing of the neck at the stem end, relative to the width.
    pub(super) neck: Range,
    /// The depth of the stem end's dent, relative to the length.
    pub(super) dent: Range,
    pub(super) ribs: (u32, u32),
    /// The depth of the grooves between ribs, relative to the radius.
    pub(super) rib_depth: Range,
    pub(super) asymmetry: Range,
    pub(super) peduncle_length_cm: Range,
    pub(super) peduncle_width_cm: Range,
    pub(super) colors: &'static [FruitColor],
}

/// A round body with narrow dents.
const ROUND: Form = Form {
    boxy: (2.0, 2.0),
    dimple_radius: (0.3, 0.25),
    blossom_dimple: 0.3,
    groove_rounding: 0.35,
    neck: 0.0,
};

impl FruitKind {
    /// All kinds.
    pub const ALL: [Self; 6] = [
        Self::Pear,
        Self::Eggplant,
        Self::Cucumber,
        Self::Tomato,
        Self::Apple,
        Self::Ball,
    ];

    /// The name of the kind, as the command line and file names have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pear => "pear",
            Self::Eggplant => "eggplant",
            Self::Cucumber => "cucumber",
            Self::Tomato => "tomato",
            Self::Apple => "apple",
            Self::Ball => "ball",
        }
    }

    pub(super) fn measures(self) -> Measures {
        use FruitColor::{Green, Purple, Red, Yellow};
        const NONE: Range = (0.0, 0.0);
        // A ball's are the ones that the others vary.
        let ball = Measures {
            form: ROUND,
            length_cm: (5.0, 9.0),
            width: (1.0, 1.0),
            taper: NONE,
            neck: NONE,
            dent: NONE,
            ribs: (5, 5),
            rib_depth: NONE,
            asymmetry: NONE,
            peduncle_length_cm: (0.8, 2.0),
            peduncle_width_cm: (0.25, 0.45),
            colors: &[Red, Yellow, Green],
        };
        let irregular = (0.005, 0.025);
        match self {
            Self::Ball => ball,
            Self::Pear => Measures {
                length_cm: (7.5, 11.0),
                width: (0.64, 0.8),
                taper: (-0.1, 0.05),
                neck: (0.3, 0.5),
                dent: (0.01, 0.04),
                asymmetry: irregular,
                colors: &[Green, Yellow],
                ..ball
            },
            Self::Eggplant => Measures {
                form: Form {
                    boxy: (2.3, 2.3),
                    ..ROUND
                },
                length_cm: (11.0, 17.0),
                width: (0.38, 0.55),
                taper: (-0.35, -0.1),
                neck: (0.1, 0.25),
                asymmetry: irregular,
                peduncle_length_cm: (1.5, 3.0),
                peduncle_width_cm: (0.7, 1.1),
                colors: &[Purple],
                ..ball
            },
            Self::Cucumber => Measures {
                form: Form {
                    boxy: (2.8, 2.8),
                    ..ROUND
                },
                length_cm: (12.0, 19.0),
                width: (0.2, 0.3),
                taper: (-0.1, 0.1),
                ribs: (7, 10),
                rib_depth: (0.0, 0.02),
                asymmetry: irregular,
                colors: &[Green],
                ..ball
            },
            Self::Tomato => Measures {
                form: Form {
                    boxy: (2.2, 2.1),
                    dimple_radius: (0.38, 0.25),
                    ..ROUND
                },
                length_cm: (4.5, 7.0),
                width: (1.05, 1.3),
                taper: (-0.05, 0.1),
                dent: (0.05, 0.12),
                ribs: (5, 9),
                rib_depth: (0.0, 0.06),
                asymmetry: irregular,
                colors: &[Red, Yellow],
                ..ball
            },
            Self::Apple => Measures {
                form: Form {
                    boxy: (2.3, 2.2),
                    dimple_radius: (0.36, 0.28),
                    blossom_dimple: 0.6,
                    ..ROUND
                },
                length_cm: (5.5, 8.0),
                width: (1.0, 1.18),
                taper: (0.02, 0.18),
                dent: (0.1, 0.18),
                rib_depth: (0.0, 0.03),
                asymmetry: irregular,
                ..ball
            },
        }
    }
}
