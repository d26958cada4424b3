//! A leaf between the camera and the fruit, pushed in until it hides as much as was asked for.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};
use rand::{Rng, RngExt};

use super::color::Paint;
use crate::geometry::Cloud;
use crate::simulate::depth_camera::{DepthCamera, DepthImage};
use crate::simulate::mesh::{Mesh, Vertex};

const ACROSS: u32 = 41;
const ALONG: u32 = 61;
/// The distance between the leaf's farthest point and the fruit's nearest.
const GAP_CM: f64 = 0.5;

/// The shape and posture of a leaf.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulate) struct Leaf {
    length_cm: f64,
    /// The direction in the image along which it reaches over the fruit.
    towards_rad: f64,
    turn: DMat3,
}

impl Leaf {
    pub(in crate::simulate) fn draw(rng: &mut impl Rng) -> Self {
        let length_cm = 11.0 + 5.0 * rng.random::<f64>();
        // From above and the sides, since leaves hang down.
        let towards_rad = PI / 2.0 + (rng.random::<f64>() - 0.5) * PI;
        let lean = |u: f64| (u - 0.5) * 50_f64.to_radians();
        let [yaw, pitch] = rng.random::<[f64; 2]>().map(lean);
        Self {
            length_cm,
            towards_rad,
            turn: DMat3::from_rotation_y(yaw) * DMat3::from_rotation_x(pitch),
        }
    }

    /// Places the leaf so that it hides about `cover` of the pixels of `fruit`, and returns the share that it
    /// does hide.
    ///
    /// It is slid along its own direction over the fruit; one too small to hide so much is grown.
    pub(in crate::simulate) fn covering(
        mut self,
        cover: f64,
        camera: &DepthCamera,
        fruit: &DepthImage,
        paint: &Paint,
    ) -> (Mesh, f64) {
        let seen = FruitSeen::new(camera, fruit);
        loop {
            let shape = self.mesh(paint);
            let hidden_at = |reach_cm: f64| {
                let leaf = self.placed(&shape, &seen, reach_cm);
                let hidden = camera.count_hidden(&leaf, fruit) as f64 / seen.pixels as f64;
                (leaf, hidden)
            };
            // From not touching the fruit to lying over its middle.
            let (mut low, mut high) = (-self.length_cm - seen.radius_cm, 0.0);
            let (leaf, hidden) = hidden_at(high);
            if hidden < cover && self.length_cm < 6.0 * seen.radius_cm {
                self.length_cm *= 1.2;
                continue;
            }
            let mut best = (leaf, hidden);
            for _ in 0..9 {
                let middle = f64::midpoint(low, high);
                let (leaf, hidden) = hidden_at(middle);
                if hidden < cover {
                    low = middle;
                } else {
                    high = middle;
                }
                if (hidden - cover).abs() < (best.1 - cover).abs() {
                    best = (leaf, hidden);
                }
            }
            return best;
        }
    }

    /// The leaf around its own middle, tip towards `towards_rad`: pointed oval, cupped along the
    /// midrib, drooping at the tip, a little wavy at the rim.
    fn mesh(&self, paint: &Paint) -> Mesh {
        let tip = DVec2::from_angle(self.towards_rad);
        Mesh::sheet(Cloud::LEAF, (ACROSS, ALONG), |column, row| {
            let along = f64::from(row) / f64::from(ALONG - 1);
            let across = f64::from(column) / f64::from(ACROSS - 1) * 2.0 - 1.0;
            let half_width = 0.31 * (PI * along.powf(0.8)).sin().max(0.0).powf(0.75);
            let aside = across * half_width;
            let cupped = 0.55 * aside * aside / 0.31;
            let drooping = 0.28 * (along - 0.45).powi(2);
            let wavy = 0.012 * across * across * (along * 5.0 * TAU).sin();
            let flat = tip * (along - 0.5) + tip.perp() * aside;
            let vein = (-(across * half_width / 0.012).powi(2)).exp();
            let position = self.turn * flat.extend(cupped + drooping + wavy);
            Vertex {
                position: position * self.length_cm,
                color: paint.leaf(vein),
            }
        })
    }

    /// Just before the fruit, its middle `reach_cm` along its direction from the fruit's middle.
    fn placed(&self, shape: &Mesh, seen: &FruitSeen, reach_cm: f64) -> Mesh {
        let farthest = shape.positions.iter().map(|p| p.z).fold(f64::MIN, f64::max);
        let depth_cm = seen.nearest_cm - GAP_CM - farthest;
        let on_ray = seen.ray * depth_cm;
        let reach = DVec2::from_angle(self.towards_rad) * reach_cm;
        shape.clone().moved(DMat3::IDENTITY, on_ray + reach.extend(0.0))
    }
}

/// The place of the fruit in the image.
struct FruitSeen {
    nearest_cm: f64,
    /// The point at depth 1 in the middle of its visible part.
    ray: DVec3,
    /// Half the diagonal of its visible part.
    radius_cm: f64,
    pixels: usize,
}

impl FruitSeen {
    fn new(camera: &DepthCamera, fruit: &DepthImage) -> Self {
        let nearest_cm = fruit.depths_cm.iter().copied().fold(f64::INFINITY, f64::min);
        let (low, high) = fruit.bounds();
        let (low, high) = (camera.ray(low), camera.ray(high));
        Self {
            nearest_cm,
            ray: (low + high) / 2.0,
            radius_cm: (high - low).length() / 2.0 * nearest_cm,
            pixels: fruit.covered(),
        }
    }
}
