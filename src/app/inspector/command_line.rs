//! The command line that draws what the window shows.

use crate::evaluate::TruthChoice;
use crate::fruit::PeduncleChoice;
use crate::method::AxisSource;
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
    // The command knows kinds of references, and not the best known one: that is named by its kind.
    let kind = match (state.many.against, state.reference().map(|axis| &axis.source)) {
        (TruthChoice::Auto, Some(AxisSource::Simulation)) => TruthChoice::Truth,
        (TruthChoice::Auto, Some(AxisSource::Adjudicated | AxisSource::Annotators(_))) => TruthChoice::Manual,
        (TruthChoice::Auto, _) => TruthChoice::Peduncle,
        (chosen, _) => chosen,
    };
    if kind != TruthChoice::Peduncle {
        add("--reference", kind.name().into());
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
    words.extend(request.options());
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
