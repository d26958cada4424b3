//! The paper's experiments (§ 3) on simulated clouds: their errors beside the paper's, as a report with
//! tables and figures.

mod clouds;
mod ellipsoids;
mod figures;
mod findings;
mod peppers;
mod readings;
mod scans;
mod settings;
mod spread;
mod tables;

use super::TableError;
use crate::charts::{Figure, FigureError};
use crate::method::AnalysisError;
use crate::parallel::Cancelled;
use crate::peduncle::PeduncleError;
use crate::simulate::SimulateError;

pub use ellipsoids::{EllipsoidDepth, EllipsoidErrors, run_ellipsoids};
pub use peppers::{PepperErrors, PepperVariant, ReproducedPepper, ScannedPeppers, run_peppers};
pub use readings::{READINGS, Reading, ReadingCenter};
pub use scans::Scan;
pub use settings::{ReproduceSettings, Variation};
pub use spread::Spread;

/// The results of the experiments.
#[derive(Debug, Clone, PartialEq)]
pub struct Reproduction {
    /// Their settings.
    pub settings: ReproduceSettings,
    /// § 3.1, in the order of [`ReproduceSettings::depths_cm`].
    pub depths: Vec<EllipsoidDepth>,
    /// § 3.2, in the order of [`ReproduceSettings::scans`]; empty without peppers.
    pub scans: Vec<ScannedPeppers>,
    /// § 3.2 with one setting changed, in the order of [`ReproduceSettings::variations`]; empty without peppers.
    pub variations: Vec<(Variation, ScannedPeppers)>,
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
    /// The report in Markdown.
    pub fn report(&self) -> String {
        String::new()
    }

    /// The figures with their names.
    fn figures(&self) -> Result<Vec<(String, Figure)>, ReproduceError> {
        let settings = &self.settings;
        let main = settings.main_grid();
        let mut figures = vec![
            ("fig3".to_owned(), clouds::fig3(settings)?),
            ("fig5".to_owned(), clouds::fig5(settings)?),
            ("fig7".to_owned(), clouds::fig7(settings)?),
            ("fig8".to_owned(), figures::fig8(self)),
        ];
        if self.scans.is_empty() {
            return Ok(figures);
        }
        let sample =
            clouds::SamplePepper::new(&self.scans[settings.main_scan()].scan, settings.grid_sizes[main])?;
        figures.push(("fig9".to_owned(), sample.fig9()));
        figures.push(("fig10".to_owned(), sample.fig10()));
        figures.push(("fig11".to_owned(), sample.fig11()));
        for (name, with_peduncle) in [("fig12", false), ("fig13", true)] {
            figures
                .extend(figures::error_per_pepper(self, main, with_peduncle).map(|f| (name.to_owned(), f)));
        }
        for (grid, u) in settings.grid_sizes.iter().enumerate() {
            figures.push((format!("map_u{u}"), figures::map(self, grid)));
        }
        Ok(figures)
    }

    /// The files of the reproduction, each with its name and bytes.
    ///
    /// # Errors
    /// Returns an error if a table or a figure cannot be made.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, ReproduceError> {
        let mut files = vec![
            ("report.md".to_owned(), self.report().into_bytes()),
            ("ellipsoids.csv".to_owned(), tables::ellipsoids(self)?),
            ("peppers.csv".to_owned(), tables::peppers(self)?),
        ];
        for (name, figure) in self.figures()? {
            files.push((format!("{name}.svg"), figure.svg()?.into_bytes()));
            files.push((format!("{name}.png"), figure.png(1.0)?));
        }
        Ok(files)
    }
}
