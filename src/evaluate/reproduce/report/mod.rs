//! The report in Markdown: what the paper says, what is assumed, what comes out, and which of its figures are
//! reproduced.

mod ellipsoids;
mod peppers;
mod sets;

use super::findings::{
    Comparison, PAPER_FIG_8_DEG, PAPER_FIG_8_RANGE_DEG, PEDUNCLE_VARIANTS, TOLERANCE_DEG, upright_means,
};
use super::peppers::{OUTLIER_NEIGHBORS, OUTLIER_STD};
use super::readings::{AS_INTENDED, AS_PRINTED, READINGS};
use super::{PaperFigure, Reproduction, ScannedPeppers, Spread};

/// Writes the report. `figures` are the names of the files of each figure.
pub(super) fn markdown(results: &Reproduction, figures: &[(PaperFigure, Vec<String>)]) -> String {
    let mut sections = vec![
        "# Reproduction of Li et al., Sensors 18 (2018) 3083, § 3".to_owned(),
        introduction(results),
        verdicts(results),
        assumptions(results),
        ellipsoids::section(results),
    ];
    if results.main_peppers().is_some() {
        sections.push(peppers::section(results));
        sections.extend(sets::section(results));
    }
    sections.push(gallery(results, figures));
    sections.join("\n\n") + "\n"
}

/// A table of Markdown. The first column is of words, the others of numbers if `numbers`.
fn table(head: &[String], rows: &[Vec<String>], numbers: bool) -> String {
    let line = |cells: &[String]| format!("| {} |", cells.join(" | "));
    let rule = (0..head.len()).map(|i| if numbers && i > 0 { "---:" } else { "---" }.to_owned());
    let rule: Vec<String> = rule.collect();
    let lines = [line(head), line(&rule)]
        .into_iter()
        .chain(rows.iter().map(|row| line(row)));
    lines.collect::<Vec<_>>().join("\n")
}

fn strings<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).into()
}

fn introduction(results: &Reproduction) -> String {
    let settings = &results.settings;
    let scans = settings.scans();
    let main = &settings.main();
    let peppers = if results.scans.is_empty() {
        String::new()
    } else {
        format!(
            " § 3.2 is run on {} simulated peppers for each of {} scans, and from {}, lean at most {}°, for {} other sets of them and {} changes.",
            settings.peppers,
            scans.len(),
            main.arc_name(),
            main.lean_deg,
            results.other_sets.len(),
            results.variations.len(),
        )
    };
    format!(
        "Axiscope {}, seed {}. § 3.1 is run on the paper's ellipsoid at {} depths, {} times each.{peppers} The same command gives the same numbers. \
         A mean of the paper counts as reproduced within {TOLERANCE_DEG}°. *As printed*: the center of Eq. 3 word for word, the scores added up. *As intended*: the center \
         equidistant from the surface, the mean of the scores, planes under which at least 30 % of the points have a partner. `ellipsoids.csv` and `peppers.csv` hold every number.",
        env!("CARGO_PKG_VERSION"),
        settings.seed,
        settings.depths_cm.len(),
        settings.runs,
    )
}

/// The mean over the depths of a reading's mean error on one grid.
fn mean_over_depths(results: &Reproduction, grid: usize, reading: usize) -> Option<Spread> {
    let errors = results
        .depths
        .iter()
        .filter_map(|d| d.grids[grid][reading].as_ref());
    Spread::of(errors.map(|e| e.to_image_up_deg.mean))
}

fn degrees(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |v| format!("{v:.2}°"))
}

fn yes(reproduced: bool) -> String {
    if reproduced { "**yes**" } else { "no" }.to_owned()
}

/// The table of the paper's figures with ours and the settings that they need.
fn verdicts(results: &Reproduction) -> String {
    let settings = &results.settings;
    let (main, u) = (settings.main_grid(), settings.grid_sizes[settings.main_grid()]);
    let near = |value: f64, paper: f64| (value - paper).abs() <= TOLERANCE_DEG;
    let upright = upright_means(results);
    let mut rows = vec![vec![
        "§ 3.1, mean over the depths".to_owned(),
        format!("{PAPER_FIG_8_DEG:.2}°"),
        upright
            .iter()
            .map(|(_, mean)| format!("{mean:.2}°"))
            .collect::<Vec<_>>()
            .join(", "),
        "the upright candidate n = (1, 0, 0) alone, with the true center".to_owned(),
        yes(upright.iter().all(|(_, mean)| near(*mean, PAPER_FIG_8_DEG))),
    ]];
    let of_upright = Spread::of(results.depths.iter().map(|d| d.upright_deg));
    let (least, largest) = PAPER_FIG_8_RANGE_DEG;
    rows.push(vec![
        "Fig. 8, the curve over depth".to_owned(),
        format!("{least}° to {largest}°, flat"),
        of_upright.map_or("–".into(), |s| {
            format!("{:.1}° falling to {:.1}°", s.max, s.min)
        }),
        "the same".to_owned(),
        yes(of_upright.is_some_and(|s| s.min >= least - TOLERANCE_DEG && s.max <= largest + TOLERANCE_DEG)),
    ]);
    for (reading, name) in [(AS_PRINTED, "as printed"), (AS_INTENDED, "as intended")] {
        let mean = mean_over_depths(results, main, reading).map(|s| s.mean);
        rows.push(vec![
            "§ 3.1, by the whole method".to_owned(),
            format!("{PAPER_FIG_8_DEG:.2}°"),
            degrees(mean),
            format!("{name}, u = {u}"),
            yes(mean.is_some_and(|m| near(m, PAPER_FIG_8_DEG))),
        ]);
    }
    let mut pepper_rows = |scanned: &ScannedPeppers, grid: usize, reading: usize| {
        let Some(compared) = Comparison::of(scanned, grid, reading) else {
            return;
        };
        for (cell, paper) in compared.cells.iter().zip(&PEDUNCLE_VARIANTS) {
            let Spread { mean, min, max, .. } = cell.to_reference;
            rows.push(vec![
                format!("Fig. {}, peppers {}", paper.figure, paper.name),
                format!(
                    "{:.2}° ({:.2} to {:.2})",
                    paper.mean_deg, paper.range_deg.0, paper.range_deg.1
                ),
                format!("{mean:.2}° ({min:.2} to {max:.2})"),
                format!(
                    "{}, {}, lean at most {}°, u = {}",
                    fraction_name(reading),
                    scanned.scan.arc_name(),
                    scanned.scan.lean_deg,
                    settings.grid_sizes[grid]
                ),
                yes(near(mean, paper.mean_deg)),
            ]);
        }
    };
    if let Some(scanned) = results.main_peppers() {
        let nearest = results.nearest().map(|c| (c.grid, c.reading));
        let main = (main, AS_INTENDED);
        for (grid, reading) in nearest
            .into_iter()
            .filter(|&nearest| nearest != main)
            .chain([main])
        {
            pepper_rows(scanned, grid, reading);
        }
        let one_view = super::Scan {
            arc_deg: 0.0,
            ..scanned.scan.clone()
        };
        if let Some(single) = results.scanned(&one_view).filter(|_| scanned.scan.arc_deg > 0.0) {
            pepper_rows(single, main.0, main.1);
        }
    }
    let head = strings([
        "the paper's figure",
        "the paper",
        "ours: mean (least to largest)",
        "under",
        "mean reproduced",
    ]);
    let table = format!("## What is reproduced\n\n{}", table(&head, &rows, false));
    match results.main_peppers() {
        Some(_) => format!("{table}\n\n{}", reproducing_settings(results)),
        None => table,
    }
}

/// The scans and u under which both means of § 3.2 are reproduced, in a sentence.
fn reproducing_settings(results: &Reproduction) -> String {
    let settings = &results.settings;
    let all = 2 * results.scans.len() * settings.grid_sizes.len();
    let found = results.reproducing();
    let list: Vec<String> = found
        .iter()
        .map(|(scanned, compared)| {
            let u = settings.grid_sizes[compared.grid];
            let (arc, lean) = (scanned.scan.arc_name(), scanned.scan.lean_deg);
            format!(
                "{arc}, lean at most {lean}°, u = {u}, {}",
                fraction_name(compared.reading)
            )
        })
        .collect();
    let list = if list.is_empty() {
        "none".to_owned()
    } else {
        list.join("; ")
    };
    format!(
        "Of the {all} triples of a scan, a u and a least share of partners in the tables of § 3.2 below, {} give both means of Fig. 12 and 13 within {TOLERANCE_DEG}°: {list}. \
         The one that comes nearest was picked from the table and not before; the other sets of peppers below show how much of it is luck.",
        found.len()
    )
}

/// The name of the preset "as intended" with either least share of partners.
fn fraction_name(reading: usize) -> &'static str {
    if READINGS[reading].needs_half {
        "as intended, half need a partner"
    } else {
        "as intended"
    }
}

fn assumptions(results: &Reproduction) -> String {
    let settings = &results.settings;
    let rows = [
        [
            "real axis of the ellipsoid",
            "“could be manually determined”; by the ellipsoid's equation (§ 2.1, 3.3)",
            "image-up (0, −1, 0). The half-axes x₁ = y₁ make it a solid of revolution about the depth axis, so that its shape names no upright axis",
        ],
        [
            "u",
            "an integer > 4 (§ 2.2); 6 with Fig. 9",
            "each of the list; 6 for the figures of clouds",
        ],
        [
            "depths",
            "25 to 70 cm by 1 cm, “thus 45 point clouds”",
            "all 46, and both sets of 45",
        ],
        [
            "50 times",
            "45 clouds 50 times (§ 3.1); § 3.2 names no repetitions",
            "50 ellipsoids at each depth with random points of their own; the peppers once, and again with other random points of Eq. 3",
        ],
        [
            "points and noise of the ellipsoid",
            "not stated",
            "see above; no noise",
        ],
        [
            "Eq. 3's random points",
            "normally distributed in the vicinity, number not stated",
            "10,000, as widely spread as the cloud",
        ],
        ["k of Eq. 2", "not stated", "30"],
        [
            "peppers",
            "27 scans of Sa et al.",
            "simulated ones with a known axis; the scans are not ours to give",
        ],
        [
            "how they were scanned",
            "KinFu: a moved camera and fused frames, “an incomplete 3D reconstruction (the part located opposite the camera was invisible)”",
            "a depth image every 15° of an arc around the fruit, fused with a voxel grid of 0.2 cm; poses off by 0.2° and 0.1 cm. ±120° shows most of the far side, ±60° and ±90° leave a part of it invisible",
        ],
        [
            "lean",
            "not stated; sweet peppers hang",
            "at most as listed, towards the camera and to a side apart",
        ],
        [
            "viewpoint p_v of a fused scan",
            "(0, 0, 0)",
            "the place in the middle of the arc",
        ],
        [
            "place of the fruit",
            "(3, 5, z₀) cm for the ellipsoid; not stated for the scans",
            "in the middle of the image, 45 cm ahead: the camera of a scan is aimed at its object. Anywhere in the image in one change",
        ],
        [
            "least share of points with a partner",
            "not stated; the scores of a plane are added up",
            "30 %, and a half in the second of each pair of tables",
        ],
        [
            "normals of a fused scan",
            "by Eq. 2, side not stated",
            "turned to the cameras that saw the point; turned to p_v in one change",
        ],
        [
            "reference of § 3.2",
            "from the fruit's center through the peduncle's",
            "the same, with the center of the reading. The error against the true axis stands beside it",
        ],
    ];
    let mut rows: Vec<Vec<String>> = rows.map(strings).into();
    rows.push(vec![
        "filters".into(),
        "an outlier remover and a voxel grid, without numbers".into(),
        format!("{OUTLIER_NEIGHBORS} neighbors and {OUTLIER_STD} standard deviation; 0.2 cm"),
    ]);
    let head = strings(["", "the paper says", "here"]);
    format!(
        "## What is known and what is assumed\n\n{}\n\nHalf-axes 2.5, 2.5 and 2 cm, center (3, 5, z₀) cm, {} visible points; τ = 3/π cm/rad.",
        table(&head, &rows, false),
        settings.points
    )
}

/// Every figure beside the paper's caption, with the command that draws it alone.
fn gallery(results: &Reproduction, figures: &[(PaperFigure, Vec<String>)]) -> String {
    let mut sections = vec!["## The figures".to_owned()];
    for (figure, files) in figures {
        let title = match figure {
            PaperFigure::Map => "The error over coverage and lean".to_owned(),
            other => other.name().replace("fig", "Fig. "),
        };
        let images: Vec<String> = files.iter().map(|file| format!("![{title}]({file})")).collect();
        sections.push(format!(
            "### {title}\n\n> The paper: {}\n\n{} Drawn alone by `axiscope reproduce --figure {}{}`.\n\n{}",
            figure.in_the_paper(),
            figure.here(&results.settings),
            figure.name(),
            results.settings.options(),
            images.join("\n\n")
        ));
    }
    sections.join("\n\n")
}
