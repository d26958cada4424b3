//! The points that the method works on, each with a unit normal.

use std::num::NonZeroUsize;
use std::sync::{Arc, OnceLock};

use glam::DVec3;

use crate::geometry::{Cloud, Spread, estimate_normals};
use crate::neighbors::Neighbors;
use crate::parallel::{Cancelled, Watch};

/// Why a cloud is no surface that the method could work on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum SurfaceError {
    /// There are hardly any points.
    #[error("it has {found} points, and at least {} are needed", Surface::MIN_POINTS)]
    TooFewPoints {
        /// Points left after filters.
        found: usize,
    },
    /// All points are the same one.
    #[error("all of its {points} points are equal")]
    AllPointsEqual {
        /// How many there are.
        points: usize,
    },
    /// The points make a line.
    #[error("all of its {points} points lie on a line")]
    PointsOnALine {
        /// How many there are.
        points: usize,
    },
    /// The file's normals were asked for, and it has none.
    #[error("it has no normals of its own (nx, ny, nz); let them be estimated")]
    NoNormalsInFile,
    /// Hardly any point has a normal.
    #[error(
        "only {with_normal} of its {points} points have a normal, and at least {} are needed",
        Surface::MIN_POINTS
    )]
    TooFewNormals {
        /// Points with a normal.
        with_normal: usize,
        /// Points in all.
        points: usize,
    },
    /// The work was called off.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The used points of a cloud: those that have a normal. In the file's unit and frame.
#[derive(Debug, Clone)]
pub struct Surface {
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
    source: Vec<usize>,
    /// Built when it is first asked for, once for all planes and all their details.
    neighbors: OnceLock<Option<Arc<Neighbors>>>,
}

impl PartialEq for Surface {
    fn eq(&self, other: &Self) -> bool {
        (&self.points, &self.normals, &self.source) == (&other.points, &other.normals, &other.source)
    }
}

impl Surface {
    /// The fewest points that are worked on: a sphere takes four.
    pub const MIN_POINTS: usize = 4;

    /// Points with their normals, which are made of unit length; those without one are left out.
    ///
    /// # Errors
    /// Where the points or their normals are too few, all equal, or on a line. (Of columns of
    /// unequal length the longer one's end is left out.)
    pub fn new(points: &[DVec3], normals: &[DVec3]) -> Result<Self, SurfaceError> {
        check_spread(points)?;
        Self::of_those_with_normals(
            points,
            normals.iter().take(points.len()).map(|n| n.try_normalize()),
        )
    }

    /// The points of `cloud` with normals estimated from their `k` nearest (Eq. 2), turned towards
    /// `viewpoint`.
    ///
    /// # Errors
    /// Where the points or their normals are too few, all equal, or on a line.
    pub fn with_estimated_normals(
        cloud: &Cloud,
        k: NonZeroUsize,
        viewpoint: DVec3,
        watch: &dyn Watch,
    ) -> Result<Self, SurfaceError> {
        check_spread(cloud.positions())?;
        let normals = estimate_normals(cloud.positions(), k, viewpoint, watch)?;
        Self::of_those_with_normals(cloud.positions(), normals.into_iter())
    }

    /// The points of `cloud` with the file's normals as they stand there, made of unit length; they
    /// are not turned, since a normal that faces away from the viewpoint says that the point could
    /// not be seen from it (Eq. 11).
    ///
    /// # Errors
    /// Where the cloud has no normals, or too few, or its points are too few, equal or on a line.
    pub fn with_file_normals(cloud: &Cloud) -> Result<Self, SurfaceError> {
        let normals = cloud.normals().ok_or(SurfaceError::NoNormalsInFile)?;
        check_spread(cloud.positions())?;
        let unit = normals.iter().map(|n| n.as_dvec3().try_normalize());
        Self::of_those_with_normals(cloud.positions(), unit)
    }

    fn of_those_with_normals(
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

    /// How many points there are; at least [`Surface::MIN_POINTS`].
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Never: a surface has points.
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

    /// For each point its index in the cloud that it came from, ascending.
    pub fn source(&self) -> &[usize] {
        &self.source
    }

    /// The index of the points that all planes share, built by the first call. `None` where there
    /// are more points than it holds, [`u32::MAX`].
    pub fn neighbors(&self) -> Option<&Neighbors> {
        (self.neighbors)
            .get_or_init(|| Neighbors::new(&self.points).map(Arc::new))
            .as_deref()
    }

    /// How many normals face away from `viewpoint` (Eq. 11 fails for them).
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
    if Spread::of_points(points).is_none_or(|s| s.is_line()) {
        return Err(SurfaceError::PointsOnALine { points: found });
    }
    Ok(())
}
