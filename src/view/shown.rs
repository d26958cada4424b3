//! The points that are shown, with their places among the points that the method used.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::geometry::{Cloud, Extent, near_one_another, strays};
use crate::method::{Analysis, Surface};
use crate::neighbors::Neighbors;
use crate::parallel::map_pieces;
use crate::render::Color;

/// The points of a cloud as shown beside its analysis. Columns are the cloud's own, not copies.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownPoints {
    /// Positions in the file's unit and frame.
    pub positions: Arc<Vec<DVec3>>,
    /// The file's colors, if it has any.
    pub colors: Option<Arc<Vec<Color>>>,
    /// The file's labels, if it has any.
    pub labels: Option<Arc<Vec<i32>>>,
    /// For each point its index in the analysis' surface.
    pub in_surface: Places,
    /// For each point the index of its point in the file; `None` if the points are the file's own.
    pub in_file: Option<Vec<usize>>,
    /// The indices of the points that lie far from all others, ascending.
    pub strays: Vec<usize>,
    /// The extent of the bulk of the points.
    pub extent: Extent,
    /// Positions relative to the extent's center, as the renderer needs them.
    pub local_positions: Arc<[Vec3]>,
}

/// The optional place of each point among others: four bytes per point.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// Empty if no point has a place.
    of: Vec<u32>,
    len: usize,
}

impl Places {
    const NONE: u32 = u32::MAX;

    /// No place for any of `len` points.
    pub fn none(len: usize) -> Self {
        Self { of: Vec::new(), len }
    }

    /// The number of points, with a place or without.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The place of a point; `None` also if there is no such point.
    pub fn get(&self, point: usize) -> Option<usize> {
        let place = self.of.get(point).copied();
        place
            .filter(|&place| place != Self::NONE)
            .map(|place| place as usize)
    }

    /// All points' places.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<usize>> {
        (0..self.len).map(|point| self.get(point))
    }
}

impl FromIterator<Option<usize>> for Places {
    fn from_iter<I: IntoIterator<Item = Option<usize>>>(places: I) -> Self {
        // More cannot be indexed, and so have no neighbors to be partners of anyway.
        let small = |place: usize| u32::try_from(place).unwrap_or(Self::NONE);
        let of: Vec<u32> = places
            .into_iter()
            .map(|place| place.map_or(Self::NONE, small))
            .collect();
        Self { len: of.len(), of }
    }
}

impl ShownPoints {
    /// Every point of the file. Where a voxel grid has replaced them by others, these are shown, each
    /// with the color and label of the file's point nearest to it. Where only a sample was analyzed,
    /// all points are still shown, each in the place of the nearest used point, unless that lies outside of its cube.
    pub fn new(cloud: &Cloud, analysis: &Analysis) -> Self {
        Self::bare(cloud).analyzed(cloud, analysis)
    }

    /// [`ShownPoints::new`] for points that were shown [`ShownPoints::bare`] before, with which it shares its columns where
    /// possible.
    #[must_use]
    pub fn analyzed(&self, cloud: &Cloud, analysis: &Analysis) -> Self {
        let surface = analysis.surface.points();
        if analysis.params.filters.voxel_cm.is_some() {
            let nearest = Neighbors::new(cloud.positions()).map(|n| n.nearest_of_each(surface));
            let source: Vec<usize> = nearest.into_iter().flatten().map(|n| n.index).collect();
            let shown = Self::of(
                Arc::new(surface.to_vec()),
                (cloud.colors()).map(|c| Arc::new(source.iter().map(|&i| c[i]).collect())),
                (cloud.labels()).map(|l| Arc::new(source.iter().map(|&i| l[i]).collect())),
            );
            return Self {
                in_surface: (0..surface.len()).map(Some).collect(),
                in_file: Some(source),
                ..shown
            };
        }
        let in_surface = match analysis.sample_edge {
            Some(edge) => nearest_in(&analysis.surface, cloud.positions(), edge),
            None => same_in(surface, cloud.positions()),
        };
        Self {
            in_surface,
            ..self.clone()
        }
    }

    /// Every point of a file that was not analyzed, or could not be.
    pub fn bare(cloud: &Cloud) -> Self {
        Self::of(
            cloud.shared_positions(),
            cloud.shared_colors(),
            cloud.shared_labels(),
        )
    }

    fn of(
        positions: Arc<Vec<DVec3>>,
        colors: Option<Arc<Vec<Color>>>,
        labels: Option<Arc<Vec<i32>>>,
    ) -> Self {
        let strays = strays(&positions);
        let extent = Extent::robust_without(&positions, &strays).unwrap_or(Extent {
            min: DVec3::ZERO,
            max: DVec3::ONE,
        });
        let origin = extent.center();
        Self {
            // Strays may lie farther away than single precision reaches.
            local_positions: (positions.iter())
                .map(|&p| (p - origin).clamp(-FARTHEST, FARTHEST).as_vec3())
                .collect(),
            in_surface: Places::none(positions.len()),
            positions,
            colors,
            labels,
            in_file: None,
            strays,
            extent,
        }
    }

    /// Values of the file's points as values of the shown points.
    pub(super) fn of_file<'a>(&self, values: &'a [i32]) -> Cow<'a, [i32]> {
        match &self.in_file {
            Some(in_file) => in_file.iter().map(|&i| values[i]).collect(),
            None => values.into(),
        }
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }
}

/// The farthest local position along an axis.
const FARTHEST: DVec3 = DVec3::splat(1e30);

/// For each point the used point of the very same coordinates: all but a voxel grid only leave points out.
fn same_in(surface: &[DVec3], points: &[DVec3]) -> Places {
    let key = |p: &DVec3| p.to_array().map(|c| (c + 0.0).to_bits());
    let mut places: HashMap<[u64; 3], Vec<usize>> = HashMap::with_capacity(surface.len());
    for (i, p) in surface.iter().enumerate().rev() {
        places.entry(key(p)).or_default().push(i);
    }
    points
        .iter()
        // Copies of one point take their places in the surface in turn.
        .map(|p| places.get_mut(&key(p)).and_then(Vec::pop))
        .collect()
}

/// For each point the used point nearest to it, if one lies within a cube's diagonal.
fn nearest_in(surface: &Surface, points: &[DVec3], edge: f64) -> Places {
    let Some(neighbors) = surface.neighbors() else {
        return Places::none(points.len());
    };
    let mut all = vec![None; points.len()];
    let farthest_squared = 3.0 * edge * edge;
    // Close points ask for nearly the same.
    let order = near_one_another(points, 8.0 * edge);
    let pieces = map_pieces(order.len(), 4096, &(), |range| {
        let queries: Vec<DVec3> = order[range.clone()].iter().map(|&i| points[i]).collect();
        let index =
            |n: &crate::neighbors::Neighbor| (n.distance_squared <= farthest_squared).then_some(n.index);
        neighbors
            .nearest_of_each(&queries)
            .iter()
            .map(index)
            .collect::<Vec<_>>()
    });
    // Without a watch, nothing is called off.
    for (&i, found) in order.iter().zip(pieces.into_iter().flatten().flatten()) {
        all[i] = found.map(|index| index as u32);
    }
    all.into_iter()
        .map(|place| place.map(|place| place as usize))
        .collect()
}
