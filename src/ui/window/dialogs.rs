//! The desktop's file dialogs, which a thread beside the interface waits for.

use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use crate::app::PeduncleCommand;
use crate::app::peduncle::PedunclePath;
use crate::fruit::PeduncleChoice;
use rfd::{AsyncFileDialog, FileHandle};

/// The answer to a dialog.
pub enum Asked {
    /// Files or folders to open.
    Open(Vec<PathBuf>),
    /// The path for a picture of the view, and its size in pixels.
    SaveImage(PathBuf, [u32; 2]),
    /// The path for the current cloud.
    SaveCloud(PathBuf),
    /// A command with a path for the peduncle.
    Peduncle(PeduncleCommand),
    /// The folder that gets a new one with the results.
    SaveResults(PathBuf),
    /// The reason why no dialog could be shown.
    Failed(String),
}

pub fn open_files(ctx: &egui::Context, answers: &Sender<Asked>) {
    let dialog = AsyncFileDialog::new()
        .set_title("Open point clouds")
        .add_filter("Point clouds (PLY)", &["ply", "PLY"]);
    let answer = dialog.pick_files();
    wait(ctx, answers, async move {
        let paths = answer.await?.iter().map(path_of).collect();
        Some(Asked::Open(paths))
    });
}

pub fn open_folder(ctx: &egui::Context, answers: &Sender<Asked>) {
    let answer = AsyncFileDialog::new()
        .set_title("Open a folder of point clouds")
        .pick_folder();
    wait(ctx, answers, async move {
        Some(Asked::Open(vec![path_of(&answer.await?)]))
    });
}

pub fn save_image(ctx: &egui::Context, answers: &Sender<Asked>, name: &str, size_px: [u32; 2]) {
    let answer = AsyncFileDialog::new()
        .set_title("Save the view")
        .set_file_name(name)
        .add_filter("PNG", &["png"])
        .save_file();
    wait(ctx, answers, async move {
        Some(Asked::SaveImage(path_of(&answer.await?), size_px))
    });
}

/// Asks for the path of a cloud that lies in no file yet.
pub fn save_cloud(ctx: &egui::Context, answers: &Sender<Asked>, name: &str) {
    let answer = AsyncFileDialog::new()
        .set_title("Save the cloud, and its truth beside it")
        .set_file_name(name)
        .add_filter("Point clouds (PLY)", &["ply"])
        .save_file();
    wait(ctx, answers, async move {
        Some(Asked::SaveCloud(path_of(&answer.await?)))
    });
}

/// Asks for the peduncle's file, for the folder of clouds without it, or for the path to save it, by default `name`.
pub fn peduncle_path(ctx: &egui::Context, answers: &Sender<Asked>, wanted: PedunclePath, name: &str) {
    let dialog = AsyncFileDialog::new();
    let clouds = |dialog: AsyncFileDialog| dialog.add_filter("Point clouds (PLY)", &["ply", "PLY"]);
    let choose = |choice| Asked::Peduncle(PeduncleCommand::Choose(choice));
    match wanted {
        PedunclePath::File => {
            let answer = clouds(dialog.set_title("The peduncle's points")).pick_file();
            wait(ctx, answers, async move {
                Some(choose(PeduncleChoice::File(path_of(&answer.await?))))
            });
        }
        PedunclePath::Removed => {
            let title = "The folder of the clouds without their peduncles";
            let answer = dialog.set_title(title).pick_folder();
            wait(ctx, answers, async move {
                Some(choose(PeduncleChoice::Removed(path_of(&answer.await?))))
            });
        }
        PedunclePath::SaveAs => {
            let dialog = clouds(dialog.set_title("Save the peduncle"));
            let answer = dialog.set_file_name(name).save_file();
            wait(ctx, answers, async move {
                let path = path_of(&answer.await?);
                Some(Asked::Peduncle(PeduncleCommand::SaveAs(path)))
            });
        }
    }
}

/// Asks for the folder that gets a new one with the results.
pub fn save_results(ctx: &egui::Context, answers: &Sender<Asked>) {
    let answer = AsyncFileDialog::new()
        .set_title("Save the results in a new folder within")
        .pick_folder();
    wait(ctx, answers, async move {
        Some(Asked::SaveResults(path_of(&answer.await?)))
    });
}

/// The message on a desktop without dialogs, which answers like a person who cancels.
const NO_DIALOG: &str = "This desktop offers no file dialogs (xdg-desktop-portal or zenity would). Drop files on the window, \
                         or name them on the command line; “axiscope render” draws pictures.";

fn path_of(handle: &FileHandle) -> PathBuf {
    handle.path().to_owned()
}

/// Waits for a dialog on a thread of its own. The dialog itself was made on the interface's, as some systems require.
fn wait(
    ctx: &egui::Context,
    answers: &Sender<Asked>,
    answer: impl Future<Output = Option<Asked>> + Send + 'static,
) {
    let ctx = ctx.clone();
    let waiting = answers.clone();
    let thread = std::thread::Builder::new().name("dialog".into()).spawn(move || {
        let asked = Instant::now();
        let answer = pollster::block_on(answer).or_else(|| {
            // No person cancels so quickly: there was no dialog.
            let is_missing = asked.elapsed() < Duration::from_millis(400);
            is_missing.then(|| Asked::Failed(NO_DIALOG.into()))
        });
        if let Some(answer) = answer {
            // The receiver is gone if the window has closed meanwhile.
            let _ = waiting.send(answer);
            ctx.request_repaint();
        }
    });
    if let Err(error) = thread {
        let _ = answers.send(Asked::Failed(format!("No dialog could be shown: {error}.")));
    }
}
