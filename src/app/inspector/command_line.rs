//! The command line that draws what the window shows.

use crate::evaluate::TruthChoice;
use crate::fruit::PeduncleChoice;
use crate::fruit::Request;
use crate::method::{Aggregation, CenterMethod, NormalSource, Params, Preset, RandomSearch, TAU_CM_PER_RAD};
use crate::view::{Overlay, Theme};

use crate::app::state::{PlaneChoice, State};

/// The words of `render` with the settings that are in force, for a picture of so many pixels: `render`,
/// the cloud, the output and the options. Whatever stands at its default is left out.
pub fn command_line(state: &State, out: &str, size_px: [u32; 2]) -> Vec<String> {
    let cloud = state.source().map(|s| s.path().display().to_string());
    let mut words = vec!["render".to_owned()];
    words.extend(cloud);
    words.extend(["-o".to_owned(), out.to_owned()]);
    let style = state.shown_style();
    let mut add = |option: &str, value: String| words.extend([option.to_owned(), value]);
    let [width_px, height_px] = size_px;
    add("--size", format!("{width_px}x{height_px}"));
    if style.coloring != crate::view::Coloring::Side {
        add("--color", style.coloring.name().into());
    }
    if let PlaneChoice::At { g, h } = state.settings.plane {
        add("--plane", format!("{g},{h}"));
    }
    let overlays: Vec<&str> = Overlay::ALL
        .into_iter()
        .filter(|&overlay| style.overlays.has(overlay))
        .map(Overlay::name)
        .collect();
    let overlays = if overlays.is_empty() {
        "none".into()
    } else {
        overlays.join(",")
    };
    add("--overlays", overlays);
    if state.style.theme == Theme::Light {
        add("--background", "light".into());
    }
    match state.truth {
        TruthChoice::Truth => add("--reference", "truth".into()),
        TruthChoice::Manual => add("--reference", "manual".into()),
        TruthChoice::PeduncleDirection => add("--reference", "peduncle-direction".into()),
        TruthChoice::Auto | TruthChoice::Peduncle => {}
    }
    if let Some(shown) = state.shown() {
        let size = state.style.point_size_in_window(shown.len());
        let scaled = size * super::image::picture_scale(state, height_px);
        add("--point-size", scaled.min(100.0).to_string());
    }
    // Without a failure: a camera is plain numbers.
    if let Ok(camera) = serde_json::to_string(&state.camera) {
        add("--camera", camera);
    }
    if !state.style.eye_dome {
        words.push("--flat".into());
    }
    let mut request = state.settings.request.clone();
    if let Some(path) = state.saved_peduncle() {
        request.peduncle = PeduncleChoice::File(path.to_owned());
    }
    words.extend(analysis_options(&request));
    words
}

/// The options that every analyzing command shares, where they are not at their defaults.
pub fn analysis_options(request: &Request) -> Vec<String> {
    let mut words = Vec::new();
    let params = &request.params;
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
    if let Some(unit) = request.unit {
        add("--unit", unit.symbol().into());
    }
    match request.normals {
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
    if let PeduncleChoice::Removed(folder) = &request.peduncle {
        add("--removed", folder.display().to_string());
    } else if !matches!(request.peduncle, PeduncleChoice::Auto | PeduncleChoice::Points(_)) {
        // Points that were picked have a name once they are saved.
        add("--peduncle", request.peduncle.to_string());
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
    if request.without_peduncle {
        words.push("--without-peduncle".into());
    }
    words
}

/// Words as somebody would type them in a POSIX shell.
pub fn quoted(words: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.,/=+:%@".contains(c);
    let quote = |word: &String| {
        if !word.is_empty() && word.chars().all(plain) {
            word.clone()
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    words.iter().map(quote).collect::<Vec<_>>().join(" ")
}
