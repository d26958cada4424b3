//! The options of `axiscope analyze` for the points of one plane: one point's steps, and a table of all of them.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use axiscope::evaluate::{Examination, PointRow, PointsFormat, point_rows, point_table};
use axiscope::geometry::Unit;
use axiscope::method::{Candidate, Side, plane_detail};
use clap::Args;
use glam::DVec3;

use super::text::{direction, position, row};
use crate::cli::options::{OrBest, plane_choice, position as coordinates};
use crate::cli::output;

#[derive(Debug, Args)]
#[command(next_help_heading = "Points under one plane")]
pub(super) struct PointOptions {
    /// Plane of --point and --points: best, or its G,H
    #[arg(long, value_name = "PLANE", default_value = "best", value_parser = plane_choice)]
    plane: OrBest<[usize; 2]>,
    /// Point whose steps are shown (Eq. 12–15): its index in the file, from 0, or X,Y,Z for the nearest used point
    #[arg(long, value_name = "INDEX|X,Y,Z", value_parser = wanted_point, allow_hyphen_values = true)]
    point: Option<WantedPoint>,
    /// File for all used points with normal, side, partner, d, ξ and S: NAME.csv, NAME.parquet or NAME.ply
    #[arg(long, value_name = "FILE")]
    points: Option<PathBuf>,
}

/// A point as it was asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
enum WantedPoint {
    /// By its index in the file.
    Index(usize),
    /// The used point nearest to this place, in the file's unit and frame.
    Nearest(DVec3),
}

fn wanted_point(text: &str) -> Result<WantedPoint, String> {
    if let Ok(index) = text.trim().parse() {
        return Ok(WantedPoint::Index(index));
    }
    match coordinates(text) {
        Ok(place) => Ok(WantedPoint::Nearest(place)),
        Err(_) => Err("expected the index of a point, or three numbers X,Y,Z".into()),
    }
}

/// One point's steps and the plane that they belong to.
pub(super) struct ExplainedPoint {
    pub(super) candidate: Candidate,
    pub(super) row: PointRow,
}

impl PointOptions {
    /// Writes the table of points, if one was asked for, and returns the steps of the wanted point.
    pub(super) fn run(&self, examined: &Examination) -> anyhow::Result<Option<ExplainedPoint>> {
        if self.point.is_none() && self.points.is_none() {
            return Ok(None);
        }
        let format = match &self.points {
            Some(path) => Some(PointsFormat::of_path(path).ok_or_else(|| {
                anyhow!(
                    "{}: the format of the points follows from the file's ending, .csv, .parquet or .ply",
                    path.display()
                )
            })?),
            None => None,
        };
        let analysis = &examined.analysis;
        let grid = analysis.planes.grid;
        let index = match self.plane {
            Some([g, h]) => {
                let u = grid.u();
                (grid.index_of(g, h))
                    .ok_or_else(|| anyhow!("there is no plane g {g}, h {h}: both go from 1 to {u}"))?
            }
            None => {
                analysis
                    .best
                    .map_err(|none| anyhow!("no plane is best: {none}"))?
                    .index
            }
        };
        let plane = analysis.plane(index);
        let viewpoint = analysis.params.viewpoint;
        let detail = plane_detail(&analysis.surface, analysis.params.unit, plane, viewpoint, &())?;
        let mut rows = point_rows(examined, &detail);
        if let Some((path, format)) = self.points.as_ref().zip(format) {
            if is_same_file(path, &examined.fruit.file.path) {
                bail!("{}: --points would write over the cloud itself", path.display());
            }
            output::write(path, &point_table(&rows, examined.fruit.unit, format)?)?;
        }
        let Some(wanted) = self.point else { return Ok(None) };
        let found = match wanted {
            WantedPoint::Index(index) => rows.iter().position(|row| row.index_in_file == Some(index)),
            WantedPoint::Nearest(place) => {
                let distance = |row: &PointRow| row.steps.position.distance_squared(place);
                (0..rows.len()).min_by(|&a, &b| distance(&rows[a]).total_cmp(&distance(&rows[b])))
            }
        };
        match (found, wanted) {
            (Some(found), _) => Ok(Some(ExplainedPoint {
                candidate: grid.candidate(index),
                row: rows.swap_remove(found),
            })),
            (None, WantedPoint::Index(index)) => {
                let count = examined.fruit.cloud().len();
                if index < count {
                    bail!(
                        "the point {index} is not used: a filter, a missing normal or the peduncle's removal left it out"
                    );
                }
                bail!("there is no point {index}: the cloud has {count}, counted from 0");
            }
            (None, WantedPoint::Nearest(_)) => bail!("no point is used"),
        }
    }
}

/// Whether two paths name one file that is there.
fn is_same_file(a: &Path, b: &Path) -> bool {
    a.canonicalize()
        .is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
}

/// Writes the steps of a point (Fig. 6).
pub(super) fn write_steps(
    out: &mut impl Write,
    explained: &ExplainedPoint,
    unit: Unit,
) -> std::io::Result<()> {
    let (candidate, steps) = (&explained.candidate, &explained.row.steps);
    writeln!(out)?;
    let index = match explained.row.index_in_file {
        Some(index) => format!("{index} of the file, "),
        None => String::new(),
    };
    row(
        out,
        "Point",
        &format!("{index}under plane g {}, h {}", candidate.g, candidate.h),
    )?;
    row(out, "p", &position(steps.position, unit))?;
    row(out, "normal n", &direction(steps.normal))?;
    let side = match steps.side {
        Side::Front => "in front of the plane",
        Side::Back => "behind the plane",
    };
    row(
        out,
        "side",
        &format!("{:.3} cm {side}", steps.plane_distance_cm.abs()),
    )?;
    row(
        out,
        "reflection",
        &format!("{} (Eq. 12)", position(steps.reflection, unit)),
    )?;
    row(
        out,
        "its normal ñ",
        &format!("{} (Eq. 13)", direction(steps.reflected_normal)),
    )?;
    let visible = if steps.visibility_cm > 0.0 {
        "a partner would be visible"
    } else {
        "a partner would face away"
    };
    row(
        out,
        "ñ · (p_v − p̈)",
        &format!("{:.2} cm: {visible} (Eq. 14)", steps.visibility_cm),
    )?;
    let Some(partner) = &steps.partner else {
        return row(out, "partner", "none: the point adds nothing to the score");
    };
    let index = match explained.row.partner_in_file {
        Some(index) => format!("{index} of the file, at "),
        None => String::new(),
    };
    row(
        out,
        "partner",
        &format!("{index}{}", position(partner.position, unit)),
    )?;
    row(out, "its normal", &direction(partner.normal))?;
    row(out, "d", &format!("{:.4} cm", partner.distance_cm))?;
    let degrees = partner.angle_rad.to_degrees();
    row(out, "ξ", &format!("{:.4} rad = {degrees:.2}°", partner.angle_rad))?;
    row(
        out,
        "S = d + τξ",
        &format!(
            "{:.4} cm with τ = {} cm/rad (Eq. 15)",
            partner.score_cm, partner.tau_cm_per_rad
        ),
    )
}
