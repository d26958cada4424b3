//! A thinned surface: the means of cubic cells, so that a fit costs the same for any number of points.

use glam::DVec3;

use crate::geometry::{by_cell, voxel_edge_for};
use crate::parallel::{Cancelled, Watch};

/// Points with normals, spread evenly over the visible surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Positions in centimeters, relative to the viewpoint.
    pub points: Vec<DVec3>,
    /// Unit normals, one a point, turned towards the viewpoint.
    pub normals: Vec<DVec3>,
}

/// Cells with fewer points than this share of the median cell's are left out: they hold strays.
const LEAST_SHARE: f64 = 0.15;

impl Sample {
    /// Replaces points by the means of at most `most` cubic cells.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if the watch cancels the work.
    pub(super) fn of(
        points: &[DVec3],
        normals: &[DVec3],
        most: usize,
        watch: &dyn Watch,
    ) -> Result<Self, Cancelled> {
        let Some(edge) = voxel_edge_for(points, most, watch)? else {
            return Ok(Self {
                points: points.to_vec(),
                normals: normals.to_vec(),
            });
        };
        let (order, starts) = by_cell(points, edge, watch)?;
        let mut counts: Vec<usize> = starts.windows(2).map(|w| w[1] - w[0]).collect();
        counts.sort_unstable();
        let least = LEAST_SHARE * counts.get(counts.len() / 2).map_or(0.0, |&c| c as f64);
        let mut sample = Self {
            points: Vec::with_capacity(counts.len()),
            normals: Vec::with_capacity(counts.len()),
        };
        for cell in starts.windows(2).map(|w| &order[w[0]..w[1]]) {
            let normal = cell.iter().map(|&i| normals[i]).sum::<DVec3>().try_normalize();
            if let Some(normal) = normal.filter(|_| cell.len() as f64 >= least) {
                let sum: DVec3 = cell.iter().map(|&i| points[i]).sum();
                sample.points.push(sum / cell.len() as f64);
                sample.normals.push(normal);
            }
        }
        Ok(sample)
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}
