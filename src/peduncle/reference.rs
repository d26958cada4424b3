//! The peduncle and its reference axes (§ 3.2).

use super::{HueRange, hue_deg};
use crate::geometry::{Cloud, Extent, PointSet, Spread, strays, without};
use crate::method::{AxisEstimate, AxisSource};
use crate::neighbors::Neighbors;
use glam::DVec3;

/// The way in which a cloud's peduncle was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PeduncleSource {
    /// By the file's labels: [`Cloud::PEDUNCLE`].
    Label,
    /// By a separate file.
    Companion,
    /// By comparison with the same cloud without it.
    Removal,
    /// By color.
    Hue(HueRange),
    /// Point by point, by hand.
    Picked,
}

/// The reason why a cloud's peduncle was not found.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PeduncleError {
    /// There are no labels.
    #[error("it has no labels (a property named label, class or scalar_label)")]
    NoLabels,
    /// No point is labeled so.
    #[error("none of its points is labeled {}, the peduncle's label", Cloud::PEDUNCLE)]
    NoneLabeled,
    /// There are no colors.
    #[error("it has no colors to tell the peduncle by")]
    NoColors,
    /// No point has such a color.
    #[error("none of its points has a hue from {}° to {}°", range.from_deg, range.to_deg)]
    NoneOfHue {
        /// The requested range.
        range: HueRange,
    },
    /// The companion has no points.
    #[error("the peduncle's file has no points")]
    EmptyCompanion,
    /// The cloud without its peduncle has no points.
    #[error("the cloud without its peduncle has no points")]
    EmptyBody,
    /// The cloud without its peduncle has every point of the cloud.
    #[error("no point of the cloud is missing in the cloud without its peduncle")]
    NoneRemoved,
    /// The cloud without its peduncle is another cloud.
    #[error(
        "it is not the same cloud without its peduncle: {missing} of {points} points are missing there, and \
         {strange} of its own {body} are not in the cloud"
    )]
    OtherBody {
        /// The cloud's points that are not in the other.
        missing: usize,
        /// The cloud's points.
        points: usize,
        /// The other's points that are not in the cloud.
        strange: usize,
        /// The other's points.
        body: usize,
    },
    /// A point was picked that the cloud does not have.
    #[error("point {index} (counted from 0) was picked, and the cloud has only {points} points")]
    NoSuchPoint {
        /// The first such index.
        index: usize,
        /// The cloud's points.
        points: usize,
    },
    /// The reference axis has no direction.
    #[error("the mean of the peduncle's points is the fruit center: they give no axis")]
    AtCenter,
    /// There are too few points to fit a direction to.
    #[error(
        "the peduncle has {points} points, and its own direction is fitted to {} or more",
        Peduncle::LEAST_FOR_DIRECTION
    )]
    TooFewForDirection {
        /// The peduncle's points.
        points: usize,
    },
    /// The points are spread about as far across as along.
    #[error(
        "the peduncle's points have no direction of their own: they are spread only {elongation:.2} times as far along as \
         across"
    )]
    NoDirection {
        /// The standard deviation along the direction of greatest spread, in those across it.
        elongation: f64,
    },
}

/// A fruit's peduncle: the distribution of its points, and the cloud's points that belong to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Peduncle {
    /// The way in which it was found.
    pub source: PeduncleSource,
    /// The mean of its points, in the cloud's unit and frame.
    pub mean: DVec3,
    /// The spread of its points about the mean.
    pub spread: Spread,
    /// The number of its points.
    pub points: usize,
    /// The indices of the cloud's points that belong to it, ascending. Empty if the peduncle has a separate file and the
    /// cloud is the body alone.
    pub in_cloud: Vec<usize>,
}

impl Peduncle {
    /// The points labeled [`Cloud::PEDUNCLE`].
    ///
    /// # Errors
    /// Returns an error if there are no labels, or none of them is the peduncle's.
    pub fn by_label(cloud: &Cloud) -> Result<Self, PeduncleError> {
        let labels = cloud.labels().ok_or(PeduncleError::NoLabels)?;
        Self::of_points(cloud, PeduncleSource::Label, |i| labels[i] == Cloud::PEDUNCLE)
            .ok_or(PeduncleError::NoneLabeled)
    }

    /// The points whose color has a hue in `range`.
    ///
    /// # Errors
    /// Returns an error if there are no colors, or none in the range.
    pub fn by_hue(cloud: &Cloud, range: HueRange) -> Result<Self, PeduncleError> {
        let colors = cloud.colors().ok_or(PeduncleError::NoColors)?;
        let is_peduncle = |i: usize| hue_deg(colors[i]).is_some_and(|hue| range.contains(hue));
        Self::of_points(cloud, PeduncleSource::Hue(range), is_peduncle)
            .ok_or(PeduncleError::NoneOfHue { range })
    }

    /// The points of a separate file, in the cloud's unit and frame. The cloud's points that
    /// coincide with one of them, to a ten-thousandth of the cloud's size, belong to it.
    ///
    /// # Errors
    /// Returns an error if the companion has no points.
    pub fn by_companion(cloud: &Cloud, companion: &Cloud) -> Result<Self, PeduncleError> {
        let points = companion.positions();
        let index = Neighbors::new(points).ok_or(PeduncleError::EmptyCompanion)?;
        let spread = Spread::of_points(points).ok_or(PeduncleError::EmptyCompanion)?;
        let size = Extent::robust(cloud.positions()).map_or(0.0, |e| e.size().length());
        let near = (1e-4 * size).powi(2);
        let nearest = index.nearest_of_each(cloud.positions());
        let coincides = |&i: &usize| nearest[i].distance_squared <= near;
        Ok(Self {
            source: PeduncleSource::Companion,
            mean: spread.mean,
            spread,
            points: points.len(),
            in_cloud: (0..cloud.len()).filter(coincides).collect(),
        })
    }

    /// The points that are missing in `body`, the same cloud without its peduncle (§ 2.1), in the same unit
    /// and frame. A point is missing if none of the body's coincides with it, to a ten-thousandth of the
    /// cloud's size.
    ///
    /// # Errors
    /// Returns an error if no point is missing, or if half of either cloud's points or more are not in the other: then
    /// these are two clouds, or one of them was filtered again.
    pub fn by_removal(cloud: &Cloud, body: &Cloud) -> Result<Self, PeduncleError> {
        let size = Extent::robust(cloud.positions()).map_or(0.0, |e| e.size().length());
        let near = (1e-4 * size).powi(2);
        let kept = Neighbors::new(body.positions()).ok_or(PeduncleError::EmptyBody)?;
        let in_body = kept.nearest_of_each(cloud.positions());
        let is_missing = |i: usize| in_body[i].distance_squared > near;
        let removed =
            Self::of_points(cloud, PeduncleSource::Removal, is_missing).ok_or(PeduncleError::NoneRemoved)?;
        let all = Neighbors::new(cloud.positions()).ok_or(PeduncleError::NoneRemoved)?;
        let in_cloud = all.nearest_of_each(body.positions());
        let strange = in_cloud.iter().filter(|n| n.distance_squared > near).count();
        if 2 * removed.points >= cloud.len() || 2 * strange >= body.len() {
            return Err(PeduncleError::OtherBody {
                missing: removed.points,
                points: cloud.len(),
                strange,
                body: body.len(),
            });
        }
        Ok(removed)
    }

    /// The points that were picked by hand; `None` for an empty selection.
    ///
    /// # Errors
    /// Returns an error if one of them is not the cloud's.
    pub fn by_points(cloud: &Cloud, picked: &PointSet) -> Result<Option<Self>, PeduncleError> {
        if let Some(index) = picked.iter().find(|&i| i >= cloud.len()) {
            let points = cloud.len();
            return Err(PeduncleError::NoSuchPoint { index, points });
        }
        Ok(Self::of_indices(
            cloud,
            PeduncleSource::Picked,
            picked.iter().collect(),
        ))
    }

    fn of_points(cloud: &Cloud, source: PeduncleSource, is_peduncle: impl Fn(usize) -> bool) -> Option<Self> {
        // Whatever a stray's label or color: far from the fruit it is no part of it, and would pull the mean away.
        let strays = strays(cloud.positions());
        let in_cloud = without(&strays, cloud.len())
            .filter(|&i| is_peduncle(i))
            .collect();
        Self::of_indices(cloud, source, in_cloud)
    }

    fn of_indices(cloud: &Cloud, source: PeduncleSource, in_cloud: Vec<usize>) -> Option<Self> {
        let spread = Spread::of(in_cloud.iter().map(|&i| (cloud.positions()[i], 1.0)))?;
        Some(Self {
            source,
            mean: spread.mean,
            spread,
            points: in_cloud.len(),
            in_cloud,
        })
    }

    /// The cloud without the peduncle's points: the paper's second variant of its data (§ 2.1).
    pub fn removed_from(&self, cloud: &Cloud) -> Cloud {
        let mut gone = self.in_cloud.iter().peekable();
        let kept: Vec<usize> = (0..cloud.len())
            .filter(|i| gone.next_if_eq(&i).is_none())
            .collect();
        cloud.select(&kept)
    }

    /// The reference axis of § 3.2: from the fruit center through the mean of the peduncle's points.
    ///
    /// # Errors
    /// Returns an error if center and mean coincide.
    pub fn reference_axis(&self, center: DVec3) -> Result<AxisEstimate, PeduncleError> {
        let direction = (self.mean - center)
            .try_normalize()
            .ok_or(PeduncleError::AtCenter)?;
        Ok(AxisEstimate {
            source: AxisSource::Peduncle,
            origin: center,
            direction,
            confidence: None,
        })
    }

    /// The fewest points that a direction is fitted to: with fewer, noise decides.
    pub const LEAST_FOR_DIRECTION: usize = 10;

    /// The least spread of the points along their direction, in multiples of their spread across it. A tube that is as
    /// long as wide has no direction, and the half of a stump that a camera sees is spread up to about twice as far
    /// across as it is deep.
    pub const LEAST_ELONGATION: f64 = 2.0;

    /// The standard deviation of the points along the direction of their greatest spread, in multiples
    /// of the greatest one across it; infinite for points on a line, 1 for a single point.
    pub fn elongation(&self) -> f64 {
        let [_, across, along] = self.spread.variances;
        if along > 0.0 { (along / across).sqrt() } else { 1.0 }
    }

    /// A second reference, the peduncle's own direction: the line through the mean of its points along
    /// which they are spread most, pointed away from the fruit center. It does not depend on the center
    /// otherwise, so it tells apart a method that failed from a center that is off.
    ///
    /// # Errors
    /// Returns an error if there are fewer than [`Peduncle::LEAST_FOR_DIRECTION`] points, or if they are spread less than
    /// [`Peduncle::LEAST_ELONGATION`] times as far along as across.
    pub fn direction_axis(&self, center: DVec3) -> Result<AxisEstimate, PeduncleError> {
        if self.points < Self::LEAST_FOR_DIRECTION {
            let points = self.points;
            return Err(PeduncleError::TooFewForDirection { points });
        }
        let elongation = self.elongation();
        if elongation < Self::LEAST_ELONGATION {
            return Err(PeduncleError::NoDirection { elongation });
        }
        let along = self.spread.axes[2];
        let outward = (self.mean - center).dot(along);
        Ok(AxisEstimate {
            source: AxisSource::PeduncleDirection,
            origin: self.mean,
            direction: if outward < 0.0 { -along } else { along },
            confidence: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_runs_from_the_center_through_the_peduncle_s_mean() {
        let cloud = Cloud::new(vec![
            DVec3::ZERO,
            DVec3::new(1.0, 4.0, 0.0),
            DVec3::new(3.0, 4.0, 0.0),
        ]);
        let cloud = cloud.with_labels(vec![0, 1, 1]).expect("one a point");
        let peduncle = Peduncle::by_label(&cloud).expect("labeled");
        let axis = peduncle
            .reference_axis(DVec3::new(2.0, 1.0, 0.0))
            .expect("an axis");
        assert!(axis.direction.distance(DVec3::Y) < 1e-12);
        assert_eq!(
            peduncle.reference_axis(peduncle.mean),
            Err(PeduncleError::AtCenter)
        );
        assert_eq!(peduncle.removed_from(&cloud).positions(), [DVec3::ZERO]);
    }
}
