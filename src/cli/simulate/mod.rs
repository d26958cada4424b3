//! `axiscope simulate`: clouds with a known axis, with the truth about each in a file beside it.

mod camera;
mod pepper;
mod scan;

use std::path::{Path, PathBuf};

use anyhow::Context;
use axiscope::files;
use axiscope::fruit::simulated_files;
use axiscope::geometry::{Cloud, Unit};
use axiscope::ply::Encoding;
use axiscope::simulate::{EllipsoidSettings, PepperSettings, SimulateError, Simulated, Truth, seeds};
use clap::{Args, Subcommand};
use glam::DVec3;

use super::options::{Depths, depths, number, pair, position};
use super::output::{is_standard_output, say};
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
    /// The PLY file to write, or a folder for several, or - for standard output; the truth goes beside it as NAME.truth.json
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
        let (name, points) = (path.display(), made.cloud.len());
        if !has_name(&path) {
            say!("Wrote {points} points; a truth is written only beside a file.");
        } else if made.truth.is_some() {
            say!("Wrote {name} ({points} points) and its truth beside it.");
        } else {
            say!("Wrote {name} ({points} points) without a truth, since its axis is not known.");
        }
        return Ok(());
    }
    if output.out.as_deref().is_some_and(is_standard_output) {
        return Err(usage_error(
            "several clouds go into a folder, not to standard output",
        ));
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
    say!("Wrote {} clouds {with}to {}.", jobs.len(), folder.display());
    Ok(())
}

/// Writes `NAME.ply` and `NAME.truth.json`, both whole or not at all; to standard output or a device only the cloud.
fn write_cloud(path: &Path, made: &Made, output: &Output) -> anyhow::Result<()> {
    let truth = made.truth.as_ref();
    let written = simulated_files(path, &made.cloud, truth, made.seed, made.unit, output.encoding)?;
    if !has_name(path) {
        return super::output::write(path, &written[0].1);
    }
    let truth_path = path.with_extension("truth.json");
    if truth.is_none() && truth_path.exists() {
        anyhow::bail!(
            "{}: this would be taken for the truth about the new cloud, which has none; remove it or write elsewhere",
            truth_path.display()
        );
    }
    Ok(files::write_all(&written)?)
}

/// Whether a path names a regular file, there or yet to be written, so that another can stand beside it: not standard
/// output, a device or a pipe.
fn has_name(path: &Path) -> bool {
    !is_standard_output(path) && files::is_replaceable(path)
}
