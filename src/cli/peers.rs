//! Other libraries at the work of ours, for `axiscope bench`.

use std::fs::File;
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::path::Path;

use anyhow::Context;
use glam::DVec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

fn kiddo_tree(points: &[DVec3]) -> anyhow::Result<ImmutableKdTree<f64, 3>> {
    let rows: Vec<[f64; 3]> = points.iter().map(DVec3::to_array).collect();
    ImmutableKdTree::new_from_slice(&rows)
        .ok()
        .context("kiddo does not take these points")
}

/// Builds kiddo's tree of `points` and finds the nearest of each query.
pub(super) fn kiddo_nearest(points: &[DVec3], queries: &[DVec3]) -> anyhow::Result<()> {
    let tree = kiddo_tree(points)?;
    for query in queries {
        let query = query.to_array();
        black_box(
            tree.query(&query)
                .nearest_one::<SquaredEuclidean<f64>>()
                .execute(),
        );
    }
    Ok(())
}

/// Builds kiddo's tree of `points` and finds the `k` nearest of each query.
pub(super) fn kiddo_k_nearest(points: &[DVec3], queries: &[DVec3], k: NonZeroUsize) -> anyhow::Result<()> {
    let tree = kiddo_tree(points)?;
    for query in queries {
        let query = query.to_array();
        black_box(tree.query(&query).nearest_n::<SquaredEuclidean<f64>>(k).execute());
    }
    Ok(())
}

/// Reads a PLY file by `ply-rs-bw`.
pub(super) fn ply_rs_read(path: &Path) -> anyhow::Result<()> {
    let ply = Parser::<Vertex>::new().read_ply(&mut File::open(path)?)?;
    let vertices = ply.payload.get("vertex").context("there are vertices")?;
    let sums = vertices
        .iter()
        .map(|v| v.single_or_double.iter().sum::<f64>() + f64::from(v.bytes[0]));
    black_box(sums.sum::<f64>());
    Ok(())
}

/// Position and normal, and the color.
#[derive(Default)]
struct Vertex {
    single_or_double: [f64; 6],
    bytes: [u8; 4],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let column = match name {
            "x" | "red" => 0,
            "y" | "green" => 1,
            "z" | "blue" => 2,
            "nx" | "alpha" => 3,
            "ny" => 4,
            "nz" => 5,
            _ => return PropertyAccessResult::Ignored,
        };
        match property {
            Property::Float(value) => self.single_or_double[column] = f64::from(value),
            Property::Double(value) => self.single_or_double[column] = value,
            Property::UChar(value) if column < 4 => self.bytes[column] = value,
            _ => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}
