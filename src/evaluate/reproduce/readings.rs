//! The readings of the paper that are compared: a center and an aggregation each.

use glam::DVec3;

use crate::geometry::{Cloud, Unit};
use crate::method::{
    Aggregation, Analysis, AnalysisError, AxisEstimate, CenterMethod, Filters, NormalSource, Params, Preset,
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
    /// Whether a plane needs a partner for half of the points, rather than for the share that goes with the aggregation.
    pub needs_half: bool,
}

/// All readings, the two presets first.
pub const READINGS: [Reading; 9] = {
    use Aggregation::{Mean, Sum};
    use ReadingCenter::{Equidistant, MeanRms, Sphere, True};
    const fn reading(center: ReadingCenter, aggregation: Aggregation) -> Reading {
        Reading {
            center,
            aggregation,
            needs_half: false,
        }
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
        Reading {
            needs_half: true,
            ..reading(Equidistant, Mean)
        },
    ]
};
/// The indices of all [`READINGS`].
pub(super) const EVERY_READING: [usize; READINGS.len()] = [0, 1, 2, 3, 4, 5, 6, 7, 8];
/// The index of the preset "as printed" in [`READINGS`].
pub(super) const AS_PRINTED: usize = 0;
/// The index of the preset "as intended" in [`READINGS`].
pub(super) const AS_INTENDED: usize = 1;
/// The index of the true center with the mean of the scores.
pub(super) const TRUE_CENTER_MEAN_SCORE: usize = 7;
/// The index of the preset "as intended" with a partner for half of the points.
pub(super) const HALF: usize = 8;

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
            _ if self.needs_half => " (as intended, half)",
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
    /// The normal of the symmetry plane.
    pub(super) normal: DVec3,
    /// The symmetry axis.
    pub(super) axis: AxisEstimate,
    /// The share of points with a partner under the symmetry plane, 0 to 1.
    pub(super) partner_share: f64,
}

/// The results of every reading of one cloud on one grid of candidate planes; `None` for a reading without a
/// center, symmetry plane or axis.
pub(super) type GridResults = [Option<ReadingResult>; READINGS.len()];

/// The results of every reading of one cloud on several grids.
pub(super) struct ReadingResults {
    /// Used points.
    pub(super) points: usize,
    /// One for each grid.
    pub(super) grids: Vec<GridResults>,
}

/// The analysis of a cloud apart from what the readings differ in.
#[derive(Debug, Clone)]
pub(super) struct Analyzed<'a> {
    /// The filters.
    pub(super) filters: Filters,
    /// The source of the normals.
    pub(super) normals: NormalSource,
    /// The grids of candidate planes.
    pub(super) grid_sizes: &'a [usize],
    /// The indices of the readings that are computed.
    pub(super) readings: &'a [usize],
    /// The seed of Eq. 3's random points.
    pub(super) search_seed: u64,
}

impl Analyzed<'_> {
    /// Analyzes a cloud in centimeters, seen from the origin, by every reading. Each center's plane terms are
    /// computed once.
    ///
    /// # Errors
    /// Returns an error if the cloud cannot be analyzed by any reading.
    pub(super) fn analyze(
        &self,
        cloud: Cloud,
        true_center_cm: DVec3,
    ) -> Result<ReadingResults, AnalysisError> {
        use ReadingCenter::{Equidistant, MeanRms, Sphere, True};
        let search = RandomSearch {
            seed: self.search_seed,
            ..RandomSearch::default()
        };
        let mut stages = Stages::new(cloud);
        let mut results = ReadingResults {
            points: 0,
            grids: vec![[const { None }; READINGS.len()]; self.grid_sizes.len()],
        };
        // Center by center, since one is kept at a time.
        for center in [MeanRms, Equidistant, Sphere, True] {
            let method = match center {
                MeanRms => CenterMethod::MeanRms(search),
                Equidistant => CenterMethod::Equidistant(search),
                Sphere => CenterMethod::Sphere,
                True => CenterMethod::Given(true_center_cm),
            };
            let of_center = |&&i: &&usize| READINGS[i].center == center;
            for (&u, results_of_grid) in self.grid_sizes.iter().zip(&mut results.grids) {
                for &reading in self.readings.iter().filter(of_center) {
                    let params = self.params(READINGS[reading], method, u);
                    match stages.analyze(&params, &()) {
                        Ok(analysis) => {
                            results.points = analysis.surface.len();
                            results_of_grid[reading] = ReadingResult::of(&analysis);
                        }
                        Err(AnalysisError::Center(_)) => {}
                        Err(error) => return Err(error),
                    }
                }
            }
        }
        Ok(results)
    }

    fn params(&self, reading: Reading, center: CenterMethod, u: usize) -> Params {
        let aggregation = reading.aggregation;
        Params {
            u,
            normals: self.normals,
            center,
            aggregation,
            min_partner_fraction: if reading.needs_half {
                0.5
            } else {
                aggregation.default_min_partner_fraction()
            },
            filters: self.filters,
            ..Params::new(Preset::AsIntended, Unit::Centimeter)
        }
    }
}

impl ReadingResult {
    /// The result of an analysis, if it has an axis.
    fn of(analysis: &Analysis) -> Option<Self> {
        let (best, axis) = (analysis.best.ok()?, analysis.axis.clone()?);
        let planes = &analysis.planes;
        Some(Self {
            center_cm: analysis.center,
            normal: best.candidate.normal,
            axis,
            partner_share: planes.terms[best.index].partners as f64 / planes.points as f64,
        })
    }
}
