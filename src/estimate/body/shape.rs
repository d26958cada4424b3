//! The surface of a fitted body.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use glam::DVec3;

use super::basis::{self, Basis};
use super::pose::Pose;

/// Rings from pole to pole, and points on each, that stand for a body's surface.
const RINGS: usize = 30;
const AROUND: usize = 56;

/// The harmonics at each point of the rings.
#[derive(Debug)]
struct Grid {
    units: Vec<DVec3>,
    /// `basis.terms()` numbers a point.
    values: Vec<f64>,
}

impl Grid {
    fn new(basis: &Basis) -> Self {
        let unit = |i: usize| {
            let (ring, step) = (i / AROUND, i % AROUND);
            let (sin, cos) = ((ring as f64 + 0.5) / RINGS as f64 * PI).sin_cos();
            let (across, along) = ((step as f64 + 0.5) / AROUND as f64 * TAU).sin_cos();
            DVec3::new(sin * along, sin * across, cos)
        };
        let units: Vec<DVec3> = (0..RINGS * AROUND).map(unit).collect();
        let mut values = vec![0.0; units.len() * basis.terms()];
        for (values, unit) in values.chunks_exact_mut(basis.terms()).zip(&units) {
            basis.values(unit.to_array(), values);
        }
        Self { units, values }
    }
}

static COARSE_GRID: LazyLock<Grid> = LazyLock::new(|| Grid::new(&basis::COARSE));
static FINE_GRID: LazyLock<Grid> = LazyLock::new(|| Grid::new(&basis::FINE));

/// A body: its pose and the coefficients of its harmonics.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The pose.
    pub pose: Pose,
    /// The coefficients in centimeters; the first is the mean radius.
    beta: Vec<f64>,
}

impl Body {
    pub(super) fn new(pose: Pose, beta: Vec<f64>) -> Self {
        Self { pose, beta }
    }

    fn basis(&self) -> &'static Basis {
        if self.beta.len() == basis::COARSE.terms() {
            &basis::COARSE
        } else {
            &basis::FINE
        }
    }

    /// Returns the position of the surface in the direction at `polar_rad` from the axis (0 to π) and `around_rad` about
    /// it, in centimeters relative to the viewpoint.
    pub fn point(&self, polar_rad: f64, around_rad: f64) -> DVec3 {
        let (sin, cos) = polar_rad.sin_cos();
        let (across, along) = around_rad.sin_cos();
        let unit = DVec3::new(sin * along, sin * across, cos);
        let (radius, _) = self.basis().radius(&self.beta, unit.to_array());
        self.pose.position_of(radius * unit)
    }

    /// Returns the profile of the body of revolution that the zonal terms describe: (t, ρ), along the axis and from it in
    /// centimeters, at `polar_rad` from the axis.
    pub fn profile(&self, polar_rad: f64) -> (f64, f64) {
        let zonal: Vec<f64> = self
            .basis()
            .orders()
            .zip(&self.beta)
            .map(|(m, &b)| if m == 0 { b } else { 0.0 })
            .collect();
        let (sin, cos) = polar_rad.sin_cos();
        let (radius, _) = self.basis().radius(&zonal, [sin, 0.0, cos]);
        (radius * cos * self.pose.stretch, radius * sin)
    }

    /// Returns the waist of the profile: the least distance from the axis between two bulges, as a share of the smaller
    /// bulge's, 0 to 1; `None` unless there are two bulges. Hardly any fruit has a waist, but two beside each other do.
    pub fn waist(&self) -> Option<f64> {
        const STEPS: usize = 90;
        let distance = |i: usize| self.profile((i as f64 + 0.5) / STEPS as f64 * PI).1;
        let distances: Vec<f64> = (0..STEPS).map(distance).collect();
        let largest = |range: &[f64]| range.iter().copied().fold(0.0, f64::max);
        let waist = |i: usize| {
            let bulge = largest(&distances[..i]).min(largest(&distances[i + 1..]));
            (bulge > distances[i]).then(|| distances[i].max(0.0) / bulge)
        };
        (1..STEPS - 1).filter_map(waist).min_by(f64::total_cmp)
    }

    /// Returns points all over the surface, in centimeters relative to the viewpoint.
    pub(super) fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        let grid: &Grid = if self.beta.len() == basis::COARSE.terms() {
            &COARSE_GRID
        } else {
            &FINE_GRID
        };
        let values = grid.values.chunks_exact(self.beta.len());
        grid.units.iter().zip(values).map(|(&unit, values)| {
            let radius: f64 = values.iter().zip(&self.beta).map(|(y, b)| y * b).sum();
            self.pose.position_of(radius * unit)
        })
    }
}
