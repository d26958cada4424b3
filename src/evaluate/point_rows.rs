//! Every used point of a cloud under one plane, with its place in the file.

use glam::DVec3;

use super::Examination;
use crate::method::{PlaneDetail, PointSteps};
use crate::neighbors::Neighbors;

/// A used point of a cloud under one plane (Eq. 12–15).
#[derive(Debug, Clone, PartialEq)]
pub struct PointRow {
    /// The index of the point in the file, from 0; `None` where a voxel grid put the point in the place of several.
    pub index_in_file: Option<usize>,
    /// The index in the file of its visible partner; `None` without a partner, or if that is not the file's.
    pub partner_in_file: Option<usize>,
    /// The steps of the method for it.
    pub steps: PointSteps,
}

/// Collects the rows of all used points under the plane of `detail`, in the order of the surface.
pub fn point_rows(examined: &Examination, detail: &PlaneDetail) -> Vec<PointRow> {
    let analysis = &examined.analysis;
    let surface = &analysis.surface;
    let in_file = indices_in_file(examined.fruit.cloud().positions(), surface.points());
    (0..surface.len())
        .filter_map(|i| {
            let steps = PointSteps::new(analysis, detail, i)?;
            Some(PointRow {
                index_in_file: in_file[i],
                partner_in_file: steps.partner.as_ref().and_then(|p| in_file[p.surface_index]),
                steps,
            })
        })
        .collect()
}

/// Finds the index of each used point in the file: the filters keep points as they are, or replace them by means,
/// which have none.
fn indices_in_file(file: &[DVec3], used: &[DVec3]) -> Vec<Option<usize>> {
    let Some(neighbors) = Neighbors::new(file) else {
        return vec![None; used.len()];
    };
    let nearest = neighbors.nearest_of_each(used);
    nearest
        .iter()
        .zip(used)
        .map(|(nearest, used)| (file[nearest.index] == *used).then_some(nearest.index))
        .collect()
}
