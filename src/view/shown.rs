//! The points that are shown, and which of them the method used.

use std::collections::HashMap;

use glam::DVec3;

use crate::geometry::{Cloud, Neighbors};
use crate::method::Analysis;
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
}

impl ShownPoints {
    /// Every point of the file. Where a voxel grid has replaced them by others, these are shown, each
    /// with the color and label of the file's point nearest to it.
    pub fn new(cloud: &Cloud, analysis: &Analysis) -> Self {
        let surface = analysis.surface.points();
        if analysis.params.filters.voxel_cm.is_some() {
            let nearest = Neighbors::new(cloud.positions());
            let source: Vec<usize> = surface
                .iter()
                .map(|&p| nearest.as_ref().map_or(0, |n| n.nearest(p).index))
                .collect();
            return Self {
                positions: surface.to_vec(),
                colors: cloud.colors().map(|c| source.iter().map(|&i| c[i]).collect()),
                labels: cloud.labels().map(|l| source.iter().map(|&i| l[i]).collect()),
                in_surface: (0..surface.len()).map(Some).collect(),
            };
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
        Self {
            positions: cloud.positions().to_vec(),
            colors: cloud.colors().map(<[_]>::to_vec),
            labels: cloud.labels().map(<[_]>::to_vec),
            in_surface,
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
