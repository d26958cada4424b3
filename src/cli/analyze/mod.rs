//! `axiscope analyze`: one cloud's planes, best plane, axis and error.

mod points;
mod text;

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context;
use axiscope::estimate::{EstimateError, EstimateSettings, Estimator, estimate};
use axiscope::evaluate::{
    AnalysisReport, Examination, TimedEstimate, Timings, TruthChoice, examine, surface_of,
};
use axiscope::fruit::Fruit;
use axiscope::method::Stage;
use clap::{Args, ValueEnum};

use super::options::{AnalysisOptions, EstimatorOptions};
use super::output::Printable;
use super::progress::StageClock;
use points::{PointOptions, write_steps};
use text::write_text;

#[derive(Debug, Args)]
pub(super) struct Analyze {
    /// The point cloud (PLY)
    cloud: PathBuf,
    /// Reference against which the error is taken apart
    #[arg(long, value_enum, default_value = "auto")]
    truth: TruthChoice,
    #[command(flatten)]
    analysis: AnalysisOptions,
    #[command(flatten)]
    estimators: EstimatorOptions,
    #[command(flatten)]
    points: PointOptions,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// A short report
    Text,
    /// One JSON object (schema axiscope.analysis/1)
    Json,
}

pub(super) fn run(args: &Analyze) -> anyhow::Result<()> {
    let started = Instant::now();
    let mut request = args.analysis.request();
    request.estimates = args.estimators.settings(&[Estimator::Paper, Estimator::Body]);
    let clock = StageClock::new();
    let fruit = Fruit::read_watched(&args.cloud, &request, &clock)?;
    let read = milliseconds_since(started);
    let examined = examine(fruit, &request, &clock);
    let times = clock.finish();
    let examined = examined.with_context(|| args.cloud.display().to_string())?;
    let of_analysis = milliseconds_since(started) - read;
    // Its times are not those of the analysis.
    let clock = StageClock::new();
    let examined = examined.with_true_center(&clock);
    clock.finish();
    let examined = examined?;
    let estimates = timed_estimates(&examined, &request.estimates, of_analysis)?;
    let explained = (args.points.run(&examined)).with_context(|| args.cloud.display().to_string())?;
    let timings = Timings {
        read,
        normals: times.milliseconds(Stage::Normals),
        center: times.milliseconds(Stage::Center),
        plane_terms: times.milliseconds(Stage::PlaneTerms),
        total: milliseconds_since(started),
    };
    match args.format {
        Format::Text => {
            let mut out = Printable::stdout();
            write_text(&mut out, args, &examined, &timings, &estimates)?;
            if let Some(explained) = &explained {
                write_steps(&mut out, explained, examined.fruit.unit)?;
            }
        }
        Format::Json => {
            let mut report = AnalysisReport::new(
                &args.cloud,
                &request,
                args.analysis.seed,
                &examined,
                args.truth,
                timings,
                &estimates,
            );
            if let Some(explained) = &explained {
                report = report.with_point(&explained.candidate, &explained.row);
            }
            // The text is complete before its first byte goes out, so that a reader gets all of it or nothing.
            let text = serde_json::to_string_pretty(&report)?;
            writeln!(std::io::stdout(), "{text}")?;
        }
    }
    Ok(())
}

fn milliseconds_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

/// Runs the estimators, each with its time: `of_analysis` milliseconds for the paper's, which has run already, and for
/// the others that of the surface too, which all of them need.
fn timed_estimates(
    examined: &Examination,
    settings: &EstimateSettings,
    of_analysis: f64,
) -> anyhow::Result<Vec<TimedEstimate>> {
    let started = Instant::now();
    let is_fitted = settings.estimators.iter().any(|&e| e != Estimator::Paper);
    let surface = if is_fitted {
        surface_of(examined, &())
    } else {
        Err(EstimateError::NoFit)
    };
    let of_surface = milliseconds_since(started);
    let mut estimates = Vec::new();
    for &estimator in &settings.estimators {
        let started = Instant::now();
        let estimate = estimate(estimator, &examined.analysis, &surface, settings.prior, &())?;
        let before = if estimator == Estimator::Paper {
            of_analysis
        } else {
            of_surface
        };
        let ms = before + milliseconds_since(started);
        estimates.push(TimedEstimate { estimate, ms });
    }
    Ok(estimates)
}
