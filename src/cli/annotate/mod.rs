//! `axiscope annotate`: the true axis of one cloud, set by hand.

mod change;
mod script;

use std::io::{BufRead, Read, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use axiscope::annotate::DiskFiles;
use axiscope::annotate::exchange::{Placement, SlicerFrame, place, read_lines, write_line};
use axiscope::annotate::{Annotation, Author, CloudId, Ends, Judgment, Method, Role, Store, StoreError, now};
use axiscope::evaluate::{Examination, examine, start_axis};
use axiscope::files::read_at_most;
use axiscope::fruit::Fruit;
use axiscope::geometry::{Extent, Unit};
use clap::{Args, ValueEnum};

use super::options::AnalysisOptions;
use super::output::{Printable, say};
use super::progress::StageClock;
use super::usage_error;
use change::Change;

#[derive(Debug, Args)]
pub(super) struct Annotate {
    /// The point cloud (PLY)
    cloud: PathBuf,
    /// Your name; the axis is saved in CLOUD.NAME.axis.json
    #[arg(long, value_name = "NAME")]
    annotator: String,
    /// Decide between the annotators: save the final axis in CLOUD.adjudicated.axis.json
    #[arg(long)]
    adjudicate: bool,
    #[command(flatten)]
    change: Change,
    /// Read edits from a file, or from standard input (-), a line for each with the options of that edit; each is
    /// answered with `saved N` once it is on the disk
    #[arg(long, value_name = "FILE", conflicts_with_all = ["edit", "undo", "redo", "import"])]
    script: Option<PathBuf>,
    /// Import the axis from a markup line of 3D Slicer (.mrk.json), drawn from the peduncle's base to the blossom end
    #[arg(long, value_name = "FILE", conflicts_with_all = ["edit", "undo", "redo"])]
    import: Option<PathBuf>,
    /// Name of the line, if the file holds several
    #[arg(long, value_name = "NAME", requires = "import")]
    line: Option<String>,
    /// Also write the axis as a line for 3D Slicer
    #[arg(long, value_name = "FILE")]
    export: Option<PathBuf>,
    /// Frame in which the cloud is loaded in Slicer
    #[arg(long, value_enum, default_value = "lps")]
    slicer_frame: SlicerFrame,
    /// The cloud is loaded in Slicer with its own numbers taken for millimeters, instead of converted
    #[arg(long)]
    slicer_as_is: bool,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    #[command(flatten)]
    analysis: AnalysisOptions,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// A few lines
    Text,
    /// The axis file (schema axiscope.axis/1), or null
    Json,
}

pub(super) fn run(args: &Annotate) -> anyhow::Result<()> {
    let author = if args.adjudicate {
        Author::adjudicator(&args.annotator)
    } else {
        Author::annotator(&args.annotator)
    };
    let author = author.map_err(|error| usage_error(&error.to_string()))?;
    let request = args.analysis.request();
    let fruit = Fruit::read(&args.cloud, &request)?;
    let (mut store, writable) = open(&args.cloud, &fruit.file.sha256, fruit.unit, author)?;
    let mut out = std::io::stdout().lock();
    if let Some(script) = &args.script {
        follow(args, script, &fruit, &mut store, &mut out)?;
        return Ok(writable?);
    }
    if args.change.is_any() {
        apply(args, &args.change, &fruit, &mut store)?;
    } else if let Some(file) = &args.import {
        import(args, file, &fruit, &mut store)?;
    } else if let Err(error) = writable {
        say!("Warning: nothing can be saved here: {error}");
    }
    if let Some(file) = &args.export {
        let ends = store.current().and_then(Annotation::ends).copied();
        let ends = ends.context("there is no axis to export")?;
        let text = write_line(&line_name(&store), &ends, fruit.unit, args.placement());
        super::output::write(file, text.as_bytes())?;
    }
    match args.format {
        Format::Text => write_text(&mut Printable::new(out), &store)?,
        Format::Json => writeln!(out, "{}", serde_json::to_string_pretty(&store.current())?)?,
    }
    Ok(())
}

/// The longest line of a script, in bytes: an edit whose note is as long as an axis file can be.
const LONGEST_LINE: u64 = 2 << 20;
/// The longest markup file of 3D Slicer that is read, in bytes.
const LONGEST_IMPORT: u64 = 16 << 20;

/// Opens an annotator's files beside a cloud, and prints the notices about them to standard error.
pub(super) fn open(
    cloud: &Path,
    sha256: &str,
    unit: Unit,
    author: Author,
) -> anyhow::Result<(Store, Result<(), StoreError>)> {
    let id = CloudId {
        file: cloud.file_name().unwrap_or_default().to_string_lossy().into(),
        sha256: sha256.to_owned(),
    };
    let (store, writable) = Store::open(Box::new(DiskFiles::default()), cloud, id, unit, author)?;
    for notice in store.notices() {
        say!("Warning: {notice}");
    }
    Ok((store, writable))
}

/// Carries out one edit, undo or redo.
fn apply(args: &Annotate, change: &Change, fruit: &Fruit, store: &mut Store) -> anyhow::Result<()> {
    let known = store.notices().len();
    let done = if change.undo {
        store.undo(&now())
    } else if change.redo {
        store.redo(&now())
    } else {
        let viewpoint = args.analysis.viewpoint;
        let judgment = change.judgment(store.current(), viewpoint, |method| start(args, fruit, method))?;
        store.edit(judgment, &now()).map(|()| true)
    };
    for notice in &store.notices()[known..] {
        say!("Warning: {notice}");
    }
    let what = if change.undo { "undo" } else { "do again" };
    anyhow::ensure!(done?, "there is nothing to {what}");
    Ok(())
}

/// Computes the axis to start from, which takes an analysis.
fn start(args: &Annotate, fruit: &Fruit, method: Method) -> anyhow::Result<Ends> {
    let clock = StageClock::new();
    let examined = examine(fruit.clone(), &args.analysis.request(), &clock);
    clock.finish();
    let Examination {
        fruit,
        analysis,
        references,
        ..
    } = examined.with_context(|| args.cloud.display().to_string())?;
    Ok(start_axis(&fruit, &analysis, &references, method)?)
}

/// Carries out the edits of a script, a line each, and answers each at once: `saved N`; `not saved: …` for an edit that is
/// kept and tried again with the next; or `refused: …` for a line that is not an edit.
fn follow(
    args: &Annotate,
    script: &Path,
    fruit: &Fruit,
    store: &mut Store,
    out: &mut impl Write,
) -> anyhow::Result<()> {
    let mut lines: Box<dyn BufRead> = if script == Path::new("-") {
        Box::new(std::io::stdin().lock())
    } else {
        let file = std::fs::File::open(script).with_context(|| script.display().to_string())?;
        Box::new(std::io::BufReader::new(file))
    };
    let (mut line, mut refused) = (String::new(), 0);
    loop {
        line.clear();
        let read = lines.by_ref().take(LONGEST_LINE + 1).read_line(&mut line);
        if read.with_context(|| script.display().to_string())? == 0 {
            break;
        }
        anyhow::ensure!(
            line.len() as u64 <= LONGEST_LINE,
            "{}: a line is longer than {} MB, which no edit needs",
            script.display(),
            LONGEST_LINE >> 20
        );
        let done = match script::change_of(&line) {
            Ok(None) => continue,
            Ok(Some(change)) => apply(args, &change, fruit, store),
            Err(error) => Err(anyhow::anyhow!(error)),
        };
        match done {
            Ok(()) => writeln!(out, "saved {}", store.operations())?,
            Err(error) if is_pending(&error) => writeln!(out, "not saved: {error}")?,
            Err(error) => {
                refused += 1;
                writeln!(out, "refused: {error}")?;
            }
        }
        out.flush()?;
    }
    store.save()?;
    anyhow::ensure!(refused == 0, "{refused} lines were refused");
    Ok(())
}

/// Whether an edit was made that could not be saved, rather than refused.
fn is_pending(error: &anyhow::Error) -> bool {
    let error = error.downcast_ref();
    error.is_some_and(|error| !matches!(error, StoreError::TooLong { .. }))
}

impl Annotate {
    fn placement(&self) -> Placement {
        Placement {
            frame: self.slicer_frame,
            numbers_as_they_are: self.slicer_as_is,
        }
    }
}

fn import(args: &Annotate, file: &Path, fruit: &Fruit, store: &mut Store) -> anyhow::Result<()> {
    let named = || file.display().to_string();
    let bytes = read_at_most(file, LONGEST_IMPORT).with_context(named)?;
    let lines = read_lines(&bytes).with_context(named)?;
    let mut fitting = lines
        .iter()
        .filter(|line| args.line.as_ref().is_none_or(|name| *name == line.name));
    let line = match (fitting.next(), fitting.next()) {
        (Some(line), None) => line,
        (None, _) => anyhow::bail!("{}: it holds no line of that name", named()),
        _ => anyhow::bail!("{}: it holds several lines: choose one with --line", named()),
    };
    let extent = Extent::robust(fruit.cloud().positions()).context("the cloud has no points")?;
    let ends = place(line, fruit.unit, &extent, args.placement()).with_context(named)?;
    let judgment = Judgment {
        method: Method::Imported,
        ..Judgment::by_hand(ends)
    };
    Ok(store.edit(judgment, &now())?)
}

fn line_name(store: &Store) -> String {
    let stem = Path::new(&store.cloud().file).file_stem().unwrap_or_default();
    format!("{} {}", stem.to_string_lossy(), store.author().name())
}

fn write_text(out: &mut impl Write, store: &Store) -> std::io::Result<()> {
    let mut row = |name: &str, value: &str| writeln!(out, "{name:<16}{value}");
    let Some(annotation) = store.current() else {
        return row("Axis", "none yet");
    };
    let judgment = &annotation.judgment;
    match judgment.ends {
        None => row("Axis", "cannot be told")?,
        Some(ends) => {
            let unit = annotation.unit;
            row("Peduncle base", &format!("{:.4} {unit}", ends.peduncle_base()))?;
            row("Blossom end", &format!("{:.4} {unit}", ends.blossom_end()))?;
            row(
                "Direction",
                &format!("{:.4}, length {:.4} {unit}", ends.direction(), ends.length()),
            )?;
        }
    }
    let blind = if judgment.blind { ", blind" } else { "" };
    row("Method", &format!("{}{blind}", judgment.method.name()))?;
    if let Some(confidence) = judgment.confidence {
        row("Confidence", &confidence.value().to_string())?;
    }
    if !judgment.note.is_empty() {
        row("Note", &judgment.note)?;
    }
    let role = match annotation.role {
        Role::Annotator => "",
        Role::Adjudicator => ", adjudicated",
    };
    row(
        "Annotator",
        &format!("{}{role}, {}", annotation.annotator, annotation.modified),
    )?;
    let history = store.history();
    row(
        "History",
        &format!(
            "{} to undo, {} to redo",
            history.undo_steps(),
            history.redo_steps()
        ),
    )?;
    row("File", &store.axis_path().display().to_string())
}
