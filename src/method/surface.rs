//! The points that the method works on, each with a unit normal.

use std::num::NonZeroUsize;
use std::sync::{Arc, OnceLock};

use glam::DVec3;

use super::Params;
use crate::geometry::{Cloud, Extent, Spread, estimate_normals};
use crate::neighbors::Neighbors;
use crate::parallel::{Cancelled, Watch};

/// Why a cloud cannot be used as a surface.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// There are fewer than [`Surface::MIN_POINTS`] points.
    #[error("it has {found} points, and at least {} are needed", Surface::MIN_POINTS)]
    TooFewPoints {
        /// Points left after filters.
        found: usize,
    },
    /// All points are equal.
    #[error("all of its {points} points are equal")]
    AllPointsEqual {
        /// Points of the cloud.
        points: usize,
    },
    /// The coordinates are out of the range of the computation.
    #[error(
        "its coordinates reach {largest:e} and its points span {span:e}: at most {max:e} and at least {min:e} can be computed with",
        max = Params::LARGEST,
        min = 1.0 / Params::LARGEST
    )]
    OutOfRange {
        /// The largest coordinate by amount, in the file's unit.
        largest: f64,
        /// The longest edge of the points' box, in the file's unit.
        span: f64,
    },
    /// All points lie on a line.
    #[error("all of its {points} points lie on a line")]
    PointsOnALine {
        /// Points of the cloud.
        points: usize,
    },
    /// The file's normals were requested, and it has none.
    #[error("it has no normals of its own (nx, ny, nz); let them be estimated")]
    NoNormalsInFile,
    /// Fewer than [`Surface::MIN_POINTS`] points have a normal.
    #[error(
        "only {with_normal} of its {points} points have a normal, and at least {} are needed",
        Surface::MIN_POINTS
    )]
    TooFewNormals {
        /// Points with a normal.
        with_normal: usize,
        /// Points of the cloud.
        points: usize,
    },
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The used points of a cloud, which are those that have a normal, in the file's unit and frame.
#[derive(Debug, Clone)]
pub struct Surface {
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
    source: Vec<usize>,
    /// The search tree, built for the first plane and shared by all planes and their details.
    neighbors: OnceLock<Option<Arc<Neighbors>>>,
}

impl PartialEq for Surface {
    fn eq(&self, other: &Self) -> bool {
        (&self.points, &self.normals, &self.source) == (&other.points, &other.normals, &other.source)
    }
}

impl Surface {
    /// The fewest points of a surface: a sphere takes four.
    pub const MIN_POINTS: usize = 4;

    /// Makes a surface of points and their normals, which are scaled to unit length. Points whose normal
    /// is zero are left out, and so is the end of the longer column if the lengths differ.
    ///
    /// # Errors
    /// Returns an error if the points or their normals are too few, or the points are all equal or on a
    /// line.
    pub fn new(points: &[DVec3], normals: &[DVec3]) -> Result<Self, SurfaceError> {
        check_spread(points)?;
        Self::with_normals(
            points,
            normals.iter().take(points.len()).map(|n| n.try_normalize()),
        )
    }

    /// Makes a surface of a cloud with normals that are estimated from the `k` nearest points of each
    /// (Eq. 2) and turned towards `viewpoint`.
    ///
    /// # Errors
    /// Returns an error if the points or their normals are too few, the points are all equal or on a
    /// line, or the watch cancels the work.
    pub fn with_estimated_normals(
        cloud: &Cloud,
        k: NonZeroUsize,
        viewpoint: DVec3,
        watch: &dyn Watch,
    ) -> Result<Self, SurfaceError> {
        check_spread(cloud.positions())?;
        let normals = estimate_normals(cloud.positions(), k, viewpoint, watch)?;
        Self::with_normals(cloud.positions(), normals.into_iter())
    }

    /// Makes a surface of a cloud with the normals of its file, scaled to unit length. They are not
    /// turned, since a normal that faces away from the viewpoint says that the point could not be seen
    /// from there (Eq. 11).
    ///
    /// # Errors
    /// Returns an error if the cloud has no normals or too few, or its points are too few, all equal or
    /// on a line.
    pub fn with_file_normals(cloud: &Cloud) -> Result<Self, SurfaceError> {
        let normals = cloud.normals().ok_or(SurfaceError::NoNormalsInFile)?;
        check_spread(cloud.positions())?;
        let unit = normals.iter().map(|n| n.as_dvec3().try_normalize());
        Self::with_normals(cloud.positions(), unit)
    }

    fn with_normals(
        points: &[DVec3],
        normals: impl Iterator<Item = Option<DVec3>>,
    ) -> Result<Self, SurfaceError> {
        let mut surface = Self {
            points: Vec::with_capacity(points.len()),
            normals: Vec::with_capacity(points.len()),
            source: Vec::with_capacity(points.len()),
            neighbors: OnceLock::new(),
        };
        for (i, normal) in normals.enumerate() {
            if let Some(normal) = normal {
                surface.points.push(points[i]);
                surface.normals.push(normal);
                surface.source.push(i);
            }
        }
        if surface.len() < Self::MIN_POINTS {
            return Err(SurfaceError::TooFewNormals {
                with_normal: surface.len(),
                points: points.len(),
            });
        }
        Ok(surface)
    }

    /// The number of points, at least [`Surface::MIN_POINTS`].
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Always false, since a surface has points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Positions in the file's unit and frame.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Unit normals, one a point.
    pub fn normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// The index of each point in the cloud that the surface was made of, ascending.
    pub fn source(&self) -> &[usize] {
        &self.source
    }

    /// The search tree of the points, built by the first call. `None` for more than [`u32::MAX`] points,
    /// which it cannot hold.
    pub fn neighbors(&self) -> Option<&Neighbors> {
        (self.neighbors)
            .get_or_init(|| Neighbors::new(&self.points).map(Arc::new))
            .as_deref()
    }

    /// [`Surface::neighbors`], whose building is called off by a watch.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if the watch cancels the work.
    pub fn neighbors_watched(&self, watch: &dyn Watch) -> Result<Option<&Neighbors>, Cancelled> {
        if self.neighbors.get().is_none() {
            let built = Neighbors::new_watched(&self.points, watch)?.map(Arc::new);
            // Whoever else has built it meanwhile has built the same.
            let _ = self.neighbors.set(built);
        }
        Ok(self.neighbors())
    }

    /// The number of normals that face away from `viewpoint`, for which Eq. 11 fails.
    pub fn facing_away(&self, viewpoint: DVec3) -> usize {
        let faces_away = |(p, n): (&DVec3, &DVec3)| n.dot(viewpoint - *p) < 0.0;
        self.points
            .iter()
            .zip(&self.normals)
            .filter(|&pair| faces_away(pair))
            .count()
    }
}

fn check_spread(points: &[DVec3]) -> Result<(), SurfaceError> {
    let found = points.len();
    if found < Surface::MIN_POINTS {
        return Err(SurfaceError::TooFewPoints { found });
    }
    if points.iter().all(|&p| p == points[0]) {
        return Err(SurfaceError::AllPointsEqual { points: found });
    }
    if let Some(extent) = Extent::of(points) {
        let largest = extent.min.abs().max(extent.max.abs()).max_element();
        let span = extent.size().max_element();
        if largest > Params::LARGEST || span < 1.0 / Params::LARGEST {
            return Err(SurfaceError::OutOfRange { largest, span });
        }
    }
    if Spread::of_points(points).is_none_or(|s| s.is_line()) {
        return Err(SurfaceError::PointsOnALine { points: found });
    }
    Ok(())
}
