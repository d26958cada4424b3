//! The result of one cloud as text.

use std::io::Write;

use axiscope::evaluate::{
    ErrorBreakdown, Examination, TimedEstimate, Timings, TruthChoice, peduncle_disagreement_deg, reference_of,
};
use axiscope::geometry::Unit;
use axiscope::method::axis_error_rad;
use axiscope::method::{Aggregation, Analysis, AxisEstimate, AxisSource, CenterMethod};
use axiscope::peduncle::PeduncleSource;
use glam::DVec3;

use super::Analyze;

/// Describes an estimate in one line.
fn described(timed: &TimedEstimate, examined: &Examination) -> String {
    let estimate = &timed.estimate;
    let Some(axis) = &estimate.axis else {
        return format!("none: {}", estimate.warnings.join(" "));
    };
    let mut parts = vec![direction(axis.direction)];
    if let Some(confidence) = estimate.confidence {
        parts.push(format!("confidence {confidence:.2}"));
    }
    if estimate.ambiguous {
        parts.push("ambiguous".into());
    }
    let reference = reference_of(&examined.references, TruthChoice::Auto);
    if let Some((error_deg, reference)) = timed.error_deg(&examined.references).zip(reference) {
        parts.push(format!(
            "error {error_deg:.2}° to {}",
            reference.source.in_words()
        ));
    }
    if let (Some(share), Some(occlusion)) = (estimate.seen_share, estimate.occlusion) {
        parts.push(format!(
            "{:.0} % seen (occlusion: {})",
            100.0 * share,
            occlusion.name()
        ));
    }
    parts.push(format!("{:.0} ms", timed.ms));
    parts.join(", ")
}

/// Writes the report.
pub(super) fn write_text(
    out: &mut impl Write,
    args: &Analyze,
    examined: &Examination,
    timings: &Timings,
    estimates: &[TimedEstimate],
) -> std::io::Result<()> {
    let Examination {
        fruit,
        analysis,
        warnings,
        ..
    } = examined;
    let (params, unit) = (&analysis.params, fruit.unit);
    let grid = analysis.planes.grid;
    let (points, used) = (fruit.cloud().len(), analysis.surface.len());
    let path = args.cloud.display();
    write!(out, "{path}: {points} points in {}", unit_name(unit))?;
    if used != points {
        write!(out, ", {used} of them used")?;
    }
    writeln!(out, "\n")?;

    row(
        out,
        "Preset",
        &format!("{} ({})", params.preset_name(), reading(analysis)),
    )?;
    row(out, "Fruit center", &position(analysis.center, unit))?;
    match &analysis.best {
        Err(none) => row(out, "Symmetry plane", &format!("none: {none}"))?,
        Ok(best) => {
            let c = best.candidate;
            let u = grid.u();
            let text = format!(
                "g {}, h {} of {u} × {u}, normal {}",
                c.g,
                c.h,
                direction(c.normal)
            );
            row(out, "Symmetry plane", &text)?;
            let partners = analysis.planes.terms[best.index].partners;
            let share = 100.0 * partners as f64 / used as f64;
            let text = format!(
                "score {:.4} cm, {partners} points have a partner ({share:.0} %)",
                best.score_cm
            );
            row(out, "", &text)?;
            if let Some((c, score)) = best.runner_up {
                let lead = match best.lead() {
                    Some(lead) => format!(" ({:.1} % more)", 100.0 * lead),
                    None => String::new(),
                };
                let text = format!("g {}, h {}, score {score:.4} cm{lead}", c.g, c.h);
                row(out, "Runner-up", &text)?;
            }
        }
    }
    match &analysis.axis {
        Some(axis) => row(out, "Symmetry axis", &direction(axis.direction))?,
        None => row(out, "Symmetry axis", "none")?,
    }
    write_references(out, examined)?;
    for timed in estimates {
        row(
            out,
            &format!("By {}", timed.estimate.estimator.name()),
            &described(timed, examined),
        )?;
    }
    let truth = reference_of(&examined.references, args.truth);
    if let Some(parts) = truth.and_then(|truth| examined.error_breakdown(truth)) {
        write_parts(out, &parts, analysis.ranking.order().len())?;
    }
    let Timings {
        read,
        normals,
        center,
        plane_terms,
        total,
    } = timings;
    let text = format!(
        "{total:.1} ms: read {read:.1}, normals {normals:.1}, center {center:.1}, planes {plane_terms:.1}"
    );
    row(out, "Time", &text)?;
    for (i, warning) in warnings.iter().enumerate() {
        writeln!(out, "{}Warning: {warning}", if i == 0 { "\n" } else { "" })?;
    }
    Ok(())
}

/// Writes every reference, the axis's error against each, and the angle between those of the peduncle.
fn write_references(out: &mut impl Write, examined: &Examination) -> std::io::Result<()> {
    let Examination {
        fruit,
        analysis,
        references,
        ..
    } = examined;
    let reference = reference_of(references, TruthChoice::Peduncle);
    let error_to = |reference: &AxisEstimate| match &analysis.axis {
        Some(axis) => format!("{:.2}°", axis_error_rad(axis, reference).to_degrees()),
        None => "none without an axis".into(),
    };
    match (reference, &fruit.peduncle) {
        (Some(reference), Some(peduncle)) => {
            let how = match peduncle.source {
                PeduncleSource::Label => "labels",
                PeduncleSource::Companion => "a file of its own",
                PeduncleSource::Removal => "the cloud without it",
                PeduncleSource::Hue(_) => "color",
                PeduncleSource::Picked => "hand",
            };
            let count = peduncle.points;
            let text = format!(
                "{} (peduncle: {count} points by {how})",
                direction(reference.direction)
            );
            row(out, "Reference axis", &text)?;
            row(out, "Error", &error_to(reference))?;
        }
        _ => row(out, "Reference axis", "none: no peduncle is known")?,
    }
    if let Some(second) = reference_of(references, TruthChoice::PeduncleDirection) {
        let text = format!("{} (the peduncle's own direction)", direction(second.direction));
        row(out, "2nd reference", &text)?;
        row(out, "Error", &error_to(second))?;
        if let Some(apart) = peduncle_disagreement_deg(references) {
            let text = format!("the two references are {apart:.2}° apart");
            row(out, "", &text)?;
        }
    }
    for reference in references {
        let name = match &reference.source {
            AxisSource::Simulation => "True axis",
            AxisSource::Annotator(_) | AxisSource::Annotators(_) | AxisSource::Adjudicated => "Axis by hand",
            _ => continue,
        };
        let source = reference.source.in_words();
        row(
            out,
            name,
            &format!("{} ({source})", direction(reference.direction)),
        )?;
        row(out, "Error", &error_to(reference))?;
    }
    Ok(())
}

/// Writes the parts of an error; `scored` is the number of planes with a score.
fn write_parts(out: &mut impl Write, parts: &ErrorBreakdown, scored: usize) -> std::io::Result<()> {
    let (lean, grid) = (parts.lean_part_deg, parts.grid_part_deg);
    let text = match parts.error_deg.zip(parts.choice_part_deg) {
        Some((error, choice)) => format!(
            "{error:.2}° against {} = {lean:.2}° lean + {grid:.2}° grid + {choice:.2}° choice of the plane",
            parts.truth
        ),
        None => format!(
            "no axis; against {}: {lean:.2}° lean, {grid:.2}° grid",
            parts.truth
        ),
    };
    row(out, "Error's parts", &text)?;
    let nearest = &parts.nearest_candidate;
    let rank = match nearest.rank {
        Some(rank) => format!("rank {rank} of {scored}"),
        None => "without a score".into(),
    };
    let text = format!(
        "nearest candidate: g {}, h {}, {:.2}° off, {rank}",
        nearest.g, nearest.h, nearest.error_deg
    );
    row(out, "", &text)?;
    if let Some(given) = &parts.true_center {
        let error = given
            .error_deg
            .map_or("no axis".into(), |error| format!("{error:.2}° off"));
        let text = format!(
            "true center, {:.2} cm from the computed one: {error} if it is given",
            given.distance_cm
        );
        row(out, "", &text)?;
    }
    Ok(())
}

pub(super) fn row(out: &mut impl Write, name: &str, value: &str) -> std::io::Result<()> {
    writeln!(out, "{name:<16}{value}")
}

/// Describes the parameters that decide how the paper is read.
fn reading(analysis: &Analysis) -> String {
    let params = &analysis.params;
    let center = match params.center {
        CenterMethod::MeanRms(_) => "mean-rms center",
        CenterMethod::Equidistant(_) => "equidistant center",
        CenterMethod::Sphere => "sphere's center",
        CenterMethod::Given(_) => "given center",
    };
    let aggregate = match params.aggregation {
        Aggregation::Mean => "mean score",
        Aggregation::Sum => "summed score",
    };
    let fraction = 100.0 * params.min_partner_fraction;
    if fraction > 0.0 {
        format!("{center}, {aggregate}, partners for at least {fraction:.0} % of the points")
    } else {
        format!("{center}, {aggregate}, every plane in the running")
    }
}

fn unit_name(unit: Unit) -> &'static str {
    match unit {
        Unit::Meter => "meters",
        Unit::Centimeter => "centimeters",
        Unit::Millimeter => "millimeters",
    }
}

/// Formats a position to a tenth of a millimeter or better.
pub(super) fn position(p: DVec3, unit: Unit) -> String {
    let digits = match unit {
        Unit::Meter => 5,
        Unit::Centimeter => 3,
        Unit::Millimeter => 2,
    };
    format!("({:.digits$}, {:.digits$}, {:.digits$}) {unit}", p.x, p.y, p.z)
}

pub(super) fn direction(v: DVec3) -> String {
    // Adding zero turns a rounded -0.0 into 0.
    let [x, y, z] = v.to_array().map(|c| (c * 1e4).round() / 1e4 + 0.0);
    format!("({x:.4}, {y:.4}, {z:.4})")
}
