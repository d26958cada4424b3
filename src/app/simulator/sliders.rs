//! The sliders of the simulator: a setting each, with its name, its unit and its range.

use std::ops::RangeInclusive;

use crate::simulate::PepperSettings;

/// A setting of the simulated pepper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Slider {
    /// The lean of the stem end towards the camera.
    LeanTowardsCamera,
    /// The lean to the image's right.
    LeanSideways,
    /// The turn about the fruit's own axis.
    Spin,
    /// The depth of the fruit's center.
    Distance,
    /// The fruit's height.
    Height,
    /// The fruit's width.
    Width,
    /// The number of lobes.
    Lobes,
    /// The depth of the grooves between lobes.
    LobeDepth,
    /// The narrowing of the blossom end.
    Taper,
    /// The departure from symmetry.
    Asymmetry,
    /// The number of places that the camera looks from.
    Views,
    /// The arc that the camera covers on its way around the fruit.
    Arc,
    /// The error of the camera's known pose.
    PoseError,
    /// The standard deviation of a depth.
    Noise,
    /// The share of pixels without a depth.
    Holes,
    /// The share of the fruit that a leaf hides.
    Leaf,
}

/// A part of the panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SliderGroup {
    /// The place and the turn of the fruit.
    Pose,
    /// The shape of the fruit.
    Fruit,
    /// The camera and what is before it.
    Scan,
}

impl SliderGroup {
    /// All groups.
    pub const ALL: [Self; 3] = [Self::Pose, Self::Fruit, Self::Scan];

    /// The title of the group.
    pub fn title(self) -> &'static str {
        match self {
            Self::Pose => "Pose",
            Self::Fruit => "Fruit",
            Self::Scan => "Scan",
        }
    }

    /// The sliders of the group.
    pub fn sliders(self) -> &'static [Slider] {
        match self {
            Self::Pose => &[
                Slider::LeanTowardsCamera,
                Slider::LeanSideways,
                Slider::Spin,
                Slider::Distance,
            ],
            Self::Fruit => &[
                Slider::Height,
                Slider::Width,
                Slider::Lobes,
                Slider::LobeDepth,
                Slider::Taper,
                Slider::Asymmetry,
            ],
            Self::Scan => &[
                Slider::Views,
                Slider::Arc,
                Slider::PoseError,
                Slider::Noise,
                Slider::Holes,
                Slider::Leaf,
            ],
        }
    }
}

/// The properties of a slider.
struct Facts {
    label: &'static str,
    suffix: &'static str,
    range: RangeInclusive<f64>,
    step: f64,
    decimals: usize,
    tip: &'static str,
}

impl Slider {
    #[expect(clippy::too_many_lines, reason = "a row for each slider")]
    fn facts(self) -> Facts {
        let facts = |label, suffix, range, step, decimals, tip| Facts {
            label,
            suffix,
            range,
            step,
            decimals,
            tip,
        };
        match self {
            Self::LeanTowardsCamera => facts(
                "Lean to camera",
                "°",
                -60.0..=60.0,
                0.5,
                1,
                "The lean of the stem end out of the image, positive towards the camera. An axis by Eq. 16 stands \
                 across the view ray, and is off by this much at least.",
            ),
            Self::LeanSideways => facts(
                "Lean sideways",
                "°",
                -90.0..=90.0,
                0.5,
                1,
                "The lean of the axis within the image, positive to the right.",
            ),
            Self::Spin => facts(
                "Spin",
                "°",
                0.0..=360.0,
                1.0,
                0,
                "The turn about the fruit's own axis: other lobes face the camera.",
            ),
            Self::Distance => facts(
                "Distance",
                " cm",
                22.0..=120.0,
                0.5,
                1,
                "The depth of the fruit's center. A fruit that is far has few points.",
            ),
            Self::Height => facts(
                "Height",
                " cm",
                4.0..=20.0,
                0.1,
                1,
                "From the lowest lobe to the shoulders.",
            ),
            Self::Width => facts(
                "Width",
                " cm",
                3.0..=15.0,
                0.1,
                1,
                "Twice the largest distance of a lobe from the axis.",
            ),
            Self::Lobes => facts("Lobes", "", 1.0..=8.0, 1.0, 0, "The number of lobes."),
            Self::LobeDepth => facts(
                "Lobe depth",
                " %",
                0.0..=40.0,
                0.5,
                1,
                "The depth of the grooves between lobes, as a share of the radius.",
            ),
            Self::Taper => facts(
                "Taper",
                " %",
                0.0..=80.0,
                1.0,
                0,
                "The narrowing towards the blossom end, as a share of the width.",
            ),
            Self::Asymmetry => facts(
                "Asymmetry",
                " %",
                0.0..=20.0,
                0.5,
                1,
                "The departure from symmetry, as a share of the fruit's size: unequal lobes, an oval section, slanting \
                 shoulders.",
            ),
            Self::Views => facts(
                "Views",
                "",
                1.0..=15.0,
                1.0,
                0,
                "The number of places that the camera looks from. The points of several views are fused to one cloud, as \
                 in the paper (§ 2.1).",
            ),
            Self::Arc => facts(
                "Arc",
                "°",
                0.0..=360.0,
                5.0,
                0,
                "The whole arc of the camera's way around the fruit: 180° are 90° to either side. Without effect for one \
                 view.",
            ),
            Self::PoseError => facts(
                "Pose error",
                "°",
                0.0..=3.0,
                0.05,
                2,
                "The standard deviation of the error with which the camera's rotation is known. Without effect for one \
                 view.",
            ),
            Self::Noise => facts(
                "Noise at 40 cm",
                " mm",
                0.0..=5.0,
                0.05,
                2,
                "The standard deviation of a depth at 40 cm; it grows with the square of the distance.",
            ),
            Self::Holes => facts(
                "Holes",
                " %",
                0.0..=90.0,
                1.0,
                0,
                "The share of the pixels that have no depth, at random.",
            ),
            Self::Leaf => facts(
                "Hidden by a leaf",
                " %",
                0.0..=80.0,
                1.0,
                0,
                "The share of the fruit that a leaf before it hides.",
            ),
        }
    }

    /// The label.
    pub fn label(self) -> &'static str {
        self.facts().label
    }

    /// The unit as it stands behind the number, with a space where one belongs; empty for a count.
    pub fn suffix(self) -> &'static str {
        self.facts().suffix
    }

    /// The range, in the slider's unit.
    pub fn range(self) -> RangeInclusive<f64> {
        self.facts().range
    }

    /// The step, in the slider's unit.
    pub fn step(self) -> f64 {
        self.facts().step
    }

    /// The decimals that are shown.
    pub fn decimals(self) -> usize {
        self.facts().decimals
    }

    /// The explanation.
    pub fn tip(self) -> &'static str {
        self.facts().tip
    }

    /// The value in settings of which nothing is left to chance, in the slider's unit; `None` if it is.
    pub fn value(self, s: &PepperSettings) -> Option<f64> {
        match self {
            Self::LeanTowardsCamera => s.tilt_towards_camera_deg,
            Self::LeanSideways => s.tilt_sideways_deg,
            Self::Spin => s.spin_deg,
            Self::Distance => s.center_cm.map(|center| center.z),
            Self::Height => s.height_cm,
            Self::Width => s.width_cm,
            Self::Lobes => s.lobes.map(f64::from),
            Self::LobeDepth => s.lobe_depth.map(|share| 100.0 * share),
            Self::Taper => s.taper.map(|share| 100.0 * share),
            Self::Asymmetry => Some(100.0 * s.asymmetry),
            Self::Views => Some(s.scan.views.into()),
            Self::Arc => Some(s.scan.arc_deg),
            Self::PoseError => Some(s.scan.pose_noise_deg),
            Self::Noise => Some(10.0 * s.camera.noise_cm),
            Self::Holes => Some(100.0 * s.camera.dropout),
            Self::Leaf => Some(100.0 * s.leaf_cover),
        }
    }

    /// Sets the value, given in the slider's unit and clamped to its range.
    pub fn set(self, s: &mut PepperSettings, value: f64) {
        let range = self.range();
        let value = value.clamp(*range.start(), *range.end());
        match self {
            Self::LeanTowardsCamera => s.tilt_towards_camera_deg = Some(value),
            Self::LeanSideways => s.tilt_sideways_deg = Some(value),
            Self::Spin => s.spin_deg = Some(value),
            // Along its ray: the fruit stays where it is in the image.
            Self::Distance => s.center_cm = s.center_cm.map(|center| center * (value / center.z)),
            Self::Height => {
                s.height_cm = Some(value);
                // A dimple is at most a quarter of the height.
                s.dimple_cm = s.dimple_cm.map(|dimple_cm| dimple_cm.min(0.25 * value));
            }
            Self::Width => s.width_cm = Some(value),
            // A small whole number.
            Self::Lobes => s.lobes = Some(value.round() as u32),
            Self::LobeDepth => s.lobe_depth = Some(value / 100.0),
            Self::Taper => s.taper = Some(value / 100.0),
            Self::Asymmetry => s.asymmetry = value / 100.0,
            // A small whole number.
            Self::Views => s.scan.views = value.round() as u32,
            Self::Arc => s.scan.arc_deg = value,
            Self::PoseError => s.scan.pose_noise_deg = value,
            Self::Noise => s.camera.noise_cm = value / 10.0,
            Self::Holes => s.camera.dropout = value / 100.0,
            Self::Leaf => s.leaf_cover = value / 100.0,
        }
    }

    /// Takes the setting away, so that what is left can be compared.
    pub(super) fn clear(self, s: &mut PepperSettings) {
        match self {
            Self::Distance => s.center_cm = None,
            slider => slider.set(s, *slider.range().start()),
        }
    }
}
