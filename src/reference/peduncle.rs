//! The peduncle, and the reference axis that it gives (§ 3.2).

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::geometry::{Cloud, Extent, Neighbors};
use crate::method::{AxisEstimate, AxisSource};

/// A range of hues in degrees, 0 to 360; it may run through 0, as 350 to 20 does.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HueRange {
    /// Where it begins.
    pub from_deg: f64,
    /// Where it ends, inclusive.
    pub to_deg: f64,
}

impl HueRange {
    /// Whether a hue lies in the range.
    pub fn contains(&self, hue_deg: f64) -> bool {
        if self.from_deg <= self.to_deg {
            (self.from_deg..=self.to_deg).contains(&hue_deg)
        } else {
            hue_deg >= self.from_deg || hue_deg <= self.to_deg
        }
    }
}

/// How a cloud's peduncle was told from its body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PeduncleSource {
    /// By the file's labels: [`Cloud::PEDUNCLE`].
    Label,
    /// By a file of its own.
    Companion,
    /// By the same cloud without it.
    Removal,
    /// By color.
    Hue(HueRange),
}

/// Why a cloud's peduncle was not found as asked.
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
        /// The range that was asked for.
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
    /// The reference axis has no direction.
    #[error("the mean of the peduncle's points is the fruit center: they give no axis")]
    AtCenter,
}

/// A fruit's peduncle: where its points are, and which of the cloud's points belong to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Peduncle {
    /// How it was found.
    pub source: PeduncleSource,
    /// The mean of its points, in the cloud's unit and frame.
    pub mean: DVec3,
    /// How many points it has.
    pub points: usize,
    /// The indices of the cloud's points that belong to it, ascending. Empty where the peduncle has a
    /// file of its own and the cloud is the body alone.
    pub in_cloud: Vec<usize>,
}

/// Colors grayer than this share of their brightest channel have no hue to speak of.
const LEAST_SATURATION: f64 = 0.15;

/// The hue of a color (red, green, blue, alpha) in degrees, 0 to 360; `None` for grays.
pub fn hue_deg(color: [u8; 4]) -> Option<f64> {
    let [r, g, b] = [color[0], color[1], color[2]].map(f64::from);
    let (max, min) = (r.max(g).max(b), r.min(g).min(b));
    let chroma = max - min;
    if max <= 0.0 || chroma / max < LEAST_SATURATION {
        return None;
    }
    let sixth = if max == r {
        (g - b) / chroma
    } else if max == g {
        (b - r) / chroma + 2.0
    } else {
        (r - g) / chroma + 4.0
    };
    Some((60.0 * sixth).rem_euclid(360.0))
}

impl Peduncle {
    /// The points labeled [`Cloud::PEDUNCLE`].
    ///
    /// # Errors
    /// Where there are no labels, or none of them is the peduncle's.
    pub fn by_label(cloud: &Cloud) -> Result<Self, PeduncleError> {
        let labels = cloud.labels().ok_or(PeduncleError::NoLabels)?;
        Self::of_points(cloud, PeduncleSource::Label, |i| labels[i] == Cloud::PEDUNCLE)
            .ok_or(PeduncleError::NoneLabeled)
    }

    /// The points whose color has a hue in `range`.
    ///
    /// # Errors
    /// Where there are no colors, or none in the range.
    pub fn by_hue(cloud: &Cloud, range: HueRange) -> Result<Self, PeduncleError> {
        let colors = cloud.colors().ok_or(PeduncleError::NoColors)?;
        let is_peduncle = |i: usize| hue_deg(colors[i]).is_some_and(|hue| range.contains(hue));
        Self::of_points(cloud, PeduncleSource::Hue(range), is_peduncle)
            .ok_or(PeduncleError::NoneOfHue { range })
    }

    /// The points of a file of its own, in the cloud's unit and frame. The cloud's points that
    /// coincide with one of them, to a ten-thousandth of the cloud's size, belong to it.
    ///
    /// # Errors
    /// Where the companion has no points.
    pub fn by_companion(cloud: &Cloud, companion: &Cloud) -> Result<Self, PeduncleError> {
        let points = companion.positions();
        let index = Neighbors::new(points).ok_or(PeduncleError::EmptyCompanion)?;
        let size = Extent::robust(cloud.positions()).map_or(0.0, |e| e.size().length());
        let near = (1e-4 * size).powi(2);
        let coincides = |p: &DVec3| index.nearest(*p).distance_squared <= near;
        let belongs = cloud.positions().iter().enumerate();
        Ok(Self {
            source: PeduncleSource::Companion,
            mean: points.iter().sum::<DVec3>() / points.len() as f64,
            points: points.len(),
            in_cloud: belongs.filter(|(_, p)| coincides(p)).map(|(i, _)| i).collect(),
        })
    }

    /// The points that are missing in `body`, the same cloud without its peduncle (§ 2.1), in the same unit
    /// and frame. A point is missing where none of the body's coincides with it, to a ten-thousandth of the
    /// cloud's size.
    ///
    /// # Errors
    /// Where none is missing, or where half of either cloud's points or more are not in the other: then
    /// these are two clouds, or one of them was filtered anew.
    pub fn by_removal(cloud: &Cloud, body: &Cloud) -> Result<Self, PeduncleError> {
        let size = Extent::robust(cloud.positions()).map_or(0.0, |e| e.size().length());
        let near = (1e-4 * size).powi(2);
        let kept = Neighbors::new(body.positions()).ok_or(PeduncleError::EmptyBody)?;
        let is_missing = |p: DVec3| kept.nearest(p).distance_squared > near;
        let removed = Self::of_points(cloud, PeduncleSource::Removal, |i| {
            is_missing(cloud.positions()[i])
        })
        .ok_or(PeduncleError::NoneRemoved)?;
        let all = Neighbors::new(cloud.positions()).ok_or(PeduncleError::NoneRemoved)?;
        let is_strange = |p: &&DVec3| all.nearest(**p).distance_squared > near;
        let strange = body.positions().iter().filter(is_strange).count();
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

    fn of_points(cloud: &Cloud, source: PeduncleSource, is_peduncle: impl Fn(usize) -> bool) -> Option<Self> {
        let in_cloud: Vec<usize> = (0..cloud.len()).filter(|&i| is_peduncle(i)).collect();
        let sum: DVec3 = in_cloud.iter().map(|&i| cloud.positions()[i]).sum();
        (!in_cloud.is_empty()).then(|| Self {
            source,
            mean: sum / in_cloud.len() as f64,
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
    /// Where these are one point.
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_are_those_of_the_color_wheel() {
        let cases = [
            ([255, 0, 0, 255], 0.0),
            ([255, 255, 0, 255], 60.0),
            ([0, 200, 0, 255], 120.0),
            ([0, 0, 9, 255], 240.0),
        ];
        for (color, hue) in cases {
            assert_eq!(hue_deg(color), Some(hue));
        }
        assert_eq!(hue_deg([255, 0, 128, 0]).map(f64::round), Some(330.0));
        assert_eq!(hue_deg([128, 128, 128, 255]), None);
        assert_eq!(hue_deg([0, 0, 0, 255]), None);
        assert_eq!(hue_deg([100, 95, 97, 255]), None, "nearly gray");
    }

    #[test]
    fn a_range_may_run_through_red() {
        let red = HueRange {
            from_deg: 350.0,
            to_deg: 20.0,
        };
        assert!([350.0, 359.0, 0.0, 20.0].into_iter().all(|hue| red.contains(hue)));
        assert!([21.0, 180.0, 349.0].into_iter().all(|hue| !red.contains(hue)));
        let green = HueRange {
            from_deg: 90.0,
            to_deg: 150.0,
        };
        assert!(green.contains(120.0) && !green.contains(0.0) && !green.contains(151.0));
    }

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
