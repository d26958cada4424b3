//! How far annotators agree about a cloud, and over a set of clouds.

use std::collections::BTreeMap;

use glam::DVec3;
use serde::Serialize;

use super::{Annotation, Ends, Role};
use crate::geometry::{angle_between_lines_rad, symmetric_eigen};
use crate::method::{AxisEstimate, AxisSource};

/// From how many degrees on somebody is far off, unless told otherwise.
pub const FAR_OFF_DEG: f64 = 10.0;

/// Two annotators of one cloud.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pair {
    /// One, by name the first.
    pub a: String,
    /// The other.
    pub b: String,
    /// The angle between their axes as lines, 0 to 90 degrees.
    pub angle_deg: f64,
    /// Whether they call opposite ends the peduncle's.
    pub is_opposite: bool,
}

/// The mean of several axes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeanAxis {
    /// The mean of their middles, in the file's unit and frame.
    pub origin: DVec3,
    /// The unit direction that is closest to all of them as lines, towards the end that most call the
    /// peduncle's.
    pub direction: DVec3,
    /// How many there are.
    pub count: usize,
    /// Root mean square of their angles to it, in degrees.
    pub spread_deg: f64,
}

/// What the annotators say of one cloud.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CloudAgreement {
    /// The cloud's file, as the caller names it.
    pub file: String,
    /// Who has set an axis, by name.
    pub annotators: Vec<String>,
    /// Who says that it cannot be told, by name.
    pub cannot_tell: Vec<String>,
    /// Every two who have set one.
    pub pairs: Vec<Pair>,
    /// The largest of their angles.
    pub largest_deg: Option<f64>,
    /// Who is farther off than the limit from more than half of the others. Where there are but two, both.
    pub far_off: Vec<String>,
    /// The mean of their axes; `None` without any, or where they contradict one another so that none
    /// stands out.
    pub mean: Option<MeanAxis>,
    /// Whoever decided, where somebody has.
    pub adjudicator: Option<String>,
    /// The adjudicated direction; `None` also where it was decided that it cannot be told.
    pub adjudicated: Option<DVec3>,
    /// Each annotator's angle to it, in degrees.
    pub to_adjudicated_deg: BTreeMap<String, f64>,
}

/// One annotator over a set of clouds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnnotatorSummary {
    /// The name.
    pub annotator: String,
    /// Clouds with an axis of theirs.
    pub clouds: usize,
    /// Clouds where they say that it cannot be told.
    pub cannot_tell: usize,
    /// Clouds where they are far off.
    pub far_off: usize,
    /// The mean angle to the other annotators, in degrees; `None` where nobody else has set an axis.
    pub mean_deg: Option<f64>,
    /// The same to the adjudicated axes.
    pub to_adjudicated_deg: Option<f64>,
}

/// Two annotators over a set of clouds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairSummary {
    /// One, by name the first.
    pub a: String,
    /// The other.
    pub b: String,
    /// Clouds with an axis of both.
    pub clouds: usize,
    /// The mean of the angles between them, in degrees.
    pub mean_deg: f64,
    /// The largest.
    pub largest_deg: f64,
    /// Clouds where they call opposite ends the peduncle's.
    pub opposite: usize,
}

/// A set of clouds: who agrees with whom.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SetAgreement {
    /// From how many degrees on somebody is far off.
    pub far_off_deg: f64,
    /// Each cloud, in the caller's order.
    pub clouds: Vec<CloudAgreement>,
    /// Each annotator, by name.
    pub annotators: Vec<AnnotatorSummary>,
    /// Every two who have a cloud in common, by name.
    pub pairs: Vec<PairSummary>,
}

/// The mean axis: the direction that minimizes the sum of the squared sines of the angles to it, which
/// is the largest eigenvector of Σ d·dᵀ. `None` of nothing, and of axes among which no direction stands
/// out, such as two at right angles.
pub fn mean_axis<'a>(axes: impl IntoIterator<Item = &'a Ends>) -> Option<MeanAxis> {
    let axes: Vec<&Ends> = axes.into_iter().collect();
    let count = axes.len();
    let directions: Vec<DVec3> = axes.iter().map(|ends| ends.direction()).collect();
    let mut sum = [0.0; 6];
    for d in &directions {
        let products = [d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z];
        for (sum, product) in sum.iter_mut().zip(products) {
            *sum += product;
        }
    }
    let (values, vectors) = symmetric_eigen(sum);
    // Of n axes the values add up to n; equal ones leave the direction to rounding.
    if count == 0 || values[2] - values[1] < 1e-6 * count as f64 {
        return None;
    }
    let line = vectors[2];
    let toward = directions.iter().map(|d| d.dot(line).signum()).sum::<f64>();
    // A tie between the senses is broken by the first.
    let sense = if toward == 0.0 {
        directions[0].dot(line)
    } else {
        toward
    };
    let direction = line * sense.signum();
    let squares = directions
        .iter()
        .map(|&d| angle_between_lines_rad(d, direction).to_degrees().powi(2));
    Some(MeanAxis {
        origin: axes.iter().map(|ends| ends.middle()).sum::<DVec3>() / count as f64,
        direction,
        count,
        spread_deg: (squares.sum::<f64>() / count as f64).sqrt(),
    })
}

/// A cloud's annotations as axes to compare with: each annotator's, then their mean, then the
/// adjudicated one, as far as there are any. Where it was decided that the axis cannot be told, there is
/// no mean either.
pub fn estimates(annotations: &[Annotation]) -> Vec<AxisEstimate> {
    let of = |role: Role| annotations.iter().filter(move |a| a.role == role);
    let mut axes: Vec<AxisEstimate> = of(Role::Annotator).filter_map(Annotation::estimate).collect();
    let is_hopeless = of(Role::Adjudicator).any(|a| a.ends().is_none());
    let mean = mean_axis(of(Role::Annotator).filter_map(Annotation::ends)).filter(|_| !is_hopeless);
    axes.extend(mean.map(|mean| AxisEstimate {
        source: AxisSource::Annotators(mean.count),
        origin: mean.origin,
        direction: mean.direction,
        confidence: None,
    }));
    axes.extend(of(Role::Adjudicator).filter_map(Annotation::estimate));
    axes
}

impl CloudAgreement {
    /// Compares a cloud's annotations, one an annotator.
    pub fn of(file: &str, annotations: &[Annotation], far_off_deg: f64) -> Self {
        let mut by_name: Vec<&Annotation> =
            annotations.iter().filter(|a| a.role == Role::Annotator).collect();
        by_name.sort_by(|a, b| a.annotator.cmp(&b.annotator));
        let axes: Vec<(&str, &Ends)> = by_name
            .iter()
            .filter_map(|a| Some((a.annotator.as_str(), a.ends()?)))
            .collect();
        let mut pairs = Vec::new();
        let mut far_from = vec![0; axes.len()];
        for (i, (a, one)) in axes.iter().enumerate() {
            for (j, (b, other)) in axes.iter().enumerate().skip(i + 1) {
                let angle = one.angle_to_deg(other);
                let angle_deg = angle.min(180.0 - angle);
                if angle_deg > far_off_deg {
                    far_from[i] += 1;
                    far_from[j] += 1;
                }
                pairs.push(Pair {
                    a: (*a).into(),
                    b: (*b).into(),
                    angle_deg,
                    is_opposite: angle > 90.0,
                });
            }
        }
        let names = |of: &[(&str, &Ends)]| of.iter().map(|(name, _)| (*name).to_owned()).collect();
        let far_off = axes
            .iter()
            .zip(far_from)
            .filter(|(_, far)| 2 * far > axes.len() - 1);
        let decided = annotations.iter().find(|a| a.role == Role::Adjudicator);
        let adjudicated = decided.and_then(|a| a.ends()).map(Ends::direction);
        let to_adjudicated = adjudicated.map(|direction| {
            let angle = |ends: &Ends| angle_between_lines_rad(ends.direction(), direction).to_degrees();
            axes.iter()
                .map(|(name, ends)| ((*name).to_owned(), angle(ends)))
                .collect()
        });
        Self {
            file: file.into(),
            annotators: names(&axes),
            cannot_tell: by_name
                .iter()
                .filter(|a| a.ends().is_none())
                .map(|a| a.annotator.clone())
                .collect(),
            largest_deg: pairs.iter().map(|p| p.angle_deg).max_by(f64::total_cmp),
            pairs,
            far_off: far_off.map(|((name, _), _)| (*name).to_owned()).collect(),
            mean: mean_axis(axes.iter().map(|(_, ends)| *ends)),
            adjudicator: decided.map(|a| a.annotator.clone()),
            adjudicated,
            to_adjudicated_deg: to_adjudicated.unwrap_or_default(),
        }
    }
}

/// A mean that grows.
#[derive(Default)]
struct Mean {
    sum: f64,
    count: usize,
    largest: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
        self.largest = self.largest.max(value);
    }

    fn value(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}

impl SetAgreement {
    /// Sums up the clouds of a set.
    pub fn of(clouds: Vec<CloudAgreement>, far_off_deg: f64) -> Self {
        let mut annotators: BTreeMap<&str, (AnnotatorSummary, Mean, Mean)> = BTreeMap::new();
        let mut pairs: BTreeMap<(&str, &str), (Mean, usize)> = BTreeMap::new();
        for cloud in &clouds {
            for name in cloud.annotators.iter().chain(&cloud.cannot_tell) {
                let new = || AnnotatorSummary {
                    annotator: name.clone(),
                    clouds: 0,
                    cannot_tell: 0,
                    far_off: 0,
                    mean_deg: None,
                    to_adjudicated_deg: None,
                };
                let entry = annotators.entry(name);
                let (summary, to_others, to_adjudicated) =
                    entry.or_insert_with(|| (new(), Mean::default(), Mean::default()));
                summary.clouds += usize::from(cloud.annotators.contains(name));
                summary.cannot_tell += usize::from(cloud.cannot_tell.contains(name));
                summary.far_off += usize::from(cloud.far_off.contains(name));
                let with_them = cloud.pairs.iter().filter(|p| p.a == *name || p.b == *name);
                with_them.for_each(|pair| to_others.add(pair.angle_deg));
                if let Some(&angle) = cloud.to_adjudicated_deg.get(name) {
                    to_adjudicated.add(angle);
                }
            }
            for pair in &cloud.pairs {
                let (angle, opposite) = pairs.entry((&pair.a, &pair.b)).or_default();
                angle.add(pair.angle_deg);
                *opposite += usize::from(pair.is_opposite);
            }
        }
        let annotators = annotators
            .into_values()
            .map(|(mut summary, others, adjudicated)| {
                summary.mean_deg = others.value();
                summary.to_adjudicated_deg = adjudicated.value();
                summary
            });
        let pairs = pairs.into_iter().map(|((a, b), (angle, opposite))| PairSummary {
            a: a.into(),
            b: b.into(),
            clouds: angle.count,
            mean_deg: angle.value().unwrap_or_default(),
            largest_deg: angle.largest,
            opposite,
        });
        let (annotators, pairs) = (annotators.collect(), pairs.collect());
        Self {
            far_off_deg,
            clouds,
            annotators,
            pairs,
        }
    }
}
