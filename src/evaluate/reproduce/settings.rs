//! The settings of the experiments, and the scans that follow from them.

use super::readings::{AS_INTENDED, EVERY_READING, HALF};
use super::scans::Scan;

/// The u that § 3.2 states with Fig. 9; § 2.2 says u > 4.
pub(super) const PAPER_U: usize = 6;
/// The draws of Eq. 3's random points beside the first.
const OTHER_SEARCHES: [u64; 2] = [1, 2];

/// The settings of the experiments.
#[derive(Debug, Clone, PartialEq)]
pub struct ReproduceSettings {
    /// z₀ of § 3.1: the depths of the ellipsoid's center, in centimeters, ascending. At least one.
    pub depths_cm: Vec<f64>,
    /// Ellipsoids at each depth, each with random points of its own.
    pub runs: usize,
    /// Visible points of an ellipsoid.
    pub points: usize,
    /// Peppers of § 3.2, each with and without its peduncle.
    pub peppers: usize,
    /// Sets of that many peppers in all, under the scan of Fig. 12 and 13: how far apart their means are. At least one.
    pub sets: usize,
    /// Steps of the candidate grid along each angle. At least one.
    pub grid_sizes: Vec<usize>,
    /// Whole arcs of the scans of § 3.2 in degrees; 0 is one view. At least one.
    pub arcs_deg: Vec<f64>,
    /// The largest leans of § 3.2 in degrees. At least one.
    pub leans_deg: Vec<f64>,
    /// The seed of everything random.
    pub seed: u64,
}

/// A setting that is changed to see how much it matters.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// The change, in words.
    pub name: String,
    /// The scan with it.
    pub scan: Scan,
}

/// An option's value as the command line has it.
type Value<'a> = &'a dyn Fn(&ReproduceSettings) -> String;

impl Default for ReproduceSettings {
    /// The paper's depths, runs and number of peppers; one view and three fused scans.
    fn default() -> Self {
        Self {
            depths_cm: (25..=70).map(f64::from).collect(),
            runs: 50,
            points: 1500,
            peppers: 27,
            sets: 8,
            grid_sizes: vec![5, PAPER_U, 7, 10, 12, 14],
            arcs_deg: vec![0.0, 120.0, 180.0, 240.0],
            leans_deg: vec![8.0, 15.0, 30.0],
            seed: 0,
        }
    }
}

impl ReproduceSettings {
    /// The options of the command that differ from the default, each after a space.
    pub(super) fn options(&self) -> String {
        fn list<T: ToString>(values: &[T]) -> String {
            values.iter().map(T::to_string).collect::<Vec<_>>().join(",")
        }
        let depths = |s: &Self| match s.depths_cm[..] {
            [first, second, .., last] => format!("{first}..{last}:{}", second - first),
            [first, last] => format!("{first}..{last}:{}", last - first),
            _ => list(&s.depths_cm),
        };
        let options: [(&str, Value<'_>); 9] = [
            ("z0", &depths),
            ("runs", &|s| s.runs.to_string()),
            ("points", &|s| s.points.to_string()),
            ("peppers", &|s| s.peppers.to_string()),
            ("sets", &|s| s.sets.to_string()),
            ("u", &|s| list(&s.grid_sizes)),
            ("arc", &|s| list(&s.arcs_deg)),
            ("lean", &|s| list(&s.leans_deg)),
            ("seed", &|s| s.seed.to_string()),
        ];
        let default = Self::default();
        let differing = options
            .into_iter()
            .filter(|(_, value)| value(self) != value(&default));
        differing
            .map(|(name, value)| format!(" --{name} {}", value(self)))
            .collect::<Vec<_>>()
            .concat()
    }

    /// The index of the u that the figures are drawn for: the paper's 6, else the first.
    pub(super) fn main_grid(&self) -> usize {
        self.grid_sizes.iter().position(|&u| u == PAPER_U).unwrap_or(0)
    }

    /// The grids of one run of § 3.1: all of them in a tenth of the runs, since 14² planes take their time.
    pub(super) fn grids_of_run(&self, run: usize) -> &[usize] {
        if run < self.runs.div_ceil(10) {
            &self.grid_sizes
        } else {
            let main = self.main_grid();
            &self.grid_sizes[main..=main]
        }
    }

    /// The scans of § 3.2: every arc with every lean.
    pub fn scans(&self) -> Vec<Scan> {
        let of_arc = |&arc_deg| {
            let scan = move |&lean_deg| Scan::new(arc_deg, lean_deg, self.seed);
            self.leans_deg.iter().map(scan)
        };
        self.arcs_deg.iter().flat_map(of_arc).collect()
    }

    /// The scan that Fig. 12 and 13 are drawn for.
    pub fn main(&self) -> Scan {
        self.scans().swap_remove(self.main_scan())
    }

    /// The index in [`Self::scans`] of the scan that Fig. 12 and 13 are drawn for: the arc that is nearest to ±90° and the
    /// least lean.
    fn main_scan(&self) -> usize {
        let scans = self.scans();
        let key = |scan: &Scan| ((scan.arc_deg - 180.0).abs(), scan.lean_deg);
        let order = |&a: &usize, &b: &usize| {
            let (a, b) = (key(&scans[a]), key(&scans[b]));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        (0..scans.len()).min_by(order).unwrap_or(0)
    }

    /// The readings that a scan is analyzed by: all of them for the scan of Fig. 12 and 13 and for one view of the same
    /// fruits, else the intended one.
    pub fn readings_of(&self, scan: &Scan) -> &'static [usize] {
        let main = &self.main();
        let one_view = Scan {
            arc_deg: 0.0,
            ..main.clone()
        };
        if scan == main || *scan == one_view {
            &EVERY_READING
        } else {
            &[AS_INTENDED, HALF]
        }
    }

    /// The scan of Fig. 12 and 13 on the other sets of peppers, whose seeds follow upon the first.
    pub fn other_sets(&self) -> Vec<Scan> {
        let of_set = |set| Scan {
            seed: self.seed.wrapping_add(set),
            ..self.main()
        };
        (1..self.sets as u64).map(of_set).collect()
    }

    /// The changes to the scan of Fig. 12 and 13.
    pub fn variations(&self) -> Vec<Variation> {
        let main = &self.main();
        let mut variations = Vec::new();
        let mut vary = |name: String, change: &dyn Fn(&mut Scan)| {
            let mut scan = main.clone();
            change(&mut scan);
            variations.push(Variation { name, scan });
        };
        for search in OTHER_SEARCHES {
            vary(
                format!("other random points of Eq. 3 (draw {})", search + 1),
                &|scan| {
                    scan.search = search;
                },
            );
        }
        vary("every normal turned to p_v".to_owned(), &|scan| {
            scan.normals_to_viewpoint = true;
        });
        vary("camera poses without error".to_owned(), &|scan| {
            scan.pose_noise = 0.0;
        });
        vary("three times the error of the camera poses".to_owned(), &|scan| {
            scan.pose_noise = 3.0;
        });
        vary("voxel grid of 0.3 cm".to_owned(), &|scan| scan.voxel_cm = 0.3);
        vary("the fruit anywhere in the image".to_owned(), &|scan| {
            scan.anywhere = true;
        });
        variations
    }
}
