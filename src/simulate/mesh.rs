//! Surfaces as fine triangles, whose corners have a normal, a color and a label.

use glam::{DVec3, Vec3};

use super::views::View;

/// A point of a surface with its color (red, green, blue, 0 to 255).
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub(super) position: DVec3,
    pub(super) color: Vec3,
}

/// Triangles that share corners.
#[derive(Debug, Clone, Default)]
pub(super) struct Mesh {
    pub(super) positions: Vec<DVec3>,
    /// Of unit length after [`Mesh::finish`]; they may point to either side.
    pub(super) normals: Vec<DVec3>,
    pub(super) colors: Vec<Vec3>,
    /// A label for each corner; the three of a triangle are equal.
    pub(super) labels: Vec<i32>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Makes a closed skin over `rings` rings of `around` corners, with a single corner at either end.
    pub(super) fn skin(
        label: i32,
        (rings, around): (u32, u32),
        first: Vertex,
        last: Vertex,
        on_ring: impl Fn(u32, u32) -> Vertex,
    ) -> Self {
        let mut mesh = Self::default();
        mesh.push(first, label);
        for ring in 0..rings {
            for step in 0..around {
                mesh.push(on_ring(ring, step), label);
            }
        }
        mesh.push(last, label);
        let corner = |ring: u32, step: u32| 1 + ring * around + step % around;
        let end = 1 + rings * around;
        for step in 0..around {
            mesh.triangles.push([0, corner(0, step + 1), corner(0, step)]);
            for ring in 1..rings {
                mesh.quad(
                    corner(ring - 1, step),
                    corner(ring - 1, step + 1),
                    corner(ring, step + 1),
                    corner(ring, step),
                );
            }
            let (a, b) = (corner(rings - 1, step), corner(rings - 1, step + 1));
            mesh.triangles.push([a, b, end]);
        }
        mesh.finish()
    }

    /// Makes an open sheet of `columns` by `rows` corners.
    pub(super) fn sheet(
        label: i32,
        (columns, rows): (u32, u32),
        corner: impl Fn(u32, u32) -> Vertex,
    ) -> Self {
        let mut mesh = Self::default();
        for row in 0..rows {
            for column in 0..columns {
                mesh.push(corner(column, row), label);
            }
        }
        for row in 1..rows {
            for column in 1..columns {
                let (below, here) = ((row - 1) * columns + column, row * columns + column);
                mesh.quad(below - 1, below, here, here - 1);
            }
        }
        mesh.finish()
    }

    /// Makes a surface of triangles whose corners have a color and a label each.
    pub(super) fn of_triangles(
        positions: Vec<DVec3>,
        colors: Vec<Vec3>,
        labels: Vec<i32>,
        triangles: Vec<[u32; 3]>,
    ) -> Self {
        let mesh = Self {
            positions,
            normals: Vec::new(),
            colors,
            labels,
            triangles,
        };
        mesh.finish()
    }

    fn push(&mut self, vertex: Vertex, label: i32) {
        self.positions.push(vertex.position);
        self.colors.push(vertex.color);
        self.labels.push(label);
    }

    fn quad(&mut self, a: u32, b: u32, c: u32, d: u32) {
        self.triangles.push([a, b, c]);
        self.triangles.push([a, c, d]);
    }

    /// Gives each corner the mean normal of its triangles, weighted by their areas.
    fn finish(mut self) -> Self {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|i| self.positions[i as usize]);
            let twice_the_area = (b - a).cross(c - a);
            for &i in corners {
                normals[i as usize] += twice_the_area;
            }
        }
        self.normals = normals.into_iter().map(DVec3::normalize_or_zero).collect();
        self
    }

    /// Adds another surface to this one.
    pub(super) fn append(&mut self, other: &Self) {
        let offset = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        self.colors.extend(&other.colors);
        self.labels.extend(&other.labels);
        self.triangles
            .extend(other.triangles.iter().map(|t| t.map(|i| i + offset)));
    }

    /// Moves the surface from the frame into that of a camera in it.
    pub(super) fn seen_from(self, view: View) -> Self {
        let to_camera = view.rotation.transpose();
        self.moved(to_camera, -(to_camera * view.position_cm))
    }

    /// Moves the surface rigidly.
    pub(super) fn moved(mut self, rotation: glam::DMat3, translation: DVec3) -> Self {
        for p in &mut self.positions {
            *p = rotation * *p + translation;
        }
        for n in &mut self.normals {
            *n = rotation * *n;
        }
        self
    }
}
