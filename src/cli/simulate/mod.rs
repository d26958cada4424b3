//! `axiscope simulate`: clouds with a known axis, with the truth about each in a file beside it.

mod camera;
mod pepper;
mod scan;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use axiscope::geometry::{Cloud, Unit};
use axiscope::ply::{self, Encoding, WriteOptions};
use axiscope::simulate::{EllipsoidSettings, PepperSettings, SimulateError, Simulated, Truth, seeds};
use clap::{Args, Subcommand};
use glam::DVec3;

use super::options::{Depths, depths, number, pair, position};
use super::{progress, usage_error};
use pepper::Pepper;
use scan::Scan;

#[derive(Debug, Args)]
pub(super) struct Simulate {
    #[command(subcommand)]
    shape: Shape,
}

#[derive(Debug, Subcommand)]
enum Shape {
    /// The paper's ellipsoid (§ 2.1), the part that faces the camera
    Ellipsoid(Ellipsoid),
    /// A lobed, tapered pepper with a peduncle, as a depth camera sees it
    Pepper(Box<Pepper>),
    /// A mesh from a file, as a depth camera sees it
    Scan(Box<Scan>),
}

/// The number of the clouds, and their files.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
struct Output {
    /// The PLY file to write, or a folder for several; the truth goes beside it as NAME.truth.json
    /// [default: pepper.ply or ellipsoid.ply; for several, the folder peppers or ellipsoids]
    #[arg(short, long, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Number of clouds, each with its own seed, which follows from --seed
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Encoding of the numbers in the file
    #[arg(long, value_enum, default_value = "binary")]
    encoding: Encoding,
}

/// The unit of clouds that are made from nothing.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
struct OutputUnit {
    /// Unit of the file's coordinates
    #[arg(long, value_enum, default_value = "cm")]
    unit: Unit,
}

#[derive(Debug, Args)]
struct Ellipsoid {
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    unit: OutputUnit,
    /// Half-axes along x, y and z, in cm
    #[arg(long, value_name = "X,Y,Z", default_value = "2.5,2.5,2", value_parser = position, allow_hyphen_values = true)]
    half_axes_cm: DVec3,
    /// The center's x and y, in cm
    #[arg(long, value_name = "X,Y", default_value = "3,5", value_parser = pair, allow_hyphen_values = true)]
    center_cm: [f64; 2],
    /// The center's depth in cm, or a range FROM..TO[:STEP]: the paper's is 25..70:1
    #[arg(long, value_name = "Z", default_value = "25", value_parser = depths, allow_hyphen_values = true)]
    z0: Depths,
    /// Number of visible points, which the paper does not state
    #[arg(long, value_name = "N", default_value_t = 3000)]
    points: usize,
    /// Standard deviation of a depth at 40 cm, in cm; it grows with the square of the distance
    #[arg(long, value_name = "CM", default_value_t = 0.0, value_parser = number, allow_hyphen_values = true)]
    noise_cm: f64,
}

/// Sets a field if its option is given.
fn set<T>(field: &mut T, option: Option<T>) {
    if let Some(value) = option {
        *field = value;
    }
}

pub(super) fn run(args: &Simulate) -> anyhow::Result<()> {
    match &args.shape {
        Shape::Ellipsoid(args) => ellipsoids(args),
        Shape::Pepper(args) => peppers(args),
        Shape::Scan(args) => scan::run(args),
    }
}

fn ellipsoids(args: &Ellipsoid) -> anyhow::Result<()> {
    let [x, y] = args.center_cm;
    let at = |z0: f64, seed: u64| EllipsoidSettings {
        half_axes_cm: args.half_axes_cm,
        center_cm: DVec3::new(x, y, z0),
        points: args.points,
        noise_cm: args.noise_cm,
        seed,
    };
    let seeds = seeds(args.output.seed, args.output.count as usize);
    let mut jobs = Vec::new();
    for &z0 in &args.z0.0 {
        // With several depths, names state the depth: ellipsoid_z025.0_000.
        let depth = if args.z0.0.len() > 1 {
            format!("_z{z0:05.1}")
        } else {
            String::new()
        };
        jobs.extend(
            seeds
                .iter()
                .enumerate()
                .map(|(i, &seed)| (format!("ellipsoid{depth}_{i:03}"), z0, seed)),
        );
    }
    let jobs = jobs.into_iter().map(|(name, z0, seed)| (name, at(z0, seed)));
    write_all(&args.output, "ellipsoid", &jobs.collect::<Vec<_>>(), |settings| {
        Ok(of_simulated(settings.simulate()?, args.unit.unit))
    })
}

fn peppers(args: &Pepper) -> anyhow::Result<()> {
    let settings = args.settings()?;
    let seeds = seeds(args.output.seed, args.output.count as usize);
    let jobs = seeds.into_iter().enumerate().map(|(i, seed)| {
        let settings = PepperSettings {
            seed,
            ..settings.clone()
        };
        (format!("pepper_{i:03}"), settings)
    });
    write_all(&args.output, "pepper", &jobs.collect::<Vec<_>>(), |settings| {
        let mut simulated = settings.simulate()?;
        if args.without_peduncle {
            simulated = simulated.without_peduncle();
        }
        Ok(of_simulated(simulated, args.unit.unit))
    })
}

/// A cloud with its unit, and the truth about it, where there is one.
struct Made {
    cloud: Cloud,
    unit: Unit,
    seed: u64,
    truth: Option<Truth>,
}

fn of_simulated(simulated: Simulated, unit: Unit) -> Made {
    let Simulated { cloud, truth } = simulated.in_unit(unit);
    Made {
        cloud,
        unit,
        seed: truth.seed,
        truth: Some(truth),
    }
}

/// Simulates each job and writes it, one after the other. The same seed gives the same bytes.
fn write_all<S>(
    output: &Output,
    shape: &str,
    jobs: &[(String, S)],
    simulate: impl Fn(&S) -> Result<Made, SimulateError>,
) -> anyhow::Result<()> {
    let simulate = |settings: &S| {
        simulate(settings).map_err(|error| match error {
            SimulateError::Setting { .. } | SimulateError::ViewpointInside | SimulateError::LooksAtItself => {
                usage_error(&error.to_string())
            }
            _ => error.into(),
        })
    };
    if let [(_, settings)] = jobs {
        let path = output
            .out
            .clone()
            .unwrap_or_else(|| format!("{shape}.ply").into());
        let path = if path.is_dir() {
            path.join(format!("{shape}.ply"))
        } else {
            path
        };
        let made = simulate(settings)?;
        write_cloud(&path, &made, output)?;
        let truth = if made.truth.is_some() {
            "and its truth beside it"
        } else {
            "without a truth, since its axis is not known"
        };
        eprintln!("Wrote {} ({} points) {truth}.", path.display(), made.cloud.len());
        return Ok(());
    }
    let folder = output.out.clone().unwrap_or_else(|| format!("{shape}s").into());
    if folder.extension().is_some_and(|e| e.eq_ignore_ascii_case("ply")) {
        let message = format!(
            "several clouds go into a folder, and {} names a file",
            folder.display()
        );
        return Err(usage_error(&message));
    }
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    let bar = progress::bar("Simulating {wide_bar} {pos}/{len}");
    bar.set_length(jobs.len() as u64);
    let mut truths = 0;
    for (name, settings) in jobs {
        let made = simulate(settings).with_context(|| name.clone())?;
        truths += usize::from(made.truth.is_some());
        write_cloud(&folder.join(format!("{name}.ply")), &made, output)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let with = if truths > 0 { "with their truths " } else { "" };
    eprintln!("Wrote {} clouds {with}to {}.", jobs.len(), folder.display());
    Ok(())
}

/// Writes `NAME.ply` and `NAME.truth.json`, each whole or not at all.
fn write_cloud(path: &Path, made: &Made, output: &Output) -> anyhow::Result<()> {
    let truth_path = path.with_extension("truth.json");
    if made.truth.is_none() && truth_path.exists() {
        anyhow::bail!(
            "{}: this would be taken for the truth about the new cloud, which has none; remove it or write elsewhere",
            truth_path.display()
        );
    }
    let comments = [format!(
        "simulated by axiscope {}, seed {}",
        env!("CARGO_PKG_VERSION"),
        made.seed
    )];
    let mut bytes = Vec::new();
    let options = WriteOptions {
        unit: Some(made.unit),
        comments: &comments,
        encoding: output.encoding,
        ..WriteOptions::default()
    };
    ply::write(&mut bytes, &made.cloud, &options)?;
    write_whole(path, &bytes)?;
    let Some(truth) = &made.truth else {
        return Ok(());
    };
    let json = serde_json::to_string_pretty(truth)? + "\n";
    write_whole(&truth_path, json.as_bytes())
}

/// Writes a file under a temporary name and then renames it, so that no reader finds half of it.
fn write_whole(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    let write = || -> std::io::Result<()> {
        let mut name = path.file_name().unwrap_or_default().to_os_string();
        name.push(".part");
        let part = path.with_file_name(name);
        let mut file = std::fs::File::create(&part)?;
        file.write_all(bytes)?;
        std::fs::rename(&part, path)
    };
    write().with_context(|| path.display().to_string())
}
