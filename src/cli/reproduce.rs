//! `axiscope reproduce`: the paper's experiments (§ 3) beside the paper's figures.

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context;
use axiscope::evaluate::reproduce::{
    Needs, PaperFigure, ReproduceSettings, Reproduction, Scan, run_ellipsoids, run_peppers,
};
use axiscope::files::write_all;
use clap::Args;

use super::options::{Depths, depths, grid_size, number};
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
    /// Sets of so many peppers: how far apart the means of Fig. 12 and 13 are that one set or another gives
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    sets: u32,
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
    /// At most 5 runs, 6 peppers and 3 sets of them: a seventh of the time, to see what comes out
    #[arg(long)]
    quick: bool,
    /// Draw these figures alone, in a list with commas, and run only what they need
    #[arg(long, value_name = "FIGURE", value_delimiter = ',', value_enum)]
    figure: Vec<PaperFigure>,
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
    let started = Instant::now();
    std::fs::create_dir_all(&args.out).with_context(|| args.out.display().to_string())?;
    let reproduction = experiments(args)?;
    let files = if args.figure.is_empty() {
        reproduction.files()?
    } else {
        let drawn = args
            .figure
            .iter()
            .map(|&figure| reproduction.figure_files(figure));
        drawn.collect::<Result<Vec<_>, _>>()?.concat()
    };
    let report = files.iter().find(|(name, _)| name == "report.md");
    if let Some((_, report)) = report {
        std::io::stdout().lock().write_all(report)?;
    }
    let files = files
        .into_iter()
        .map(|(name, bytes)| (args.out.join(name), bytes));
    write_all(&files.collect::<Vec<_>>())?;
    let what = if args.figure.is_empty() {
        "the report, its tables and its figures"
    } else {
        "the figures"
    };
    say!(
        "Wrote {what} to {} in {:.0} s.",
        args.out.display(),
        started.elapsed().as_secs_f64()
    );
    Ok(())
}

/// Runs the experiments that are needed.
fn experiments(args: &Reproduce) -> anyhow::Result<Reproduction> {
    let settings = settings(args);
    let all = args.figure.is_empty();
    let needed = |needs: Needs| all || args.figure.iter().any(|figure| figure.needs() == needs);
    let mut results = Reproduction {
        settings,
        depths: Vec::new(),
        scans: Vec::new(),
        other_sets: Vec::new(),
        variations: Vec::new(),
    };
    let settings = &results.settings;
    if needed(Needs::Ellipsoids) {
        let bar = CountingBar::new("§ 3.1, ellipsoids", settings.depths_cm.len() * settings.runs);
        results.depths = run_ellipsoids(settings, &bar)?;
        bar.finish();
    }
    let planned = match settings.peppers {
        0 => Vec::new(),
        _ if needed(Needs::Scans) => settings.scans(),
        _ if needed(Needs::MainScan) => vec![settings.main()],
        _ => Vec::new(),
    };
    let (other_sets, varied) = if all && !planned.is_empty() {
        (settings.other_sets(), settings.variations())
    } else {
        (Vec::new(), Vec::new())
    };
    let sets = planned.len() + other_sets.len() + varied.len();
    let mut done = 0;
    let mut run = |scan: &Scan| {
        done += 1;
        let bar = CountingBar::new(&format!("§ 3.2, peppers, set {done} of {sets}"), settings.peppers);
        let scanned = run_peppers(settings, scan, settings.readings_of(scan), &bar);
        bar.finish();
        scanned
    };
    for scan in &planned {
        results.scans.push(run(scan)?);
    }
    for scan in &other_sets {
        results.other_sets.push(run(scan)?);
    }
    for variation in varied {
        let scanned = run(&variation.scan)?;
        results.variations.push((variation, scanned));
    }
    Ok(results)
}

/// The settings that the options ask for.
fn settings(args: &Reproduce) -> ReproduceSettings {
    let mut settings = ReproduceSettings {
        depths_cm: args.z0.0.clone(),
        runs: args.runs as usize,
        points: args.points,
        peppers: args.peppers as usize,
        sets: args.sets as usize,
        grid_sizes: args.u.clone(),
        arcs_deg: args.arc.clone(),
        leans_deg: args.lean.clone(),
        seed: args.seed,
    };
    if args.quick {
        settings.runs = settings.runs.min(5);
        settings.peppers = settings.peppers.min(6);
        settings.sets = settings.sets.min(3);
    }
    settings
}
