//! `axiscope annotations`: a folder's axes set by hand, and the agreement between the annotators.

use std::collections::HashMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context;
use axiscope::annotate::exchange::{ImportedRow, read_table, write_table};
use axiscope::annotate::{Annotation, Author, CloudAgreement, FAR_OFF_DEG, Role, SetAgreement, now};
use axiscope::evaluate::Row;
use axiscope::files::read_at_most;
use axiscope::fruit::{AxisFiles, Fruit, PeduncleChoice, Request, read_annotations, read_cloud};
use axiscope::geometry::Unit;
use clap::{Args, ValueEnum};
use comfy_table::Table;
use comfy_table::presets::NOTHING;
use serde::Serialize;

use super::annotate::open;
use super::evaluate::clouds_in;
use super::options::{OrAuto, positive, unit_or_auto};
use super::output::{Printable, say};

#[derive(Debug, Args)]
pub(super) struct Annotations {
    /// The folder with the clouds (PLY) and the axis files beside them
    folder: PathBuf,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Angle in degrees beyond which an annotator counts as far off
    #[arg(long, value_name = "DEG", default_value_t = FAR_OFF_DEG, value_parser = positive)]
    far_off: f64,
    /// Also write every axis as CSV
    #[arg(long, value_name = "FILE")]
    export: Option<PathBuf>,
    /// First import axes from CSV with the columns of an export, at least the file, the annotator and both ends;
    /// each becomes an edit that can be undone
    #[arg(long, value_name = "FILE")]
    import: Option<PathBuf>,
    /// Unit of the clouds' coordinates
    #[arg(long, default_value = "auto", value_parser = unit_or_auto())]
    unit: OrAuto<Unit>,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// Tables
    Text,
    /// One JSON object (schema axiscope.agreement/1)
    Json,
}

#[derive(Serialize)]
struct Report<'a> {
    schema: &'static str,
    #[serde(flatten)]
    agreement: &'a SetAgreement,
    warnings: &'a [String],
}

pub(super) fn run(args: &Annotations) -> anyhow::Result<()> {
    let clouds = clouds_in(&args.folder)?;
    if let Some(table) = &args.import {
        import(args, table, &clouds)?;
    }
    let (mut files, mut annotated, mut warnings) = (AxisFiles::default(), Vec::new(), Vec::new());
    for path in &clouds {
        let name = Row::name_in(&args.folder, path);
        // A cloud without axis files need not be read.
        let files = files.of(path);
        if files.is_empty() {
            annotated.push((name, Vec::new()));
            continue;
        }
        match read_cloud(path) {
            Ok(file) => {
                let (annotations, unusable) = read_annotations(&files, &file.sha256);
                warnings.extend(unusable);
                annotated.push((name, annotations));
            }
            Err(error) => warnings.push(format!("{error}.")),
        }
    }
    for warning in &warnings {
        say!("Warning: {warning}");
    }
    if let Some(file) = &args.export {
        let rows = annotated
            .iter()
            .flat_map(|(name, annotations)| annotations.iter().map(move |a| (name.as_str(), a)));
        let table = write_table(rows)?;
        super::output::write(file, &table)?;
    }
    let of =
        |(name, annotations): &(String, Vec<Annotation>)| CloudAgreement::of(name, annotations, args.far_off);
    let agreement = SetAgreement::of(annotated.iter().map(of).collect(), args.far_off);
    match args.format {
        Format::Text => Ok(write_text(&mut Printable::stdout(), &agreement)?),
        Format::Json => {
            let report = Report {
                schema: "axiscope.agreement/1",
                agreement: &agreement,
                warnings: &warnings,
            };
            Ok(writeln!(
                std::io::stdout(),
                "{}",
                serde_json::to_string_pretty(&report)?
            )?)
        }
    }
}

/// The longest table that is read, in bytes: some hundred thousand axes.
const LONGEST_TABLE: u64 = 64 << 20;

/// Imports the axes of a table. Every row is checked before the first is written.
fn import(args: &Annotations, table: &Path, clouds: &[PathBuf]) -> anyhow::Result<()> {
    let named = || table.display().to_string();
    let bytes = read_at_most(table, LONGEST_TABLE).with_context(named)?;
    let rows = read_table(&bytes).with_context(named)?;
    let mut known_clouds = HashMap::new();
    let mut ready = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let of_row = || format!("{}: row {}", table.display(), i + 1);
        ready.push(prepare(args, row, clouds, &mut known_clouds).with_context(of_row)?);
    }
    let (mut taken, mut known) = (0, 0);
    for (path, cloud, author, row) in ready {
        let (mut store, writable) = open(path, &cloud.sha256, cloud.unit, author)?;
        writable?;
        let judgment = row.in_unit(cloud.unit)?;
        if store
            .current()
            .is_some_and(|current| current.judgment == judgment)
        {
            known += 1;
        } else {
            store.edit(judgment, &now())?;
            taken += 1;
        }
    }
    say!("Took {taken} axes from {}; {known} were known.", table.display());
    Ok(())
}

/// The part of a cloud that an imported axis needs: its points are not kept.
struct KnownCloud {
    sha256: String,
    unit: Unit,
}

fn prepare<'a>(
    args: &Annotations,
    row: &'a ImportedRow,
    clouds: &'a [PathBuf],
    known: &mut HashMap<&'a Path, Arc<KnownCloud>>,
) -> anyhow::Result<(&'a Path, Arc<KnownCloud>, Author, &'a ImportedRow)> {
    let author = match row.role {
        Role::Annotator => Author::annotator(&row.annotator),
        Role::Adjudicator => Author::adjudicator(&row.annotator),
    }?;
    // Only clouds in the folder: a table comes from outside, and could name any file.
    let path = clouds
        .iter()
        .find(|path| Row::name_in(&args.folder, path) == row.file)
        .with_context(|| format!("there is no cloud {:?} in {}", row.file, args.folder.display()))?;
    let cloud = if let Some(cloud) = known.get(path.as_path()) {
        cloud.clone()
    } else {
        let request = Request {
            unit: args.unit,
            peduncle: PeduncleChoice::None,
            ..Request::default()
        };
        let fruit = Fruit::read(path, &request)?;
        let (sha256, unit) = (fruit.file.sha256.clone(), fruit.unit);
        let cloud = Arc::new(KnownCloud { sha256, unit });
        known.insert(path, cloud.clone());
        cloud
    };
    anyhow::ensure!(
        row.sha256.as_ref().is_none_or(|hash| *hash == cloud.sha256),
        "{} is not the cloud that this axis was set for",
        path.display()
    );
    row.in_unit(cloud.unit)?;
    Ok((path, cloud, author, row))
}

fn write_text(out: &mut impl Write, set: &SetAgreement) -> std::io::Result<()> {
    let annotated = set.clouds.iter().filter(|c| !is_silent(c)).count();
    writeln!(
        out,
        "{} clouds, {annotated} with an axis set by hand; far off means more than {}°",
        set.clouds.len(),
        set.far_off_deg
    )?;
    let mut worst: Vec<&CloudAgreement> = set.clouds.iter().filter(|c| !is_silent(c)).collect();
    // The largest disagreement comes first.
    worst.sort_by(|a, b| {
        let of = |c: &CloudAgreement| c.largest_deg.unwrap_or(-1.0);
        of(b).total_cmp(&of(a)).then_with(|| a.file.cmp(&b.file))
    });
    let degrees = |value: Option<f64>| value.map_or("–".into(), |v| format!("{v:.2}°"));
    let mut table = vec![
        [
            "Cloud",
            "Largest",
            "Spread",
            "Set by",
            "Far off",
            "Cannot tell",
            "Decided by",
        ]
        .map(String::from),
    ];
    table.extend(worst.iter().map(|cloud| {
        [
            cloud.file.clone(),
            degrees(cloud.largest_deg),
            degrees(cloud.mean.as_ref().map(|m| m.spread_deg)),
            list(&cloud.annotators),
            list(&cloud.far_off),
            list(&cloud.cannot_tell),
            cloud.adjudicator.clone().unwrap_or("–".into()),
        ]
    }));
    write_table_text(out, &table)?;
    let mut table = vec![
        [
            "Annotator",
            "Axes",
            "Cannot tell",
            "Far off",
            "To the others",
            "To the adjudicated",
        ]
        .map(String::from),
    ];
    table.extend(set.annotators.iter().map(|a| {
        [
            a.annotator.clone(),
            a.clouds.to_string(),
            a.cannot_tell.to_string(),
            a.far_off.to_string(),
            degrees(a.mean_deg),
            degrees(a.to_adjudicated_deg),
        ]
    }));
    write_table_text(out, &table)?;
    let mut table = vec![["Pair", "Clouds", "Mean", "Largest", "Opposite ends"].map(String::from)];
    table.extend(set.pairs.iter().map(|p| {
        [
            format!("{} and {}", p.a, p.b),
            p.clouds.to_string(),
            degrees(Some(p.mean_deg)),
            degrees(Some(p.largest_deg)),
            p.opposite.to_string(),
        ]
    }));
    write_table_text(out, &table)
}

fn is_silent(cloud: &CloudAgreement) -> bool {
    cloud.annotators.is_empty() && cloud.cannot_tell.is_empty() && cloud.adjudicator.is_none()
}

fn list(names: &[String]) -> String {
    if names.is_empty() {
        "–".into()
    } else {
        names.join(", ")
    }
}

/// Writes columns under their heads; a table without rows is left out.
fn write_table_text<const N: usize>(out: &mut impl Write, rows: &[[String; N]]) -> std::io::Result<()> {
    if rows.len() < 2 {
        return Ok(());
    }
    let mut table = Table::new();
    table.load_style(NOTHING).add_rows(rows);
    for column in table.column_iter_mut() {
        column.set_padding((0, 2));
    }
    writeln!(out)?;
    for line in table.lines() {
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}
