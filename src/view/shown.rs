//! The points that are shown, and which of them the method used.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::geometry::{Cloud, Extent, Neighbors, map_pieces, near_one_another};
use crate::method::{Analysis, Surface};
use crate::render::Color;

/// The points of a cloud as shown beside its analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownPoints {
    /// Positions in the file's unit and frame.
    pub positions: Vec<DVec3>,
    /// The file's colors, if it has any.
    pub colors: Option<Vec<Color>>,
    /// The file's labels, if it has any.
    pub labels: Option<Vec<i32>>,
    /// For each point its index in the analysis' surface; `None` where it was not used.
    pub in_surface: Vec<Option<usize>>,
    /// For each point the file's point that it stands for; `None` where each is the file's own.
    pub in_file: Option<Vec<usize>>,
    /// What the bulk of the points spans.
    pub extent: Extent,
    /// Positions less the extent's center, as the renderer wants them.
    pub local_positions: Arc<[Vec3]>,
}

impl ShownPoints {
    /// Every point of the file. Where a voxel grid has replaced them by others, these are shown, each
    /// with the color and label of the file's point nearest to it. Where only a sample was analyzed,
    /// all points are shown still, and each stands for the used point nearest to it, unless its cube
    /// cannot have held it.
    pub fn new(cloud: &Cloud, analysis: &Analysis) -> Self {
        let surface = analysis.surface.points();
        if analysis.params.filters.voxel_cm.is_some() {
            let nearest = Neighbors::new(cloud.positions());
            let source: Vec<usize> = surface
                .iter()
                .map(|&p| nearest.as_ref().map_or(0, |n| n.nearest(p).index))
                .collect();
            let mut shown = Self::of(
                surface.to_vec(),
                cloud.colors().map(|c| source.iter().map(|&i| c[i]).collect()),
                cloud.labels().map(|l| source.iter().map(|&i| l[i]).collect()),
                (0..surface.len()).map(Some).collect(),
            );
            shown.in_file = Some(source);
            return shown;
        }
        if let Some(edge) = analysis.sample_edge {
            return Self::of_cloud(cloud, nearest_in(&analysis.surface, cloud.positions(), edge));
        }
        // Everything else only leaves points out: those that stayed have the very coordinates.
        let key = |p: &DVec3| p.to_array().map(|c| (c + 0.0).to_bits());
        let mut places: HashMap<[u64; 3], Vec<usize>> = HashMap::with_capacity(surface.len());
        for (i, p) in surface.iter().enumerate().rev() {
            places.entry(key(p)).or_default().push(i);
        }
        let in_surface = cloud
            .positions()
            .iter()
            // Copies of one point take their places in the surface in turn.
            .map(|p| places.get_mut(&key(p)).and_then(Vec::pop))
            .collect();
        Self::of_cloud(cloud, in_surface)
    }

    /// Every point of a file that was not analyzed, or could not be.
    pub fn bare(cloud: &Cloud) -> Self {
        Self::of_cloud(cloud, vec![None; cloud.len()])
    }

    fn of_cloud(cloud: &Cloud, in_surface: Vec<Option<usize>>) -> Self {
        Self::of(
            cloud.positions().to_vec(),
            cloud.colors().map(<[_]>::to_vec),
            cloud.labels().map(<[_]>::to_vec),
            in_surface,
        )
    }

    fn of(
        positions: Vec<DVec3>,
        colors: Option<Vec<Color>>,
        labels: Option<Vec<i32>>,
        in_surface: Vec<Option<usize>>,
    ) -> Self {
        let extent = Extent::robust(&positions).unwrap_or(Extent {
            min: DVec3::ZERO,
            max: DVec3::ONE,
        });
        let origin = extent.center();
        Self {
            local_positions: positions.iter().map(|&p| (p - origin).as_vec3()).collect(),
            positions,
            colors,
            labels,
            in_surface,
            in_file: None,
            extent,
        }
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }
}

/// For each point the used point nearest to it, if one lies within a cube's diagonal.
fn nearest_in(surface: &Surface, points: &[DVec3], edge: f64) -> Vec<Option<usize>> {
    let mut all = vec![None; points.len()];
    let Some(neighbors) = surface.neighbors() else {
        return all;
    };
    let farthest_squared = 3.0 * edge * edge;
    // Close points ask for nearly the same.
    let order = near_one_another(points, 8.0 * edge);
    let pieces = map_pieces(order.len(), 4096, &(), |range| {
        let queries: Vec<DVec3> = order[range.clone()].iter().map(|&i| points[i]).collect();
        let index =
            |n: &crate::geometry::Neighbor| (n.distance_squared <= farthest_squared).then_some(n.index);
        neighbors
            .nearest_of_each(&queries)
            .iter()
            .map(index)
            .collect::<Vec<_>>()
    });
    // Nobody calls this off.
    for (&i, found) in order.iter().zip(pieces.into_iter().flatten().flatten()) {
        all[i] = found;
    }
    all
}
