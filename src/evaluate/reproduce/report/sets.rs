//! The section on other sets of peppers: how much the mean over 27 of them tells.

use super::{strings, table};
use crate::evaluate::reproduce::findings::{Comparison, PEDUNCLE_VARIANTS, TOLERANCE_DEG};
use crate::evaluate::reproduce::readings::{AS_INTENDED, HALF};
use crate::evaluate::reproduce::{Reproduction, ScannedPeppers, Spread};

/// Writes the section; none unless several sets were scanned.
pub(super) fn section(results: &Reproduction) -> Option<String> {
    let main = results
        .main_peppers()
        .filter(|_| !results.other_sets.is_empty())?;
    let sets: Vec<_> = [main].into_iter().chain(&results.other_sets).collect();
    let by_grid = |reading| {
        let rows: Vec<_> = (results.settings.grid_sizes.iter().enumerate())
            .filter_map(|(grid, u)| row(*u, &comparisons(&sets, grid, reading)))
            .collect();
        let head = strings([
            "",
            "with: mean ± between sets (°)",
            "least to largest (°)",
            "sets below the paper's mean",
            "without: mean ± between sets (°)",
            "least to largest (°)",
            "sets below the paper's mean",
            "both within 1.5°",
        ]);
        table(&head, &rows, true)
    };
    Some(format!(
        "## § 3.2 on other sets of peppers\n\n\
         The same scan ({}, lean at most {}°) of {} sets of {} peppers each, of the seeds {} to {}: the mean over the sets of their mean errors against § 3.2's reference, \
         the standard deviation between the sets, and in how many of them both means are within {TOLERANCE_DEG}° of the paper's {:.2}° (with) and {:.2}° (without the peduncle). \
         What one set gives is as far from what another gives as these columns say. As intended:\n\n{}\n\n\
         With a partner for at least half of the points:\n\n{}",
        main.scan.arc_name(),
        main.scan.lean_deg,
        sets.len(),
        results.settings.peppers,
        main.scan.seed,
        results.other_sets.last()?.scan.seed,
        PEDUNCLE_VARIANTS[1].mean_deg,
        PEDUNCLE_VARIANTS[0].mean_deg,
        by_grid(AS_INTENDED),
        by_grid(HALF),
    ))
}

/// The two means of each set that has both.
fn comparisons(sets: &[&ScannedPeppers], grid: usize, reading: usize) -> Vec<Comparison> {
    let of_set = |set: &&ScannedPeppers| Comparison::of(set, grid, reading);
    sets.iter().filter_map(of_set).collect()
}

fn row(u: usize, compared: &[Comparison]) -> Option<Vec<String>> {
    let count = compared.len();
    let mut cells = vec![format!("u = {u}")];
    // With the peduncle first, as in the other tables.
    for variant in [1, 0] {
        let means = || compared.iter().map(|c| c.cells[variant].to_reference.mean);
        let Spread { mean, std, min, max } = Spread::of(means())?;
        let below = means()
            .filter(|&m| m < PEDUNCLE_VARIANTS[variant].mean_deg)
            .count();
        cells.push(format!("{mean:.1} ± {std:.1}"));
        cells.push(format!("{min:.1} to {max:.1}"));
        cells.push(format!("{below} of {count}"));
    }
    let reproduced = compared.iter().filter(|c| c.reproduces()).count();
    cells.push(format!("{reproduced} of {count}"));
    Some(cells)
}
