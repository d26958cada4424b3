//! `axiscope reproduce`: the paper's experiments (§ 3) beside the paper's figures.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use axiscope::evaluate::reproduce::{ReproduceSettings, Reproduction, run_ellipsoids, run_peppers};
use axiscope::files::write_all;
use clap::Args;

use super::options::{Depths, depths, grid_size};
use super::output::say;
use super::progress::CountingBar;

#[derive(Debug, Args)]
pub(super) struct Reproduce {
    /// The folder for the report, its tables and its figures
    #[arg(short, long, value_name = "DIR", default_value = "reproduction")]
    out: PathBuf,
    /// Depths of the ellipsoid in cm, as FROM..TO[:STEP]
    #[arg(long, value_name = "Z", default_value = "25..70:1", value_parser = depths)]
    z0: Depths,
    /// Runs at each depth, each with its own random points
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    runs: u32,
    /// Visible points of an ellipsoid, which the paper does not state
    #[arg(long, value_name = "N", default_value_t = 1500)]
    points: usize,
    /// Simulated peppers, each with and without its peduncle; 0 leaves § 3.2 out
    #[arg(long, value_name = "N", default_value_t = 27, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    peppers: u32,
    /// Steps of the grid of candidate planes along each angle
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = grid_size)]
    u: usize,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
}

pub(super) fn run(args: &Reproduce) -> anyhow::Result<()> {
    std::fs::create_dir_all(&args.out).with_context(|| args.out.display().to_string())?;
    let settings = ReproduceSettings {
        depths_cm: args.z0.0.clone(),
        runs: args.runs as usize,
        points: args.points,
        peppers: args.peppers as usize,
        u: args.u,
        seed: args.seed,
    };

    let bar = CountingBar::new("§ 3.1, ellipsoids", settings.depths_cm.len() * settings.runs);
    let depths = run_ellipsoids(&settings, &bar)?;
    bar.finish();
    let bar = CountingBar::new("§ 3.2, peppers", settings.peppers);
    let peppers = run_peppers(&settings, &bar)?;
    bar.finish();

    let reproduction = Reproduction {
        settings,
        depths,
        peppers,
    };
    let files = reproduction.files()?;
    let files = files
        .into_iter()
        .map(|(name, bytes)| (args.out.join(name), bytes));
    write_all(&files.collect::<Vec<_>>())?;
    std::io::stdout()
        .lock()
        .write_all(reproduction.report().as_bytes())?;
    say!(
        "Wrote the report, its tables and its figures to {}.",
        args.out.display()
    );
    Ok(())
}
