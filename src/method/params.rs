//! The parameters of an analysis, and the two readings of the paper.

use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;

use glam::DVec3;

use super::{Aggregation, CandidateGrid, CenterMethod, RandomSearch};
use crate::geometry::Unit;

/// The paper's weight of an angle against a distance (Eq. 15): 3/π centimeters per radian.
pub const TAU_CM_PER_RAD: f64 = 3.0 / std::f64::consts::PI;

/// The source of the normals.
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
    /// The number of nearest points that each point's mean distance is taken over.
    pub neighbors: NonZeroUsize,
    /// The largest excess of a point's mean distance over the cloud's mean, in standard deviations.
    pub std_ratio: f64,
}

/// The filters of a cloud, in their order: strays, outliers, voxel grid, and the sample of a cloud that is
/// still too large. Outliers and voxel grid are off by default.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Filters {
    /// Whether [`crate::geometry::strays`], points far from all others, are analyzed with them.
    #[serde(default)]
    pub keep_strays: bool,
    /// The filter of statistical outliers.
    pub outliers: Option<OutlierFilter>,
    /// The edge of the voxel grid in centimeters, which leaves one point for each cube.
    pub voxel_cm: Option<f64>,
    /// The most points that are analyzed, at least [`Filters::FEWEST`]. A larger cloud is replaced by a
    /// sample: a voxel grid, as fine as this number allows.
    #[serde(default = "Filters::usual_most")]
    pub max_points: usize,
}

impl Filters {
    /// The default of [`Filters::max_points`], which takes seconds to analyze.
    pub const MOST: usize = 1_000_000;
    /// The least [`Filters::max_points`].
    pub const FEWEST: usize = 100;

    fn usual_most() -> usize {
        Self::MOST
    }
}

impl Default for Filters {
    fn default() -> Self {
        Self {
            keep_strays: false,
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
    /// As the text around the equations means it: the point equidistant from the surface, the mean score,
    /// and only planes for which enough points have a partner.
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

/// The parameters of an analysis. Start from a [`Preset`] by [`Params::new`] and change the others.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Params {
    /// Steps of the candidate grid along each angle; the paper's § 3.2 uses 6.
    pub u: usize,
    /// τ of Eq. 15 in centimeters per radian, not negative.
    pub tau_cm_per_rad: f64,
    /// The unit of the cloud's coordinates.
    pub unit: Unit,
    /// The source of the normals.
    pub normals: NormalSource,
    /// k of Eq. 2, at least 3.
    pub k: NonZeroUsize,
    /// The method to find the fruit center.
    pub center: CenterMethod,
    /// The way that a plane's score is made of its points' scores.
    pub aggregation: Aggregation,
    /// The least share of points with a partner that a plane must have to win, 0 to 1.
    pub min_partner_fraction: f64,
    /// p_v in the file's unit and frame.
    pub viewpoint: DVec3,
    /// The filters of the cloud.
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
    /// The partner fraction is not from 0 to 1.
    #[error("the least partner fraction must be from 0 to 1, not {0}")]
    PartnerFraction(f64),
    /// A coordinate is not finite.
    #[error("the {0} must have finite coordinates")]
    NotFinite(&'static str),
    /// A number is so large that results would overflow.
    #[error("the {0} must be at most {max:e}, not {1:e}", max = Params::LARGEST)]
    TooLarge(&'static str, f64),
    /// A number that must be positive is not.
    #[error("the {0} must be a positive number, not {1}")]
    NotPositive(&'static str, f64),
    /// The random search has no points to try.
    #[error("the center's search needs at least one random point")]
    NoRandomPoints,
    /// The random search has more points than memory or patience.
    #[error("the center's search tries at most {max} random points, not {0}", max = RandomSearch::MOST)]
    TooManyRandomPoints(usize),
}

impl Params {
    /// The largest number that a parameter or a coordinate may be: squares and sums of such numbers are finite.
    pub const LARGEST: f64 = 1e100;

    /// The parameters of a preset with the paper's numbers, for a cloud in `unit` seen from the origin.
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

    /// The same parameters with the fruit center given, in the file's unit and frame.
    #[must_use]
    pub fn with_center(&self, center: DVec3) -> Self {
        Self {
            center: CenterMethod::Given(center),
            ..self.clone()
        }
    }

    /// The preset whose reading of the paper these parameters follow, or `None` for a mixture ("custom").
    /// The reading is the method of the center, the aggregation and the least partner fraction; u, τ and
    /// the rest are numbers that the paper leaves free.
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

    /// Checks the range of every number.
    ///
    /// # Errors
    /// Returns an error for the first number that is out of range.
    pub fn check(&self) -> Result<(), ParamError> {
        CandidateGrid::new(self.u)?;
        if !(self.tau_cm_per_rad.is_finite() && self.tau_cm_per_rad >= 0.0) {
            return Err(ParamError::Tau(self.tau_cm_per_rad));
        }
        at_most("weight τ in centimeters per radian", self.tau_cm_per_rad)?;
        if self.k.get() < 3 {
            return Err(ParamError::NeighborCount(self.k.get()));
        }
        if !(0.0..=1.0).contains(&self.min_partner_fraction) {
            return Err(ParamError::PartnerFraction(self.min_partner_fraction));
        }
        if !self.viewpoint.is_finite() {
            return Err(ParamError::NotFinite("viewpoint"));
        }
        at_most(
            "viewpoint's distance along an axis",
            self.viewpoint.abs().max_element(),
        )?;
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
            CenterMethod::Given(center) => {
                at_most("center's distance along an axis", center.abs().max_element())
            }
            CenterMethod::MeanRms(search) | CenterMethod::Equidistant(search) => {
                if search.count == 0 {
                    return Err(ParamError::NoRandomPoints);
                }
                if search.count > RandomSearch::MOST {
                    return Err(ParamError::TooManyRandomPoints(search.count));
                }
                positive("spread of the center's random points", search.spread)?;
                at_most("spread of the center's random points", search.spread)
            }
            CenterMethod::Sphere => Ok(()),
        }
    }
}

fn at_most(name: &'static str, value: f64) -> Result<(), ParamError> {
    if value <= Params::LARGEST {
        Ok(())
    } else {
        Err(ParamError::TooLarge(name, value))
    }
}
