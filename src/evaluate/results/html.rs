//! report.html: the summary, the figures and the worst clouds on one page that needs nothing else.

use std::fmt::Write;
use std::path::Path;

use super::{WorstPicture, worst_first};
use crate::evaluate::{Row, Summary};
use crate::fruit::Request;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// How many clouds are listed, worst first.
const WORST: usize = 30;

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem;color:#1c1c1c}\
h1,h2{font-weight:600}table{border-collapse:collapse;margin:1rem 0}th,td{padding:.3rem .8rem;border-bottom:1px solid #ddd;\
text-align:left;vertical-align:top}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}figure{margin:1.5rem 0}\
svg,img{max-width:100%;height:auto}.g{display:grid;\
grid-template-columns:repeat(auto-fill,minmax(22rem,1fr));gap:1rem}.g figure{margin:0}code{font-size:13px}";

/// The page. Whatever comes from outside is escaped.
pub(super) fn report(
    folder: &Path,
    request: &Request,
    rows: &[Row],
    summary: &Summary,
    figures: &[String],
    pictures: &[WorstPicture],
) -> String {
    let mut page = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut page, folder, request, rows, summary, figures)
        .and_then(|()| write_worst(&mut page, rows))
        .and_then(|()| write_pictures(&mut page, pictures))
        .and_then(|()| writeln!(page, "</body></html>"));
    page
}

fn write(
    page: &mut String,
    folder: &Path,
    request: &Request,
    rows: &[Row],
    summary: &Summary,
    figures: &[String],
) -> std::fmt::Result {
    let folder = escaped(&folder.display().to_string());
    writeln!(
        page,
        "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Axiscope: {folder}</title>\
         <style>{STYLE}</style></head><body><h1>Symmetry axes of {folder}</h1>"
    )?;
    let params = &request.params;
    writeln!(
        page,
        "<p>Axiscope {}, preset {}, u = {}, τ = {:.4} cm/rad, {}.</p>",
        env!("CARGO_PKG_VERSION"),
        params.preset_name(),
        params.u,
        params.tau_cm_per_rad,
        if request.without_peduncle {
            "without the peduncle's points"
        } else {
            "clouds as they stand"
        }
    )?;
    writeln!(
        page,
        "<table><tr><th>Clouds</th><td class=\"n\">{}</td></tr>",
        summary.clouds
    )?;
    let number = |value: Option<f64>, unit: &str| value.map_or("–".into(), |v| format!("{v:.2}{unit}"));
    let percent = |value: Option<f64>| number(value.map(|v| 100.0 * v), " %");
    let lines = [
        ("With an error", summary.measured.to_string()),
        ("Mean error", number(summary.mean_deg, "°")),
        ("Median", number(summary.median_deg, "°")),
        ("95th percentile", number(summary.p95_deg, "°")),
        ("Worst", number(summary.worst.as_ref().map(|w| w.error_deg), "°")),
        ("Under 5°", percent(summary.share_under_5_deg)),
        ("Under 10°", percent(summary.share_under_10_deg)),
        ("Under 15°", percent(summary.share_under_15_deg)),
    ];
    for (name, value) in lines {
        writeln!(page, "<tr><th>{name}</th><td class=\"n\">{value}</td></tr>")?;
    }
    writeln!(page, "</table>")?;
    if !summary.failures.is_empty() {
        writeln!(
            page,
            "<h2>Clouds without an error</h2><table><tr><th>File</th><th>Reason</th></tr>"
        )?;
        for row in rows {
            if let Some(reason) = &row.failure {
                let (file, reason) = (escaped(&row.file), escaped(reason));
                writeln!(page, "<tr><td><code>{file}</code></td><td>{reason}</td></tr>")?;
            }
        }
        writeln!(page, "</table>")?;
    }
    for figure in figures {
        writeln!(page, "<figure>{figure}</figure>")?;
    }
    Ok(())
}

fn write_pictures(page: &mut String, pictures: &[WorstPicture]) -> std::fmt::Result {
    if pictures.is_empty() {
        return Ok(());
    }
    writeln!(
        page,
        "<h2>Pictures of the worst</h2><p>The computed axis in green, the reference in white; the colors are the \
         sides of the symmetry plane.</p><div class=\"g\">"
    )?;
    for picture in pictures {
        let (file, error_deg) = (escaped(&picture.file), picture.error_deg.unwrap_or_default());
        writeln!(
            page,
            "<figure><img alt=\"{file}, {error_deg:.2}° off\" src=\"data:image/png;base64,{}\">\
             <figcaption><code>{file}</code>, {error_deg:.2}°</figcaption></figure>",
            STANDARD.encode(&picture.png)
        )?;
    }
    writeln!(page, "</div>")
}

fn write_worst(page: &mut String, rows: &[Row]) -> std::fmt::Result {
    let worst = worst_first(rows);
    if worst.is_empty() {
        return Ok(());
    }
    writeln!(
        page,
        "<h2>The worst first</h2><table><tr><th>File</th><th class=\"n\">Error</th><th>Against</th>\
         <th class=\"n\">Score (cm)</th><th class=\"n\">Lead</th><th class=\"n\">Points with a partner</th><th>Warnings</th></tr>"
    )?;
    for row in worst.into_iter().take(WORST) {
        let error_deg = row.error_deg.unwrap_or_default();
        let text = |value: &Option<String>| escaped(value.as_deref().unwrap_or("–"));
        let number = |value: Option<f64>, digits: usize, unit: &str| {
            value.map_or("–".into(), |v| format!("{v:.digits$}{unit}"))
        };
        writeln!(
            page,
            "<tr><td><code>{}</code></td><td class=\"n\">{error_deg:.2}°</td><td>{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>",
            escaped(&row.file),
            text(&row.truth),
            number(row.score_cm, 4, ""),
            number(row.lead.map(|l| 100.0 * l), 1, " %"),
            number(row.partner_fraction.map(|f| 100.0 * f), 0, " %"),
            escaped(&row.warnings)
        )?;
    }
    writeln!(page, "</table>")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
