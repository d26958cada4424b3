//! `axiscope evaluate`: a folder of clouds, each compared with its reference.

mod both;
mod sweep;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::Context;
use axiscope::evaluate::{
    MeanParts, Reuse, Row, RowStore, Runner, StoreKind, StoredRow, Summary, Sweep, TruthChoice, add_tags,
    annotation_files, read_tags, result_files,
};
use axiscope::files::write_all;
use axiscope::parallel::{Watch, map_pieces};
use clap::Args;

use super::options::AnalysisOptions;
use super::output::{Printable, say};
use super::progress::CountingBar;
use sweep::SweepOption;

#[derive(Debug, Clone, Args)]
pub(super) struct Evaluate {
    /// The folder with the clouds (PLY)
    folder: PathBuf,
    /// Reference that errors are measured against
    #[arg(long, value_enum, default_value = "auto")]
    truth: TruthChoice,
    /// The folder for results.csv, results.parquet, summary.json, report.html and the figures
    #[arg(short, long, value_name = "DIR", default_value = "evaluation")]
    out: PathBuf,
    /// Evaluate with and without the peduncle, the paper's two experiments, into two folders in DIR
    #[arg(long, conflicts_with = "without_peduncle")]
    both: bool,
    /// Also map the mean error over ranges of settings: u=FROM..TO[:STEP], tau=FROM..TO[:STEP], or both
    #[arg(long, value_name = "RANGE", num_args = 1..=2)]
    sweep: Vec<SweepOption>,
    /// Evaluate only part I of N of the folder, for a job array; the parts' tables, results-I-of-N.csv and so on, can be
    /// concatenated
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Reuse the rows of an earlier run into the same folder whose cloud and settings are unchanged
    #[arg(long)]
    resume: bool,
    /// Number of the worst clouds that the report shows pictures of
    #[cfg(feature = "window")]
    #[arg(long, value_name = "N", default_value_t = 12)]
    pictures: usize,
    #[command(flatten)]
    analysis: AnalysisOptions,
}

/// One of several equal parts of a list.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shard {
    /// The number of the part, from 1.
    index: usize,
    of: usize,
}

impl Shard {
    /// Returns the name of this part's file, so that parts share a folder: `results.csv` becomes `results-2-of-5.csv`.
    fn named(self, name: &str) -> String {
        let Self { index, of } = self;
        match name.rsplit_once('.') {
            Some((stem, ending)) => format!("{stem}-{index}-of-{of}.{ending}"),
            None => format!("{name}-{index}-of-{of}"),
        }
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text
            .split_once('/')
            .and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, of)) if (1..=of).contains(&index) => Ok(Self { index, of }),
            _ => Err("expected I/N, with I from 1 to N"),
        }
    }
}

pub(super) fn run(args: &Evaluate) -> anyhow::Result<()> {
    if args.both {
        return both::run(args);
    }
    let sweep = SweepOption::settings(&args.sweep, args.analysis.u, args.analysis.tau)?;
    let mut clouds = clouds_in(&args.folder)?;
    if let Some(Shard { index, of }) = args.shard {
        clouds = clouds.into_iter().skip(index - 1).step_by(of).collect();
    }
    std::fs::create_dir_all(&args.out).with_context(|| args.out.display().to_string())?;
    let request = args.analysis.request();
    let rows_folder = args.out.join("rows");
    std::fs::create_dir_all(&rows_folder).with_context(|| rows_folder.display().to_string())?;
    let store = RowStore::in_folder(rows_folder, StoreKind::Record);
    let reuse = if args.resume {
        Reuse::WhereStored
    } else {
        Reuse::Never
    };
    let runner = Runner::new(&store, &request, sweep.as_ref().map(|s| (s, args.truth)), reuse);

    let bar = CountingBar::new("Evaluating", clouds.len());
    let stored = evaluate_all(&args.folder, &clouds, &runner, &bar)?;
    bar.finish();
    if let Some(problem) = store.take_problem() {
        say!("Warning: a later --resume will not find every row: {problem}");
    }

    let mut rows: Vec<Row> = stored.iter().map(|s| s.outcome.against(args.truth)).collect();
    match read_tags(&args.folder) {
        Ok(tags) => add_tags(&mut rows, &tags),
        Err(problem) => say!("Warning: {problem}"),
    }
    let summary = Summary::of(&rows);
    let map = sweep.map(|settings| {
        let mut map = Sweep::new(settings);
        for errors_deg in stored.iter().filter_map(|s| s.sweep_deg.as_ref()) {
            map.add(errors_deg);
        }
        map
    });
    #[cfg(feature = "window")]
    let pictures = {
        let (pictures, problem) =
            axiscope::evaluate::pictures_of_worst(&args.folder, &rows, &request, args.pictures);
        if let Some(problem) = problem {
            say!("Warning: {problem}");
        }
        pictures
    };
    #[cfg(not(feature = "window"))]
    let pictures = Vec::new();
    let files = result_files(&args.folder, &request, &rows, map.as_ref(), &pictures)?;
    let named = |name: String| args.shard.map_or(name.clone(), |shard| shard.named(&name));
    let files = files
        .into_iter()
        .map(|(name, bytes)| (args.out.join(named(name)), bytes));
    write_all(&files.collect::<Vec<_>>())?;
    write_summary(&mut Printable::stdout(), &summary)?;
    say!(
        "Wrote results, summary, figures and {} to {}.",
        named("report.html".into()),
        args.out.display()
    );
    Ok(())
}

/// Lists the clouds of a folder; fails if there is none.
pub(super) fn clouds_in(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let clouds = axiscope::fruit::clouds_in(folder).with_context(|| folder.display().to_string())?;
    anyhow::ensure!(
        !clouds.is_empty(),
        "{}: there are no PLY files in this folder",
        folder.display()
    );
    Ok(clouds)
}

/// Evaluates the clouds, several at a time; the results are in the clouds' order.
fn evaluate_all(
    folder: &Path,
    clouds: &[PathBuf],
    runner: &Runner<'_>,
    watch: &dyn Watch,
) -> anyhow::Result<Vec<StoredRow>> {
    let annotations = annotation_files(clouds);
    let one = |path: &PathBuf| {
        let annotations = annotations.get(path).map_or(&[][..], Vec::as_slice);
        // Nobody cancels it, and it is allowed to analyze: there is a row.
        let evaluated = runner.evaluate(&Row::name_in(folder, path), path, annotations, &());
        evaluated.map(|evaluated| evaluated.map(|e| e.row))
    };
    let rows = map_pieces(clouds.len(), 1, watch, |range| one(&clouds[range.start]))?;
    let rows = rows.into_iter().collect::<Result<Option<Vec<_>>, _>>()?;
    rows.context("a cloud has no row")
}

fn write_summary(out: &mut impl Write, summary: &Summary) -> std::io::Result<()> {
    let degrees = |value: Option<f64>| value.map_or("none".into(), |v| format!("{v:.2}°"));
    let percent = |value: Option<f64>| value.map_or("none".into(), |v| format!("{:.0} %", 100.0 * v));
    let mut row = |name: &str, value: String| writeln!(out, "{name:<16}{value}");
    row(
        "Clouds",
        format!("{}, {} with an error", summary.clouds, summary.measured),
    )?;
    row("Mean error", degrees(summary.mean_deg))?;
    row("Median", degrees(summary.median_deg))?;
    row("95th percentile", degrees(summary.p95_deg))?;
    if let Some(worst) = &summary.worst {
        row("Worst", format!("{:.2}° ({})", worst.error_deg, worst.file))?;
    }
    row(
        "Under 5/10/15°",
        [
            summary.share_under_5_deg,
            summary.share_under_10_deg,
            summary.share_under_15_deg,
        ]
        .map(percent)
        .join(", "),
    )?;
    if let Some(parts) = &summary.error_parts {
        let MeanParts {
            clouds,
            error_deg,
            lean_part_deg: lean,
            grid_part_deg: grid,
            choice_part_deg: choice,
            ..
        } = parts;
        let text = format!(
            "{error_deg:.2}° = {lean:.2}° lean + {grid:.2}° grid + {choice:.2}° choice of the plane (means of {clouds})"
        );
        row("Error's parts", text)?;
        if let Some(given) = &parts.true_center {
            let text = format!(
                "{:.2}° with the true center given, which is {:.2} cm from the computed one",
                given.error_true_center_deg, given.center_distance_cm
            );
            row("", text)?;
        }
    }
    for (reason, count) in &summary.failures {
        row("No error", format!("{count} × {reason}"))?;
    }
    Ok(())
}
