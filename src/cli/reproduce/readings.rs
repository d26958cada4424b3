//! The ways to read the paper that are tried side by side.

use axiscope::geometry::{Unit, angle_between_lines_rad};
use axiscope::method::{
    Aggregation, CandidateGrid, CenterMethod, RandomSearch, Ranking, Surface, TAU_CM_PER_RAD, find_center,
    plane_terms, symmetry_axis,
};
use glam::DVec3;

/// Where the fruit center is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Center {
    MeanRms,
    Equidistant,
    Sphere,
    /// The simulation's own: what a perfect search would find.
    True,
}

/// One reading: a center and an aggregation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Reading {
    pub(super) center: Center,
    pub(super) aggregation: Aggregation,
}

/// All of them, the two presets first.
pub(super) const READINGS: [Reading; 8] = {
    use Aggregation::{Mean, Sum};
    use Center::{Equidistant, MeanRms, Sphere, True};
    const fn reading(center: Center, aggregation: Aggregation) -> Reading {
        Reading { center, aggregation }
    }
    [
        reading(MeanRms, Sum),
        reading(Equidistant, Mean),
        reading(Equidistant, Sum),
        reading(Sphere, Sum),
        reading(True, Sum),
        reading(MeanRms, Mean),
        reading(Sphere, Mean),
        reading(True, Mean),
    ]
};
/// Where the presets are among [`READINGS`].
pub(super) const AS_PRINTED: usize = 0;
pub(super) const AS_INTENDED: usize = 1;

impl Reading {
    pub(super) fn name(self) -> String {
        let center = match self.center {
            Center::MeanRms => "mean-rms",
            Center::Equidistant => "equidistant",
            Center::Sphere => "sphere",
            Center::True => "true center",
        };
        let aggregation = match self.aggregation {
            Aggregation::Mean => "mean",
            Aggregation::Sum => "sum",
        };
        let preset = match READINGS.iter().position(|r| *r == self) {
            Some(AS_PRINTED) => " (as printed)",
            Some(AS_INTENDED) => " (as intended)",
            _ => "",
        };
        format!("{center}, {aggregation}{preset}")
    }
}

/// What one reading made of one cloud.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    /// The fruit center, in cm.
    pub(super) center_cm: DVec3,
    /// The direction of the symmetry axis.
    pub(super) axis: DVec3,
    /// The share of points with a partner under the winning plane, 0 to 1.
    pub(super) partner_share: f64,
}

impl Found {
    /// The angle to another axis in degrees.
    pub(super) fn error_deg(&self, other: DVec3) -> f64 {
        angle_between_lines_rad(self.axis, other).to_degrees()
    }
}

/// What every reading makes of a surface in centimeters, seen from the origin; `None` where it has no
/// symmetry plane or no axis. The terms of a center's planes are computed once.
pub(super) fn all_readings(
    surface: &Surface,
    true_center_cm: DVec3,
    u: usize,
    seed: u64,
) -> anyhow::Result<[Option<Found>; 8]> {
    let grid = CandidateGrid::new(u)?;
    let search = RandomSearch {
        seed,
        ..RandomSearch::default()
    };
    let mut found = [None; 8];
    for center in [Center::MeanRms, Center::Equidistant, Center::Sphere, Center::True] {
        let method = match center {
            Center::MeanRms => CenterMethod::MeanRms(search),
            Center::Equidistant => CenterMethod::Equidistant(search),
            Center::Sphere => CenterMethod::Sphere,
            Center::True => CenterMethod::Given(true_center_cm),
        };
        let Ok(center_cm) = find_center(surface.points(), &method, &()) else {
            continue;
        };
        let planes = plane_terms(surface, Unit::Centimeter, center_cm, DVec3::ZERO, grid, &())?;
        for (reading, found) in READINGS.iter().zip(&mut found) {
            if reading.center != center {
                continue;
            }
            let aggregation = reading.aggregation;
            let least = aggregation.default_min_partner_fraction();
            let ranking = Ranking::new(&planes, TAU_CM_PER_RAD, aggregation, least);
            *found = ranking.best().ok().and_then(|best| {
                let axis = symmetry_axis(grid.candidate(best).normal, center_cm, DVec3::ZERO).ok()?;
                let partner_share = planes.terms[best].partners as f64 / planes.points as f64;
                Some(Found {
                    center_cm,
                    axis,
                    partner_share,
                })
            });
        }
    }
    Ok(found)
}

/// Mean, standard deviation and how many, of values that exist.
#[derive(Debug, Clone, Copy)]
pub(super) struct Summary {
    pub(super) mean: f64,
    pub(super) std: f64,
    pub(super) min: f64,
    pub(super) max: f64,
}

impl Summary {
    pub(super) fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
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
