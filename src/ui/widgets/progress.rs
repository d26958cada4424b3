//! The progress of an analysis.

use egui::ProgressBar;

use crate::app::workers::Progress;
use crate::method::Stage;

/// Returns a bar with the running stage, its share that is done, and the seconds from the second one on.
pub fn stage_progress(progress: &Progress) -> ProgressBar {
    let stage = progress.stage.map_or("Reading", stage_name);
    let mut text = format!("{stage} · {:.0} %", 100.0 * progress.share);
    let seconds = progress.elapsed.as_secs();
    if seconds >= 2 {
        text += &format!(" · {seconds} s");
    }
    ProgressBar::new(progress.share as f32).text(text)
}

fn stage_name(stage: Stage) -> &'static str {
    match stage {
        Stage::Filters => "Filters",
        Stage::Normals => "Normals",
        Stage::Center => "Fruit center",
        Stage::PlaneTerms => "Candidate planes",
        Stage::Scores => "Scores",
    }
}
