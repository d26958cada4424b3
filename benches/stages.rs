//! Each stage of the method on clouds of the shape of the paper's ellipsoid, and the scoring of planes on clouds
//! that search trees are slow on.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::num::NonZeroUsize;

use axiscope::fruit::parse_cloud;
use axiscope::geometry::{Cloud, Plane, Unit, estimate_normals};
use axiscope::method::{
    Aggregation, CandidateGrid, CenterMethod, Preset, RandomSearch, Ranking, Surface, TAU_CM_PER_RAD,
    find_center, fit_sphere, plane_detail, plane_terms,
};
use axiscope::neighbors::Neighbors;
use axiscope::ply::{self, Encoding, WriteOptions};
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
                unit * half_axes + ELLIPSOID_CENTER,
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

/// Moves point `i`, which is `at` on the ellipsoid and `d` seen from its center.
type Move = fn(i: usize, at: DVec3, d: DVec3) -> DVec3;

const ELLIPSOID_CENTER: DVec3 = DVec3::new(3.0, 5.0, 25.0);

/// Point `i` of a clump, the points of which fill a unit cube evenly.
fn in_clump(i: usize) -> DVec3 {
    (DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * i as f64).fract() - 0.5
}

const AWKWARD: [(&str, Move); 6] = [
    ("even", |_, at, _| at),
    ("equal coordinates", |_, at, _| (at * 20.0).round() / 20.0),
    ("a line", |i, _, d| {
        ELLIPSOID_CENTER + DVec3::new(d.x, 1e-3 * in_clump(i).x, 1e-3 * in_clump(i).y)
    }),
    ("8 clumps", |i, _, d| {
        ELLIPSOID_CENTER + 2.0 * d.signum() + 1e-2 * in_clump(i)
    }),
    ("one far stray", |i, at, _| if i == 0 { at + 1e6 } else { at }),
    ("quantized depth", |_, at, _| {
        DVec3::new(at.x, at.y, (at.z * 10.0).round() / 10.0)
    }),
];

fn awkward(c: &mut Criterion) {
    let mut group = c.benchmark_group("plane terms with their index, u = 6");
    group.sample_size(10);
    let grid = CandidateGrid::new(6).expect("a grid");
    let center = DVec3::new(3.0, 5.0, 24.6);
    for count in [3_000, 30_000] {
        let (points, normals) = ellipsoid(count);
        for (name, moved) in AWKWARD {
            let points: Vec<DVec3> = (points.iter().enumerate())
                .map(|(i, &at)| moved(i, at, at - ELLIPSOID_CENTER))
                .collect();
            group.bench_function(BenchmarkId::new(name, count), |b| {
                b.iter(|| {
                    let surface = Surface::new(black_box(&points), &normals).expect("a surface");
                    plane_terms(&surface, Unit::Centimeter, center, DVec3::ZERO, grid, &())
                });
            });
        }
        // Ten points at each place.
        let duplicates: Vec<DVec3> = (0..count).map(|i| points[i / 10]).collect();
        group.bench_function(BenchmarkId::new("duplicates", count), |b| {
            b.iter(|| {
                let surface = Surface::new(black_box(&duplicates), &normals).expect("a surface");
                plane_terms(&surface, Unit::Centimeter, center, DVec3::ZERO, grid, &())
            });
        });
    }
    group.finish();
}

criterion_group!(benches, stages, awkward);
criterion_main!(benches);
