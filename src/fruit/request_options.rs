//! A request as options of the command line.

use super::{PeduncleChoice, Request};
use crate::method::{Aggregation, CenterMethod, NormalSource, Params, Preset, RandomSearch, TAU_CM_PER_RAD};

impl Request {
    /// Returns the options, shared by all commands that analyze, that ask for the same. Defaults are left out.
    pub fn options(&self) -> Vec<String> {
        let mut words = Vec::new();
        let params = &self.params;
        let mut add = |option: &str, value: String| words.extend([option.to_owned(), value]);
        let preset = match params.aggregation {
            Aggregation::Mean => Preset::AsIntended,
            Aggregation::Sum => Preset::AsPrinted,
        };
        let defaults = Params::new(preset, params.unit);
        if preset != Preset::AsIntended {
            add("--preset", preset.name().into());
        }
        if params.u != defaults.u {
            add("--u", params.u.to_string());
        }
        if params.tau_cm_per_rad != TAU_CM_PER_RAD {
            add("--tau", params.tau_cm_per_rad.to_string());
        }
        if let Some(unit) = self.unit {
            add("--unit", unit.symbol().into());
        }
        match self.normals {
            Some(NormalSource::Estimate) => add("--normals", "estimate".into()),
            Some(NormalSource::File) => add("--normals", "file".into()),
            None => {}
        }
        if params.k != defaults.k {
            add("--k", params.k.to_string());
        }
        if params.center.preset() != Some(preset) {
            let center = match params.center {
                CenterMethod::MeanRms(_) => "mean-rms".into(),
                CenterMethod::Equidistant(_) => "equidistant".into(),
                CenterMethod::Sphere => "sphere".into(),
                CenterMethod::Given(p) => format!("{},{},{}", p.x, p.y, p.z),
            };
            add("--center", center);
        }
        if let Some(search) = params.center.search() {
            let usual = RandomSearch::default();
            if search.count != usual.count {
                add("--center-samples", search.count.to_string());
            }
            if search.spread != usual.spread {
                add("--center-spread", search.spread.to_string());
            }
            if search.seed != usual.seed {
                add("--seed", search.seed.to_string());
            }
        }
        if params.min_partner_fraction != params.aggregation.default_min_partner_fraction() {
            add("--min-partner-fraction", params.min_partner_fraction.to_string());
        }
        if params.viewpoint != defaults.viewpoint {
            let p = params.viewpoint;
            add("--viewpoint", format!("{},{},{}", p.x, p.y, p.z));
        }
        if let PeduncleChoice::Removed(folder) = &self.peduncle {
            add("--removed", folder.display().to_string());
        } else if !matches!(self.peduncle, PeduncleChoice::Auto | PeduncleChoice::Points(_)) {
            // Points that were picked have a name once they are saved.
            add("--peduncle", self.peduncle.to_string());
        }
        if let Some(outliers) = params.filters.outliers {
            add("--outlier-neighbors", outliers.neighbors.to_string());
            add("--outlier-std", outliers.std_ratio.to_string());
        }
        if let Some(edge) = params.filters.voxel_cm {
            add("--voxel-cm", edge.to_string());
        }
        if params.filters.max_points != defaults.filters.max_points {
            add("--max-points", params.filters.max_points.to_string());
        }
        if params.filters.keep_strays {
            words.push("--keep-strays".into());
        }
        if self.without_peduncle {
            words.push("--without-peduncle".into());
        }
        words
    }
}
