//! `axiscope reproduce`: the paper's experiments (§ 3) beside the paper's figures.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use axiscope::evaluate::reproduce::{ReproduceSettings, Reproduction, Scan, run_ellipsoids, run_peppers};
use clap::Args;

use super::options::{Depths, depths, grid_size, number};
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
    /// Steps of the grid of candidate planes along each angle, in a list with commas
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "5,6,7,10,12,14", value_parser = grid_size)]
    u: Vec<usize>,
    /// Whole arcs of the scans of § 3.2 in degrees, in a list with commas: 180 are ±90°, 0 is one view
    #[arg(long, value_name = "DEG", value_delimiter = ',', default_value = "0,120,180,240", value_parser = arc)]
    arc: Vec<f64>,
    /// Largest leans of the fruits of § 3.2 in degrees, in a list with commas
    #[arg(long, value_name = "DEG", value_delimiter = ',', default_value = "8,15,30", value_parser = lean)]
    lean: Vec<f64>,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
}

fn arc(text: &str) -> Result<f64, String> {
    degrees(text, 360.0)
}

fn lean(text: &str) -> Result<f64, String> {
    degrees(text, 90.0)
}

fn degrees(text: &str, most: f64) -> Result<f64, String> {
    match number(text)? {
        value if (0.0..=most).contains(&value) => Ok(value),
        _ => Err(format!("expected 0 to {most} degrees")),
    }
}

pub(super) fn run(args: &Reproduce) -> anyhow::Result<()> {
    std::fs::create_dir_all(&args.out).with_context(|| args.out.display().to_string())?;
    let settings = ReproduceSettings {
        depths_cm: args.z0.0.clone(),
        runs: args.runs as usize,
        points: args.points,
        peppers: args.peppers as usize,
        grid_sizes: args.u.clone(),
        arcs_deg: args.arc.clone(),
        leans_deg: args.lean.clone(),
        seed: args.seed,
    };
    let bar = CountingBar::new("§ 3.1, ellipsoids", settings.depths_cm.len() * settings.runs);
    let depths = run_ellipsoids(&settings, &bar)?;
    bar.finish();

    let (mut scans, mut variations) = (Vec::new(), Vec::new());
    if settings.peppers > 0 {
        let (planned, varied) = (settings.scans(), settings.variations());
        let sets = planned.len() + varied.len();
        let run = |set: usize, scan: &Scan| {
            let title = format!("§ 3.2, peppers, set {} of {sets}", set + 1);
            let bar = CountingBar::new(&title, settings.peppers);
            let scanned = run_peppers(&settings, scan, settings.readings_of(scan), &bar);
            bar.finish();
            scanned
        };
        for scan in &planned {
            scans.push(run(scans.len(), scan)?);
        }
        for variation in varied {
            let scanned = run(planned.len() + variations.len(), &variation.scan)?;
            variations.push((variation, scanned));
        }
    }

    let reproduction = Reproduction {
        settings,
        depths,
        scans,
        variations,
    };
    for (name, bytes) in reproduction.files()? {
        let path = args.out.join(name);
        std::fs::write(&path, bytes).with_context(|| path.display().to_string())?;
    }
    std::io::stdout()
        .lock()
        .write_all(reproduction.report().as_bytes())?;
    eprintln!(
        "Wrote the report, its tables and its figures to {}.",
        args.out.display()
    );
    Ok(())
}
