//! Colors of skin, peduncle and leaf without shading, as under white light from all sides.

use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

/// The color of a fruit by its ripeness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum FruitColor {
    /// Ripe and red.
    Red,
    /// Ripe and yellow.
    Yellow,
    /// Unripe: hardly to be told from its peduncle by color.
    Green,
    /// Ripe and purple, as eggplants are; no seed draws it for a pepper.
    Purple,
}

impl FruitColor {
    /// The colors of sweet peppers, of which a seed draws one.
    pub const PEPPERS: [Self; 3] = [Self::Red, Self::Yellow, Self::Green];

    fn skin(self) -> Vec3 {
        match self {
            Self::Red => Vec3::new(186.0, 28.0, 24.0),
            Self::Yellow => Vec3::new(232.0, 172.0, 28.0),
            Self::Green => Vec3::new(58.0, 108.0, 38.0),
            Self::Purple => Vec3::new(62.0, 28.0, 72.0),
        }
    }
}

const PEDUNCLE: Vec3 = Vec3::new(104.0, 142.0, 62.0);
const LEAF: Vec3 = Vec3::new(46.0, 98.0, 42.0);
const LEAF_VEIN: Vec3 = Vec3::new(112.0, 150.0, 84.0);

/// The colors of one plant.
#[derive(Debug, Clone)]
pub(in crate::simulate) struct Paint {
    skin: Vec3,
    peduncle: Vec3,
    leaf: Vec3,
    /// Slow waves across the skin: a direction in radians per half size, and a phase.
    mottle: [(DVec3, f64); 4],
}

impl Paint {
    pub(in crate::simulate) fn draw(color: FruitColor, rng: &mut impl Rng) -> Self {
        let mut tone = |base: Vec3| {
            let brightness = 0.9 + 0.2 * rng.random::<f32>();
            let hue = Vec3::from_array(rng.random::<[f32; 3]>()) * 12.0 - 6.0;
            base * brightness + hue
        };
        Self {
            skin: tone(color.skin()),
            peduncle: tone(PEDUNCLE),
            leaf: tone(LEAF),
            mottle: std::array::from_fn(|_| {
                let direction = DVec3::from_array(rng.random::<[f64; 3]>()) * 2.0 - 1.0;
                (direction * 6.0, rng.random::<f64>() * std::f64::consts::TAU)
            }),
        }
    }

    /// The skin at a place given relative to the body's half size, `unripe` 0 to 1 of the way to green.
    pub(in crate::simulate) fn fruit(&self, relative: DVec3, unripe: f64) -> Vec3 {
        let waves = self
            .mottle
            .iter()
            .map(|(k, phase)| (k.dot(relative) + phase).sin());
        let brightness = 1.0 + 0.025 * waves.sum::<f64>() as f32;
        self.skin.lerp(FruitColor::Green.skin(), unripe as f32) * brightness
    }

    /// The peduncle, paler towards its cut end (0 at the base, 1 at the end).
    pub(in crate::simulate) fn peduncle(&self, along: f64) -> Vec3 {
        self.peduncle * (0.88 + 0.2 * along as f32)
    }

    /// The leaf, `vein` 0 to 1 of the way to the color of its midrib.
    pub(in crate::simulate) fn leaf(&self, vein: f64) -> Vec3 {
        self.leaf.lerp(LEAF_VEIN, vein as f32)
    }
}
