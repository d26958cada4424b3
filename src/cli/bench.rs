//! `axiscope bench`: how long each stage takes here, beside other programs where they are at hand.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use anyhow::Context;
use axiscope::fruit::read_cloud;
use axiscope::geometry::{Cloud, Plane, Unit, estimate_normals};
use axiscope::method::{
    CandidateGrid, CenterMethod, Preset, RandomSearch, Surface, find_center, plane_detail, plane_terms,
};
use axiscope::neighbors::Neighbors;
use axiscope::ply::{self, Encoding, WriteOptions};
use clap::Args;
use glam::{DVec3, Vec3};

use super::peers;

/// Time each stage on simulated clouds, beside other programs where they are installed.
///
/// Every figure is the least of several runs, taken in turn with the other program's. Nothing is
/// downloaded; what is not installed is left out.
#[derive(Debug, Args)]
pub(super) struct Bench {
    /// Points of the clouds that are analyzed
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "3000,30000,300000", value_parser = clap::value_parser!(u32).range(100..=100_000_000))]
    points: Vec<u32>,
    /// Points of the files that are read
    #[arg(long, value_name = "N", default_value = "1000000", value_parser = clap::value_parser!(u32).range(100..=100_000_000))]
    read_points: u32,
    /// Runs of each stage
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u8).range(1..))]
    runs: u8,
    /// A program that scores planes by nanoflann, called as `PROGRAM FILE U CX CY CZ UNIT_IN_CM`: the file has
    /// x y z nx ny nz as 32-bit floats a point; it prints an object with `build_ms` and `score_ms`
    #[arg(long, value_name = "PROGRAM")]
    peer_nanoflann: Option<PathBuf>,
    /// The Python whose modules open3d and trimesh are measured, if it has them
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: PathBuf,
}

pub(super) fn run(args: &Bench) -> anyhow::Result<()> {
    let folder = Folder::new()?;
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "Least of {} runs on {}; the ratio is the other program's time to ours.\n",
        args.runs,
        match threads() {
            1 => "one thread".to_string(),
            threads => format!("{threads} threads"),
        }
    )?;
    writeln!(
        out,
        "{:<24} {:>10} {:>12}  other programs",
        "stage", "points", "time"
    )?;
    read_stages(args, &folder, &mut out)?;
    for &points in &args.points {
        analysis_stages(args, points as usize, &folder, &mut out)?;
    }
    Ok(())
}

#[cfg(feature = "parallel")]
fn threads() -> usize {
    rayon::current_num_threads()
}

#[cfg(not(feature = "parallel"))]
fn threads() -> usize {
    1
}

/// A row of the table.
struct Row<'a> {
    stage: &'a str,
    points: usize,
    ms: f64,
    others: Vec<(&'static str, Option<f64>)>,
}

impl Row<'_> {
    fn write(&self, out: &mut impl Write) -> std::io::Result<()> {
        let of_other = |&(name, ms): &(&str, Option<f64>)| {
            let ms = ms?;
            Some(format!("{name} {} ({:.1}×)", time(ms), ms / self.ms))
        };
        let others: Vec<String> = self.others.iter().filter_map(of_other).collect();
        let others = if others.is_empty() {
            "–".to_string()
        } else {
            others.join(", ")
        };
        let (stage, points) = (self.stage, self.points);
        writeln!(out, "{stage:<24} {points:>10} {:>12}  {others}", time(self.ms))?;
        out.flush()
    }
}

fn time(ms: f64) -> String {
    if ms < 1000.0 {
        format!("{ms:.2} ms")
    } else {
        format!("{:.2} s", ms / 1e3)
    }
}

fn read_stages(args: &Bench, folder: &Folder, out: &mut impl Write) -> anyhow::Result<()> {
    let count = args.read_points as usize;
    let (points, normals) = ellipsoid(count);
    let color = |i: usize| [i as u8, (i >> 8) as u8, (i >> 16) as u8, 255];
    let cloud = Cloud::new(points)
        .with_normals(normals.iter().map(|n| n.as_vec3()).collect::<Vec<Vec3>>())?
        .with_colors((0..count).map(color).collect())?;
    for (stage, encoding) in [
        ("read, binary", Encoding::BinaryLittleEndian),
        ("read, ASCII", Encoding::Ascii),
    ] {
        let path = folder.0.join("cloud.ply");
        let options = WriteOptions {
            encoding,
            ..WriteOptions::default()
        };
        ply::write(
            std::io::BufWriter::new(std::fs::File::create(&path)?),
            &cloud,
            &options,
        )?;
        let open3d = "import open3d\ndef work(f): open3d.io.read_point_cloud(f)";
        let trimesh = "import trimesh\ndef work(f): trimesh.load(f)";
        let mut ply_rs = f64::INFINITY;
        let ms = least(args.runs, || {
            let ms = timed(|| Ok(read_cloud(&path).map(drop)?))?;
            ply_rs = ply_rs.min(timed(|| peers::ply_rs_read(&path))?);
            Ok(Some(ms))
        })?;
        Row {
            stage,
            points: count,
            ms,
            others: vec![
                ("ply-rs-bw", Some(ply_rs)),
                ("Open3D", python(args, open3d, &path)),
                ("trimesh", python(args, trimesh, &path)),
            ],
        }
        .write(out)?;
    }
    Ok(())
}

fn analysis_stages(args: &Bench, count: usize, folder: &Folder, out: &mut impl Write) -> anyhow::Result<()> {
    let (points, normals) = ellipsoid(count);
    let (mut row, k) = (
        |row: Row<'_>| row.write(out),
        NonZeroUsize::new(30).context("above zero")?,
    );
    let raw = folder.0.join("rows.bin");
    let rows = points.iter().zip(&normals).flat_map(|(p, n)| {
        let row = [p.as_vec3().to_array(), n.as_vec3().to_array()];
        row.into_iter().flatten().flat_map(f32::to_le_bytes)
    });
    std::fs::write(&raw, rows.collect::<Vec<u8>>())?;

    let ms = least(args.runs, || {
        black_box(estimate_normals(black_box(&points), k, DVec3::ZERO, &()))?;
        Ok(None)
    })?;
    let open3d = "import numpy, open3d\n\
        def work(f):\n p = open3d.geometry.PointCloud(c)\n p.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(30))\n\
        c = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(\
        numpy.fromfile(sys.argv[1], '<f4').reshape(-1, 6)[:, :3].astype(float)))";
    row(Row {
        stage: "normals, k = 30",
        points: count,
        ms,
        others: vec![("Open3D", python(args, open3d, &raw))],
    })?;
    let method = CenterMethod::of_preset(Preset::AsIntended, RandomSearch::default());
    let ms = least(args.runs, || {
        black_box(find_center(black_box(&points), &method, &()))?;
        Ok(None)
    })?;
    row(Row {
        stage: "center, equidistant",
        points: count,
        ms,
        others: Vec::new(),
    })?;
    let center = DVec3::new(3.0, 5.0, 24.6);
    for (stage, u) in [("plane terms, u = 6", 6), ("plane terms, u = 12", 12)] {
        let mut other = f64::INFINITY;
        let ms = least(args.runs, || {
            // A surface of its own for each run, since it keeps the index of its points.
            let surface = Surface::new(&points, &normals)?;
            let started = Instant::now();
            let grid = CandidateGrid::new(u)?;
            black_box(plane_terms(
                &surface,
                Unit::Centimeter,
                center,
                DVec3::ZERO,
                grid,
                &(),
            ))?;
            let ms = started.elapsed().as_secs_f64() * 1e3;
            // In turn, so that both meet whatever else the machine does.
            if let Some(program) = &args.peer_nanoflann {
                other = other.min(nanoflann(program, &raw, u, center)?);
            }
            Ok(Some(ms))
        })?;
        row(Row {
            stage,
            points: count,
            ms,
            others: vec![("nanoflann", other.is_finite().then_some(other))],
        })?;
    }
    search_stages(args, &points, center, &mut row)?;
    // Whoever looks at a plane has had its score computed, and so the index of the points.
    let surface = Surface::new(&points, &normals)?;
    surface.neighbors();
    let plane = Plane {
        point: center,
        normal: CandidateGrid::new(6)?.candidate(14).normal,
    };
    let ms = least(args.runs, || {
        black_box(plane_detail(
            black_box(&surface),
            Unit::Centimeter,
            plane,
            DVec3::ZERO,
            &(),
        ))?;
        Ok(None)
    })?;
    row(Row {
        stage: "one plane's detail",
        points: count,
        ms,
        others: Vec::new(),
    })?;
    Ok(())
}

/// The search for neighbors alone, on one thread, with the building of the tree.
fn search_stages(
    args: &Bench,
    points: &[DVec3],
    center: DVec3,
    row: &mut impl FnMut(Row<'_>) -> std::io::Result<()>,
) -> anyhow::Result<()> {
    let index = Neighbors::new(points).context("there are points")?;
    let in_order: Vec<DVec3> = index.order().iter().map(|&i| points[i as usize]).collect();
    // A sixth of the planes, of every angle.
    let planes = CandidateGrid::new(6)?.candidates().step_by(7);
    let mirrored = planes.flat_map(|candidate| {
        let plane = Plane {
            point: center,
            normal: candidate.normal,
        };
        in_order.iter().map(move |&p| plane.reflect_point(p))
    });
    let mirrored: Vec<DVec3> = mirrored.collect();
    let k = NonZeroUsize::new(30).context("above zero")?;
    for stage in ["nearest, mirrored", "30 nearest, one thread"] {
        let is_mirrored = stage == "nearest, mirrored";
        let mut kiddo = f64::INFINITY;
        let ms = least(args.runs, || {
            let ms = timed(|| {
                let index = Neighbors::new(points).context("there are points")?;
                if is_mirrored {
                    black_box(index.nearest_of_each(&mirrored));
                } else {
                    for &query in &in_order {
                        black_box(index.nearest_places(query, k));
                    }
                }
                Ok(())
            })?;
            kiddo = kiddo.min(timed(|| {
                if is_mirrored {
                    peers::kiddo_nearest(points, &mirrored)
                } else {
                    peers::kiddo_k_nearest(points, &in_order, k)
                }
            })?);
            Ok(Some(ms))
        })?;
        row(Row {
            stage,
            points: points.len(),
            ms,
            others: vec![("kiddo", Some(kiddo))],
        })?;
    }
    Ok(())
}

/// The time that work takes in milliseconds.
fn timed(work: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<f64> {
    let started = Instant::now();
    work()?;
    Ok(started.elapsed().as_secs_f64() * 1e3)
}

/// The least time of several runs in milliseconds; a run may tell its own.
fn least(runs: u8, mut work: impl FnMut() -> anyhow::Result<Option<f64>>) -> anyhow::Result<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..runs {
        let started = Instant::now();
        let told = work()?;
        least = least.min(told.unwrap_or_else(|| started.elapsed().as_secs_f64() * 1e3));
    }
    Ok(least)
}

fn nanoflann(program: &Path, rows: &Path, u: usize, center: DVec3) -> anyhow::Result<f64> {
    let output = Command::new(program)
        .arg(rows)
        .args([u.to_string()])
        .args(center.to_array().map(|c| c.to_string()))
        .arg("1")
        .output()
        .with_context(|| program.display().to_string())?;
    let told: serde_json::Value = serde_json::from_slice(&output.stdout)
        .with_context(|| format!("{}: it printed no JSON object", program.display()))?;
    let ms = |key: &str| told[key].as_f64();
    (ms("build_ms").zip(ms("score_ms")))
        .map(|(build, score)| build + score)
        .with_context(|| format!("{}: it told no `build_ms` and `score_ms`", program.display()))
}

/// The least time of a Python function `work(file)`, measured in Python after its imports; `None`
/// where these fail.
fn python(args: &Bench, define: &str, file: &Path) -> Option<f64> {
    let script = format!(
        "import sys, time\n{define}\nleast = float('inf')\nfor _ in range({}):\n \
         start = time.perf_counter()\n work(sys.argv[1])\n \
         least = min(least, time.perf_counter() - start)\nprint(1e3 * least)",
        args.runs
    );
    let output = Command::new(&args.python)
        .args(["-c", &script])
        .arg(file)
        .output()
        .ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}

/// A folder for files, gone with this.
struct Folder(PathBuf);

impl Folder {
    fn new() -> std::io::Result<Self> {
        let path = std::env::temp_dir().join(format!("axiscope-bench-{}", std::process::id()));
        std::fs::create_dir(&path)?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left behind in the system's folder for such files harms nobody.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Points and normals of the half of the paper's ellipsoid that faces the camera, evenly along a
/// spiral and then out of order, as points in files are.
fn ellipsoid(count: usize) -> (Vec<DVec3>, Vec<DVec3>) {
    let half_axes = DVec3::new(2.5, 2.5, 2.0);
    // A prime: coprime to every count but its multiples.
    let step = 1_000_003;
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
