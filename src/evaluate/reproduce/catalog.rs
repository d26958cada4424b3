//! The figures of the paper that the program draws, with what the paper shows in each.

use super::readings::AS_INTENDED;
use super::{ReproduceError, ReproduceSettings, Reproduction, clouds, figures};
use crate::charts::Figure;

/// A figure of the paper, or the map of the error that is ours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum PaperFigure {
    /// The simulated ellipsoid.
    Fig3,
    /// Points with and without a visible partner.
    Fig5,
    /// Calculated and real axis of the ellipsoid.
    Fig7,
    /// The error over the ellipsoid's depth.
    Fig8,
    /// Six candidate planes of a pepper.
    Fig9,
    /// The calculated axis of a pepper.
    Fig10,
    /// Calculated axis and reference of a pepper.
    Fig11,
    /// The error of each pepper without its peduncle.
    Fig12,
    /// The error of each pepper with its peduncle.
    Fig13,
    /// The error over coverage and lean; not in the paper.
    Map,
}

/// The experiments that a figure needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Needs {
    /// A cloud or two, made when it is drawn.
    Nothing,
    /// § 3.1.
    Ellipsoids,
    /// The main scan of § 3.2.
    MainScan,
    /// All scans of § 3.2.
    Scans,
}

impl PaperFigure {
    /// All of them, in the paper's order.
    pub const ALL: [Self; 10] = [
        Self::Fig3,
        Self::Fig5,
        Self::Fig7,
        Self::Fig8,
        Self::Fig9,
        Self::Fig10,
        Self::Fig11,
        Self::Fig12,
        Self::Fig13,
        Self::Map,
    ];

    /// The name of its file and of the option that draws it alone.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fig3 => "fig3",
            Self::Fig5 => "fig5",
            Self::Fig7 => "fig7",
            Self::Fig8 => "fig8",
            Self::Fig9 => "fig9",
            Self::Fig10 => "fig10",
            Self::Fig11 => "fig11",
            Self::Fig12 => "fig12",
            Self::Fig13 => "fig13",
            Self::Map => "map",
        }
    }

    /// The experiments that it needs.
    pub fn needs(self) -> Needs {
        match self {
            Self::Fig3 | Self::Fig5 | Self::Fig7 | Self::Fig9 | Self::Fig10 | Self::Fig11 => Needs::Nothing,
            Self::Fig8 => Needs::Ellipsoids,
            Self::Fig12 | Self::Fig13 => Needs::MainScan,
            Self::Map => Needs::Scans,
        }
    }

    /// Whether it is of § 3.2.
    pub(super) fn is_of_peppers(self) -> bool {
        !matches!(self, Self::Fig3 | Self::Fig5 | Self::Fig7 | Self::Fig8)
    }

    /// What the paper's figure shows, by its caption and text.
    pub(super) fn in_the_paper(self) -> &'static str {
        match self {
            Self::Fig3 => {
                "Simulated point cloud 20 cm away from the camera: (a) front view, (b) side view. The part that faces away from the viewpoint is removed."
            }
            Self::Fig5 => {
                "Symmetry planes and visible symmetric partners. (a) A pepper imaged frontally: virtually all of its points (yellow) have symmetric partners (red). (b) Imaged obliquely, with the same plane, now rotated: only the yellow points have a visible partner (red), the green ones have none."
            }
            Self::Fig7 => {
                "Errors between true and calculated symmetry axes of the cloud 20 cm away. Two colors show the symmetry plane; the green line is the calculated axis, the white one the real axis. (a) Close-range view, (b) camera view."
            }
            Self::Fig8 => {
                "Mean error between real and calculated axes for each distance of the simulated cloud: 45 clouds, 50 times. It varies between 5° and 8°, by no more than 3° from 25 to 70 cm, and its mean is 6.4710°."
            }
            Self::Fig9 => {
                "Six effects of u² segmentation (u = 6), the sides of the candidate plane in red and blue; the left picture is the symmetry plane. (a) Without peduncle, (b) with it."
            }
            Self::Fig10 => {
                "Sweet-pepper cloud with the calculated symmetry axis (green, dotted) in different perspectives. (a) Without peduncle, (b) with it."
            }
            Self::Fig11 => {
                "Calculated axes (green) and the axes taken as real, from the fruit's center through the peduncle's (white), from different views. (a) Without peduncle, (b) with it."
            }
            Self::Fig12 => {
                "Errors between calculated and real axes without the peduncle: 3.6957° to 9.3433°, 7.3729° on average."
            }
            Self::Fig13 => {
                "Errors between calculated and real axes with the complete peduncle: 4.4879° to 8.9578°, 6.9343° on average."
            }
            Self::Map => "Not in the paper.",
        }
    }

    /// What our figure shows.
    pub(super) fn here(self, settings: &ReproduceSettings) -> String {
        let main = &settings.main();
        let u = settings.grid_sizes[settings.main_grid()];
        let pepper = format!(
            "the first pepper of the set {}, lean at most {}°, u = {u}, as intended",
            main.arc_name(),
            main.lean_deg
        );
        match self {
            Self::Fig3 => "The same ellipsoid, without noise.".into(),
            Self::Fig5 => "A simulated pepper of four lobes before one camera, and a plane through its true axis, along the line of sight and turned by 45° with the fruit.".into(),
            Self::Fig7 => format!("As intended, u = {u}. The real axis is black here."),
            Self::Fig8 => "Above, the upright candidate alone: its error is Eq. 16's and needs no points. Below, the planes that win. Bands are the standard deviation over the runs.".into(),
            Self::Fig9 => format!("Six of the {} candidates by their rank, of {pepper}. The number is the mean score.", u * u),
            Self::Fig10 => format!("The calculated axis of {pepper}."),
            Self::Fig11 => format!("Calculated axis and § 3.2's reference (black) of {pepper}."),
            Self::Fig12 | Self::Fig13 => format!(
                "{} simulated peppers scanned over {}, lean at most {}°. The upper figure has the paper's u, as intended; the lower one the u and the least partner fraction that come nearest to both of its means.",
                settings.peppers,
                main.arc_name(),
                main.lean_deg
            ),
            Self::Map => "The mean error against § 3.2's reference over both variants, as intended, with a partner for at least half of the points.".into(),
        }
    }

    /// Draws it, each figure with the name of its file: more than one where it is drawn for several u. None where its
    /// experiments were not run.
    ///
    /// # Errors
    /// Returns an error if a cloud for it cannot be made or analyzed.
    pub fn draw(self, results: &Reproduction) -> Result<Vec<(String, Figure)>, ReproduceError> {
        let settings = &results.settings;
        let sample =
            || clouds::SamplePepper::new(&settings.main(), settings.grid_sizes[settings.main_grid()]);
        let of_grid = |grid: usize| format!("{}_u{}", self.name(), settings.grid_sizes[grid]);
        let alone = |figure| vec![(self.name().to_owned(), figure)];
        Ok(match self {
            Self::Fig3 => alone(clouds::fig3(settings)?),
            Self::Fig5 => alone(clouds::fig5(settings)?),
            Self::Fig7 => alone(clouds::fig7(settings)?),
            Self::Fig8 if results.depths.is_empty() => Vec::new(),
            Self::Fig8 => alone(figures::fig8(results)),
            Self::Fig9 => alone(sample()?.fig9()),
            Self::Fig10 => alone(sample()?.fig10()),
            Self::Fig11 => alone(sample()?.fig11()),
            Self::Fig12 | Self::Fig13 => {
                let figure =
                    |grid, reading| figures::error_per_pepper(results, grid, reading, self == Self::Fig13);
                let main = (settings.main_grid(), AS_INTENDED);
                let nearest = results.nearest().map(|c| (c.grid, c.reading));
                let main_figure = figure(main.0, main.1).map(|figure| (self.name().to_owned(), figure));
                let nearest = nearest.filter(|&nearest| nearest != main);
                let nearest =
                    nearest.and_then(|(grid, reading)| Some((of_grid(grid), figure(grid, reading)?)));
                main_figure.into_iter().chain(nearest).collect()
            }
            Self::Map => {
                let grids = 0..settings.grid_sizes.len();
                grids
                    .filter_map(|grid| Some((of_grid(grid), figures::map(results, grid)?)))
                    .collect()
            }
        })
    }
}
