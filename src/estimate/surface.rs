//! The visible surface of a fruit, prepared once for all estimators.

use std::num::NonZeroUsize;

use glam::DVec3;

use super::{EstimateError, Sample, View};
use crate::geometry::{Spread, Unit, by_cell, estimate_normals, strays_watched, voxel_edge_for, without};
use crate::method::fit_sphere;
use crate::parallel::{Cancelled, Watch};

/// The visible surface of a fruit, without its peduncle if that is known: what every estimator but the paper's works on.
///
/// Positions are in centimeters, along the axes of the file's frame, **relative to the viewpoint**: the camera is at
/// zero, and the ray to a point is the point itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// All points (or the means of small cells if they are more than [`Surface::MOST_POINTS`]).
    pub points: Vec<DVec3>,
    /// Unit normals, one a point: turned towards the viewpoint, or, unless [`View::OneCamera`], away from the middle.
    pub normals: Vec<DVec3>,
    /// About 160 points, for searches.
    pub coarse: Sample,
    /// About 450 points, for the last fit.
    pub fine: Sample,
    /// The kind of view. Only one camera's has an outline.
    pub view: View,
    /// The size of the fruit in centimeters: the points' spread (RMS distance from their mean) / 0.87, which for the
    /// seen half of a sphere is about its radius.
    pub size_cm: f64,
    /// The mean of the points.
    pub mean: DVec3,
    /// A guess at the fruit's center, behind the seen surface.
    pub center: DVec3,
    viewpoint: DVec3,
    unit: Unit,
}

impl Surface {
    /// The fewest points of a surface that a body is fitted to.
    pub const LEAST_POINTS: usize = 100;
    /// The most points that are kept; more would not change a fit.
    pub const MOST_POINTS: usize = 12_000;

    const COARSE: usize = 160;
    const FINE: usize = 450;

    /// Prepares the surface of a fruit from its points and its viewpoint, in the file's unit and frame. Strays are left out.
    ///
    /// # Errors
    /// Returns an error if the points are too few, on a line or in a plane, or the watch cancels the work.
    pub fn new(
        positions: &[DVec3],
        unit: Unit,
        viewpoint: DVec3,
        watch: &dyn Watch,
    ) -> Result<Self, EstimateError> {
        let in_cm = unit.in_cm();
        // A single stray would set the size and the center.
        let strays = strays_watched(positions, watch)?;
        let kept = without(&strays, positions.len()).map(|i| positions[i]);
        let points: Vec<DVec3> = kept.map(|p| (p - viewpoint) * in_cm).collect();
        let points = thinned(points, watch)?;
        let (points, mut normals) = with_normals(points, watch)?;
        let spread = checked_spread(&points)?;
        let size_cm = spread.rms_radius() / 0.87;
        let view = View::of(&points, size_cm);
        if view != View::OneCamera {
            for (normal, point) in normals.iter_mut().zip(&points) {
                let outward = normal.dot(*point - spread.mean) >= 0.0;
                *normal = if outward { *normal } else { -*normal };
            }
        }
        Ok(Self {
            coarse: Sample::of(&points, &normals, Self::COARSE, watch)?,
            fine: Sample::of(&points, &normals, Self::FINE, watch)?,
            center: start_center(&points, &spread, view),
            mean: spread.mean,
            points,
            normals,
            view,
            size_cm,
            viewpoint,
            unit,
        })
    }

    /// The unit of the file.
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// Returns a position of this room in the file's unit and frame.
    pub fn in_file(&self, position_cm: DVec3) -> DVec3 {
        self.viewpoint + position_cm / self.unit.in_cm()
    }
}

/// The means of small cells, if there are more than [`Surface::MOST_POINTS`].
fn thinned(points: Vec<DVec3>, watch: &dyn Watch) -> Result<Vec<DVec3>, Cancelled> {
    let Some(edge) = voxel_edge_for(&points, Surface::MOST_POINTS, watch)? else {
        return Ok(points);
    };
    let (order, starts) = by_cell(&points, edge, watch)?;
    let cells = starts.windows(2).map(|w| &order[w[0]..w[1]]);
    let mean = |cell: &[usize]| cell.iter().map(|&i| points[i]).sum::<DVec3>() / cell.len() as f64;
    Ok(cells.map(mean).collect())
}

/// The points that have a normal, and the normals, turned towards the viewpoint.
fn with_normals(points: Vec<DVec3>, watch: &dyn Watch) -> Result<(Vec<DVec3>, Vec<DVec3>), Cancelled> {
    const FEW: NonZeroUsize = NonZeroUsize::new(20).unwrap();
    const MANY: NonZeroUsize = NonZeroUsize::new(30).unwrap();
    let k = if points.len() < 4_000 { FEW } else { MANY };
    let normals = estimate_normals(&points, k, DVec3::ZERO, watch)?;
    let both = points.into_iter().zip(normals);
    Ok(both.filter_map(|(point, normal)| Some((point, normal?))).unzip())
}

/// The spread of points that are a surface.
fn checked_spread(points: &[DVec3]) -> Result<Spread, EstimateError> {
    /// A plane's thickness, which is noise, as a share of its length.
    const FLAT: f64 = 0.03;
    let (points_found, least) = (points.len(), Surface::LEAST_POINTS);
    let too_few = EstimateError::TooFewPoints {
        points: points_found,
        least,
    };
    let spread = Spread::of_points(points).ok_or(too_few)?;
    let [thickness, width, length] = spread.variances.map(f64::sqrt);
    if points_found < least {
        Err(too_few)
    } else if width <= FLAT * length {
        Err(EstimateError::Line)
    } else if thickness <= FLAT * length {
        Err(EstimateError::Flat)
    } else {
        Ok(spread)
    }
}

/// The center of the sphere that fits the points, kept from 0.25 to 1 spreads behind their mean and at most half a
/// spread beside it; the mean itself unless one camera saw the fruit from outside.
fn start_center(points: &[DVec3], spread: &Spread, view: View) -> DVec3 {
    let mean = spread.mean;
    let (View::OneCamera, Some(ahead)) = (view, mean.try_normalize()) else {
        return mean;
    };
    let rms = spread.rms_radius();
    let offset = fit_sphere(points).map_or(ahead * 0.5 * rms, |(center, _)| center - mean);
    let behind = offset.dot(ahead).clamp(0.25 * rms, rms);
    let beside = (offset - offset.dot(ahead) * ahead).clamp_length_max(0.5 * rms);
    mean + behind * ahead + beside
}
