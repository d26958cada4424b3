//! report.html: the summary, the figures and the worst clouds on one page that needs nothing else.

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{WorstPicture, worst_first};
use crate::evaluate::{Row, Summary};
use crate::fruit::Request;

/// The number of clouds in the list of the worst.
const WORST: usize = 30;

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem;color:#1c1c1c}\
h1,h2{font-weight:600}table{border-collapse:collapse;margin:1rem 0}th,td{padding:.3rem .8rem;border-bottom:1px solid #ddd;\
text-align:left;vertical-align:top}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}figure{margin:1.5rem 0}\
svg,img{max-width:100%;height:auto}.g{display:grid;\
grid-template-columns:repeat(auto-fill,minmax(22rem,1fr));gap:1rem}.g figure{margin:0}code{font-size:13px}";

/// Writes the page. Everything but the figures, which are SVG of the program's own, is escaped.
pub(super) fn report(
    folder: &Path,
    request: &Request,
    rows: &[Row],
    summary: &Summary,
    figures: &[String],
    pictures: &[WorstPicture],
) -> String {
    let folder = folder.display();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { "Axiscope: " (folder) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Symmetry axes of " (folder) }
                p { (settings(request)) }
                (summary_table(summary))
                (failures(rows))
                @for figure in figures {
                    figure { (PreEscaped(figure)) }
                }
                (worst_table(rows))
                (worst_pictures(pictures))
            }
        }
    };
    page.into_string()
}

fn settings(request: &Request) -> String {
    let params = &request.params;
    format!(
        "Axiscope {}, preset {}, u = {}, τ = {:.4} cm/rad, {}.",
        env!("CARGO_PKG_VERSION"),
        params.preset_name(),
        params.u,
        params.tau_cm_per_rad,
        if request.without_peduncle {
            "without the peduncle's points"
        } else {
            "clouds as they stand"
        }
    )
}

fn summary_table(summary: &Summary) -> Markup {
    let degrees = |value| number(value, 2, "°");
    let percent = |value: Option<f64>| number(value.map(|v| 100.0 * v), 2, " %");
    let lines = [
        ("Clouds", summary.clouds.to_string()),
        ("With an error", summary.measured.to_string()),
        ("Mean error", degrees(summary.mean_deg)),
        ("Median", degrees(summary.median_deg)),
        ("95th percentile", degrees(summary.p95_deg)),
        ("Worst", degrees(summary.worst.as_ref().map(|w| w.error_deg))),
        ("Under 5°", percent(summary.share_under_5_deg)),
        ("Under 10°", percent(summary.share_under_10_deg)),
        ("Under 15°", percent(summary.share_under_15_deg)),
    ];
    html! {
        table {
            @for (name, value) in lines {
                tr { th { (name) } td.n { (value) } }
            }
        }
    }
}

fn failures(rows: &[Row]) -> Markup {
    let failed: Vec<_> = rows
        .iter()
        .filter_map(|row| Some((&row.file, row.failure.as_ref()?)))
        .collect();
    html! {
        @if !failed.is_empty() {
            h2 { "Clouds without an error" }
            table {
                tr { th { "File" } th { "Reason" } }
                @for (file, reason) in failed {
                    tr { td { code { (file) } } td { (reason) } }
                }
            }
        }
    }
}

fn worst_table(rows: &[Row]) -> Markup {
    let worst = worst_first(rows);
    html! {
        @if !worst.is_empty() {
            h2 { "The worst first" }
            table {
                tr {
                    th { "File" } th.n { "Error" } th { "Against" } th.n { "Score (cm)" } th.n { "Lead" }
                    th.n { "Points with a partner" } th { "Warnings" }
                }
                @for row in worst.into_iter().take(WORST) {
                    tr {
                        td { code { (row.file) } }
                        td.n { (number(row.error_deg, 2, "°")) }
                        td { (row.truth.as_deref().unwrap_or("–")) }
                        td.n { (number(row.score_cm, 4, "")) }
                        td.n { (number(row.lead.map(|l| 100.0 * l), 1, " %")) }
                        td.n { (number(row.partner_fraction.map(|f| 100.0 * f), 0, " %")) }
                        td { (row.warnings) }
                    }
                }
            }
        }
    }
}

fn worst_pictures(pictures: &[WorstPicture]) -> Markup {
    html! {
        @if !pictures.is_empty() {
            h2 { "Pictures of the worst" }
            p {
                "The computed axis in green, the reference in white; the colors are the sides of the symmetry plane."
            }
            div.g {
                @for WorstPicture { file, error_deg, png } in pictures {
                    @let error = number(*error_deg, 2, "°");
                    figure {
                        img alt={ (file) ", " (error) " off" }
                            src={ "data:image/png;base64," (STANDARD.encode(png)) };
                        figcaption { code { (file) } ", " (error) }
                    }
                }
            }
        }
    }
}

/// Formats a number with its unit; a dash if there is none.
fn number(value: Option<f64>, digits: usize, unit: &str) -> String {
    value.map_or_else(|| "–".into(), |v| format!("{v:.digits$}{unit}"))
}
