//! Every number and choice that the result depends on, and the two readings of the paper.

use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;

use glam::DVec3;

use super::{Aggregation, CandidateGrid, CenterMethod, RandomSearch};
use crate::geometry::Unit;

/// The paper's weight of an angle against a distance (Eq. 15): 3/π centimeters per radian.
pub const TAU_CM_PER_RAD: f64 = 3.0 / std::f64::consts::PI;

/// Where the normals come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum NormalSource {
    /// The plane fitted to each point's neighborhood (Eq. 2).
    Estimate,
    /// The file's own normals.
    File,
}

/// The statistical outlier filter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OutlierFilter {
    /// How many nearest points each point's mean distance is taken over.
    pub neighbors: NonZeroUsize,
    /// How many standard deviations above the cloud's mean of that distance a point may lie.
    pub std_ratio: f64,
}

/// Filters that run before anything else: outliers, voxel grid, and then the sample of what is still
/// too much. The first two are off by default.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Filters {
    /// Leave out statistical outliers.
    pub outliers: Option<OutlierFilter>,
    /// Thin to one point a cube of this edge, in centimeters.
    pub voxel_cm: Option<f64>,
    /// The most points that are analyzed, at least [`Filters::FEWEST`]. Of a cloud of more a sample is:
    /// a voxel grid, as fine as this number allows.
    #[serde(default = "Filters::usual_most")]
    pub max_points: usize,
}

impl Filters {
    /// What [`Filters::max_points`] is where nothing is said: a cloud of so many points takes seconds.
    pub const MOST: usize = 1_000_000;
    /// The least it may be.
    pub const FEWEST: usize = 100;

    fn usual_most() -> usize {
        Self::MOST
    }
}

impl Default for Filters {
    fn default() -> Self {
        Self {
            outliers: None,
            voxel_cm: None,
            max_points: Self::MOST,
        }
    }
}

/// A reading of what the paper leaves open: the center's Eq. 3 and how scores are added up (§ 2.5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Preset {
    /// Word for word: the RMS distance of Eq. 3, the sum of the scores, every plane in the running.
    AsPrinted,
    /// What the words around the equations mean: the point equidistant from the surface, the mean
    /// score, and only planes for which enough points have a partner.
    AsIntended,
}

impl Preset {
    /// The name that the command line and the reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::AsIntended => "as-intended",
        }
    }

    fn aggregation(self) -> Aggregation {
        match self {
            Self::AsPrinted => Aggregation::Sum,
            Self::AsIntended => Aggregation::Mean,
        }
    }
}

/// Every parameter of an analysis. Build one from a [`Preset`] and change what should differ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Params {
    /// Steps of the candidate grid along each angle; the paper's § 3.2 uses 6.
    pub u: usize,
    /// τ of Eq. 15 in centimeters per radian, not negative.
    pub tau_cm_per_rad: f64,
    /// The unit of the cloud's coordinates.
    pub unit: Unit,
    /// Where normals come from.
    pub normals: NormalSource,
    /// k of Eq. 2, at least 3.
    pub k: NonZeroUsize,
    /// How the fruit center is found.
    pub center: CenterMethod,
    /// How a plane's score is made of its points' scores.
    pub aggregation: Aggregation,
    /// The least share of points with a partner that lets a plane win, 0 to 1.
    pub min_partner_fraction: f64,
    /// p_v in the file's unit and frame.
    pub viewpoint: DVec3,
    /// Filters of the cloud.
    pub filters: Filters,
}

/// A parameter out of its range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ParamError {
    /// The sample is too small.
    #[error("a sample must be allowed at least {min} points, not {0}", min = Filters::FEWEST)]
    TooSmallSample(usize),
    /// u is out of range.
    #[error(
        "u must be a whole number from {min} to {max} (the paper: u > 4), not {0}",
        min = CandidateGrid::MIN_U,
        max = CandidateGrid::MAX_U
    )]
    GridSize(usize),
    /// τ is negative or not finite.
    #[error("τ must be a finite number of centimeters per radian, 0 or more, not {0}")]
    Tau(f64),
    /// k is too small for a plane.
    #[error("k must be at least 3, since three points make a plane, not {0}")]
    NeighborCount(usize),
    /// The partner fraction is no fraction.
    #[error("the least partner fraction must be from 0 to 1, not {0}")]
    PartnerFraction(f64),
    /// A coordinate is not finite.
    #[error("the {0} must have finite coordinates")]
    NotFinite(&'static str),
    /// A filter's number is out of range.
    #[error("the {0} must be a positive number, not {1}")]
    NotPositive(&'static str, f64),
    /// The random search has no points to try.
    #[error("the center's search needs at least one random point")]
    NoRandomPoints,
}

impl Params {
    /// A preset's parameters with the paper's numbers, for a cloud in `unit` seen from the origin.
    pub fn new(preset: Preset, unit: Unit) -> Self {
        let aggregation = preset.aggregation();
        Self {
            u: 6,
            tau_cm_per_rad: TAU_CM_PER_RAD,
            unit,
            normals: NormalSource::Estimate,
            k: const { NonZeroUsize::new(30).unwrap() },
            center: CenterMethod::of_preset(preset, RandomSearch::default()),
            aggregation,
            min_partner_fraction: aggregation.default_min_partner_fraction(),
            viewpoint: DVec3::ZERO,
            filters: Filters::default(),
        }
    }

    /// The preset whose reading of the paper these parameters follow, or `None` for a mixture of
    /// their own ("custom"). The reading is the center's method, the aggregation and the least
    /// partner fraction; u, τ and the rest are numbers that the paper leaves free.
    pub fn preset(&self) -> Option<Preset> {
        [Preset::AsPrinted, Preset::AsIntended]
            .into_iter()
            .find(|&preset| {
                self.center.preset() == Some(preset)
                    && self.aggregation == preset.aggregation()
                    && self.min_partner_fraction == self.aggregation.default_min_partner_fraction()
            })
    }

    /// The preset's name, or "custom".
    pub fn preset_name(&self) -> &'static str {
        self.preset().map_or("custom", Preset::name)
    }

    /// Checks every number's range.
    ///
    /// # Errors
    /// The first one that is out of it.
    pub fn check(&self) -> Result<(), ParamError> {
        CandidateGrid::new(self.u)?;
        if !(self.tau_cm_per_rad.is_finite() && self.tau_cm_per_rad >= 0.0) {
            return Err(ParamError::Tau(self.tau_cm_per_rad));
        }
        if self.k.get() < 3 {
            return Err(ParamError::NeighborCount(self.k.get()));
        }
        if !(0.0..=1.0).contains(&self.min_partner_fraction) {
            return Err(ParamError::PartnerFraction(self.min_partner_fraction));
        }
        if !self.viewpoint.is_finite() {
            return Err(ParamError::NotFinite("viewpoint"));
        }
        let positive = |name, value: f64| {
            if value.is_finite() && value > 0.0 {
                Ok(())
            } else {
                Err(ParamError::NotPositive(name, value))
            }
        };
        if let Some(edge) = self.filters.voxel_cm {
            positive("voxel edge in centimeters", edge)?;
        }
        if self.filters.max_points < Filters::FEWEST {
            return Err(ParamError::TooSmallSample(self.filters.max_points));
        }
        if let Some(filter) = self.filters.outliers {
            positive("outlier filter's standard-deviation ratio", filter.std_ratio)?;
        }
        match &self.center {
            CenterMethod::Given(center) if !center.is_finite() => Err(ParamError::NotFinite("center")),
            CenterMethod::MeanRms(search) | CenterMethod::Equidistant(search) => {
                if search.count == 0 {
                    return Err(ParamError::NoRandomPoints);
                }
                positive("spread of the center's random points", search.spread)
            }
            _ => Ok(()),
        }
    }
}
