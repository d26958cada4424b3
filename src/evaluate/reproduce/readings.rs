//! The readings of the paper that are compared: a center and an aggregation each.

use glam::DVec3;

use crate::geometry::{Cloud, Unit};
use crate::method::{
    Aggregation, AnalysisError, AxisEstimate, CenterMethod, Filters, NormalSource, Params, Preset,
    RandomSearch, Stages,
};

/// The source of the fruit center in a reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReadingCenter {
    /// Eq. 3 as printed.
    MeanRms,
    /// Eq. 3 as intended.
    Equidistant,
    /// The best sphere's center.
    Sphere,
    /// The simulation's own: the result of a perfect search.
    True,
}

/// A reading of what the paper leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// The source of the fruit center.
    pub center: ReadingCenter,
    /// The way that scores are added up.
    pub aggregation: Aggregation,
}

/// All readings, the two presets first.
pub const READINGS: [Reading; 8] = {
    use Aggregation::{Mean, Sum};
    use ReadingCenter::{Equidistant, MeanRms, Sphere, True};
    const fn reading(center: ReadingCenter, aggregation: Aggregation) -> Reading {
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
/// The index of the preset "as printed" in [`READINGS`].
pub(super) const AS_PRINTED: usize = 0;
/// The index of the preset "as intended" in [`READINGS`].
pub(super) const AS_INTENDED: usize = 1;

impl Reading {
    /// The name that the report and its tables use.
    pub fn name(self) -> String {
        let center = match self.center {
            ReadingCenter::MeanRms => "mean-rms",
            ReadingCenter::Equidistant => "equidistant",
            ReadingCenter::Sphere => "sphere",
            ReadingCenter::True => "true center",
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

/// The result of one reading of one cloud.
#[derive(Debug, Clone)]
pub(super) struct ReadingResult {
    /// The fruit center in centimeters.
    pub(super) center_cm: DVec3,
    /// The symmetry axis.
    pub(super) axis: AxisEstimate,
    /// The share of points with a partner under the symmetry plane, 0 to 1.
    pub(super) partner_share: f64,
}

/// The results of every reading of one cloud.
pub(super) struct ReadingResults {
    /// Used points.
    pub(super) points: usize,
    /// One for each of [`READINGS`]; `None` for a reading without a center, symmetry plane or axis.
    pub(super) readings: [Option<ReadingResult>; READINGS.len()],
}

/// Analyzes a cloud in centimeters, seen from the origin, by every reading. Each center's plane terms are
/// computed once.
///
/// # Errors
/// Returns an error if the cloud cannot be analyzed by any reading.
pub(super) fn analyze_by_readings(
    cloud: Cloud,
    filters: Filters,
    true_center_cm: DVec3,
    u: usize,
    seed: u64,
) -> Result<ReadingResults, AnalysisError> {
    use ReadingCenter::{Equidistant, MeanRms, Sphere, True};
    let search = RandomSearch {
        seed,
        ..RandomSearch::default()
    };
    let mut stages = Stages::new(cloud);
    let mut results = ReadingResults {
        points: 0,
        readings: [const { None }; READINGS.len()],
    };
    // Center by center, since one is kept at a time.
    for center in [MeanRms, Equidistant, Sphere, True] {
        let method = match center {
            MeanRms => CenterMethod::MeanRms(search),
            Equidistant => CenterMethod::Equidistant(search),
            Sphere => CenterMethod::Sphere,
            True => CenterMethod::Given(true_center_cm),
        };
        for (reading, result) in READINGS.iter().zip(&mut results.readings) {
            if reading.center != center {
                continue;
            }
            let aggregation = reading.aggregation;
            let params = Params {
                u,
                normals: NormalSource::Estimate,
                center: method,
                aggregation,
                min_partner_fraction: aggregation.default_min_partner_fraction(),
                filters,
                ..Params::new(Preset::AsIntended, Unit::Centimeter)
            };
            let analysis = match stages.analyze(&params, &()) {
                Ok(analysis) => analysis,
                Err(AnalysisError::Center(_)) => continue,
                Err(error) => return Err(error),
            };
            results.points = analysis.surface.len();
            if let (Ok(best), Some(axis)) = (analysis.best, analysis.axis) {
                let planes = &analysis.planes;
                *result = Some(ReadingResult {
                    center_cm: analysis.center,
                    axis,
                    partner_share: planes.terms[best.index].partners as f64 / planes.points as f64,
                });
            }
        }
    }
    Ok(results)
}
