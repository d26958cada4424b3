//! A surface of triangles that comes from elsewhere.

use glam::{DVec3, Vec3};
use rustc_hash::FxHashMap;

use super::mesh::Mesh;
use crate::geometry::Cloud;

/// The reason why triangles are no surface that can be scanned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// There are no triangles.
    #[error("it has no triangles")]
    NoTriangles,
    /// There are more than [`TriangleMesh::MOST_TRIANGLES`].
    #[error(
        "it has {triangles} triangles, and at most {} are scanned",
        TriangleMesh::MOST_TRIANGLES
    )]
    TooManyTriangles {
        /// The number of triangles.
        triangles: usize,
    },
    /// A triangle has a corner that is no vertex.
    #[error("triangle {triangle} has the corner {corner}, and there are {vertices} vertices")]
    NoSuchVertex {
        /// The triangle, from 0.
        triangle: usize,
        /// The index of its corner.
        corner: u32,
        /// The number of vertices.
        vertices: usize,
    },
    /// A coordinate is infinite or no number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// The vertex, from 0.
        vertex: usize,
    },
    /// All triangles are lines or points.
    #[error("none of its triangles has an area")]
    NoArea,
}

/// Triangles whose corners are shared, in any unit and frame. Every corner is finite, and some triangle has an area.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    colors: Option<Vec<[u8; 4]>>,
    labels: Option<Vec<i32>>,
}

impl TriangleMesh {
    /// The most triangles of a mesh.
    pub const MOST_TRIANGLES: usize = 20_000_000;

    /// Makes a mesh of positions and, for each triangle, the indices of its three corners. Corners at one place
    /// become one, since files repeat them along seams, or for each triangle.
    ///
    /// # Errors
    /// Returns an error if there are no triangles or too many, a corner is missing or not finite, or no triangle has
    /// an area.
    pub fn new(positions: &[DVec3], triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        Self::with_vertices(&Cloud::new(positions.to_vec()), positions, triangles)
    }

    /// Makes a mesh whose vertices are the points of a cloud, with its colors and labels.
    ///
    /// # Errors
    /// Returns the errors of [`TriangleMesh::new`].
    pub fn of_cloud(vertices: &Cloud, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        Self::with_vertices(vertices, vertices.positions(), triangles)
    }

    fn with_vertices(
        columns: &Cloud,
        positions: &[DVec3],
        mut triangles: Vec<[u32; 3]>,
    ) -> Result<Self, MeshError> {
        check(positions, &triangles)?;
        let mut places: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        let mut merged = Vec::new();
        let place_of: Vec<u32> = (0..)
            .zip(positions)
            .map(|(i, p)| {
                // Both zeros are one place.
                let bits = (*p + DVec3::ZERO).to_array().map(f64::to_bits);
                *places.entry(bits).or_insert_with(|| {
                    merged.push(i);
                    merged.len() as u32 - 1
                })
            })
            .collect();
        for corners in &mut triangles {
            *corners = corners.map(|i| place_of[i as usize]);
        }
        // Labels without a fruit among them are of no use here.
        let labels = columns.labels().filter(|labels| labels.contains(&Cloud::FRUIT));
        let mesh = Self {
            positions: merged.iter().map(|&i: &usize| positions[i]).collect(),
            triangles,
            colors: (columns.colors()).map(|colors| merged.iter().map(|&i| colors[i]).collect()),
            labels: labels.map(|labels| merged.iter().map(|&i| labels[i]).collect()),
        };
        let has_area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length_squared() > 0.0;
        if mesh.corners().any(has_area) {
            Ok(mesh)
        } else {
            Err(MeshError::NoArea)
        }
    }

    /// The places of corners.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The corners of the triangles, as indices of [`TriangleMesh::positions`].
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Whether the corners have colors.
    pub fn has_colors(&self) -> bool {
        self.colors.is_some()
    }

    /// Whether the corners have labels, of which some are [`Cloud::FRUIT`].
    pub fn has_labels(&self) -> bool {
        self.labels.is_some()
    }

    /// The center of the box around all triangles and the radius of the ball around it that holds them.
    pub fn ball(&self) -> (DVec3, f64) {
        let all = || self.corners().flatten();
        let low = all().fold(DVec3::INFINITY, DVec3::min);
        let high = all().fold(DVec3::NEG_INFINITY, DVec3::max);
        let center = low.midpoint(high);
        (center, all().map(|p| p.distance(center)).fold(0.0, f64::max))
    }

    fn corners(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.triangles
            .iter()
            .map(|corners| corners.map(|i| self.positions[i as usize]))
    }

    /// The mesh as the camera takes it, with smooth normals, scaled.
    pub(super) fn scaled(&self, scale: f64) -> Mesh {
        let color = |c: &[u8; 4]| Vec3::new(c[0].into(), c[1].into(), c[2].into());
        let count = self.positions.len();
        Mesh::of_triangles(
            self.positions.iter().map(|&p| p * scale).collect(),
            (self.colors.as_ref()).map_or_else(|| vec![Vec3::ZERO; count], |c| c.iter().map(color).collect()),
            self.labels.clone().unwrap_or_else(|| vec![Cloud::FRUIT; count]),
            self.triangles.clone(),
        )
    }
}

fn check(positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    if triangles.is_empty() {
        return Err(MeshError::NoTriangles);
    }
    if triangles.len() > TriangleMesh::MOST_TRIANGLES {
        return Err(MeshError::TooManyTriangles {
            triangles: triangles.len(),
        });
    }
    if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
        return Err(MeshError::NotFinite { vertex });
    }
    let vertices = positions.len();
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&corner) = corners.iter().find(|&&i| i as usize >= vertices) {
            return Err(MeshError::NoSuchVertex {
                triangle,
                corner,
                vertices,
            });
        }
    }
    Ok(())
}
