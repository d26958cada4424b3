//! The paper's numbers, ours beside them, and which of them are reproduced.

use super::readings::{AS_INTENDED, HALF};
use super::{PepperErrors, Reproduction, Scan, ScannedPeppers, Spread};

/// The paper's mean error of § 3.1 and Fig. 8, in degrees.
pub(super) const PAPER_FIG_8_DEG: f64 = 6.4710;
/// The ends of the paper's curve in Fig. 8, in degrees.
pub(super) const PAPER_FIG_8_RANGE_DEG: (f64, f64) = (5.0, 8.0);
/// A figure counts as reproduced within this, in degrees.
pub(super) const TOLERANCE_DEG: f64 = 1.5;

/// Beyond this a plane across the axis won rather than one along it, in degrees.
pub(super) const MISSED_DEG: f64 = 45.0;

/// One of the two variants of § 3.2 and its figures in the paper.
pub(super) struct PeduncleVariant {
    /// Its name, as in "peppers with their peduncle".
    pub(super) name: &'static str,
    /// The number of the figure.
    pub(super) figure: u32,
    /// The mean error in degrees.
    pub(super) mean_deg: f64,
    /// The least and the largest error in degrees.
    pub(super) range_deg: (f64, f64),
}

/// Without the peduncle, then with it.
pub(super) const PEDUNCLE_VARIANTS: [PeduncleVariant; 2] = [
    PeduncleVariant {
        name: "without their peduncle",
        figure: 12,
        mean_deg: 7.3729,
        range_deg: (3.6957, 9.3433),
    },
    PeduncleVariant {
        name: "with their peduncle",
        figure: 13,
        mean_deg: 6.9343,
        range_deg: (4.4879, 8.9578),
    },
];

/// The errors of one set of peppers in one variant, on one grid by one reading.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// Against the reference of § 3.2, in degrees.
    pub(super) to_reference: Spread,
    /// Against the true axis, in degrees.
    pub(super) to_truth: Spread,
    /// Of the reference against the true axis, in degrees.
    pub(super) reference_to_truth: Spread,
    /// Of the best candidate against the reference, in degrees.
    pub(super) best_candidate: Spread,
    /// Of the center, in centimeters.
    pub(super) center_off_cm: Spread,
    /// Clouds with an axis.
    pub(super) clouds: usize,
    /// Those whose axis is more than [`MISSED_DEG`] off the reference.
    pub(super) missed: usize,
    /// The errors against the reference of all others.
    pub(super) others: Option<Spread>,
}

impl Cell {
    /// Sums up the errors; `None` if no cloud has an axis.
    pub(super) fn of(
        scanned: &ScannedPeppers,
        grid: usize,
        reading: usize,
        with_peduncle: bool,
    ) -> Option<Self> {
        let errors: Vec<&PepperErrors> = (scanned.peppers.iter())
            .filter_map(|pepper| pepper.variant(with_peduncle).grids[grid][reading].as_ref())
            .collect();
        let spread = |value: fn(&PepperErrors) -> f64| Spread::of(errors.iter().map(|e| value(e)));
        Some(Self {
            to_reference: spread(|e| e.to_reference_deg)?,
            to_truth: spread(|e| e.to_truth_deg)?,
            reference_to_truth: spread(|e| e.reference_to_truth_deg)?,
            best_candidate: spread(|e| e.best_candidate_deg)?,
            center_off_cm: spread(|e| e.center_off_cm)?,
            clouds: errors.len(),
            missed: errors.iter().filter(|e| e.to_reference_deg > MISSED_DEG).count(),
            others: Spread::of((errors.iter().map(|e| e.to_reference_deg)).filter(|&e| e <= MISSED_DEG)),
        })
    }
}

/// The means of both variants under one scan and one u, as intended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Comparison {
    /// The index of the reading.
    pub(super) reading: usize,
    /// The index of u.
    pub(super) grid: usize,
    /// Without the peduncle, then with it.
    pub(super) cells: [Cell; 2],
}

impl Comparison {
    /// Compares a set of peppers on one grid; `None` if a variant has no axis at all.
    pub(super) fn of(scanned: &ScannedPeppers, grid: usize, reading: usize) -> Option<Self> {
        let cell = |with| Cell::of(scanned, grid, reading, with);
        Some(Self {
            reading,
            grid,
            cells: [cell(false)?, cell(true)?],
        })
    }

    /// The larger distance of the two means from the paper's, in degrees.
    pub(super) fn off_deg(&self) -> f64 {
        let pairs = self.cells.iter().zip(&PEDUNCLE_VARIANTS);
        pairs
            .map(|(cell, paper)| (cell.to_reference.mean - paper.mean_deg).abs())
            .fold(0.0, f64::max)
    }

    /// Whether both means are the paper's, within [`TOLERANCE_DEG`].
    pub(super) fn reproduces(&self) -> bool {
        self.off_deg() <= TOLERANCE_DEG
    }
}

impl Reproduction {
    /// The peppers of one scan, if it was run.
    pub(super) fn scanned(&self, scan: &Scan) -> Option<&ScannedPeppers> {
        self.scans.iter().find(|scanned| scanned.scan == *scan)
    }

    /// The peppers of Fig. 12 and 13, if they were scanned.
    pub(super) fn main_peppers(&self) -> Option<&ScannedPeppers> {
        self.scanned(&self.settings.main())
    }

    /// The u and the reading whose means over the peppers of Fig. 12 and 13 come nearest to the paper's.
    pub(super) fn nearest(&self) -> Option<Comparison> {
        let compared = self.compared(self.main_peppers()?);
        compared
            .into_iter()
            .min_by(|a, b| a.off_deg().total_cmp(&b.off_deg()))
    }

    /// One scan on every grid by either partner fraction.
    fn compared(&self, scanned: &ScannedPeppers) -> Vec<Comparison> {
        let grids = 0..self.settings.grid_sizes.len();
        let pairs = grids.flat_map(|grid| [AS_INTENDED, HALF].map(|reading| (grid, reading)));
        pairs
            .filter_map(|(grid, reading)| Comparison::of(scanned, grid, reading))
            .collect()
    }

    /// Every scan, u and partner fraction under which both means of § 3.2 are the paper's.
    pub(super) fn reproducing(&self) -> Vec<(&ScannedPeppers, Comparison)> {
        let of_scan = |scanned| self.compared(scanned).into_iter().map(move |c| (scanned, c));
        self.scans
            .iter()
            .flat_map(of_scan)
            .filter(|(_, c)| c.reproduces())
            .collect()
    }
}

/// The mean error of the upright candidate over the depths, and over the two sets of 45 of them if there are 46.
pub(super) fn upright_means(results: &Reproduction) -> Vec<(String, f64)> {
    let errors: Vec<f64> = results.depths.iter().map(|d| d.upright_deg).collect();
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len() as f64;
    let range = |from: usize, to: usize| {
        let z = &results.settings.depths_cm;
        format!("{} to {} cm, {} depths", z[from], z[to - 1], to - from)
    };
    let count = errors.len();
    let sets = if count == 46 {
        vec![(0, 46), (0, 45), (1, 46)]
    } else {
        vec![(0, count)]
    };
    sets.into_iter()
        .map(|(from, to)| (range(from, to), mean(&errors[from..to])))
        .collect()
}
