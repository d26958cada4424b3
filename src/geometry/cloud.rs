//! A point cloud: positions, and the other columns of its file.

use std::sync::Arc;

use glam::{DVec3, Vec3};

/// A per-point column whose length is not the number of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{rows} {column} for {points} points")]
pub struct LengthMismatch {
    /// The name of the column's values.
    pub column: &'static str,
    /// Rows in the column.
    pub rows: usize,
    /// Points in the cloud.
    pub points: usize,
}

/// Points of one fruit as one camera saw them, in the file's unit and frame.
///
/// Every position is finite, and every column that is present has one row a point; the fields are
/// private to keep it so. Columns are shared between a cloud and its copies.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cloud {
    positions: Arc<Vec<DVec3>>,
    normals: Option<Arc<Vec<Vec3>>>,
    colors: Option<Arc<Vec<[u8; 4]>>>,
    labels: Option<Arc<Vec<i32>>>,
}

impl Cloud {
    /// A cloud of bare positions. Those that are not finite are left out: nothing downstream can
    /// place them. (A reader that has other columns drops such rows itself, and counts them.)
    pub fn new(mut positions: Vec<DVec3>) -> Self {
        positions.retain(|p| p.is_finite());
        Self {
            positions: Arc::new(positions),
            ..Self::default()
        }
    }

    /// Adds the file's normals, one a point; a zero vector stands for "none".
    ///
    /// # Errors
    /// Returns an error if there is not one for each point.
    pub fn with_normals(mut self, normals: Vec<Vec3>) -> Result<Self, LengthMismatch> {
        self.check("normals", normals.len())?;
        self.normals = Some(Arc::new(normals));
        Ok(self)
    }

    /// Adds colors as red, green, blue, alpha, 0 to 255 (sRGB), one a point.
    ///
    /// # Errors
    /// Returns an error if there is not one for each point.
    pub fn with_colors(mut self, colors: Vec<[u8; 4]>) -> Result<Self, LengthMismatch> {
        self.check("colors", colors.len())?;
        self.colors = Some(Arc::new(colors));
        Ok(self)
    }

    /// Adds integer labels, one a point. Our own files use [`Cloud::FRUIT`] and its neighbors.
    ///
    /// # Errors
    /// Returns an error if there is not one for each point.
    pub fn with_labels(mut self, labels: Vec<i32>) -> Result<Self, LengthMismatch> {
        self.check("labels", labels.len())?;
        self.labels = Some(Arc::new(labels));
        Ok(self)
    }

    /// The label of the fruit's own points.
    pub const FRUIT: i32 = 0;
    /// The label of the peduncle's points.
    pub const PEDUNCLE: i32 = 1;
    /// The label of a leaf in front of the fruit.
    pub const LEAF: i32 = 2;

    /// Adds columns that have one row a point by construction.
    pub(crate) fn with_columns(
        mut self,
        normals: Option<Vec<Vec3>>,
        colors: Option<Vec<[u8; 4]>>,
        labels: Option<Vec<i32>>,
    ) -> Self {
        let points = self.len();
        debug_assert!(normals.as_ref().is_none_or(|c| c.len() == points));
        debug_assert!(colors.as_ref().is_none_or(|c| c.len() == points));
        debug_assert!(labels.as_ref().is_none_or(|c| c.len() == points));
        self.normals = normals.map(Arc::new);
        self.colors = colors.map(Arc::new);
        self.labels = labels.map(Arc::new);
        self
    }

    /// Leaves out colors and labels unless they are to be kept.
    pub(crate) fn without_columns(mut self, keep_colors: bool, keep_labels: bool) -> Self {
        self.colors = self.colors.filter(|_| keep_colors);
        self.labels = self.labels.filter(|_| keep_labels);
        self
    }

    fn check(&self, column: &'static str, rows: usize) -> Result<(), LengthMismatch> {
        let points = self.len();
        if rows == points {
            Ok(())
        } else {
            Err(LengthMismatch { column, rows, points })
        }
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Positions in the file's unit and frame.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// A shared handle to the positions, which are not copied.
    pub fn shared_positions(&self) -> Arc<Vec<DVec3>> {
        self.positions.clone()
    }

    /// A shared handle to the colors.
    pub fn shared_colors(&self) -> Option<Arc<Vec<[u8; 4]>>> {
        self.colors.clone()
    }

    /// A shared handle to the labels.
    pub fn shared_labels(&self) -> Option<Arc<Vec<i32>>> {
        self.labels.clone()
    }

    /// Whether the positions and normals are the very columns of `other`, shared and not merely equal:
    /// whatever is computed from one of the clouds holds for both.
    pub fn shares_points_with(&self, other: &Self) -> bool {
        let same_normals = match (&self.normals, &other.normals) {
            (Some(ours), Some(theirs)) => Arc::ptr_eq(ours, theirs),
            (ours, theirs) => ours.is_none() && theirs.is_none(),
        };
        Arc::ptr_eq(&self.positions, &other.positions) && same_normals
    }

    /// The file's normals as they stand there (any length; zero for "none"), if it has any.
    pub fn normals(&self) -> Option<&[Vec3]> {
        self.normals.as_deref().map(Vec::as_slice)
    }

    /// Red, green, blue, alpha, 0 to 255, if the file has colors.
    pub fn colors(&self) -> Option<&[[u8; 4]]> {
        self.colors.as_deref().map(Vec::as_slice)
    }

    /// Labels, if the file has any.
    pub fn labels(&self) -> Option<&[i32]> {
        self.labels.as_deref().map(Vec::as_slice)
    }

    /// The points at `indices`, in that order, with all their columns.
    ///
    /// # Panics
    /// Panics if an index is not below [`Cloud::len`].
    #[must_use]
    pub fn select(&self, indices: &[usize]) -> Self {
        fn pick<T: Copy>(column: &[T], indices: &[usize]) -> Vec<T> {
            indices.iter().map(|&i| column[i]).collect()
        }
        Self {
            positions: Arc::new(pick(&self.positions, indices)),
            normals: self.normals().map(|c| Arc::new(pick(c, indices))),
            colors: self.colors().map(|c| Arc::new(pick(c, indices))),
            labels: self.labels().map(|c| Arc::new(pick(c, indices))),
        }
    }
}
