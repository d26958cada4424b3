//! Each stage of the method on clouds of the paper's ellipsoid's shape.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::num::NonZeroUsize;

use axiscope::geometry::{Cloud, Neighbors, Plane, Unit, estimate_normals};
use axiscope::io::parse_cloud;
use axiscope::io::ply::{self, Encoding, WriteOptions};
use axiscope::method::{
    Aggregation, CandidateGrid, CenterMethod, Preset, RandomSearch, Ranking, Surface, TAU_CM_PER_RAD,
    find_center, fit_sphere, plane_detail, plane_terms,
};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::DVec3;

/// Points and normals of the half of an ellipsoid that faces the camera, evenly along a spiral and
/// then out of order, as points in files are.
fn ellipsoid(count: usize) -> (Vec<DVec3>, Vec<DVec3>) {
    let half_axes = DVec3::new(2.5, 2.5, 2.0);
    // Coprime to the counts used.
    let step = 7919;
    (0..count)
        .map(|i| {
            let i = i * step % count;
            let z = -(i as f64 + 0.5) / count as f64;
            let turn = i as f64 * 0.618_033_988_749_895 * TAU;
            let r = (1.0 - z * z).sqrt();
            let unit = DVec3::new(r * turn.cos(), r * turn.sin(), z);
            (
                unit * half_axes + DVec3::new(3.0, 5.0, 25.0),
                (unit / half_axes).normalize(),
            )
        })
        .unzip()
}

fn stages(c: &mut Criterion) {
    let mut group = c.benchmark_group("stages");
    group.sample_size(10);
    for count in [3_000, 30_000, 300_000] {
        let (points, normals) = ellipsoid(count);
        let center = DVec3::new(3.0, 5.0, 24.6);
        group.bench_function(BenchmarkId::new("neighbors build", count), |b| {
            b.iter(|| Neighbors::new(black_box(&points)));
        });
        let neighbors = Neighbors::new(&points).expect("there are points");
        let mirrored: Vec<DVec3> = (neighbors.order().iter())
            .map(|&i| points[i as usize])
            .map(|p| DVec3::new(6.2 - p.x, p.y, p.z))
            .collect();
        group.bench_function(BenchmarkId::new("nearest of mirrored points", count), |b| {
            b.iter(|| neighbors.nearest_of_each(black_box(&mirrored)));
        });
        group.bench_function(BenchmarkId::new("normals, k = 30", count), |b| {
            let k = NonZeroUsize::new(30).expect("above zero");
            b.iter(|| estimate_normals(black_box(&points), k, DVec3::ZERO, &()));
        });
        group.bench_function(BenchmarkId::new("center, sphere", count), |b| {
            b.iter(|| fit_sphere(black_box(&points)));
        });
        let surface = Surface::new(&points, &normals).expect("a surface");
        let grid = CandidateGrid::new(6).expect("a grid");
        group.bench_function(BenchmarkId::new("plane terms, u = 6", count), |b| {
            b.iter(|| {
                plane_terms(
                    black_box(&surface),
                    Unit::Centimeter,
                    center,
                    DVec3::ZERO,
                    grid,
                    &(),
                )
            });
        });
        let plane = Plane {
            point: center,
            normal: grid.candidate(14).normal,
        };
        group.bench_function(BenchmarkId::new("one plane's detail", count), |b| {
            b.iter(|| plane_detail(black_box(&surface), Unit::Centimeter, plane, DVec3::ZERO, &()));
        });
        group.bench_function(BenchmarkId::new("scores for another τ, u = 6", count), |b| {
            let planes = plane_terms(&surface, Unit::Centimeter, center, DVec3::ZERO, grid, &())
                .expect("nobody calls it off");
            b.iter(|| Ranking::new(black_box(&planes), TAU_CM_PER_RAD, Aggregation::Mean, 0.3));
        });
        let method = CenterMethod::of_preset(Preset::AsIntended, RandomSearch::default());
        group.bench_function(BenchmarkId::new("center, equidistant", count), |b| {
            b.iter(|| find_center(black_box(&points), &method, &()));
        });
        let cloud = Cloud::new(points.clone())
            .with_normals(normals.iter().map(|n| n.as_vec3()).collect())
            .expect("as many normals as points");
        for encoding in [Encoding::BinaryLittleEndian, Encoding::Ascii] {
            let mut bytes = Vec::new();
            let options = WriteOptions {
                encoding,
                ..WriteOptions::default()
            };
            ply::write(&mut bytes, &cloud, &options).expect("written to memory");
            group.bench_function(BenchmarkId::new(format!("read {encoding:?}"), count), |b| {
                b.iter(|| parse_cloud("cloud.ply", black_box(&bytes)));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, stages);
criterion_main!(benches);
