//! Files that come from outside: dropped on the window, or chosen in the desktop's dialogs.

use std::path::{Path, PathBuf};

use super::Window;
use super::dialogs::Asked;
use crate::app::many::ManyCommand;
use crate::app::{Command, PeduncleCommand};
use crate::fruit::companion_path;
use crate::ui::action::Act;

impl Window {
    /// Collects the commands for files that were dropped, and for the answers of dialogs.
    pub(super) fn take_files(&mut self, ctx: &egui::Context, acts: &mut Vec<Act>) {
        let dropped: Vec<PathBuf> = ctx.input(|i| {
            let files = i.raw.dropped_files.iter();
            files.map(|file| file.path().to_owned()).collect()
        });
        if let [path] = &dropped[..]
            && is_companion(path)
        {
            let offer = PeduncleCommand::Offer(path.clone());
            acts.push(Act::App(Command::Peduncle(offer)));
        } else if !dropped.is_empty() {
            // A companion comes along with its cloud.
            let has_cloud = |path: &PathBuf| dropped.iter().any(|cloud| companion_path(cloud) == *path);
            let clouds = dropped.iter().filter(|path| !has_cloud(path));
            acts.push(Act::App(Command::Open(clouds.cloned().collect())));
        }
        while let Ok(answer) = self.answers.1.try_recv() {
            acts.push(Act::App(match answer {
                Asked::Open(paths) => Command::Open(paths),
                Asked::SaveImage(path, size_px) => Command::SaveImage { path, size_px },
                Asked::Peduncle(command) => Command::Peduncle(command),
                Asked::SaveCloud(path) => Command::SaveCloud(path),
                Asked::SaveResults(into) => Command::Many(ManyCommand::SaveResults(into)),
                Asked::Failed(text) => Command::Say { is_error: true, text },
            }));
        }
    }
}

/// Whether a file has the name of a companion: `NAME_peduncle.ply`.
fn is_companion(path: &Path) -> bool {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    stem.ends_with("_peduncle")
}
