//! The paper's experiments (§ 3) on simulated clouds: their errors beside the paper's, as a report with
//! tables and figures.

mod ellipsoids;
mod figures;
mod peppers;
mod readings;
mod report;
mod spread;
mod tables;

use super::TableError;
use crate::charts::FigureError;
use crate::method::AnalysisError;
use crate::parallel::Cancelled;
use crate::peduncle::PeduncleError;
use crate::simulate::SimulateError;

pub use ellipsoids::{EllipsoidDepth, EllipsoidErrors, run_ellipsoids};
pub use peppers::{PepperErrors, PepperVariant, ReproducedPepper, run_peppers};
pub use readings::{READINGS, Reading, ReadingCenter};
pub use spread::Spread;

/// The settings of the experiments.
#[derive(Debug, Clone, PartialEq)]
pub struct ReproduceSettings {
    /// z₀ of § 3.1: the depths of the ellipsoid's center, in centimeters. At least one.
    pub depths_cm: Vec<f64>,
    /// Ellipsoids at each depth, each with random points of its own.
    pub runs: usize,
    /// Visible points of an ellipsoid.
    pub points: usize,
    /// Peppers of § 3.2, each with and without its peduncle.
    pub peppers: usize,
    /// Steps of the candidate grid along each angle.
    pub u: usize,
    /// The seed of everything random.
    pub seed: u64,
}

/// The results of the experiments.
#[derive(Debug, Clone, PartialEq)]
pub struct Reproduction {
    /// Their settings.
    pub settings: ReproduceSettings,
    /// § 3.1, in the order of [`ReproduceSettings::depths_cm`].
    pub depths: Vec<EllipsoidDepth>,
    /// § 3.2.
    pub peppers: Vec<ReproducedPepper>,
}

/// Why an experiment failed.
#[derive(Debug, thiserror::Error)]
pub enum ReproduceError {
    /// A cloud could not be simulated.
    #[error(transparent)]
    Simulate(#[from] SimulateError),
    /// A cloud could not be analyzed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// A simulated pepper has no peduncle to measure against.
    #[error(transparent)]
    Peduncle(#[from] PeduncleError),
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A figure could not be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Reproduction {
    /// The report in Markdown: every reading's errors beside the paper's, and in plain words what could
    /// not be reproduced.
    pub fn report(&self) -> String {
        report::markdown(&self.settings, &self.depths, &self.peppers)
    }

    /// The files of the reproduction, each with its name and bytes: `report.md`, the tables as CSV, and
    /// the figures as SVG and PNG. Without peppers those of § 3.2 are left out.
    ///
    /// # Errors
    /// Returns an error if a table or a figure cannot be made.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, ReproduceError> {
        let mut files = vec![
            ("report.md".to_owned(), self.report().into_bytes()),
            ("ellipsoids.csv".to_owned(), tables::ellipsoids(&self.depths)?),
        ];
        let mut figures = vec![("fig8", figures::error_per_depth(&self.depths))];
        if !self.peppers.is_empty() {
            files.push(("peppers.csv".to_owned(), tables::peppers(&self.peppers)?));
            figures.push(("fig12", figures::error_per_pepper(&self.peppers, true)));
            figures.push(("fig13", figures::error_per_pepper(&self.peppers, false)));
        }
        for (name, figure) in figures {
            files.push((format!("{name}.svg"), figure.svg()?.into_bytes()));
            files.push((format!("{name}.png"), figure.png(1.0)?));
        }
        Ok(files)
    }
}
