//! The size of a cloud, from all points or without its strays.

use glam::DVec3;

use super::strays::{strays, without};

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The lowest corner.
    pub min: DVec3,
    /// The highest corner.
    pub max: DVec3,
}

impl Extent {
    /// The box that holds all points; `None` if there are none.
    pub fn of(points: &[DVec3]) -> Option<Self> {
        let first = *points.first()?;
        Some(points.iter().fold(
            Self {
                min: first,
                max: first,
            },
            |e, &p| Self {
                min: e.min.min(p),
                max: e.max.max(p),
            },
        ))
    }

    /// The box between the 2nd and the 98th percentile of each coordinate of the points that are no
    /// [`strays`]. `None` if there are no points.
    pub fn robust(points: &[DVec3]) -> Option<Self> {
        Self::robust_without(points, &strays(points))
    }

    /// [`Extent::robust`] with the points' strays, found before; ascending indices.
    pub(crate) fn robust_without(points: &[DVec3], strays: &[usize]) -> Option<Self> {
        if strays.is_empty() {
            return Self::between_percentiles(points);
        }
        let kept: Vec<DVec3> = without(strays, points.len()).map(|i| points[i]).collect();
        Self::between_percentiles(&kept)
    }

    fn between_percentiles(points: &[DVec3]) -> Option<Self> {
        if points.is_empty() {
            return None;
        }
        // Rounded outwards, so that the few points of a small cloud all count.
        let low = (points.len() - 1) * 2 / 100;
        let high = points.len() - 1 - low;
        let mut column = Vec::with_capacity(points.len());
        let mut range = |axis: usize| {
            column.clear();
            column.extend(points.iter().map(|p| p[axis]));
            let percentile =
                |column: &mut [f64], rank| *column.select_nth_unstable_by(rank, f64::total_cmp).1;
            (percentile(&mut column, low), percentile(&mut column, high))
        };
        let [x, y, z] = [range(0), range(1), range(2)];
        Some(Self {
            min: DVec3::new(x.0, y.0, z.0),
            max: DVec3::new(x.1, y.1, z.1),
        })
    }

    /// The lengths of the edges.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// The center of the box.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }
}
