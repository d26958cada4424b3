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
text-align:left;vertical-align:top}.p{display:flex;height:.8rem;width:14rem}.p i{height:100%}.lean{background:#7a7a7a}\
.grid{background:#e6a817}.choice{background:#c2452d}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}figure{margin:1.5rem 0}\
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
                (parts_table(summary))
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
    let options = request.options();
    let differing = if options.is_empty() {
        "All settings are the defaults".to_owned()
    } else {
        format!("Differing from the defaults: {}", options.join(" "))
    };
    format!(
        "Axiscope {}, preset {}, u = {}, τ = {:.4} cm/rad, {}. {differing}.",
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

/// Draws parts of an error, each of the color of its class, as one bar of the length of their share of `whole_deg`.
fn parts_bar(parts: &[(&str, f64)], whole_deg: f64) -> Markup {
    let percent = |part: f64| format!("{:.1}", 100.0 * part / whole_deg.max(1e-9));
    html! {
        div.p {
            @for (class, part) in parts {
                i class=(class) style={ "width:" (percent(*part)) "%" } {}
            }
        }
    }
}

/// Writes the means of the parts of the error, and what the center does to it.
fn parts_table(summary: &Summary) -> Markup {
    let Some(means) = &summary.error_parts else {
        return html! {};
    };
    let parts = [means.lean_part_deg, means.grid_part_deg, means.choice_part_deg];
    let lines = [
        ("lean", "Lean of the true axis, which Eq. 16 cannot express"),
        (
            "grid",
            "Grid: the candidate nearest to the true axis has no smaller error",
        ),
        (
            "choice",
            "Choice of the plane: the lowest score is another candidate's",
        ),
    ];
    html! {
        h2 { "Where the error comes from" }
        p {
            "Means of " (means.clouds) " clouds. The parts add up to the error of "
            (number(Some(means.error_deg), 2, "°")) "."
        }
        table {
            @for ((class, text), part) in lines.into_iter().zip(parts) {
                tr {
                    td { (text) }
                    td.n { (number(Some(part), 2, "°")) }
                    td { (parts_bar(&[(class, part)], means.error_deg)) }
                }
            }
        }
        @if let Some(given) = &means.true_center {
            p {
                "With the true center given, the mean error of " (given.clouds) " clouds is "
                (number(Some(given.error_true_center_deg), 2, "°")) " instead of "
                (number(Some(given.error_deg), 2, "°")) ". The computed center is "
                (number(Some(given.center_distance_cm), 2, " cm")) " from the true one on average."
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
    let longest_deg = worst.first().and_then(|row| row.error_deg).unwrap_or_default();
    let error_true_center = |row: &Row| row.error_parts.as_ref()?.true_center.as_ref()?.error_deg;
    html! {
        @if !worst.is_empty() {
            h2 { "The worst first" }
            table {
                tr {
                    th { "File" } th.n { "Error" } th { "Against" } th.n { "Score (cm)" } th.n { "Lead" }
                    th.n { "Points with a partner" } th { "Lean, grid, choice" } th.n { "With the true center" }
                    th { "Warnings" }
                }
                @for row in worst.into_iter().take(WORST) {
                    tr {
                        td { code { (row.file) } }
                        td.n { (number(row.error_deg, 2, "°")) }
                        td { (row.truth.as_deref().unwrap_or("–")) }
                        td.n { (number(row.score_cm, 4, "")) }
                        td.n { (number(row.lead.map(|l| 100.0 * l), 1, " %")) }
                        td.n { (number(row.partner_fraction.map(|f| 100.0 * f), 0, " %")) }
                        td { (row_parts(row, longest_deg)) }
                        td.n { (number(error_true_center(row), 2, "°")) }
                        td { (row.warnings) }
                    }
                }
            }
        }
    }
}

/// Draws a cloud's parts as a bar, with their numbers for a pointer that rests on it.
fn row_parts(row: &Row, longest_deg: f64) -> Markup {
    let Some((parts, choice)) = row
        .error_parts
        .as_ref()
        .and_then(|p| Some((p, p.choice_part_deg?)))
    else {
        return html! { "–" };
    };
    let (lean, grid) = (parts.lean_part_deg, parts.grid_part_deg);
    let bar = [("lean", lean), ("grid", grid), ("choice", choice)];
    html! {
        div title=(format!("lean {lean:.2}°, grid {grid:.2}°, choice of the plane {choice:.2}°")) {
            (parts_bar(&bar, longest_deg))
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
