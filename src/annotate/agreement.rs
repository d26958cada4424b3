//! The agreement between annotators: over one cloud, and over a set of clouds.

use std::collections::BTreeMap;

use glam::DVec3;
use serde::Serialize;

use super::{Annotation, Ends, Role};
use crate::geometry::{angle_between_lines_rad, symmetric_eigen};
use crate::method::{AxisEstimate, AxisSource};

/// The default angle in degrees from which an annotator counts as far off.
pub const FAR_OFF_DEG: f64 = 10.0;

/// The agreement of two annotators about one cloud.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pair {
    /// The annotator whose name sorts first.
    pub a: String,
    /// The other annotator.
    pub b: String,
    /// The angle between their axes as lines, 0 to 90 degrees.
    pub angle_deg: f64,
    /// Whether they put the peduncle at opposite ends.
    pub is_opposite: bool,
}

/// The mean of several axes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeanAxis {
    /// The mean of the axes' middles, in the file's unit and frame.
    pub origin: DVec3,
    /// The unit direction that is closest to all axes as lines; its sense is towards the end at which most of them have
    /// the peduncle.
    pub direction: DVec3,
    /// The number of axes.
    pub count: usize,
    /// The root mean square of the axes' angles to the mean, in degrees.
    pub spread_deg: f64,
}

/// The agreement of all annotators about one cloud.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CloudAgreement {
    /// The cloud's file, as the caller names it.
    pub file: String,
    /// The names of those who have set an axis, sorted.
    pub annotators: Vec<String>,
    /// The names of those who say that the axis cannot be told, sorted.
    pub cannot_tell: Vec<String>,
    /// Every two annotators who have set an axis.
    pub pairs: Vec<Pair>,
    /// The largest angle of a pair, in degrees; `None` with fewer than two axes.
    pub largest_deg: Option<f64>,
    /// The names of those who are farther off than the limit from more than half of the others; of two, both.
    pub far_off: Vec<String>,
    /// The mean axis; `None` without axes, or if they contradict one another so that no direction stands out.
    pub mean: Option<MeanAxis>,
    /// The adjudicator's name, if the cloud is adjudicated.
    pub adjudicator: Option<String>,
    /// The adjudicated direction; `None` also if the adjudicator decided that it cannot be told.
    pub adjudicated: Option<DVec3>,
    /// Each annotator's angle to the adjudicated direction, in degrees.
    pub to_adjudicated_deg: BTreeMap<String, f64>,
}

/// The summary of one annotator over a set of clouds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnnotatorSummary {
    /// The annotator's name.
    pub annotator: String,
    /// The number of clouds with an axis of this annotator.
    pub clouds: usize,
    /// The number of clouds whose axis cannot be told, in their opinion.
    pub cannot_tell: usize,
    /// The number of clouds on which they are far off.
    pub far_off: usize,
    /// The mean angle to the other annotators, in degrees; `None` if nobody else has set an axis.
    pub mean_deg: Option<f64>,
    /// The mean angle to the adjudicated axes, in degrees.
    pub to_adjudicated_deg: Option<f64>,
}

/// The summary of two annotators over a set of clouds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairSummary {
    /// The annotator whose name sorts first.
    pub a: String,
    /// The other annotator.
    pub b: String,
    /// The number of clouds with an axis of both.
    pub clouds: usize,
    /// The mean of the angles between their axes, in degrees.
    pub mean_deg: f64,
    /// The largest of these angles, in degrees.
    pub largest_deg: f64,
    /// The number of clouds on which they put the peduncle at opposite ends.
    pub opposite: usize,
}

/// The agreement of all annotators over a set of clouds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SetAgreement {
    /// The angle in degrees from which an annotator counts as far off.
    pub far_off_deg: f64,
    /// The agreement about each cloud, in the caller's order.
    pub clouds: Vec<CloudAgreement>,
    /// The summary of each annotator, sorted by name.
    pub annotators: Vec<AnnotatorSummary>,
    /// The summary of every two annotators who have a cloud in common, sorted by name.
    pub pairs: Vec<PairSummary>,
}

/// Computes the mean axis. Its direction minimizes the sum of the squared sines of the angles to the axes; it is the
/// eigenvector of the largest eigenvalue of Σ d·dᵀ. Returns `None` without axes, and for axes among which no direction
/// stands out, such as two at right angles.
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
    // The eigenvalues of n axes add up to n. If the two largest are equal, rounding would decide the direction.
    if count == 0 || values[2] - values[1] < 1e-6 * count as f64 {
        return None;
    }
    let line = vectors[2];
    let toward = directions.iter().map(|d| d.dot(line).signum()).sum::<f64>();
    // A tie between the two senses is broken by the first axis.
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

/// Returns a cloud's annotations as axes to compare with: each annotator's, then their mean, then the adjudicated one, as
/// far as they exist. If the adjudicator decided that the axis cannot be told, there is no mean either.
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
    /// Compares a cloud's annotations, one per annotator.
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

/// A running mean and maximum.
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
    /// Summarizes the clouds of a set.
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
