//! The options that the analyzing commands share, and the parsers of their values.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::str::FromStr;

use axiscope::estimate::{EstimateSettings, Estimator, Prior};
use axiscope::fruit::PeduncleChoice;
use axiscope::fruit::Request;
use axiscope::geometry::Unit;
use axiscope::method::{
    Aggregation, CandidateGrid, CenterMethod, Filters, NormalSource, OutlierFilter, Params, Preset,
    RandomSearch, TAU_CM_PER_RAD,
};
use axiscope::peduncle::HueRange;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use glam::DVec3;

/// Options of the analysis.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Analysis")]
pub(super) struct AnalysisOptions {
    /// Reading of the paper; the options below override parts of it
    #[arg(long, value_enum, default_value = "as-intended")]
    pub(super) preset: Preset,
    /// Steps of the grid of candidate planes along each angle, which makes u² planes
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = grid_size)]
    pub(super) u: usize,
    /// Weight τ of an angle against a distance, in cm per radian [default: 3/π]
    #[arg(long, value_name = "X", value_parser = not_negative, allow_negative_numbers = true)]
    pub(super) tau: Option<f64>,
    /// Unit of the file's coordinates
    #[arg(long, default_value = "auto", value_parser = unit_or_auto())]
    pub(super) unit: OrAuto<Unit>,
    /// Source of the normals
    #[arg(long, default_value = "auto", value_parser = or_auto::<NormalSource>("The file's normals where it has them, else estimated ones"))]
    pub(super) normals: OrAuto<NormalSource>,
    /// Number of nearest points, including the point itself, that a normal is fitted to
    #[arg(long, value_name = "N", default_value = "30", value_parser = neighbor_count)]
    pub(super) k: NonZeroUsize,
    /// Fruit center: equidistant, mean-rms, sphere, or X,Y,Z in the file's unit [default: the preset's]
    #[arg(long, value_name = "CENTER", allow_hyphen_values = true)]
    pub(super) center: Option<CenterOption>,
    /// Number of random points that the search for the center tries
    #[arg(long, value_name = "N", default_value = "10000", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub(super) center_samples: u32,
    /// Spread of these random points, in multiples of the cloud's own
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = positive, allow_negative_numbers = true)]
    pub(super) center_spread: f64,
    /// Combination of the points' scores into a plane's score [default: the preset's]
    #[arg(long, value_enum)]
    pub(super) aggregate: Option<Aggregation>,
    /// Least fraction of points with a partner that a symmetry plane needs, 0 to 1 [default: 0.3 for the mean, 0 for the sum]
    #[arg(long, value_name = "F", value_parser = fraction, allow_negative_numbers = true)]
    pub(super) min_partner_fraction: Option<f64>,
    /// Position of the camera, in the file's unit and frame
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", value_parser = position, allow_hyphen_values = true)]
    pub(super) viewpoint: DVec3,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) seed: u64,
    /// Source of the peduncle: auto, none, label, a PLY file, or hue=LO..HI in degrees
    #[arg(long, value_name = "WHERE", default_value = "auto", value_parser = peduncle_choice)]
    pub(super) peduncle: PeduncleChoice,
    /// Folder with the same clouds, under the same names, without their peduncles: the missing points are the peduncle
    #[arg(long, value_name = "DIR", conflicts_with = "peduncle")]
    pub(super) removed: Option<PathBuf>,
    /// Leave the peduncle's points out of the analysis
    #[arg(long)]
    pub(super) without_peduncle: bool,
    /// Analyze points that lie far from all others too, which are left out as strays otherwise
    #[arg(long)]
    pub(super) keep_strays: bool,
    /// Leave out statistical outliers, by the mean distance to this many nearest points
    #[arg(long, value_name = "N")]
    pub(super) outlier_neighbors: Option<NonZeroUsize>,
    /// Standard deviations above the mean beyond which that distance makes a point an outlier
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = positive, requires = "outlier_neighbors", allow_negative_numbers = true)]
    pub(super) outlier_std: f64,
    /// Thin the cloud to one point per cube with this edge, in cm
    #[arg(long, value_name = "CM", value_parser = positive, allow_negative_numbers = true)]
    pub(super) voxel_cm: Option<f64>,
    /// Largest number of points to analyze; a larger cloud is thinned by the finest voxel grid that suffices
    #[arg(long, value_name = "N", default_value_t = Filters::MOST, value_parser = sample_size)]
    pub(super) max_points: usize,
}

/// Options of the commands that run several estimators.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Estimators")]
pub(super) struct EstimatorOptions {
    /// Estimators of the axis, separated by commas, or all
    #[arg(long = "estimator", value_name = "NAMES", value_parser = estimators)]
    estimators: Option<Estimators>,
    /// Assumption of the fitted estimators about the axis: none, up, or lean=FREE,SD: degrees towards the camera or away that are free, and the standard deviation of more
    #[arg(long, value_name = "PRIOR", default_value_t)]
    prior: Prior,
}

impl EstimatorOptions {
    /// Returns the settings, with these estimators unless others are asked for.
    pub(super) fn settings(&self, usual: &[Estimator]) -> EstimateSettings {
        EstimateSettings {
            estimators: self
                .estimators
                .as_ref()
                .map_or(usual.to_vec(), |asked| asked.0.clone()),
            prior: self.prior,
        }
    }
}

/// Estimators, each once, in the order of reports.
#[derive(Debug, Clone)]
struct Estimators(Vec<Estimator>);

fn estimators(text: &str) -> Result<Estimators, String> {
    if text == "all" {
        return Ok(Estimators(Estimator::ALL.to_vec()));
    }
    let named = text
        .split(',')
        .map(|name| Estimator::from_str(name.trim(), false));
    let mut named = named.collect::<Result<Vec<_>, _>>().map_err(|_| {
        let names: Vec<&str> = Estimator::ALL.iter().map(|e| e.name()).collect();
        format!(
            "expected all, or some of {}, separated by commas",
            names.join(", ")
        )
    })?;
    named.sort_unstable();
    named.dedup();
    Ok(Estimators(named))
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum CenterOption {
    Equidistant,
    MeanRms,
    Sphere,
    Given(DVec3),
}

impl FromStr for CenterOption {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "equidistant" => Ok(Self::Equidistant),
            "mean-rms" => Ok(Self::MeanRms),
            "sphere" => Ok(Self::Sphere),
            _ => position(text)
                .map(Self::Given)
                .map_err(|_| "expected equidistant, mean-rms, sphere, or three numbers X,Y,Z".into()),
        }
    }
}

impl AnalysisOptions {
    /// Returns the request to analyze a cloud.
    pub(super) fn request(&self) -> Request {
        Request {
            unit: self.unit,
            peduncle: match &self.removed {
                Some(folder) => PeduncleChoice::Removed(folder.clone()),
                None => self.peduncle.clone(),
            },
            without_peduncle: self.without_peduncle,
            normals: self.normals,
            params: self.params(),
            estimates: EstimateSettings::default(),
        }
    }

    fn params(&self) -> Params {
        let search = RandomSearch {
            count: self.center_samples as usize,
            spread: self.center_spread,
            seed: self.seed,
        };
        let defaults = Params::new(self.preset, Unit::Centimeter);
        let aggregation = self.aggregate.unwrap_or(defaults.aggregation);
        Params {
            u: self.u,
            tau_cm_per_rad: self.tau.unwrap_or(TAU_CM_PER_RAD),
            k: self.k,
            center: match self.center {
                Some(CenterOption::Equidistant) => CenterMethod::Equidistant(search),
                Some(CenterOption::MeanRms) => CenterMethod::MeanRms(search),
                Some(CenterOption::Sphere) => CenterMethod::Sphere,
                Some(CenterOption::Given(center)) => CenterMethod::Given(center),
                None => CenterMethod::of_preset(self.preset, search),
            },
            aggregation,
            min_partner_fraction: self
                .min_partner_fraction
                .unwrap_or_else(|| aggregation.default_min_partner_fraction()),
            viewpoint: self.viewpoint,
            filters: Filters {
                keep_strays: self.keep_strays,
                outliers: self.outlier_neighbors.map(|neighbors| OutlierFilter {
                    neighbors,
                    std_ratio: self.outlier_std,
                }),
                voxel_cm: self.voxel_cm,
                max_points: self.max_points,
            },
            ..defaults
        }
    }
}

/// The value of an option that takes `auto` besides the names of `T`; `None` stands for `auto`. Under this name,
/// clap does not take it for an option that may be missing.
pub(super) type OrAuto<T> = Option<T>;

/// Parses the names of `T`, and `auto`, whose help text is `help`.
fn or_auto<T: ValueEnum + Send + Sync + 'static>(
    help: &'static str,
) -> impl TypedValueParser<Value = Option<T>> {
    let named = T::value_variants().iter().filter_map(T::to_possible_value);
    let auto = PossibleValue::new("auto").help(help);
    PossibleValuesParser::new(named.chain([auto])).map(|name| T::from_str(&name, false).ok())
}

/// Parses a unit, or `auto`.
pub(super) fn unit_or_auto() -> impl TypedValueParser<Value = Option<Unit>> {
    or_auto("As the file states, else guessed from its extent")
}

pub(super) fn grid_size(text: &str) -> Result<usize, String> {
    let u = text.parse::<usize>().map_err(|_| "expected a whole number")?;
    CandidateGrid::new(u)
        .map(CandidateGrid::u)
        .map_err(|e| e.to_string())
}

fn sample_size(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(most) if most >= Filters::FEWEST => Ok(most),
        _ => Err(format!("expected a whole number of at least {}", Filters::FEWEST)),
    }
}

fn neighbor_count(text: &str) -> Result<NonZeroUsize, String> {
    let k = text
        .parse::<NonZeroUsize>()
        .map_err(|_| "expected a whole number")?;
    if k.get() >= 3 {
        Ok(k)
    } else {
        Err("three points make a plane: at least 3".into())
    }
}

pub(super) fn number(text: &str) -> Result<f64, String> {
    let value = text.trim().parse::<f64>().map_err(|_| "expected a number")?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err("expected a finite number".into())
    }
}

fn not_negative(text: &str) -> Result<f64, String> {
    match number(text)? {
        value if value >= 0.0 => Ok(value),
        _ => Err("expected 0 or more".into()),
    }
}

pub(super) fn positive(text: &str) -> Result<f64, String> {
    match number(text)? {
        value if value > 0.0 => Ok(value),
        _ => Err("expected more than 0".into()),
    }
}

fn fraction(text: &str) -> Result<f64, String> {
    match number(text)? {
        value if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("expected a fraction from 0 to 1".into()),
    }
}

/// Parses three finite numbers with commas between them.
pub(super) fn position(text: &str) -> Result<DVec3, String> {
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
    match numbers[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err("expected three numbers X,Y,Z".into()),
    }
}

fn peduncle_choice(text: &str) -> Result<PeduncleChoice, String> {
    Ok(match text {
        "auto" => PeduncleChoice::Auto,
        "none" => PeduncleChoice::None,
        "label" => PeduncleChoice::Label,
        _ => match text.strip_prefix("hue=") {
            Some(range) => PeduncleChoice::Hue(hue_range(range)?),
            None => PeduncleChoice::File(PathBuf::from(text)),
        },
    })
}

fn hue_range(text: &str) -> Result<HueRange, String> {
    let (from, to) = text.split_once("..").ok_or("expected hue=LO..HI in degrees")?;
    let degrees = |text| match number(text)? {
        value if (0.0..=360.0).contains(&value) => Ok(value),
        _ => Err("expected a hue from 0 to 360 degrees".to_string()),
    };
    Ok(HueRange {
        from_deg: degrees(from)?,
        to_deg: degrees(to)?,
    })
}

/// The depths of simulated ellipsoids in cm, ascending.
#[derive(Debug, Clone)]
pub(super) struct Depths(pub(super) Vec<f64>);

pub(super) fn depths(text: &str) -> Result<Depths, String> {
    range(text).map(Depths)
}

/// Parses a number, or FROM..TO[:STEP] as the numbers from FROM to TO in steps of STEP (1 by default). Returns at least
/// one number.
pub(super) fn range(text: &str) -> Result<Vec<f64>, String> {
    let Some((from, rest)) = text.split_once("..") else {
        return Ok(vec![number(text)?]);
    };
    let (to, step) = rest.split_once(':').unwrap_or((rest, "1"));
    let (from, to, step) = (number(from)?, number(to)?, positive(step)?);
    // TO counts as a step even if rounding puts it slightly beyond: 0.1..0.3:0.1 has three.
    let steps = ((to - from) / step + 1e-3).floor();
    if !(0.0..10_000.0).contains(&steps) {
        return Err("expected FROM..TO[:STEP] with FROM below TO".into());
    }
    Ok((0..=steps as usize).map(|i| from + i as f64 * step).collect())
}

/// Parses two finite numbers with a comma between them.
pub(super) fn pair(text: &str) -> Result<[f64; 2], String> {
    let (a, b) = text
        .split_once(',')
        .ok_or("expected two numbers with a comma between them")?;
    Ok([number(a)?, number(b)?])
}

/// The value of an option that takes `best`, which is `None`. Under this name, clap does not take it for an option
/// that may be missing.
pub(super) type OrBest<T> = Option<T>;

pub(super) fn plane_choice(text: &str) -> Result<OrBest<[usize; 2]>, String> {
    if text == "best" {
        return Ok(None);
    }
    let numbers: Vec<usize> = text
        .split(',')
        .map(|n| n.trim().parse().map_err(|_| "expected best, or two numbers G,H"))
        .collect::<Result<_, _>>()?;
    match numbers[..] {
        [g, h] => Ok(Some([g, h])),
        _ => Err("expected best, or two numbers G,H".into()),
    }
}
