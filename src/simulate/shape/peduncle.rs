//! The peduncle: a tapered tube that rises from the dimple along the axis and bends away from it.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::color::Paint;
use crate::geometry::Cloud;
use crate::simulate::mesh::{Mesh, Vertex};

const RINGS: u32 = 64;
const AROUND: u32 = 48;

/// The length over which the calyx at the base narrows to the stalk.
const CALYX_HEIGHT_CM: f64 = 0.3;
/// The excess of the calyx's radius over the stalk's, in the stalk's radii.
const CALYX_FLARE: f64 = 2.3;

/// The peduncle's measures, in the fruit's frame.
#[derive(Debug, Clone)]
pub(in crate::simulate) struct Peduncle {
    /// The height of its base over the fruit's center.
    pub(in crate::simulate) base_cm: f64,
    pub(in crate::simulate) length_cm: f64,
    pub(in crate::simulate) width_cm: f64,
    /// The angle between the axis and the direction of its free end.
    pub(in crate::simulate) bend_deg: f64,
    /// The direction that it bends to, around the axis.
    pub(in crate::simulate) bend_towards_deg: f64,
}

impl Peduncle {
    pub(in crate::simulate) fn mesh(&self, paint: &Paint) -> Mesh {
        let line = self.centerline();
        let (sin, cos) = self.bend_towards_deg.to_radians().sin_cos();
        let aside = DVec3::new(cos, 0.0, -sin);
        let across = aside.cross(DVec3::Y);
        let place = |p: DVec2| aside * p.x + DVec3::Y * p.y;
        let vertex = |ring: u32, position: DVec3| Vertex {
            position,
            color: paint.peduncle(share(ring)),
        };
        let last = RINGS - 1;
        Mesh::skin(
            Cloud::PEDUNCLE,
            (RINGS, AROUND),
            vertex(0, place(line[0].0)),
            vertex(last, place(line[last as usize].0)),
            |ring, step| {
                let (center, angle_rad) = line[ring as usize];
                let around_rad = f64::from(step) / f64::from(AROUND) * TAU;
                let outward = place(DVec2::new(angle_rad.cos(), -angle_rad.sin()));
                let direction = outward * around_rad.cos() + across * around_rad.sin();
                let radius = self.radius_cm(share(ring) * self.length_cm, around_rad);
                vertex(ring, place(center) + direction * radius)
            },
        )
    }

    /// Points along the middle (aside, up) with the angle from the axis, which grows with the square
    /// of the way: along the axis at first.
    fn centerline(&self) -> Vec<(DVec2, f64)> {
        let step_cm = self.length_cm / f64::from(RINGS - 1);
        let mut point = DVec2::new(0.0, self.base_cm);
        (0..RINGS)
            .map(|ring| {
                let angle_rad = self.bend_deg.to_radians() * share(ring).powi(2);
                let here = (point, angle_rad);
                point += DVec2::new(angle_rad.sin(), angle_rad.cos()) * step_cm;
                here
            })
            .collect()
    }

    /// A stalk with five blunt ribs, thickened where it was cut, on a low cone of a calyx. The calyx is
    /// wider than the dimple at its height, so that its rim is inside the body and no gap shows.
    fn radius_cm(&self, along_cm: f64, around_rad: f64) -> f64 {
        let along = along_cm / self.length_cm;
        let stalk = 0.93 + 0.22 * along.powi(3);
        let ribs = 1.0 + 0.05 * (5.0 * around_rad).cos();
        let calyx = CALYX_FLARE * (-(along_cm / CALYX_HEIGHT_CM).powi(2)).exp();
        self.width_cm / 2.0 * ribs * (stalk + calyx)
    }
}

/// The place of a ring along the peduncle, 0 to 1.
fn share(ring: u32) -> f64 {
    f64::from(ring) / f64::from(RINGS - 1)
}
