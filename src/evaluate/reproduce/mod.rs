//! The paper's experiments (§ 3) on simulated clouds: their errors beside the paper's, as a report with
//! tables and figures.

mod catalog;
mod clouds;
mod ellipsoids;
mod figures;
mod findings;
mod page;
mod peppers;
mod readings;
mod report;
mod scans;
mod settings;
mod spread;
mod tables;

use super::TableError;
use crate::charts::FigureError;
use crate::method::AnalysisError;
use crate::parallel::Cancelled;
use crate::peduncle::PeduncleError;
use crate::simulate::SimulateError;

pub use catalog::{Needs, PaperFigure};
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
    /// § 3.2 on other sets of peppers, in the order of [`ReproduceSettings::other_sets`]; empty without peppers.
    pub other_sets: Vec<ScannedPeppers>,
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
    /// The files of one figure, each with its name and bytes, as SVG and PNG. None where the experiments that it needs
    /// were not run.
    ///
    /// # Errors
    /// Returns an error if the figure cannot be made.
    pub fn figure_files(&self, figure: PaperFigure) -> Result<Vec<(String, Vec<u8>)>, ReproduceError> {
        let mut files = Vec::new();
        for (name, figure) in figure.draw(self)? {
            files.push((format!("{name}.svg"), figure.svg()?.into_bytes()));
            files.push((format!("{name}.png"), figure.png(1.0)?));
        }
        Ok(files)
    }

    /// The files of the reproduction, each with its name and bytes: the report as `report.md` and, in one file with its
    /// figures, `report.html`; the tables as CSV; the figures as SVG and PNG. Without peppers those of § 3.2 are
    /// left out.
    ///
    /// # Errors
    /// Returns an error if a table or a figure cannot be made.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, ReproduceError> {
        let mut files = vec![("ellipsoids.csv".to_owned(), tables::ellipsoids(self)?)];
        if !self.scans.is_empty() {
            files.push(("peppers.csv".to_owned(), tables::peppers(self)?));
        }
        let (mut named, mut drawn) = (Vec::new(), Vec::new());
        for figure in PaperFigure::ALL {
            if figure.is_of_peppers() && self.scans.is_empty() {
                continue;
            }
            let mut names = Vec::new();
            for (name, figure) in figure.draw(self)? {
                let (svg, name) = (figure.svg()?, format!("{name}.svg"));
                files.push((name.replace(".svg", ".png"), figure.png(1.0)?));
                files.push((name.clone(), svg.clone().into_bytes()));
                names.push(name.clone());
                drawn.push((name, svg));
            }
            named.push((figure, names));
        }
        let report = report::markdown(self, &named);
        files.push(("report.html".to_owned(), page::page(&report, &drawn).into_bytes()));
        files.push(("report.md".to_owned(), report.into_bytes()));
        Ok(files)
    }
}
